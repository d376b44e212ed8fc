// Every problem runs in a tiny version, over every row of the public tables, and its best settings keep what they
// reached.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "study/known.hpp"
#include "study/study.hpp"

using namespace frond::study;

namespace {

class EveryProblem : public ::testing::TestWithParam<const char*> {};

// The error that the best of the tiny version's points may have.
double bound_of(const std::string& name) {
    static const std::map<std::string, double> bounds = {
        {"cantilever_tip", 1},
    };
    const auto bound = bounds.find(name);
    return bound == bounds.end() ? -1 : bound->second;
}

std::vector<const char*> names() {
    std::vector<const char*> list;
    for (const Problem& problem : problems()) list.push_back(problem.name);
    return list;
}
INSTANTIATE_TEST_SUITE_P(Study, EveryProblem, ::testing::ValuesIn(names()),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(EveryProblem, RunsAndKeepsItsError) {
    const std::string problem = GetParam();
    const Result result = run_problem(find_problem(problem), Effort::TINY, nullptr);
    ASSERT_FALSE(result.points.empty());
    double best = INFINITY;
    for (const Point& point : result.points) {
        // Explicit steps are too long, and linear tets do not feel the weight that makes a column buckle.
        const bool may_fail = point.setup.plant.integrator != frond_default_plant_def().integrator ||
                              (problem == "greenhill" && point.setup.plant.mechanics == FROND_TET_LINEAR);
        if (!may_fail) EXPECT_EQ(point.failure, "") << point.series;
        if (!point.failure.empty()) continue;
        EXPECT_TRUE(std::isfinite(point.outcome.error)) << point.series;
        EXPECT_GE(point.outcome.error, 0) << point.series;
        EXPECT_GT(point.outcome.cpu_per_second, 0) << point.series;
        EXPECT_GT(point.outcome.node_count, 0) << point.series;
        best = std::min(best, point.outcome.error);
    }
    EXPECT_LE(best, bound_of(problem)) << "best error " << best;
    // What rests on a refined reference says how well that converged.
    if (std::string(find_problem(problem).answer).find("refined") != std::string::npos)
        EXPECT_FALSE(result.notes.empty());
}

TEST(Sweeps, LeaveOutNoRowOfThePublicTables) {
    std::set<int> mechanics, integrators, solvers;
    for (const Problem& problem : problems())
        for (const Sweep& sweep : sweeps_of(problem, Effort::FULL))
            for (const Setup& setup : sweep.setups) {
                mechanics.insert(setup.plant.mechanics);
                integrators.insert(setup.plant.integrator);
                solvers.insert(setup.plant.linear_solver);
            }
    EXPECT_EQ(mechanics.size(), size_t(FROND_MECHANICS_COUNT));
    EXPECT_EQ(integrators.size(), size_t(FROND_INTEGRATOR_COUNT));
    EXPECT_EQ(solvers.size(), size_t(FROND_LINEAR_SOLVER_COUNT));
}

TEST(Sweeps, ChangeOneSettingAtATimeAndNoneTwice) {
    for (const Problem& problem : problems()) {
        std::set<std::string> keys;
        const std::vector<Setup> changes = changes_of(problem, Effort::FULL);
        EXPECT_EQ(difference(changes[0], problem.baseline()), "baseline");
        for (const Setup& setup : changes) {
            EXPECT_TRUE(keys.insert(key_of(setup)).second) << problem.name << ": " << difference(setup, changes[0]);
            if (&setup != &changes[0]) EXPECT_NE(difference(setup, changes[0]), "baseline") << problem.name;
        }
        EXPECT_GT(keys.size(), 3u) << problem.name;
    }
}

TEST(Setups, AreToldByWhatTheyChange) {
    const Setup base = find_problem("swing").baseline();
    Setup other = base;
    other.dt = 1.0 / 240;
    other.plant.integrator = FROND_IMPLICIT_EULER;
    EXPECT_EQ(difference(other, base), "1/240 s, implicit_euler");
    EXPECT_NE(key_of(other), key_of(base));
    EXPECT_EQ(time_step_text(0.75), "0.75 s");
}

// Implicit Euler damps as its formula says, and the default keeps 95 % at 1/60 s.
TEST(Amplitude, IsKeptAsTheIntegratorsSay) {
    Session session;
    session.effort = Effort::TINY;
    const Problem& problem = find_problem("amplitude");
    Setup setup = problem.baseline();
    EXPECT_LT(problem.run(setup, session).error, 0.05);
    setup.plant.integrator = FROND_IMPLICIT_EULER;
    const double z = 2 * M_PI * setup.dt, zeta = implicit_euler_damping(z);
    EXPECT_NEAR(1 - problem.run(setup, session).error, std::exp(-300 * zeta * std::atan(z)), 0.02);
}

}  // namespace
