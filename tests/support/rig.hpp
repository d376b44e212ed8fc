// Rig: a model with everything needed to step it, for tests of solve.
#pragma once

#include <gtest/gtest.h>

#include "solve/integrator.hpp"
#include "solve/solve.hpp"
#include "support/meshes.hpp"

// Makes lists of names from the lists of the public header.
#define FROND_TEST_TEXT(code, text) text,

namespace frond::test {

// The mechanics that move the cage come first in the enum.
constexpr int TET_MECHANICS = FROND_MECHANICS_ROD;

struct RigSettings : SolveSettings {
    frond_mechanics mechanics;
    int order = 1;  // order of its elements
};

inline RigSettings plain_settings(frond_mechanics mechanics = FROND_MECHANICS_TET_COROTATIONAL,
                                  frond_linear_solver solver = FROND_LINEAR_SOLVER_BLOCK) {
    RigSettings s = {};
    s.mechanics = mechanics;
    s.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    s.linear_solver = solver;
    s.newton_iterations = 1;
    s.newton_tolerance = 1e-8;
    s.max_iterations = 20000;
    s.tolerance = 1e-12;
    s.spectral_radius = 0.8;
    return s;
}

inline const TetElements& tets_of(const System& system) {
    return static_cast<const TetElements&>(elements_of(system));
}
// Returns the kinetic energy of tets, whose masses do not depend on their positions.
inline double kinetic_energy(const System& system, const VecX& v) {
    return kinetic_energy(system, elements_of(system).modelled, v);
}
// Returns a spring to a point of a tet.
inline Spring tet_spring(const System& system, int tet, const std::array<double, 4>& weights, const Vec3& target,
                         double stiffness) {
    const TetElements& elements = tets_of(system);
    return {tet_attachment(place_in_tet(elements.nodes, elements.tets, tet, weights)), target, stiffness};
}

struct Rig {
    std::shared_ptr<const Model> model;
    std::shared_ptr<const System> system;
    WorkspacePtr workspace;
    RigSettings settings;
    frond_mass masses;
    Loads loads;
    Motion motion;

    Rig(const Model& made, const RigSettings& with, frond_mass mass = FROND_MASS_LUMPED)
        : model(std::make_shared<const Model>(made)),
          system(make_system(model, with.mechanics, mass, with.order)),
          workspace(make_workspace(system)),
          settings(with),
          masses(mass) {
        motion.x = motion.pin_target = elements_of(*system).modelled;
        motion.v = loads.force = VecX::Zero(motion.x.size());
        motion.pinned.assign(size_t(node_count()), 0);
    }
    int node_count() const { return elements_of(*system).node_count; }
    // Returns the number of cage nodes, which come first.
    int corner_count() const { return int(model->cage.nodes.size()); }
    // Holds the nodes whose coordinate along the axis is at most `limit`.
    void pin_below(int axis, double limit) {
        for (int i = 0; i < node_count(); ++i)
            if (point(motion.x, i)[axis] <= limit) motion.pinned[size_t(i)] = 1;
    }
    SolveReport step(double h) { return solve_step(*workspace, settings, loads, h, motion); }
    void steps(int count, double h) {
        for (int n = 0; n < count; ++n) ASSERT_TRUE(step(h).ok) << "step " << n;
    }
    double mass() const { return node_mass_of(*system).sum(); }
    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (int i = 0; i < node_count(); ++i) sum += node_mass_of(*system)[i] * point(motion.v, i);
        return sum;
    }
    double elastic_energy() const { return row().energy(elements_of(*system), motion.x); }
    const Mechanics& row() const { return mechanics(settings.mechanics, settings.order); }
};

// Every mechanics of tets with every integrator and mass, solved directly, and with every linear solver by implicit
// Euler; with elements of order 2 each integrator only once, to save time.
struct Combination {
    int mechanics, order, integrator, linear_solver, mass;
};
inline std::vector<Combination> every_combination() {
    std::vector<Combination> all;
    for (int m = 0; m < TET_MECHANICS; ++m)
        for (int i = 0; i < FROND_INTEGRATOR_COUNT; ++i)
            for (int l = 0; l < FROND_LINEAR_SOLVER_COUNT; ++l)
                for (int k = 0; k < FROND_MASS_COUNT; ++k)
                    if (l == FROND_LINEAR_SOLVER_BLOCK || i == FROND_INTEGRATOR_IMPLICIT_EULER)
                        all.push_back({m, 1, i, l, k});
    for (int m = 0; m < TET_MECHANICS; ++m)
        for (int i = 0; i < FROND_INTEGRATOR_COUNT; ++i)
            all.push_back({m, 2, i, FROND_LINEAR_SOLVER_BLOCK, (m + i) % 2});
    return all;
}
struct EveryCombination : testing::TestWithParam<Combination> {
    RigSettings settings() const {
        RigSettings s =
            plain_settings(frond_mechanics(GetParam().mechanics), frond_linear_solver(GetParam().linear_solver));
        s.integrator = frond_integrator(GetParam().integrator);
        s.order = GetParam().order;
        return s;
    }
    bool is_explicit() const { return integrator(frond_integrator(GetParam().integrator)).is_explicit; }
    // Returns a time step at which the integrator is stable with the materials of these tests [s].
    double time_step() const { return is_explicit() ? 2e-5 : 1.0 / 60; }
    frond_mass mass() const { return frond_mass(GetParam().mass); }
};
inline std::string combination_name(const testing::TestParamInfo<Combination>& info) {
    static const char* const MECHANICS[] = {FROND_MECHANICS(FROND_TEST_TEXT)};
    static const char* const INTEGRATORS[] = {FROND_INTEGRATORS(FROND_TEST_TEXT)};
    static const char* const SOLVERS[] = {FROND_LINEAR_SOLVERS(FROND_TEST_TEXT)};
    static const char* const MASSES[] = {FROND_MASSES(FROND_TEST_TEXT)};
    return std::string(MECHANICS[info.param.mechanics]) + (info.param.order == 2 ? "_quadratic_" : "_") +
           INTEGRATORS[info.param.integrator] + "_" + SOLVERS[info.param.linear_solver] + "_" + MASSES[info.param.mass];
}

}  // namespace frond::test
