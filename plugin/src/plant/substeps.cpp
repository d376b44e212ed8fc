// In: a plant, its loads and a time h. Out: its motion h later, in as few equal substeps as keep its local error small.
//
// The end of each node is compared with a prediction from its velocity and the last change of that (Milne's device:
// predictor against corrector). The difference, 5/12 h^3 d3x/dt3, is about twice the local error of bdf2; of more exact
// integrators it is an upper bound. Counts are powers of two, so that bdf2, whose history has steps of other lengths,
// never meets one that grows by more than that (Hairer, Norsett, Wanner 1993, III.5).
#include <algorithm>
#include <cmath>

#include "core/assert.hpp"
#include "plant/plant_step.hpp"

namespace frond {

namespace {

// Returns half of the largest prediction error of a free node [m]; keeps the trend for the next substep.
double local_error(Plant& plant, const VecX& x, const VecX& v, double h) {
    const Motion& motion = plant.state.motion;
    const Trend& trend = plant.state.trend;
    const auto is_known = [&](int i) { return trend.v_end.size() == v.size() && point(trend.v_end, i) == point(v, i); };
    const int next = plant.follow ? 2 : 1;
    double most = 0;
    for (int i = 0; i < x.size() / 3; i += next) {
        if (motion.pinned[size_t(i)]) continue;
        Vec3 miss = point(motion.x, i) - point(x, i) - h * point(v, i);
        if (is_known(i)) miss -= 0.5 * h * h * point(trend.rate, i);
        most = std::max(most, miss.squaredNorm());
    }
    plant.state.trend.rate = (motion.v - v) / h;
    plant.state.trend.v_end = motion.v;
    constexpr double WILD = 1e15;  // limits [m/s], [m/s^2]: a step of almost no time gives no trend
    const auto is_wild = [](const VecX& numbers) { return !(numbers.lpNorm<Eigen::Infinity>() <= WILD); };
    if (is_wild(plant.state.trend.rate) || is_wild(plant.state.trend.v_end)) plant.state.trend = {};
    return 0.5 * std::sqrt(most);
}

// Solves with fibres where one was taut.
SolveReport solve_with_fibres(Plant& plant, double h) {
    if (plant.state.stretched > 0) plant.step.loads->fibres = fibres_of(plant);
    const SolveReport report =
        solve_step(*plant.step.workspace, plant.step.settings, *plant.step.loads, h, plant.state.motion);
    look_at_fibres(plant);
    return report;
}

// Solves all substeps, pinned nodes moving evenly; `error` is the sum of theirs.
SolveReport solve_evenly(Plant& plant, int count, double h, double& error) {
    Motion& motion = plant.state.motion;
    const VecX target = motion.pin_target;
    SolveReport sum;
    sum.ok = true;
    error = 0;
    for (int i = 1; i <= count && sum.ok; i++) {
        const VecX x = motion.x, v = motion.v;
        const VecX end = plant.follow ? wound_as(x, target) : target;
        motion.pin_target = i < count ? VecX(x + (end - x) / (count + 1 - i)) : end;
        plant.report = solve_with_fibres(plant, h / count);
        const SolveReport& one = plant.report;
        error += local_error(plant, x, v, h / count);
        sum.ok = one.ok;
        sum.converged &= one.converged;
        sum.inverted = one.inverted;
        sum.residual = std::max(sum.residual, one.residual);
        sum.add_cost(one);
    }
    motion.pin_target = target;
    return sum;
}

}  // namespace

SolveReport solve_in_substeps(Plant& plant, double h) {
    plant.step.is_inexact = false;
    if (plant.input.max_substeps <= 1 || plant.state.is_touched) return solve_with_fibres(plant, h);
    constexpr double TOO_FINE = 1.0 / 8;  // half as many substeps make four times the error
    const double allowed = plant.input.substep_tolerance * plant.size;
    FROND_ASSERT(plant.state.substeps >= 1 && plant.input.substep_tolerance >= 0);
    const Motion start = plant.state.motion;
    const Trend trend = plant.state.trend;
    SolveReport spent;
    for (int count = plant.state.substeps;; count *= 2) {
        double error = 0;
        SolveReport report = solve_evenly(plant, count, h, error);
        report.add_cost(spent);
        if ((report.ok && error <= allowed) || 2 * count > plant.input.max_substeps) {
            plant.step.is_inexact = !(error <= allowed);
            plant.state.substeps = error < TOO_FINE * allowed ? std::max(1, count / 2) : count;
            return report;
        }
        spent = report;
        plant.state.motion = start;
        plant.state.trend = trend;
    }
}

}  // namespace frond
