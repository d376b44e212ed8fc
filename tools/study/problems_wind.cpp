// A stem in a steady wind: it bends until it rests, and its drag is compared with that of a rigid one. A plant in
// gusts: how its top sways is compared with a converged run.
#include <algorithm>
#include <cmath>

#include "study/known.hpp"
#include "study/plants.hpp"
#include "study/problems.hpp"

namespace frond::study {
namespace {

constexpr Beam STEM = {0.025, 1e7, 1000, 0.3, {}};
constexpr double AIR_DENSITY = 1.2;  // [kg/m^3]

void blow(Trial& trial, double speed) {
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {speed, 0, 0};
    wind.turbulence = 0;
    wind.profile = FROND_WIND_PROFILE_UNIFORM;
    wind.density = AIR_DENSITY;
    must(frond_world_set_wind(trial.world, &wind));
}

// Applies a wind that grows for a second and then stays constant.
double drag_at_rest(Trial& trial, double speed) {
    constexpr double GROWS = 1, LASTS = 4;  // [s]
    const int steps = int(std::lround(LASTS / trial.setup.dt));
    for (int i = 1; i <= steps; i++) {
        blow(trial, speed * std::min(1.0, i * trial.setup.dt / GROWS));
        trial.step(trial.setup.dt);
    }
    frond_vec3 force;
    must(frond_plant_get_air_force(trial.plant, &force));
    return force.x;
}

// The way of a plant's top from its modelled place, and what happened to its segments.
struct Swaying {
    double mean[3];  // [m]
    double spread;   // standard deviation, of all directions together [m]
    double longest;  // longest segment, over its length [-]
};

std::vector<double> segment_lengths(const Trial& trial) {
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(trial.plant)));
    must(frond_plant_get_capsules(trial.plant, capsules.data(), int(capsules.size())));
    std::vector<double> lengths;
    for (const frond_capsule& c : capsules)
        lengths.push_back(std::hypot(std::hypot(c.end.x - c.begin.x, c.end.y - c.begin.y), c.end.z - c.begin.z));
    return lengths;
}

// Looks 60 times a second, after the first two seconds.
Swaying sway_in_gusts(Trial& trial, double duration) {
    constexpr double BEGINS = 2, LOOK = 1.0 / 60, SPEED = 8;  // [s], [s], [m/s]
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {SPEED, 0, 0};
    must(frond_world_set_wind(trial.world, &wind));
    trial.set_gravity({0, -G, 0});
    frond_vec3 start;
    must(frond_plant_get_tip(trial.plant, &start));
    const std::vector<double> modelled = segment_lengths(trial);
    double sum[3] = {}, square = 0, next = BEGINS;
    int count = 0;
    Swaying swaying = {};
    for (double time = trial.setup.dt; time < duration + BEGINS; time += trial.setup.dt) {
        trial.step(trial.setup.dt);
        if (time < next - 1e-9) continue;
        next += LOOK;
        frond_vec3 tip;
        must(frond_plant_get_tip(trial.plant, &tip));
        const double way[] = {tip.x - start.x, tip.y - start.y, tip.z - start.z};
        for (int c = 0; c < 3; c++) sum[c] += way[c], square += way[c] * way[c];
        count++;
        const std::vector<double> lengths = segment_lengths(trial);
        for (size_t i = 0; i < lengths.size(); i++)
            swaying.longest = std::max(swaying.longest, lengths[i] / modelled[i]);
    }
    for (int c = 0; c < 3; c++) swaying.mean[c] = sum[c] / count, square -= sum[c] * sum[c] / count;
    swaying.spread = std::sqrt(std::max(0.0, square / count));
    return swaying;
}

double size_of(const double (&way)[3]) {
    return std::hypot(std::hypot(way[0], way[1]), way[2]);
}

}  // namespace

Setup wind_baseline() {
    Setup setup;
    setup.dt = 1.0 / 240;
    setup.plant.mass_damping = 5;
    return setup;
}

Outcome run_reconfiguration(const Setup& setup, Session& session) {
    if (setup.body == Body::MESH) throw SceneError("the wind blows on stems");
    const ModelPtr model = make_beam(STEM, setup);
    const double stiff_drag = 0.5 * AIR_DENSITY * Beam::DRAG * STEM.width * Beam::LENGTH;  // [N] at 1 m/s
    const double C_of_square = stiff_drag * Beam::LENGTH * Beam::LENGTH / (STEM.young * inertia_of(STEM, setup.body));
    std::vector<double> numbers = {1, 10, 100};
    if (session.effort == Effort::FULL) numbers = {1, 3.162, 10, 31.62, 100, 316.2, 1000};
    double error = 0;
    std::vector<Value> values;
    Outcome outcome;
    for (double C : numbers) {
        Trial trial(model, setup);
        const double speed = std::sqrt(C / C_of_square);
        const double R = drag_at_rest(trial, speed) / (stiff_drag * speed * speed), known = reconfiguration_of(C);
        char label[32];
        std::snprintf(label, sizeof label, "C = %g: drag", C);
        values.push_back({label, R, known});
        error = std::max(error, std::abs(R / known - 1));
        const double cost = time_steps(trial, session.effort, [](Trial&, double) {});
        outcome = outcome_of(trial, error, values, cost);
    }
    return outcome;
}

Setup breeze_baseline() {
    Setup setup = standing_baseline();
    setup.plant.mechanics = FROND_MECHANICS_ROD;
    setup.plant.effects |= FROND_EFFECT_WIND;
    return setup;
}

Outcome run_breeze(const Setup& setup, Session& session) {
    const bool full = session.effort == Effort::FULL;
    const double duration = full ? 60 : session.effort == Effort::QUICK ? 10 : 2;  // [s]
    const ModelPtr model = plant_model(CORN, setup, FROND_REST_STANDS_AS_MODELLED, session);
    std::vector<double>& reference =
        session.references[std::string("breeze ") + frond_mechanics_name(setup.plant.mechanics)];
    if (reference.empty()) {
        Setup fine = breeze_baseline();
        fine.plant.mechanics = setup.plant.mechanics;
        fine.dt = full ? 1.0 / 960 : 1.0 / 240;
        fine.plant.tuning.newton_iterations = full ? 16 : 8;
        fine.plant.tuning.newton_tolerance = 1e-8;
        Trial trial(model, fine);
        const Swaying swaying = sway_in_gusts(trial, duration);
        reference = {swaying.mean[0], swaying.mean[1], swaying.mean[2], swaying.spread, swaying.longest};
    }
    Trial trial(model, setup);
    const Swaying swaying = sway_in_gusts(trial, duration);
    const uint32_t trouble = trial.trouble;
    const double known[] = {reference[0], reference[1], reference[2]};
    const double off[] = {swaying.mean[0] - known[0], swaying.mean[1] - known[1], swaying.mean[2] - known[2]};
    const double error = std::max(size_of(off) / size_of(known), std::abs(swaying.spread / reference[3] - 1));
    const double cost = time_steps(trial, session.effort, [](Trial&, double) {});
    trial.trouble = trouble;
    return outcome_of(trial, error,
                      {{"mean [m]", size_of(swaying.mean), size_of(known)},
                       {"standard deviation [m]", swaying.spread, reference[3]},
                       {"longest segment [-]", swaying.longest, reference[4]}},
                      cost);
}

}  // namespace frond::study
