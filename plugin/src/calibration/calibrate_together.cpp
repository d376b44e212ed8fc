// Organs that cannot be calibrated alone, because their tets are scattered among those of others, get one factor
// together: under equal loads elastic energy is inversely proportional to modulus, so the factor is the ratio of
// energies, cage over rods, under the plant's weight along each of the three axes.
#include <algorithm>

#include "calibration/calibrate_together.hpp"
#include "calibration/chain_loads.hpp"
#include "calibration/static_stiffness.hpp"
#include "mechanics/tet_element.hpp"

namespace frond {
namespace {

// Returns the elastic energy of organs' rods under weight along an axis [J].
double rod_energy(const Model& model, int axis, const std::vector<char>& left_out) {
    const ChainLoads loads = weigh_chain(model, axis);
    double sum = 0;
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const size_t organ = size_t(model.chain.nodes[i].organ);
        if (model.chain.nodes[i].parent < 0 || left_out[organ]) continue;
        const Section& section = model.sections[i];
        const Vec3& M = loads.moment[i];
        const auto share = [&](double load, double stiffness) { return load * load / stiffness; };
        sum += section.length / (2 * model.organ_stiffer[organ]) *
               (share(M.dot(section.wide()), section.bending_thin()) +
                share(M.dot(section.thin), section.bending_wide()) + share(M.dot(section.axis), section.twisting()) +
                share(loads.force[i].dot(section.axis), section.stretching()));
    }
    return sum;
}

// Returns the elastic energy of organs' tets for displaced nodes [J].
double cage_energy(const Model& model, const TetElements& elements, const VecX& moved,
                   const std::vector<char>& left_out) {
    double sum = 0;
    for (size_t e = 0; e < elements.tets.size(); e++) {
        if (left_out[size_t(model.cage.tet_organ[e])]) continue;
        take_gradients(elements, e, moved, [&](const TetShare& share, const Mat3& F) {
            const double swelling = F.trace();
            sum += share.volume *
                   (share.mu * (0.5 * (F + F.transpose())).squaredNorm() + 0.5 * share.lambda * swelling * swelling +
                    0.5 * share.grain * share.mu * stretch_along(share, F) * stretch_along(share, F));
        });
    }
    return sum;
}

}  // namespace

void calibrate_together(Model& model, const std::vector<char>& alone, int order) {
    constexpr int ROUNDS = 4;               // each multiplies moduli by what is lacking, so few are enough
    constexpr double LARGEST_FACTOR = 1e6;  // on a modulus in a round [-]
    if (std::all_of(alone.begin(), alone.end(), [](char is) { return is; })) return;
    double rods = 0;
    for (int axis = 0; axis < 3; axis++) rods += rod_energy(model, axis, alone);
    TetElements elements = make_tet_elements(model, nullptr, order);
    StaticStiffness stiffness(elements.pattern);
    const Mechanics& row = mechanics(FROND_MECHANICS_TET_LINEAR, order);
    const std::vector<uint8_t> held = with_middles(elements.nodes, model.root);
    const VecX masses = row.masses(elements, FROND_MASS_LUMPED).node;
    VecX load(elements.rest_positions.size()), moved(load.size());
    for (int round = 0; round < ROUNDS; round++) {
        if (!stiffness.set(elements, held, row, Tangent::positive, elements.rest_positions)) return;
        double cage = 0;
        for (int axis = 0; axis < 3; axis++) {
            load.setZero();
            for (size_t i = 0; i < held.size(); i++)
                if (!held[i]) load[3 * Eigen::Index(i) + axis] = GRAVITY * masses[Eigen::Index(i)];
            solve(stiffness.factor, load, moved);
            cage += cage_energy(model, elements, moved, alone);
        }
        if (!(rods > 0 && cage > 0)) return;
        const double factor = std::clamp(cage / rods, 1 / LARGEST_FACTOR, LARGEST_FACTOR);
        for (size_t e = 0; e < model.tet_young.size(); e++) {
            if (alone[size_t(model.cage.tet_organ[e])]) continue;
            model.tet_young[e] *= factor;
            elements.mu[e] *= factor;
            elements.lambda[e] *= factor;
        }
    }
}

}  // namespace frond
