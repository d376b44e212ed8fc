#include "calibration/sway_frequency.hpp"

#include <cmath>

#include "calibration/static_stiffness.hpp"
#include "calibration/sway.hpp"
#include "core/error.hpp"

namespace frond {

namespace {

// Rayleigh's quotient of a shape: phi.K phi over phi.M phi.
struct Bent {
    VecX shape;  // empty: nothing moves
    double stiffness = 0, mass = 0;
    double square() const { return stiffness / mass; }  // square of the angular frequency [1/s^2]
};

// Returns the slower of the two shapes into which the weight bends the body when applied sideways.
Bent find_sway(const System& system, StaticStiffness& stiffness, const std::vector<uint8_t>& still) {
    const Elements& elements = elements_of(system);
    const VecX& mass = node_mass_of(system);
    Bent slowest;
    for (int axis : {0, 2}) {
        VecX load = VecX::Zero(elements.modelled.size());
        for (int i = 0; i < elements.node_count; i++)
            if (!still[size_t(i)]) point(load, i)[axis] = mass[i];
        Bent sway;
        solve(stiffness.factor, load, sway.shape);
        for (int i = 0; i < elements.node_count; i++) sway.mass += mass[i] * point(sway.shape, i).squaredNorm();
        sway.stiffness = load.dot(sway.shape);
        if (sway.mass > 0 && (slowest.mass == 0 || sway.square() < slowest.square())) slowest = sway;
    }
    return slowest;
}

}  // namespace

double sway_frequency(const std::shared_ptr<const Model>& model) {
    const std::shared_ptr<const System> system = make_system(model, FROND_MECHANICS_ROD, FROND_MASS_LUMPED);
    const Elements& elements = elements_of(*system);
    const std::vector<uint8_t> still = still_nodes(*model, elements, true);
    StaticStiffness stiffness(elements.pattern);
    if (!stiffness.set(elements, still, FROND_MECHANICS_ROD, Tangent::positive, elements.modelled))
        fail(FROND_RESULT_BAD_GEOMETRY, "the plant's rods have no stiffness; check its materials and radii");
    const Bent sway = find_sway(*system, stiffness, still);
    if (sway.mass == 0)
        fail(FROND_RESULT_BAD_GEOMETRY, "the plant has no part that could sway: its chain is a root alone");
    return std::sqrt(sway.square()) / (2 * PI);
}

double full_damping(const System& system, frond_mechanics which, int order) {
    const Elements& elements = elements_of(system);
    const Mechanics& row = mechanics(which, order);
    const std::vector<uint8_t> still = still_nodes(model_of(system), elements, row.moves_chain);
    StaticStiffness stiffness(elements.pattern);
    // Take the stiffness under weight if the body is stable there.
    if (!stiffness.set(elements, still, row, Tangent::exact, elements.modelled) &&
        !stiffness.set(elements, still, row, Tangent::positive, elements.modelled))
        return 0;
    const Bent sway = find_sway(system, stiffness, still);
    if (!(sway.mass > 0) || !(sway.stiffness > 0)) return 0;

    BlockMatrix& K = stiffness.K;
    K.set_zero();
    row.add_stiffness(elements, elements.modelled, Tangent::positive, 1, K);
    VecX force;
    K.multiply(sway.shape, force);
    const double b = 2 * std::sqrt(sway.square()) * sway.mass / sway.shape.dot(force);
    return std::isfinite(b) ? b : 0;
}

}  // namespace frond
