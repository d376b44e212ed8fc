#include "study/path.hpp"

#include <cmath>

namespace frond::study {
namespace {

// Positions at common times, three numbers each, beginning with the start.
using Path = std::vector<double>;
constexpr double SAMPLE = 1.0 / 15;  // [s]

Path follow(Trial& trial, const Start& start, const Where& where, double duration) {
    start(trial);
    Path path;
    const auto look = [&] {
        const frond_vec3 p = where(trial);
        path.insert(path.end(), {p.x, p.y, p.z});
    };
    look();
    const int samples = int(std::lround(duration / SAMPLE)), steps = int(std::lround(SAMPLE / trial.setup.dt));
    for (int i = 0; i < samples; i++) {
        for (int k = 0; k < steps; k++) trial.step(trial.setup.dt);
        look();
    }
    return path;
}

double path_error(const Path& path, const Path& reference) {
    double square = 0, peak = 0;
    for (size_t i = 0; i < reference.size(); i += 3) {
        double miss = 0, way = 0;
        for (size_t k = 0; k < 3; k++) {
            miss += std::pow(path[i + k] - reference[i + k], 2);
            way += std::pow(reference[i + k] - reference[k], 2);
        }
        square += miss;
        peak = std::max(peak, way);
    }
    return std::sqrt(square / (double(reference.size()) / 3) / peak);
}

// Returns a setup with two solves per step, nearly undamped, iterated to convergence.
Setup reference_setup(Setup setup) {
    setup.plant.integrator = FROND_INTEGRATOR_SDIRK2;
    setup.plant.tuning.linear_solver = FROND_LINEAR_SOLVER_BLOCK;
    setup.plant.tuning.linear_tolerance = frond_default_plant_def().tuning.linear_tolerance;
    setup.plant.tuning.newton_iterations = 12;
    setup.plant.tuning.newton_tolerance = 1e-8;
    setup.dt = 1.0 / 120;
    return setup;
}

const Path& converged_path(const ModelPtr& model, const Setup& setup, const Start& start, const Where& where,
                           double duration, Session& session) {
    Setup fine = reference_setup(setup);
    const std::string key = key_of(fine);
    const auto known = session.references.find(key);
    if (known != session.references.end()) return known->second;

    const double agree = session.effort == Effort::FULL ? 2e-4 : 2e-3;
    const int refinements = session.effort == Effort::FULL ? 6 : moves_chain(setup.plant.mechanics) ? 4 : 1;
    Path path;
    std::string differences;
    for (int i = 0; i <= refinements; i++, fine.dt /= 2) {
        Trial trial(model, fine);
        const Path finer = follow(trial, start, where, duration);
        const double difference = i > 0 ? path_error(path, finer) : 1;
        if (i > 0) {
            char text[64];
            std::snprintf(text, sizeof text, "%s%.2g at %s", i > 1 ? ", " : "", difference,
                          time_step_text(fine.dt).c_str());
            differences += text;
        }
        path = finer;
        if (difference < agree) break;
    }
    session.notes.push_back(
        "Reference of " + std::string(frond_mechanics_name(setup.plant.mechanics)) +
        (setup.plant.element_order == 2 ? " T10, " : ", ") + resolution_text(setup) +
        ": sdirk2 with converged Newton; halving its step changed it, as the error is measured, by " + differences +
        ".");
    return session.references[key] = path;
}

}  // namespace

Outcome compare_path(const ModelPtr& model, const Setup& setup, const Start& start, const Where& where, double duration,
                     Session& session) {
    const Path& reference = converged_path(model, setup, start, where, duration, session);
    Trial trial(model, setup);
    const double error = path_error(follow(trial, start, where, duration), reference);
    const uint32_t trouble = trial.trouble;
    const double cpu = time_steps(trial, session.effort, [](Trial&, double) {});
    trial.trouble = trouble;
    return outcome_of(trial, error, {}, cpu);
}

}  // namespace frond::study
