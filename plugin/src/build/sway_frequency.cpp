#include "build/sway_frequency.hpp"

#include <cmath>

#include "build/static_stiffness.hpp"
#include "core/error.hpp"
#include "solve/solve.hpp"

namespace frond {

double sway_frequency(const std::shared_ptr<const Model>& model) {
    const std::shared_ptr<const System> system = make_system(model, FROND_ROD, FROND_LUMPED);
    const Elements& elements = elements_of(*system);
    const VecX& mass = node_mass_of(*system);
    // Nodes are pairs of a chain node's place and rotation.
    std::vector<uint8_t> held(size_t(elements.node_count), 0);
    for (size_t i = 0; i < model->chain.nodes.size(); i++)
        if (model->chain.nodes[i].parent < 0) held[2 * i] = held[2 * i + 1] = 1;
    StaticStiffness stiffness(elements.pattern);
    if (!stiffness.set(elements, held, FROND_ROD, Tangent::positive, elements.modelled))
        fail(FROND_BAD_GEOMETRY, "the plant's rods have no stiffness; check its materials and radii");

    double slowest = INFINITY;
    for (int axis : {0, 2}) {
        VecX load = VecX::Zero(elements.modelled.size()), bent;
        for (int i = 0; i < elements.node_count; i++)
            if (!held[size_t(i)]) point(load, i)[axis] = mass[i];
        solve(*stiffness.factor, load, bent);
        double moved = 0;
        for (int i = 0; i < elements.node_count; i++) moved += mass[i] * point(bent, i).squaredNorm();
        if (moved > 0) slowest = std::min(slowest, load.dot(bent) / moved);
    }
    if (!std::isfinite(slowest))
        fail(FROND_BAD_GEOMETRY, "the plant has no part that could sway: its chain is a root alone");
    return std::sqrt(slowest) / (2 * M_PI);
}

}  // namespace frond
