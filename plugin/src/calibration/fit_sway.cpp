// In: a plant whose organs were calibrated one by one, as it stands under its weight. Out: the change of its moduli
// with which its first modes are as fast as its rods'.
//
// Moduli that are right for each organ alone are not for the plant: where organs meet, cells are shared and copies of
// them overlap, and weight takes more from a coarse cage's stiffness than from a rod's. By Rayleigh's principle the
// derivative of the square of a mode's frequency by the logarithm of a tet's modulus is the tet's elastic energy in the
// mode, and the force that weight exerts is the same whatever the moduli are. Only what carries the plant is pulled, as
// leaves that are too stiff in a cage, and in resonance with a stem there, would be taken for it.
#include "calibration/fit_sway.hpp"

#include <algorithm>

#include "calibration/least_change.hpp"
#include "calibration/static_stiffness.hpp"
#include "core/elementary.hpp"
#include "mechanics/polar.hpp"
#include "mechanics/rod_elements.hpp"
#include "mechanics/tet_element.hpp"

namespace frond {

// Returns for each organ whether another one grows out of it.
static std::vector<char> bearing_organs(const Model& model) {
    std::vector<char> bears(model.organs.size(), 0);
    for (const ChainNode& node : model.chain.nodes) {
        if (node.parent < 0) continue;
        const int below = model.chain.nodes[size_t(node.parent)].organ;
        if (below >= 0 && below != node.organ) bears[size_t(below)] = 1;
    }
    return bears;
}

// Returns twice the elastic energy of each organ's segments in a motion from the modelled shape.
static VecX energies_of(const Model& model, const RodElements& elements, const VecX& shape) {
    constexpr double SMALL = 1e-4;  // largest displacement or rotation by which strains are measured [m], [-]
    const double scale = SMALL / shape.lpNorm<Eigen::Infinity>();
    const std::vector<RodStrain> before = rod_strains(elements, elements.modelled);
    const std::vector<RodStrain> after = rod_strains(elements, elements.modelled + scale * shape);
    VecX energies = VecX::Zero(Eigen::Index(model.organs.size()));
    for (size_t s = 0; s < elements.segments.size(); s++) {
        const RodSegment& rod = elements.segments[s];
        const Vec3 strain = (after[s].strain - before[s].strain) / scale;
        const Vec3 curvature = (after[s].curvature - before[s].curvature) / scale;
        energies[std::max(model.chain.nodes[size_t(rod.b)].organ, 0)] +=
            rod.length * (strain.cwiseAbs2().dot(rod.stretch) + curvature.cwiseAbs2().dot(rod.bend));
    }
    return energies;
}

RodSways find_sways(const Model& model, const RodElements& elements, frond_mechanics which) {
    constexpr double MUCH = 0.1;  // share of a mode's elastic energy [-]
    RodSways sways;
    sways.carries.assign(model.organs.size(), 0);
    const std::vector<char> bears = bearing_organs(model);
    const Mechanics& row = mechanics(which);
    const std::vector<uint8_t> still = still_nodes(model, elements, true);
    StaticStiffness stiffness(elements.pattern);
    if (!stiffness.set(elements, still, row, Tangent::exact, elements.modelled)) return sways;
    const VecX mass = row.masses(elements, FROND_MASS_LUMPED).node;
    for (const Sway& sway : first_sways(stiffness.factor, mass, still)) {
        if (sway.shape.size() == 0) continue;
        const VecX energies = energies_of(model, elements, sway.shape);
        for (size_t o = 0; o < sways.carries.size(); o++)
            if (bears[o] && energies[Eigen::Index(o)] > MUCH * energies.sum()) sways.carries[o] = 1;
    }
    std::vector<uint8_t> left_out = still;
    for (size_t i = 0; i < model.chain.nodes.size(); i++)
        if (!sways.carries[size_t(std::max(model.chain.nodes[i].organ, 0))]) left_out[2 * i] = left_out[2 * i + 1] = 1;
    const std::array<Sway, 2> found = first_sways(stiffness.factor, mass, still, left_out);
    for (size_t i = 0; i < found.size(); i++) {
        if (found[i].shape.size() == 0) continue;
        sways.square[i] = found[i].square;
        sways.direction[i] = found[i].direction;
        sways.energies[i] = energies_of(model, elements, found[i].shape);
    }
    return sways;
}

// Returns twice the elastic energy of each tet in a motion from x.
static VecX energies_of(const TetElements& elements, frond_mechanics which, const VecX& x, const VecX& shape) {
    VecX energies = VecX::Zero(Eigen::Index(elements.tets.size()));
    for (size_t e = 0; e < elements.tets.size(); e++) {
        std::vector<Mat3> turned;  // one per point
        take_gradients(elements, e, x, [&](const TetShare&, const Mat3& F) {
            turned.push_back(which == FROND_MECHANICS_TET_LINEAR ? Mat3(Mat3::Identity())
                                                                 : polar_decomposition(F).rotation);
        });
        size_t q = 0;
        take_gradients(elements, e, shape, [&](const TetShare& share, const Mat3& change) {
            const Mat3 gradient = turned[q++].transpose() * change;
            const Mat3 strain = 0.5 * (gradient + gradient.transpose());
            const double along = stretch_along(share, gradient);
            energies[Eigen::Index(e)] +=
                share.volume * (2 * share.mu * strain.squaredNorm() + share.lambda * strain.trace() * strain.trace() +
                                share.grain * share.mu * along * along);
        });
    }
    return energies;
}

// Returns the nodes that are still or of no organ that carries the plant.
static std::vector<uint8_t> nodes_of_others(const Model& model, const TetElements& elements,
                                            const std::vector<uint8_t>& still, const std::vector<char>& carries) {
    std::vector<uint8_t> others(still.size(), 1);
    for (size_t e = 0; e < elements.tets.size(); e++) {
        if (!carries[size_t(model.cage.tet_organ[e])]) continue;
        const ElementNodes nodes = element_nodes(elements, e);
        for (size_t n = 0; n < nodes.count; n++) others[size_t(nodes.node[n])] = still[size_t(nodes.node[n])];
    }
    return others;
}

SwayGap find_gap(const Model& model, const TetElements& elements, frond_mechanics which, const VecX& x,
                 BlockFactor& stiffness, const std::vector<uint8_t>& still, const RodSways& rods, const VecX& done) {
    constexpr double FARTHEST = 1.8;      // total change of a logarithm [-]
    constexpr double LARGEST_STEP = 0.7;  // change of a logarithm [-]
    constexpr double RIGID = 0.01;        // weight of a change relative to an error [-]
    const VecX mass = mechanics(which, elements.nodes.order).masses(elements, FROND_MASS_LUMPED).node;
    std::array<Sway, 2> sways =
        first_sways(stiffness, mass, still, nodes_of_others(model, elements, still, rods.carries));
    // A cage may be the slower one in the direction in which its rods are the faster ones.
    const auto alike = [&](size_t i) { return std::abs(sways[0].direction.dot(rods.direction[i])); };
    if (alike(0) < alike(1)) std::swap(sways[0], sways[1]);
    VecX errors = VecX::Zero(Eigen::Index(sways.size()));
    MatX slope = MatX::Zero(errors.size(), Eigen::Index(elements.tets.size()));
    for (size_t i = 0; i < sways.size(); i++) {
        const Sway& sway = sways[i];
        if (!(rods.square[i] > 0) || sway.shape.size() == 0) continue;
        errors[Eigen::Index(i)] = frond::log(rods.square[i] / sway.square);
        slope.row(Eigen::Index(i)) = energies_of(elements, which, x, sway.shape).transpose() / sway.square;
    }
    for (size_t e = 0; e < elements.tets.size(); e++)
        if (!rods.carries[size_t(model.cage.tet_organ[e])]) slope.col(Eigen::Index(e)).setZero();
    if (!errors.allFinite() || !slope.allFinite()) return {};
    return {errors.lpNorm<Eigen::Infinity>(), least_change(slope, errors, (-FARTHEST - done.array()).max(-LARGEST_STEP),
                                                           (FARTHEST - done.array()).min(LARGEST_STEP), RIGID)};
}

}  // namespace frond
