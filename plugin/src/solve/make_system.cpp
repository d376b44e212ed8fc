// In: a model and the kind of mass matrix. Out: elements, mass matrix and elimination order.
#include <algorithm>
#include <cmath>

#include "core/assert.hpp"
#include "core/error.hpp"
#include "core/product.hpp"
#include "solve/system.hpp"

namespace frond {

// Sets what follows from the elements.
static void finish(System& system, frond_mass mass) {
    system.masses = system.row->masses(*system.elements, mass);
    FROND_ASSERT(system.masses.node.size() == system.elements->node_count);
    FROND_ASSERT(system.masses.slot.size() == system.elements->pattern.row.size());
    const std::vector<double>& ratio = system.elements->damping_ratio;
    system.damps_alike = std::adjacent_find(ratio.begin(), ratio.end(), std::not_equal_to<>()) == ratio.end();

    // A node without elements would make the matrix singular. Rotations have inertia instead of mass, and are loose
    // with their positions.
    const BlockPattern& pattern = system.elements->pattern;
    const int step = system.row->moves_chain ? 2 : 1;
    system.loose.assign(size_t(system.elements->node_count), 0);
    Vec3 lower = Vec3::Constant(INFINITY), upper = -lower;
    for (int i = 0; i < system.elements->node_count; i += step) {
        const bool is_loose = !(system.masses.slot[size_t(pattern.start[size_t(i)])] > 0);
        for (int k = 0; k < step; ++k) system.loose[size_t(i + k)] = is_loose;
        lower = lower.cwiseMin(point(system.elements->rest_positions, i));
        upper = upper.cwiseMax(point(system.elements->rest_positions, i));
    }
    system.is_gone = std::find(system.loose.begin(), system.loose.end(), uint8_t(0)) == system.loose.end();
    system.size = (upper - lower).maxCoeff();

    if (system.row->moves_chain) return;
    const TetNodes& nodes = static_cast<const TetElements&>(*system.elements).nodes;
    const Embedding& chain = system.model->chain_embedding;
    for (size_t i = 0; i < chain.tet.size(); ++i)
        system.chain.push_back(
            tet_attachment(place_in_tet(nodes, system.model->cage.tets, chain.tet[i], chain.weights[i])));
}

std::shared_ptr<const System> make_system(std::shared_ptr<const Model> model, frond_mechanics which, frond_mass mass,
                                          int order) {
    if (!model) fail(FROND_RESULT_INTERNAL, "a system was asked for without a model");
    if (mass < 0 || mass >= FROND_MASS_COUNT)
        fail(FROND_RESULT_BAD_ARGUMENT, "there is no mass of number %d", int(mass));
    if (which < 0 || which >= FROND_MECHANICS_COUNT)
        fail(FROND_RESULT_BAD_ARGUMENT, "there is no mechanics %d", int(which));
    if (order < 1 || order > HIGHEST_ORDER) fail(FROND_RESULT_BAD_ARGUMENT, "there are no elements of order %d", order);
    auto system = std::make_shared<System>();
    system->model = std::move(model);
    const Mechanics& row = *(system->row = &mechanics(which, order));
    system->elements = row.make(*system->model, which);
    finish(*system, mass);
    system->plan = make_block_plan(system->elements->pattern);
    return system;
}

std::shared_ptr<const System> system_without(const System& whole, const std::vector<uint8_t>& gone) {
    auto system = std::make_shared<System>();
    system->model = whole.model;
    system->row = whole.row;
    system->elements = whole.row->without(*whole.elements, gone);
    system->plan = whole.plan;
    finish(*system, whole.masses.lumped ? FROND_MASS_LUMPED : FROND_MASS_CONSISTENT);
    return system;
}

const Model& model_of(const System& system) {
    return *system.model;
}
const Elements& elements_of(const System& system) {
    return *system.elements;
}
const VecX& node_mass_of(const System& system) {
    return system.masses.node;
}

void multiply_mass(const System& system, const std::vector<Mat3>& inertia, const VecX& v, VecX& y) {
    const BlockPattern& pattern = system.elements->pattern;
    const Masses& masses = system.masses;
    y.resize(v.size());
    FROND_ASSERT(v.size() == 3 * pattern.node_count);
    if (masses.lumped) {
        for (int i = 0; i < pattern.node_count; ++i) point(y, i) = masses.node[i] * point(v, i);
    } else {
        y.setZero();
        for (int j = 0; j < pattern.node_count; ++j)
            for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
                const int i = pattern.row[size_t(k)];
                point(y, i) += masses.slot[size_t(k)] * point(v, j);
                if (i != j) point(y, j) += masses.slot[size_t(k)] * point(v, i);
            }
    }
    for (size_t i = 0; i < inertia.size(); ++i)
        point(y, int(2 * i + 1)) += product(inertia[i], point(v, int(2 * i + 1)));
}

double kinetic_energy(const System& system, const VecX& x, const VecX& v) {
    std::vector<Mat3> inertia;
    VecX momentum;
    if (system.row->rotary_inertia) system.row->rotary_inertia(*system.elements, x, inertia);
    multiply_mass(system, inertia, v, momentum);
    return 0.5 * v.dot(momentum);
}

}  // namespace frond
