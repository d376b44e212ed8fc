// Do the mechanics agree on whole plants? Compares the shape of corn and cucumber under their weight and their first
// natural frequency with those of rods of the same model.
#include <algorithm>
#include <cmath>

#include "study/plants.hpp"
#include "study/problems.hpp"

namespace frond::study {
namespace {

constexpr double ASIDE = 0.01;  // share of the weight that pulls the plant aside before it is let go [-]

// Returns the model with default sizes of cells and capsules.
ModelPtr default_model(const PlantCase& plant, Session& session) {
    ModelPtr& model = session.models[plant.name];
    if (!model) model = load_plant({plant.name, plant.file, {}}, frond_default_model_def());
    return model;
}

// Returns the frequency of the highest peak of a signal's spectrum, with Hann's window [Hz].
double main_frequency(const std::vector<double>& signal, double dt) {
    constexpr double LOWEST = 0.1, HIGHEST = 10, STEP = 0.002;  // [Hz]
    const double count = double(signal.size());
    double mean = 0;
    for (double s : signal) mean += s / count;
    double best = 0, largest = 0;
    for (double f = LOWEST; f < HIGHEST; f += STEP) {
        double cosine = 0, sine = 0;
        for (size_t i = 0; i < signal.size(); i++) {
            const double window = 1 - std::cos(2 * M_PI * (double(i) + 0.5) / count);
            const double phase = 2 * M_PI * f * dt * double(i);
            cosine += window * (signal[i] - mean) * std::cos(phase);
            sine += window * (signal[i] - mean) * std::sin(phase);
        }
        if (std::hypot(cosine, sine) <= largest) continue;
        largest = std::hypot(cosine, sine);
        best = f;
    }
    return best;
}

frond_vec3 tip_of(Trial& trial) {
    frond_vec3 tip;
    must(frond_plant_get_tip(trial.plant, &tip));
    return tip;
}

struct Standing {
    frond_vec3 tip;    // position under its weight [m]
    double frequency;  // first natural frequency [Hz]
    double cpu;        // CPU time per simulated second [s]
    uint32_t trouble;
};

// Lets a plant go from its shape under a hundredth of its weight taken sideways; it vibrates mostly in its first mode.
Standing watch(const ModelPtr& model, const Setup& setup, Effort effort) {
    const double duration = effort == Effort::FULL ? 20 : effort == Effort::QUICK ? 8 : 4;  // [s]
    const std::unique_ptr<Trial> rests = settle(model, setup, 1, [](Trial& trial, double) {
        trial.set_gravity({0, -G, 0});
    });
    const std::unique_ptr<Trial> aside = settle(model, setup, 1, [](Trial& trial, double) {
        trial.set_gravity({ASIDE * G, -G, 0});
    });
    Setup free = setup;
    free.plant.mass_damping = free.plant.stiffness_damping = free.plant.material_damping = 0;
    Trial trial(model, free);
    trial.start_from(*aside);
    trial.set_gravity({0, -G, 0});
    std::vector<double> sway;  // first moment of the plant's mass [kg m]
    for (double t = 0; t < duration; t += setup.dt) {
        trial.step(setup.dt);
        frond_vec3 momentum;
        must(frond_plant_get_momentum(trial.plant, &momentum));
        sway.push_back((sway.empty() ? 0 : sway.back()) + momentum.x * setup.dt);
    }
    return {tip_of(*rests), main_frequency(sway, setup.dt), trial.cpu / duration, rests->trouble | trial.trouble};
}

}  // namespace

Setup agree_baseline() {
    Setup setup = standing_baseline();
    setup.dt = 1.0 / 120;
    return setup;
}

Outcome run_agree(const Setup& setup, Session& session) {
    Setup rods = setup;
    rods.plant.mechanics = FROND_MECHANICS_ROD;
    Outcome outcome;
    for (const PlantCase* plant : {&CORN, &CUCUMBER}) {
        const ModelPtr model = default_model(*plant, session);
        const frond_model_info info = model->info();
        std::vector<double>& known = session.references[plant->name];
        if (known.empty()) {
            const Standing standing = watch(model, rods, session.effort);
            known = {standing.tip.x, standing.tip.y, standing.tip.z, standing.frequency};
        }
        const Standing standing = watch(model, setup, session.effort);
        const double off =
            std::hypot(std::hypot(standing.tip.x - known[0], standing.tip.y - known[1]), standing.tip.z - known[2]) /
            (info.upper.y - info.lower.y);
        const double faster = standing.frequency / known[3] - 1;
        const std::string name = plant->name;
        outcome.values.push_back({name + ": tip [% of height]", 100 * off, 0});
        outcome.values.push_back({name + ": first sway [Hz]", standing.frequency, known[3]});
        outcome.values.push_back({name + ": difference [%]", 100 * faster, 0});
        outcome.error = std::max({outcome.error, off, std::abs(faster)});
        outcome.cpu_per_second += standing.cpu;
        outcome.trouble |= standing.trouble;
        outcome.node_count += info.node_count;
        outcome.tet_count += info.tet_count;
        outcome.capsule_count += info.capsule_count;
    }
    return outcome;
}

}  // namespace frond::study
