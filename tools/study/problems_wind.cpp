// A stem in a steady wind: it bends until it rests, and its drag is compared with that of a rigid one.
#include <cmath>

#include "study/known.hpp"
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

}  // namespace frond::study
