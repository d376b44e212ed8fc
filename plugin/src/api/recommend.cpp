// frond_recommend: a model and a bound come in, the best settings within it go out, from the Pareto front of error and
// cost that `frond study` measured (recommend_front.inc names the command that makes it).
#include <algorithm>
#include <cmath>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "calibration/sway_frequency.hpp"
#include "core/elementary.hpp"
#include "mechanics/mechanics.hpp"

using namespace frond;

namespace {

// The measured result of one setting on a stem with a natural frequency of 1 Hz.
struct Measured {
    frond_mechanics mechanics;
    frond_integrator integrator;
    int pieces;           // capsules or cage cells from root to tip
    double steps;         // steps per period of the first mode
    double error;         // rms of the tip over two periods / peak [-]
    double cpu_per_step;  // [s]
    double count;         // capsules of the chain or tets of the cage
};
constexpr Measured FRONT[] = {
#include "api/recommend_front.inc"
};

// Returns the length along the chain from a root to the farthest node [m].
double reach_of(const Model& model) {
    double reach = 0;
    for (const ChainNode& node : model.chain.nodes) reach = std::max(reach, node.distance);
    return reach;
}

// Estimates how many capsules or tets of this length the model will have. The number of a cage's tets grows with a
// power of its fineness between that of a line and that of a sheet.
double count_of(const Model& model, bool chain, double length) {
    if (chain) return std::max(1.0, model.chain.length() / length);
    constexpr double TETS_A_CELL = 6, POWER = 1.5;
    const double tets = double(model.cage.tets.size());
    const double cell = frond::cbrt(TETS_A_CELL * model.cage_report.volume / tets);
    return tets * frond::pow(cell / length, POWER);
}

frond_advice advise(const Model& model, double frequency, const Measured& row) {
    const bool chain = mechanics(row.mechanics).moves_chain;
    const double length = reach_of(model) / row.pieces;
    frond_advice advice = {};
    advice.plant = frond_default_plant_def();
    advice.plant.mechanics = row.mechanics;
    advice.plant.integrator = row.integrator;
    (chain ? advice.capsule_height : advice.cage_size) = length;
    advice.time_step = 1 / (row.steps * frequency);
    advice.error = row.error;
    advice.cpu = row.cpu_per_step * count_of(model, chain, length) / row.count / advice.time_step;
    return advice;
}

}  // namespace

frond_result frond_recommend(frond_model model, double error, double cpu, frond_advice* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        check_range(error, 0, 1, "error");
        check_range(cpu, 0, 1e9, "cpu [s/s]");
        if ((error > 0) == (cpu > 0))
            fail(FROND_RESULT_BAD_ARGUMENT, "error is %g and cpu %g; one of them must be above 0, the other 0", error,
                 cpu);
        const std::shared_ptr<const Model> m = get(model);
        const double frequency = sway_frequency(m);
        frond_advice best = {}, least = {};
        for (const Measured& row : FRONT) {
            const frond_advice advice = advise(*m, frequency, row);
            const bool fits = error > 0 ? advice.error <= error : advice.cpu <= cpu;
            const auto wish = [&](const frond_advice& a) { return error > 0 ? a.cpu : a.error; };
            const auto bound = [&](const frond_advice& a) { return error > 0 ? a.error : a.cpu; };
            if (fits && (best.time_step == 0 || wish(advice) < wish(best))) best = advice;
            if (least.time_step == 0 || bound(advice) < bound(least)) least = advice;
        }
        if (best.time_step == 0 && error > 0)
            fail(FROND_RESULT_UNSUPPORTED, "no measured settings have an error of %g; the least is %g", error,
                 least.error);
        if (best.time_step == 0)
            fail(FROND_RESULT_UNSUPPORTED, "no measured settings take only %g s of CPU a second; the cheapest take %g",
                 cpu, least.cpu);
        *out = best;
    });
}
