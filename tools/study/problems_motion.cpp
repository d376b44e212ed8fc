// Beams that move: they vibrate in known modes, fall, swing and are let go from a large bend; a twig does too. If no
// formula is known, the path of the end is compared with one that is refined in time until it no longer changes.
#include <array>
#include <cmath>

#include "study/known.hpp"
#include "study/path.hpp"
#include "study/problems.hpp"

namespace frond::study {
namespace {

constexpr Beam SWAYING = {0.02, 3.2e7, 1000, 0.3, {}};  // about 0.5 Hz
constexpr Beam LIMBER = {0.02, 1.28e8, 1000, 0.3, {}};  // about 1 Hz
const LoadFunction NO_LOAD = [](Trial&, double) {};

// ---- modes -------------------------------------------------------------------------------------------------------

double frequency_of(const Beam& beam, const Setup& setup, const Model& model, int mode) {
    return frequency(mode, beam.young * inertia_of(beam, setup.body), beam.density * area_of(beam, setup.body),
                     Beam::LENGTH, cap_mass(beam, setup.body, model));
}

// Shares of the first three modes in the beam's current shape, by least squares over its sections.
class Modes {
public:
    explicit Modes(Trial& trial) : heights(trial.section_heights(Beam::LENGTH)) {
        for (double y : heights) shapes.push_back({mode_shape(0, y), mode_shape(1, y), mode_shape(2, y)});
        for (const auto& shape : shapes)
            for (size_t i = 0; i < 3; i++)
                for (size_t j = 0; j < 3; j++) normal[i][j] += shape[i] * shape[j];
    }
    double share(Trial& trial, int mode) const {
        std::array<std::array<double, 4>, 3> rows = {};
        for (size_t k = 0; k < heights.size(); k++) {
            const double x = trial.middle(heights[k]).x;
            for (size_t i = 0; i < 3; i++) rows[i][3] += shapes[k][i] * x;
        }
        for (size_t i = 0; i < 3; i++)
            for (size_t j = 0; j < 3; j++) rows[i][j] = normal[i][j];
        // Gauss-Jordan elimination; the shapes are nearly orthogonal, so no pivoting is needed.
        for (size_t i = 0; i < 3; i++)
            for (size_t r = 0; r < 3; r++) {
                if (r == i) continue;
                const double factor = rows[r][i] / rows[i][i];
                for (size_t c = i; c < 4; c++) rows[r][c] -= factor * rows[i][c];
            }
        return rows[size_t(mode)][3] / rows[size_t(mode)][size_t(mode)];
    }

private:
    std::vector<double> heights;
    std::vector<std::array<double, 3>> shapes;
    std::array<std::array<double, 3>, 3> normal = {};
};

// Motion in a mode after release: its share in x and the total energy at every step, beginning at time zero.
struct Record {
    std::vector<double> share, energy;
    double dt;
    // Returns the times of zero crossings.
    std::vector<double> crossings() const {
        std::vector<double> times;
        for (size_t i = 1; i < share.size(); i++)
            if (share[i - 1] * share[i] < 0) times.push_back(dt * (double(i) - share[i] / (share[i] - share[i - 1])));
        return times;
    }
    double frequency() const {
        const std::vector<double> times = crossings();
        if (times.size() < 3) throw SceneError("it does not sway");
        return double(times.size() - 1) / (2 * (times.back() - times.front()));
    }
    // Returns the decay rate of the amplitude [1/s]: half that of the energy, by least squares over its logarithm.
    double decay() const {
        double n = 0, t = 0, y = 0, tt = 0, ty = 0;
        for (size_t i = 0; i < energy.size(); i++) {
            const double time = dt * double(i), log = std::log(energy[i]);
            n += 1;
            t += time;
            y += log;
            tt += time * time;
            ty += time * log;
        }
        return -0.5 * (n * ty - t * y) / (n * tt - t * t);
    }
    // An unsymmetric cage spreads vibration to the perpendicular plane, so amplitude follows from the energy of both.
    double kept() const { return std::sqrt(energy.back() / energy.front()); }
};

// Bends the beam into a mode's shape by the corresponding load, lets it go and follows it.
Record sway(Trial& trial, const Beam& beam, int mode, double duration) {
    const double b = wave_number(mode), EI = beam.young * inertia_of(beam, trial.setup.body);
    const double height = 0.03 / (b * b) * Beam::LENGTH;
    const auto bend = [=](double y) { return height * EI * std::pow(b, 4) * mode_shape(mode, y / Beam::LENGTH); };
    trial.start_from(*settle(trial.model, trial.setup, 1, [&](Trial& t, double) { t.push_along(Beam::LENGTH, bend); }));
    const Modes modes(trial);
    Record record = {{}, {}, trial.setup.dt};
    const auto look = [&] {
        frond_energy energy;
        must(frond_plant_get_energy(trial.plant, &energy));
        record.share.push_back(modes.share(trial, mode));
        record.energy.push_back(energy.kinetic + energy.elastic);
    };
    look();
    const int steps = int(std::lround(duration / trial.setup.dt));
    for (int i = 0; i < steps; i++) {
        trial.step(trial.setup.dt);
        look();
    }
    return record;
}

int mode_count(const Session& session) {
    return session.effort == Effort::TINY ? 1 : 3;
}

}  // namespace

Setup motion_baseline() {
    Setup setup = static_baseline();
    setup.dt = 1.0 / 240;
    return setup;
}

Setup free_baseline() {
    Setup setup = static_baseline();
    setup.resolution = 5;
    setup.plant.root_height = -1;
    return setup;
}

Outcome run_free_fall(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(LIMBER, setup);
    Trial trial(model, setup);
    constexpr double G = 9.81, DURATION = 1;
    trial.set_gravity({0, -G, 0});
    const int steps = int(std::lround(DURATION / setup.dt));
    for (int i = 0; i < steps; i++) trial.step(setup.dt);
    const double fallen = Beam::LENGTH - trial.middle(Beam::LENGTH).y, known = G * DURATION * DURATION / 2;
    const double cpu = time_steps(trial, session.effort, NO_LOAD);
    return outcome_of(trial, std::abs(fallen / known - 1), {{"fallen after 1 s [m]", fallen, known}}, cpu);
}

Outcome run_frequencies(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(SWAYING, setup);
    Trial trial(model, setup);
    std::vector<Value> values;
    double error = 0;
    for (int mode = 0; mode < mode_count(session); mode++) {
        const double known = frequency_of(SWAYING, setup, *model, mode);
        const double measured = sway(trial, SWAYING, mode, 3 / known).frequency();
        values.push_back({"frequency " + std::to_string(mode + 1) + " [Hz]", measured, known});
        error = std::max(error, std::abs(measured / known - 1));
    }
    return outcome_of(trial, error, values, time_steps(trial, session.effort, NO_LOAD));
}

Outcome run_damping(const Setup& given, Session& session) {
    Setup setup = given;
    setup.plant.effects |= FROND_EFFECT_DAMPING;
    setup.plant.mass_damping = 0.2;
    setup.plant.stiffness_damping = 5e-4;
    const ModelPtr model = make_beam(SWAYING, setup);
    Trial trial(model, setup);
    std::vector<Value> values;
    double error = 0;
    for (int mode = 0; mode < mode_count(session); mode++) {
        const double omega = 2 * M_PI * frequency_of(SWAYING, setup, *model, mode);
        const double known = setup.plant.mass_damping / (2 * omega) + setup.plant.stiffness_damping * omega / 2;
        const Record record = sway(trial, SWAYING, mode, 3 * 2 * M_PI / omega);
        const double measured = record.decay() / (2 * M_PI * record.frequency());
        values.push_back({"damping ratio " + std::to_string(mode + 1), measured, known});
        error = std::max(error, std::abs(measured - known));
    }
    return outcome_of(trial, error, values, time_steps(trial, session.effort, NO_LOAD));
}

static constexpr double KEPT_FOR = 5;  // time after which the kept amplitude is measured [s]

// Returns a beam whose stiffness gives a natural frequency of 1 Hz.
static Beam one_hertz_beam(const Setup& setup) {
    Beam beam = LIMBER;
    beam.young /= std::pow(frequency_of(beam, setup, *make_beam(beam, setup), 0), 2);
    return beam;
}

static Outcome amplitude_outcome(Trial& trial, double kept, const Session& session) {
    return outcome_of(trial, std::abs(1 - kept), {{"amplitude kept after 5 s", kept, 1}},
                      time_steps(trial, session.effort, NO_LOAD));
}

Outcome run_amplitude(const Setup& setup, Session& session) {
    const Beam beam = one_hertz_beam(setup);
    Trial trial(make_beam(beam, setup), setup);
    return amplitude_outcome(trial, sway(trial, beam, 0, KEPT_FOR).kept(), session);
}

// Returns the beam in the shape in which an end load of P L^2 / (E I) = 5 holds it.
static std::unique_ptr<Trial> bend_far(const ModelPtr& model, const Beam& beam, const Setup& setup) {
    Setup exact = setup;
    exact.plant.tuning.linear_solver = FROND_LINEAR_SOLVER_BLOCK;
    const double P = 5 * beam.young * inertia_of(beam, setup.body);
    return settle(model, exact, 20, [=](Trial& t, double share) { t.push_end({P * share, 0, 0}, {0, 0, 0}); });
}

Outcome run_far_amplitude(const Setup& setup, Session& session) {
    const Beam beam = one_hertz_beam(setup);
    const ModelPtr model = make_beam(beam, setup);
    Trial trial(model, setup);
    trial.start_from(*bend_far(model, beam, setup));
    const auto energy_now = [&] {
        frond_energy energy;
        must(frond_plant_get_energy(trial.plant, &energy));
        return energy.kinetic + energy.elastic;
    };
    const double before = energy_now();
    const int steps = int(std::lround(KEPT_FOR / setup.dt));
    for (int i = 0; i < steps; i++) trial.step(setup.dt);
    return amplitude_outcome(trial, std::sqrt(energy_now() / before), session);
}

Outcome sway_of(const Beam& beam, const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(beam, setup);
    const double EI = beam.young * inertia_of(beam, setup.body), w = 0.01 * Beam::LENGTH;
    const double rate = std::sqrt(EI / (beam.density * area_of(beam, setup.body)));
    const Sway known(cap_mass(beam, setup.body, *model));
    Trial trial(model, setup);
    trial.start_from(*settle(model, setup, 1, [=](Trial& t, double) { t.push_end({3 * EI * w, 0, 0}, {0, 0, 0}); }));
    const int steps = int(std::lround(2 / frequency_of(beam, setup, *model, 0) / setup.dt));
    double square = 0;
    for (int i = 1; i <= steps; i++) {
        trial.step(setup.dt);
        square += std::pow(trial.middle(Beam::LENGTH).x / w - known.at(rate * i * setup.dt), 2);
    }
    const double known_frequency = frequency_of(beam, setup, *model, 0), error = std::sqrt(square / steps);
    return outcome_of(trial, error, {{"first frequency [Hz]", NAN, known_frequency}},
                      time_steps(trial, session.effort, NO_LOAD));
}

Outcome run_sway(const Setup& setup, Session& session) {
    return sway_of(LIMBER, setup, session);
}

static double swing_time(const Session& session) {
    return session.effort == Effort::FULL ? 2 : 1;  // [s]
}
static const Where END = [](Trial& trial) { return trial.middle(Beam::LENGTH); };
static const Start UNDER_WEIGHT = [](Trial& trial) { trial.set_gravity({9.81, 0, 0}); };

Outcome run_swing(const Setup& setup, Session& session) {
    return compare_path(make_beam(peers_beam(), setup), setup, UNDER_WEIGHT, END, swing_time(session), session);
}

Outcome run_peers_swing(const Setup& setup, Session& session) {
    return run_swing(setup, session);
}

Outcome run_release(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(LIMBER, setup);
    const Start start = [&](Trial& trial) { trial.start_from(*bend_far(model, LIMBER, setup)); };
    return compare_path(model, setup, start, END, swing_time(session), session);
}

Setup twig_baseline() {
    Setup setup = static_baseline();
    setup.plant.mechanics = FROND_MECHANICS_ROD;
    return setup;
}

Outcome run_twig(const Setup& setup, Session& session) {
    ModelPtr& model = session.models["twig"];
    if (!model) {
        const tools::Casting casting = tools::cast("twig");
        tools::Play play(casting, tools::settings_of(casting, {}));
        model = std::make_shared<const Model>(play.stage.models.back());
        play.stage.models.clear();  // ownership of the model passes from the stage to us
    }
    const Start tilt = [](Trial& trial) { trial.set_gravity({0.98, -9.81, 0}); };
    const Where tip = [](Trial& trial) {
        frond_vec3 place;
        must(frond_plant_get_tip(trial.plant, &place));
        return place;
    };
    Outcome outcome = compare_path(model, setup, tilt, tip, swing_time(session), session);
    outcome.values.push_back({"CPU ms a step", 1e3 * setup.dt * outcome.cpu_per_second, NAN});
    return outcome;
}

}  // namespace frond::study
