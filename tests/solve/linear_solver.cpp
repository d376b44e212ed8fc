// Linear solvers: every row compared with dense algebra, and reports of what it did not reach.
#include "solve/linear_solver.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "support/rig.hpp"

namespace frond::test {
namespace linear_solver_tests {

struct EveryLinearSolver : testing::TestWithParam<int> {
    const LinearSolver& row = linear_solver(frond_linear_solver(GetParam()));
};
std::string solver_name(const testing::TestParamInfo<int>& info) {
    return linear_solver(frond_linear_solver(info.param)).name;
}
INSTANTIATE_TEST_SUITE_P(LinearSolvers, EveryLinearSolver, testing::Range(0, int(FROND_LINEAR_SOLVER_COUNT)),
                         solver_name);

// Stiffness of a model with `shift` added on the diagonal.
struct Problem {
    TetElements elements;
    BlockPlan plan;
    LinearScratch scratch;
    BlockMatrix A;
    VecX b, x;
    Problem(const Model& model, double shift, uint64_t seed) : elements(make_tet_elements(model)) {
        plan = make_block_plan(elements.pattern);
        scratch.block.plan = &plan;
        A.set_pattern(elements.pattern);
        A.set_zero();
        mechanics(FROND_MECHANICS_TET_LINEAR).add_stiffness(elements, elements.rest_positions, Tangent::exact, 1, A);
        for (int j = 0; j < elements.node_count; ++j)
            A.block(elements.pattern.start[size_t(j)]).diagonal().array() += shift;
        b = Dice(seed).vector(3 * elements.node_count, 1);
    }
};

TEST_P(EveryLinearSolver, AgreesWithDenseAlgebra) {
    for (uint64_t seed = 1; seed < 4; ++seed) {
        Problem p(seed == 1 ? tree_model(6, 5, 3) : box_model(3, 2, 4, {1, 1, 1}), 1000, seed);
        const LinearResult result = row.solve(p.A, p.b, {20000, 1e-13}, p.scratch, p.x);
        EXPECT_TRUE(result.ok && result.converged);
        EXPECT_GE(result.iterations, 1);
        const VecX expected = solve_dense(dense(p.A), p.b);
        EXPECT_NEAR((p.x - expected).norm(), 0, 1e-9 * expected.norm());
        EXPECT_NEAR(result.residual, (p.b - dense(p.A) * p.x).norm() / p.b.norm(), 1e-13);
    }
}

TEST_P(EveryLinearSolver, SolvesAnotherMatrixInTheSameRoom) {
    Problem p(box_model(2, 2, 2, {1, 1, 1}), 1000, 1), q(box_model(2, 2, 2, {1, 1, 1}), 9000, 2);
    row.solve(p.A, p.b, {20000, 1e-13}, p.scratch, p.x);
    row.solve(q.A, q.b, {20000, 1e-13}, p.scratch, p.x);
    EXPECT_NEAR((dense(q.A) * p.x - q.b).norm(), 0, 1e-11 * q.b.norm());
}

TEST_P(EveryLinearSolver, GivesZeroForZero) {
    Problem p(single_tet_model(), 1, 1);
    p.b.setZero();
    const LinearResult result = row.solve(p.A, p.b, {100, 1e-9}, p.scratch, p.x);
    EXPECT_TRUE(result.ok && result.converged);
    EXPECT_EQ(p.x.norm(), 0);
    EXPECT_EQ(result.residual, 0);
}

TEST_P(EveryLinearSolver, SaysSoWhenTheMatrixIsNotPositive) {
    Problem p(box_model(2, 2, 2, {1, 1, 1}), -1e5, 1);
    EXPECT_FALSE(row.solve(p.A, p.b, {20000, 1e-13}, p.scratch, p.x).ok);
}

TEST_P(EveryLinearSolver, SaysSoWhenANumberIsNotFinite) {
    Problem p(box_model(1, 1, 2, {1, 1, 1}), 1000, 1);
    p.b[4] = std::nan("");
    EXPECT_FALSE(row.solve(p.A, p.b, {100, 1e-9}, p.scratch, p.x).ok);
    Problem q(box_model(1, 1, 2, {1, 1, 1}), 1000, 1);
    q.A.values[30] = std::nan("");
    EXPECT_FALSE(row.solve(q.A, q.b, {100, 1e-9}, q.scratch, q.x).ok);
}

TEST(Pcg, KeepsItsLimitsAndReportsTheTrueResidual) {
    Problem p(tree_model(20, 10, 5), 1, 1);
    VecX r;
    for (int limit : {1, 10, 100}) {
        const LinearResult result = solve_pcg_jacobi(p.A, p.b, {limit, 1e-10}, p.scratch, p.x);
        EXPECT_TRUE(result.ok);
        EXPECT_FALSE(result.converged);
        EXPECT_LE(result.iterations, limit);
        EXPECT_NEAR(result.residual, relative_residual(p.A, p.b, p.x, r), 1e-14);
    }
    for (double tolerance : {1e-2, 1e-6}) {
        const LinearResult result = solve_pcg_jacobi(p.A, p.b, {100000, tolerance}, p.scratch, p.x);
        EXPECT_TRUE(result.converged);
        EXPECT_LE(result.residual, tolerance);
        EXPECT_GT(result.residual, tolerance * 1e-3);
    }
}

// On a slender tree, each better preconditioner needs fewer iterations for the same residual.
TEST(Pcg, NeedsFewerIterationsTheMoreItsPreconditionerKnows) {
    Problem p(tree_model(20, 10, 5), 1, 1);
    const LinearLimits limits = {100000, 1e-8};
    const int jacobi = solve_pcg_jacobi(p.A, p.b, limits, p.scratch, p.x).iterations;
    const int blocks = solve_pcg_block_jacobi(p.A, p.b, limits, p.scratch, p.x).iterations;
    const int cholesky = solve_pcg_incomplete_cholesky(p.A, p.b, limits, p.scratch, p.x).iterations;
    RecordProperty("iterations",
                   std::to_string(jacobi) + " " + std::to_string(blocks) + " " + std::to_string(cholesky));
    EXPECT_LT(blocks, jacobi);
    EXPECT_LT(cholesky, blocks / 2);
}

TEST(Pcg, AdmitsAToleranceThatNumbersCannotReach) {
    Problem p(tree_model(20, 10, 5), 1, 1);
    const LinearResult result = solve_pcg_jacobi(p.A, p.b, {20000, 1e-30}, p.scratch, p.x);
    EXPECT_TRUE(result.ok);
    EXPECT_FALSE(result.converged);
    EXPECT_LT(result.residual, 1e-6);
}

TEST(Direct, FillsLittleMoreThanTheMatrixOnATree) {
    const TetElements elements = make_tet_elements(tree_model(30, 20, 10));
    const DirectFactorPtr factor = make_direct_factor(elements.pattern);
    EXPECT_LT(double(fill_of(*factor)), 3.0 * 9 * elements.pattern.block_count());
}

TEST(Direct, StepsAgreeWithPcg) {
    for (int which = 0; which < TET_MECHANICS; ++which) {
        Rig direct(tree_model(8, 6, 4, {900, 1e7, 0.3}), plain_settings(frond_mechanics(which)));
        Rig pcg(tree_model(8, 6, 4, {900, 1e7, 0.3}),
                plain_settings(frond_mechanics(which), FROND_LINEAR_SOLVER_PCG_JACOBI));
        for (Rig* rig : {&direct, &pcg}) {
            rig->pin_below(1, 0);
            rig->loads.gravity = {2, -9.81, 0};
            rig->settings.tolerance = 1e-11;
            rig->steps(20, 1.0 / 60);
        }
        EXPECT_NEAR((direct.motion.x - pcg.motion.x).cwiseAbs().maxCoeff(), 0, 1e-7);
        EXPECT_GT((direct.motion.x - positions_of(*direct.model)).cwiseAbs().maxCoeff(), 1e-3);
    }
}

TEST(Pcg, StepThatIsNotConvergedIsTakenAndReported) {
    Rig rig(tree_model(8, 6, 4, {900, 1e7, 0.3}),
            plain_settings(FROND_MECHANICS_TET_COROTATIONAL, FROND_LINEAR_SOLVER_PCG_JACOBI));
    rig.settings.max_iterations = 3;
    rig.pin_below(1, 0);
    rig.loads.gravity = {0, -9.81, 0};
    const SolveReport report = rig.step(1.0 / 60);
    EXPECT_TRUE(report.ok);
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.iterations, 3);
    EXPECT_GT(report.residual, 1e-12);
    EXPECT_NE(rig.motion.x, positions_of(*rig.model));
}

}  // namespace linear_solver_tests

}  // namespace frond::test
