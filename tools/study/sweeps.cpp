// Sweeps: the setups over which a problem is run. Loops over the rows of the public tables, so that none is forgotten.
#include <algorithm>

#include "study/study.hpp"

namespace frond::study {
namespace {

template <class T>
std::vector<T> by(Effort effort, std::vector<T> tiny, std::vector<T> quick, std::vector<T> full) {
    return effort == Effort::TINY ? tiny : effort == Effort::QUICK ? quick : full;
}

std::vector<int> resolutions(Body body, int order, Effort effort, bool moving) {
    if (body == Body::MESH && order == 2) return by<int>(effort, {1}, {1}, {1, 2});
    if (body == Body::MESH)
        return moving ? by<int>(effort, {1}, {1}, {1, 2, 3}) : by<int>(effort, {1}, {1}, {1, 2, 3, 4});
    if (body == Body::STEM) return by<int>(effort, {5}, {5, 10, 20}, {5, 10, 20, 40, 80});
    return by<int>(effort, {8}, {8, 12}, {6, 8, 12, 16, 24, 32});
}

std::vector<double> time_steps(Effort effort) {
    return by<double>(effort, {1.0 / 60}, {1.0 / 30, 1.0 / 120},
                      {1.0 / 15, 1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480});
}

// Returns the tolerances to try; a direct solver has none.
std::vector<double> tolerances(int linear_solver, Effort effort) {
    if (linear_solver == FROND_LINEAR_SOLVER_DIRECT) return {1e-4};
    return by<double>(effort, {1e-4}, {1e-4}, {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8});
}

// Returns the bodies that suit a mechanics; structured tets have no capsules.
std::vector<Body> bodies(frond_mechanics mechanics, Body base) {
    if (base == Body::PLANT) return {Body::PLANT};
    if (moves_chain(mechanics)) return {Body::STEM};
    return {Body::MESH, Body::STEM};
}

// Sets the body: structured tets are clamped at the layer of their foot, organs where Frond holds them.
Setup with_body(Setup setup, Body body) {
    constexpr double FOOT = 1e-4;  // [m]
    if (setup.plant.root_height >= 0) setup.plant.root_height = body == Body::MESH ? FOOT : 0;
    setup.body = body;
    return setup;
}

void sweep_resolution(const Problem& problem, Effort effort, std::vector<Sweep>& sweeps) {
    const Setup base = problem.baseline();
    for (int m = 0; m < FROND_MECHANICS_COUNT; m++) {
        const frond_mechanics mechanics = frond_mechanics(m);
        if (!(problem.axes & MECHANICS) && mechanics != base.plant.mechanics) continue;
        for (Body body : bodies(mechanics, base.body))
            for (int order : {1, 2}) {
                Setup setup = with_body(base, body);
                setup.plant.mechanics = mechanics;
                setup.plant.element_order = order;
                // Cages are calibrated for order 2 as well, but that takes minutes; rods have no order.
                if (order == 2 && body != Body::MESH) continue;
                if (order == 2 && effort == Effort::QUICK && mechanics != base.plant.mechanics) continue;
                Sweep sweep;
                sweep.name = frond_mechanics_name(mechanics);
                if (!moves_chain(mechanics)) sweep.name += order == 2 ? " T10" : " T4";
                if (body == Body::MESH) sweep.name += ", own mesh";
                for (int resolution : resolutions(body, order, effort, problem.axes & TIME_STEP)) {
                    setup.resolution = resolution;
                    sweep.setups.push_back(setup);
                }
                sweeps.push_back(sweep);
            }
    }
}

// Adds the baseline with each mechanics, each as a series of its own.
void sweep_mechanics(const Problem& problem, std::vector<Sweep>& sweeps) {
    for (int m = 0; m < FROND_MECHANICS_COUNT; m++) {
        Setup setup = problem.baseline();
        setup.plant.mechanics = frond_mechanics(m);
        sweeps.push_back({frond_mechanics_name(setup.plant.mechanics), {setup}, false});
    }
}

// Adds rods with the most accurate mass matrix and integrator, for problems in which both space and time count.
void sweep_exact_rods(const Problem& problem, Effort effort, std::vector<Sweep>& sweeps) {
    Setup setup = problem.baseline();
    if (setup.body != Body::STEM) return;
    setup.plant.mechanics = FROND_MECHANICS_ROD;
    setup.plant.tuning.mass = FROND_MASS_CONSISTENT;
    setup.plant.integrator = FROND_INTEGRATOR_SDIRK2;
    Sweep sweep = {"rod, consistent mass, sdirk2", {}, false};
    for (int resolution : resolutions(Body::STEM, 1, effort, true)) {
        setup.resolution = resolution;
        sweep.setups.push_back(setup);
    }
    sweeps.push_back(sweep);
}

// Adds long steps that are divided where their error requires it.
void sweep_substeps(const Problem& problem, Effort effort, std::vector<Sweep>& sweeps) {
    Setup setup = problem.baseline();
    setup.dt = 1.0 / 30;
    setup.plant.tuning.max_substeps = 64;
    Sweep sweep = {std::string(frond_integrator_name(setup.plant.integrator)) + ", substeps as needed", {}, false};
    for (double tolerance : by<double>(effort, {1e-4}, {1e-2}, {1e-1, 1e-2, 1e-3, 1e-4, 1e-5})) {
        setup.plant.tuning.substep_tolerance = tolerance;
        sweep.setups.push_back(setup);
    }
    sweeps.push_back(sweep);
}

void sweep_time_step(const Problem& problem, Effort effort, std::vector<Sweep>& sweeps) {
    const Setup base = problem.baseline();
    const auto over_steps = [&](const std::string& name, Setup setup) {
        Sweep sweep = {name, {}, false};
        for (double dt : time_steps(effort)) {
            setup.dt = dt;
            sweep.setups.push_back(setup);
        }
        sweeps.push_back(sweep);
    };
    for (int i = 0; i < FROND_INTEGRATOR_COUNT; i++) {
        Setup setup = base;
        setup.plant.integrator = frond_integrator(i);
        // Symplectic Euler's many short steps take longest of all; the table of changes includes one such run.
        if (effort == Effort::QUICK && i == FROND_INTEGRATOR_SYMPLECTIC_EULER && base.body != Body::STEM) continue;
        over_steps(frond_integrator_name(setup.plant.integrator), setup);
    }
    if (problem.axes & RESOLUTION) return;
    for (int m = 0; m < FROND_MECHANICS_COUNT && (problem.axes & MECHANICS); m++) {
        Setup setup = base;
        setup.plant.mechanics = frond_mechanics(m);
        if (setup.plant.mechanics != base.plant.mechanics)
            over_steps(std::string(frond_mechanics_name(setup.plant.mechanics)) + ", " +
                           frond_integrator_name(setup.plant.integrator),
                       setup);
    }
}

// Adds a series for each mechanics.
void sweep_everything(const Problem& problem, Effort effort, std::vector<Sweep>& sweeps) {
    const Setup base = problem.baseline();
    for (int m = 0; m < FROND_MECHANICS_COUNT; m++) {
        Setup setup = base;
        setup.plant.mechanics = frond_mechanics(m);
        Sweep sweep = {frond_mechanics_name(setup.plant.mechanics), {}, true};
        for (int resolution : by<int>(effort, {5}, {5, 10}, {5, 10, 20, 40}))
            for (int i = 0; i < FROND_INTEGRATOR_COUNT; i++)
                for (double dt : by<double>(effort, {1.0 / 60}, {1.0 / 30, 1.0 / 120},
                                            {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480})) {
                    setup.resolution = resolution;
                    setup.plant.integrator = frond_integrator(i);
                    setup.dt = dt;
                    sweep.setups.push_back(setup);
                }
        sweeps.push_back(sweep);
    }
}

void sweep_newton(const Problem& problem, Effort effort, std::vector<Sweep>& sweeps) {
    const Setup base = problem.baseline();
    Sweep sweep = {std::string(frond_integrator_name(base.plant.integrator)) + ", more solves", {}, false};
    for (int solves : by<int>(effort, {2}, {2, 4}, {1, 2, 3, 4, 8})) {
        Setup setup = base;
        setup.plant.tuning.newton_iterations = solves;
        sweep.setups.push_back(setup);
    }
    sweeps.push_back(sweep);
}

// Iterative solves of whole plants take longest of all.
bool has_time_to_iterate(const Setup& base, Effort effort) {
    return effort == Effort::FULL || base.body != Body::PLANT;
}

void sweep_linear(const Problem& problem, Effort effort, std::vector<Sweep>& sweeps) {
    const Setup base = problem.baseline();
    if (!has_time_to_iterate(base, effort)) return;
    for (int s = 0; s < FROND_LINEAR_SOLVER_COUNT; s++) {
        if (s == base.plant.tuning.linear_solver) continue;
        Sweep sweep = {frond_linear_solver_name(frond_linear_solver(s)), {}, false};
        for (double tolerance : tolerances(s, effort)) {
            Setup setup = base;
            setup.plant.tuning.linear_solver = frond_linear_solver(s);
            setup.plant.tuning.linear_tolerance = tolerance;
            sweep.setups.push_back(setup);
        }
        sweeps.push_back(sweep);
    }
}

// Applies `change` to copies of the baseline and keeps them.
class Changes {
public:
    explicit Changes(const Setup& base) : base(base), list({base}) {}
    template <class Change>
    void add(Change change) {
        Setup setup = base;
        change(setup);
        for (const Setup& known : list)
            if (key_of(known) == key_of(setup)) return;
        list.push_back(setup);
    }
    const Setup base;
    std::vector<Setup> list;
};

void change_shape(const Problem& problem, Effort effort, Changes& changes) {
    const Setup& base = changes.base;
    if (problem.axes & (MECHANICS | EVERYTHING))
        for (int m = 0; m < FROND_MECHANICS_COUNT; m++) {
            const frond_mechanics mechanics = frond_mechanics(m);
            if (base.body == Body::MESH && moves_chain(mechanics)) continue;
            changes.add([&](Setup& s) { s.plant.mechanics = mechanics; });
        }
    if (!(problem.axes & (RESOLUTION | EVERYTHING))) return;
    const bool chain = moves_chain(base.plant.mechanics);
    if (base.body == Body::MESH) changes.add([&](Setup& s) { s.plant.element_order = 3 - base.plant.element_order; });
    for (int resolution : resolutions(base.body, base.plant.element_order, effort, problem.axes & TIME_STEP))
        changes.add([&](Setup& s) { s.resolution = resolution; });
    if (base.body == Body::STEM && !chain)
        changes.add([&](Setup& s) {
            s = with_body(s, Body::MESH);
            s.resolution = 1;
        });
    changes.add(
        [&](Setup& s) { s.plant.tuning.mass = frond_mass(FROND_MASS_COUNT - 1 - int(base.plant.tuning.mass)); });
}

}  // namespace

std::vector<Sweep> sweeps_of(const Problem& problem, Effort effort) {
    std::vector<Sweep> sweeps;
    if (problem.axes == MECHANICS) sweep_mechanics(problem, sweeps);
    if (problem.axes & RESOLUTION) sweep_resolution(problem, effort, sweeps);
    if (problem.axes & RESOLUTION && problem.axes & TIME_STEP) sweep_exact_rods(problem, effort, sweeps);
    if (problem.axes & TIME_STEP) sweep_time_step(problem, effort, sweeps);
    if (problem.axes & TIME_STEP) sweep_substeps(problem, effort, sweeps);
    if (problem.axes & NEWTON) sweep_newton(problem, effort, sweeps);
    if (problem.axes & EVERYTHING) sweep_everything(problem, effort, sweeps);
    if (problem.axes & LINEAR) sweep_linear(problem, effort, sweeps);
    return sweeps;
}

std::vector<Setup> changes_of(const Problem& problem, Effort effort) {
    Changes changes(problem.baseline());
    if (effort == Effort::TINY) return changes.list;
    change_shape(problem, effort, changes);
    if (problem.axes & (TIME_STEP | EVERYTHING)) {
        for (double dt : time_steps(effort)) changes.add([&](Setup& s) { s.dt = dt; });
        for (int i = 0; i < FROND_INTEGRATOR_COUNT; i++)
            changes.add([&](Setup& s) { s.plant.integrator = frond_integrator(i); });
    }
    if (problem.axes & NEWTON) {
        for (int solves : {1, 2, 4}) changes.add([&](Setup& s) { s.plant.tuning.newton_iterations = solves; });
        for (double tolerance : {1e-1, 1e-3})
            changes.add([&](Setup& s) {
                s.plant.tuning.newton_iterations = 4;
                s.plant.tuning.newton_tolerance = tolerance;
            });
    }
    if (problem.axes & LINEAR && has_time_to_iterate(changes.base, effort))
        for (int k = 0; k < FROND_LINEAR_SOLVER_COUNT; k++)
            for (double tolerance : tolerances(k, effort)) {
                if (k == FROND_LINEAR_SOLVER_BLOCK) continue;
                changes.add([&](Setup& s) {
                    s.plant.tuning.linear_solver = frond_linear_solver(k);
                    s.plant.tuning.linear_tolerance = tolerance;
                });
            }
    return changes.list;
}

}  // namespace frond::study
