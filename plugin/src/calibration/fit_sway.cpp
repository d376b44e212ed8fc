// In: a plant whose organs were calibrated one by one, as it stands under its weight. Out: the change of its moduli
// with which its first modes are as fast as its rods'.
//
// Moduli that are right for each organ alone are not for the plant: where organs meet, cells are shared and copies of
// them overlap, and weight takes more from a coarse cage's stiffness than from a rod's. By Rayleigh's principle the
// derivative of the square of a mode's frequency by the logarithm of a tet's modulus is the tet's elastic energy in the
// mode, and the force that weight exerts is the same whatever the moduli are.
#include "calibration/fit_sway.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/least_change.hpp"
#include "calibration/static_stiffness.hpp"
#include "core/elementary.hpp"
#include "mechanics/polar.hpp"
#include "mechanics/rod_elements.hpp"
#include "mechanics/tet_element.hpp"

namespace frond {

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

// Returns the momentum of a mode at a velocity of one. Of a chain every second node is a rotation.
static Vec3 momentum_of(const VecX& mass, const VecX& shape, int nodes_per_place) {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < int(mass.size()); i += nodes_per_place) sum += mass[i] * point(shape, i);
    return sum;
}

RodSways find_sways(const Model& model, const RodElements& elements, frond_mechanics which) {
    RodSways sways;
    sways.share = VecX::Zero(Eigen::Index(model.organs.size()));
    const Mechanics& row = mechanics(which);
    const std::vector<uint8_t> still = still_nodes(model, elements, true);
    StaticStiffness stiffness(elements.pattern);
    if (!stiffness.set(elements, still, row, Tangent::exact, elements.modelled)) return sways;
    const VecX mass = row.masses(elements, FROND_MASS_LUMPED).node;
    const std::array<Sway, 2> found = first_sways(stiffness.factor, mass, still);
    for (size_t i = 0; i < found.size(); i++) {
        if (found[i].shape.size() == 0) continue;
        sways.square[i] = found[i].square;
        sways.momentum[i] = momentum_of(mass, found[i].shape, 2);
        const VecX energies = sways.energies[i] = energies_of(model, elements, found[i].shape);
        sways.share = sways.share.cwiseMax(energies / energies.sum());
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
            energies[Eigen::Index(e)] +=
                share.volume * (2 * share.mu * strain.squaredNorm() + share.lambda * strain.trace() * strain.trace());
        });
    }
    return energies;
}

// Brings a cage's modes into the order of the rods': each to the one that moves the plant in its direction. The order
// of their frequencies is no guide, since a cage's slower sway may be the one across.
static void pair_with(const RodSways& rods, const VecX& mass, std::array<Sway, 2>& sways) {
    if (sways[0].shape.size() == 0 || sways[1].shape.size() == 0) return;
    const Vec3 first = momentum_of(mass, sways[0].shape, 1), second = momentum_of(mass, sways[1].shape, 1);
    const double kept = std::abs(first.dot(rods.momentum[0])) + std::abs(second.dot(rods.momentum[1]));
    const double swapped = std::abs(first.dot(rods.momentum[1])) + std::abs(second.dot(rods.momentum[0]));
    if (swapped > kept) std::swap(sways[0], sways[1]);
}

SwayGap find_gap(const Model& model, const TetElements& elements, frond_mechanics which, const VecX& x,
                 BlockFactor& stiffness, const std::vector<uint8_t>& still, const RodSways& rods, const VecX& done) {
    constexpr double FARTHEST = 1.8;      // total change of a logarithm [-]
    constexpr double LARGEST_STEP = 0.7;  // change of a logarithm [-]
    constexpr double RIGID = 0.01;        // weight of a change relative to an error [-]
    const VecX mass = mechanics(which, elements.nodes.order).masses(elements, FROND_MASS_LUMPED).node;
    std::array<Sway, 2> sways = first_sways(stiffness, mass, still);
    pair_with(rods, mass, sways);
    VecX errors = VecX::Zero(Eigen::Index(sways.size()));
    MatX slope = MatX::Zero(errors.size(), Eigen::Index(elements.tets.size()));
    for (size_t i = 0; i < sways.size(); i++) {
        const Sway& sway = sways[i];
        if (!(rods.square[i] > 0) || sway.shape.size() == 0) continue;
        errors[Eigen::Index(i)] = frond::log(rods.square[i] / sway.square);
        slope.row(Eigen::Index(i)) = energies_of(elements, which, x, sway.shape).transpose() / sway.square;
    }
    if (!errors.allFinite() || !slope.allFinite()) return {};
    // An organ changes as it carries the rods' sways: a leaf that is in resonance with the stem has much of a cage's
    // sway and is right as it is.
    VecX ease(slope.cols());
    for (Eigen::Index e = 0; e < slope.cols(); e++) ease[e] = std::sqrt(rods.share[model.cage.tet_organ[size_t(e)]]);
    const VecX least = (-FARTHEST - done.array()).max(-LARGEST_STEP),
               most = (FARTHEST - done.array()).min(LARGEST_STEP);
    const VecX change =
        least_change(slope * ease.asDiagonal(), errors, least.cwiseQuotient(ease), most.cwiseQuotient(ease), RIGID);
    return {errors.lpNorm<Eigen::Infinity>(), change.cwiseProduct(ease)};
}

}  // namespace frond
