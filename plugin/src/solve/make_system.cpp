// In: a model and how mass is given to nodes. Out: elements, mass matrix and elimination order.
#include <cmath>

#include "core/error.hpp"
#include "solve/system.hpp"

namespace frond {

namespace {

// Lumped: a quarter of the tet to each node. Consistent: the shape functions' own products, V rho / 20 (1 + delta).
void make_mass(System& system, frond_mass mass) {
    const TetElements& elements = system.elements;
    system.lumped = mass == FROND_LUMPED;
    system.node_mass = VecX::Zero(elements.node_count);
    system.slot_mass.assign(elements.pattern.row.size(), 0.0);
    for (size_t e = 0; e < elements.ordered.size(); ++e) {
        const double tet_mass = elements.volume[e] * elements.density[e];
        for (size_t a = 0; a < 4; ++a) {
            system.node_mass[elements.ordered[e][a]] += tet_mass / 4;
            for (size_t b = 0; b <= a; ++b) {
                const size_t slot = size_t(elements.slots[e][4 * a + b]);
                if (system.lumped)
                    system.slot_mass[slot] += a == b ? tet_mass / 4 : 0.0;
                else
                    system.slot_mass[slot] += tet_mass / (a == b ? 10 : 20);
            }
        }
    }
}

}  // namespace

std::shared_ptr<const System> make_system(std::shared_ptr<const Model> model, frond_mechanics which, frond_mass mass) {
    if (!model) fail(FROND_INTERNAL, "a system was asked for without a model");
    if (mass < 0 || mass >= FROND_MASS_COUNT) fail(FROND_BAD_ARGUMENT, "there is no mass of number %d", int(mass));
    if (which < 0 || which >= FROND_MECHANICS_COUNT) fail(FROND_BAD_ARGUMENT, "there is no mechanics %d", int(which));
    auto system = std::make_shared<System>();
    system->model = std::move(model);
    const VecX& rest = system->model->rest_positions[size_t(which)];
    system->elements = make_tet_elements(*system->model, rest.size() ? &rest : nullptr);
    make_mass(*system, mass);

    // A node without tets would make the matrix singular.
    for (double m : system->node_mass) system->loose.push_back(!(m > 0));
    const Eigen::Map<const Eigen::Matrix3Xd> nodes(system->elements.rest_positions.data(), 3,
                                                   system->elements.node_count);
    system->size = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).maxCoeff();
    system->plan = make_direct_plan(system->elements.pattern);
    return system;
}

const TetElements& elements_of(const System& system) {
    return system.elements;
}
const VecX& node_mass_of(const System& system) {
    return system.node_mass;
}

void multiply_mass(const System& system, const VecX& v, VecX& y) {
    const BlockPattern& pattern = system.elements.pattern;
    y.resize(v.size());
    if (system.lumped) {
        for (int i = 0; i < pattern.node_count; ++i) point(y, i) = system.node_mass[i] * point(v, i);
        return;
    }
    y.setZero();
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)];
            point(y, i) += system.slot_mass[size_t(k)] * point(v, j);
            if (i != j) point(y, j) += system.slot_mass[size_t(k)] * point(v, i);
        }
}

double kinetic_energy(const System& system, const VecX& v) {
    VecX momentum;
    multiply_mass(system, v, momentum);
    return 0.5 * v.dot(momentum);
}

}  // namespace frond
