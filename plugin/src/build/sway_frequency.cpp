#include "build/sway_frequency.hpp"

#include <algorithm>
#include <cmath>

#include "build/firm_tets.hpp"
#include "build/static_stiffness.hpp"
#include "core/error.hpp"

namespace frond {

namespace {

// Nodes that do not sway: those of the chain's roots, which are pairs of a place and a rotation; or of a cage those that
// the ground holds or that swing on a hinge.
std::vector<uint8_t> still_nodes(const Model& model, const Elements& elements, bool moves_chain) {
    std::vector<uint8_t> still(size_t(elements.node_count), 0);
    if (moves_chain) {
        for (size_t i = 0; i < model.chain.nodes.size(); i++)
            if (model.chain.nodes[i].parent < 0) still[2 * i] = still[2 * i + 1] = 1;
        return still;
    }
    const TetNodes& nodes = static_cast<const TetElements&>(elements).nodes;
    std::vector<uint8_t> held = find_held_nodes(model.cage, model.root);
    // A foot so slender that it counts as a hinge holds nothing: then it is taken at its word.
    if (std::all_of(held.begin(), held.end(), [](uint8_t h) { return h; })) held = model.root;
    std::copy(held.begin(), held.end(), still.begin());
    for (size_t k = 0; k < nodes.edges.size(); k++)
        still[held.size() + k] = held[size_t(nodes.edges[k][0])] && held[size_t(nodes.edges[k][1])];
    return still;
}

// Sums over a shape: phi.K phi, phi.M phi.
struct Sway {
    VecX shape;  // empty: nothing moves
    double stiffness = 0, mass = 0;
    double square() const { return stiffness / mass; }  // of the angular frequency [1/s^2]
};

// The slower of the two into which the weight bends the body when it is taken sideways.
Sway find_sway(const System& system, StaticStiffness& stiffness, const std::vector<uint8_t>& still) {
    const Elements& elements = elements_of(system);
    const VecX& mass = node_mass_of(system);
    Sway slowest;
    for (int axis : {0, 2}) {
        VecX load = VecX::Zero(elements.modelled.size());
        for (int i = 0; i < elements.node_count; i++)
            if (!still[size_t(i)]) point(load, i)[axis] = mass[i];
        Sway sway;
        solve(*stiffness.factor, load, sway.shape);
        for (int i = 0; i < elements.node_count; i++) sway.mass += mass[i] * point(sway.shape, i).squaredNorm();
        sway.stiffness = load.dot(sway.shape);
        if (sway.mass > 0 && (slowest.mass == 0 || sway.square() < slowest.square())) slowest = sway;
    }
    return slowest;
}

}  // namespace

double sway_frequency(const std::shared_ptr<const Model>& model) {
    const std::shared_ptr<const System> system = make_system(model, FROND_ROD, FROND_LUMPED);
    const Elements& elements = elements_of(*system);
    const std::vector<uint8_t> still = still_nodes(*model, elements, true);
    StaticStiffness stiffness(elements.pattern);
    if (!stiffness.set(elements, still, FROND_ROD, Tangent::positive, elements.modelled))
        fail(FROND_BAD_GEOMETRY, "the plant's rods have no stiffness; check its materials and radii");
    const Sway sway = find_sway(*system, stiffness, still);
    if (sway.mass == 0)
        fail(FROND_BAD_GEOMETRY, "the plant has no part that could sway: its chain is a root alone");
    return std::sqrt(sway.square()) / (2 * M_PI);
}

double full_damping(const System& system, frond_mechanics which, int order) {
    const Elements& elements = elements_of(system);
    const Mechanics& row = mechanics(which, order);
    const std::vector<uint8_t> still = still_nodes(model_of(system), elements, row.moves_chain);
    StaticStiffness stiffness(elements.pattern);
    // Under weight where the body is stable there.
    if (!stiffness.set(elements, still, row, Tangent::exact, elements.modelled) &&
        !stiffness.set(elements, still, row, Tangent::positive, elements.modelled))
        return 0;
    const Sway sway = find_sway(system, stiffness, still);
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
