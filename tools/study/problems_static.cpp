// Beams at rest: each is bent by known loads until it rests, and compared with the known solution; its cost is that of
// the setup's own steps from there.
#include <cmath>

#include "study/known.hpp"
#include "study/problems.hpp"

namespace frond::study {
namespace {

constexpr Beam SLENDER = {0.025, 1e8, 1000, 0.3, {}};
constexpr double SMALL = 0.01;  // deflection over length, or angle [rad], that counts as small

double stiffness_of(const Beam& beam, const Setup& setup) {
    return beam.young * inertia_of(beam, setup.body);
}
double weight_of(const Beam& beam, const Setup& setup, double g) {
    return beam.density * area_of(beam, setup.body) * g;
}

// A beam that rests under its loads, and the cost of the setup's own steps from there.
struct Bent {
    std::unique_ptr<Trial> rests;
    double cpu_per_second;
    Bent(const ModelPtr& model, const Setup& setup, const Session& session, int ramp, const LoadFunction& load)
        : rests(settle(model, setup, ramp, load)), cpu_per_second(time_from(*rests, setup, session.effort, load)) {}
    Trial& trial() const { return *rests; }
};

// Returns the distance of the end from its known position, over length.
double place_error(const frond_vec3& end, const Droop& known) {
    return std::hypot(end.x - known.down, end.y - known.along) / Beam::LENGTH;
}

// Returns the largest error of several loads, and the cost of the last.
Outcome worst_of(const ModelPtr& model, const Setup& setup, const Session& session, const std::vector<double>& loads,
                 int ramp, const char* name, const std::function<LoadFunction(double)>& load_of,
                 const std::function<Droop(double)>& known_of) {
    Outcome outcome;
    double error = 0;
    std::vector<Value> values;
    for (double size : loads) {
        const Droop known = known_of(size);
        Bent bent(model, setup, session, ramp, load_of(size));
        const frond_vec3 end = bent.trial().middle(Beam::LENGTH);
        char label[64];
        std::snprintf(label, sizeof label, "%s = %g: down/L", name, size);
        values.push_back({label, end.x, known.down});
        std::snprintf(label, sizeof label, "%s = %g: along/L", name, size);
        values.push_back({label, end.y, known.along});
        error = std::max(error, place_error(end, known));
        outcome = outcome_of(bent.trial(), error, values, bent.cpu_per_second);
    }
    return outcome;
}

std::vector<double> loads(const Session& session, std::vector<double> few, std::vector<double> all) {
    return session.effort == Effort::FULL ? all : few;
}

}  // namespace

Setup static_baseline() {
    Setup setup;
    setup.plant.effects &= ~uint32_t(FROND_EFFECT_DAMPING);
    return setup;
}

Setup peers_baseline() {
    Setup setup = static_baseline();
    setup.body = Body::MESH;
    setup.resolution = 3;
    setup.plant.root_height = 1e-4;
    return setup;
}

Outcome run_cantilever_tip(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(SLENDER, setup);
    const double P = 3 * SMALL * stiffness_of(SLENDER, setup);
    Bent bent(model, setup, session, 1, [=](Trial& t, double share) { t.push_end({P * share, 0, 0}, {0, 0, 0}); });
    const double down = bent.trial().middle(Beam::LENGTH).x;
    return outcome_of(bent.trial(), std::abs(down / SMALL - 1), {{"tip deflection/L", down, SMALL}},
                      bent.cpu_per_second);
}

Outcome run_cantilever_weight(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(SLENDER, setup);
    const double g = 8 * SMALL * stiffness_of(SLENDER, setup) / weight_of(SLENDER, setup, 1);
    Bent bent(model, setup, session, 1, [=](Trial& t, double share) { t.set_gravity({g * share, 0, 0}); });
    const double known = small_droop(8 * SMALL * cap_mass(SLENDER, setup.body, *model), 8 * SMALL);
    const double down = bent.trial().middle(Beam::LENGTH).x;
    return outcome_of(bent.trial(), std::abs(down / known - 1), {{"tip deflection/L", down, known}},
                      bent.cpu_per_second);
}

Outcome run_elastica_tip(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(SLENDER, setup);
    const double EI = stiffness_of(SLENDER, setup);
    const auto load_of = [=](double a) -> LoadFunction {
        return [=](Trial& t, double share) { t.push_end({a * EI * share, 0, 0}, {0, 0, 0}); };
    };
    return worst_of(model, setup, session, loads(session, {1, 5}, {0.25, 1, 2, 5, 10}), 20, "P L^2/(E I)", load_of,
                    [](double a) { return droop_of(a, 0); });
}

Outcome run_elastica_weight(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(SLENDER, setup);
    const double per_g = weight_of(SLENDER, setup, 1) / stiffness_of(SLENDER, setup);
    const double caps = cap_mass(SLENDER, setup.body, *model);
    const auto load_of = [=](double k) -> LoadFunction {
        return [=](Trial& t, double share) { t.set_gravity({k / per_g * share, 0, 0}); };
    };
    return worst_of(model, setup, session, loads(session, {1, 5}, {1, 5, 20, 50}), 20, "q L^3/(E I)", load_of,
                    [=](double k) { return droop_of(k * caps, k); });
}

Outcome run_roll_up(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(SLENDER, setup);
    const double EI = stiffness_of(SLENDER, setup);
    const auto load_of = [=](double m) -> LoadFunction {
        return [=](Trial& t, double share) { t.push_end({0, 0, 0}, {0, 0, -m * EI * share}); };
    };
    return worst_of(model, setup, session, loads(session, {2 * M_PI}, {M_PI / 2, M_PI, 2 * M_PI}), 40, "M L/(E I)",
                    load_of, arc_of);
}

Outcome run_torsion(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(SLENDER, setup);
    constexpr double TWIST = 0.05;  // [rad]
    const double G = SLENDER.young / (2 * (1 + SLENDER.poisson));
    const double T = TWIST * G * torsion_constant_of(SLENDER, setup.body) / Beam::LENGTH;
    Bent bent(model, setup, session, 1, [=](Trial& t, double share) { t.push_end({0, 0, 0}, {0, T * share, 0}); });
    const double twist = bent.trial().twist(Beam::LENGTH);
    return outcome_of(bent.trial(), std::abs(twist / TWIST - 1), {{"twist of the end [rad]", twist, TWIST}},
                      bent.cpu_per_second);
}

// Bends ever more slender beams of ten cells: the longer the cells, the more tets lock, unless they are calibrated.
Outcome run_aspect(const Setup& setup, Session& session) {
    constexpr int CELLS = 10;
    const bool mesh = setup.body == Body::MESH;
    Outcome outcome;
    double error = 0;
    std::vector<Value> values;
    for (int aspect : {1, 2, 5, 10}) {
        Beam beam = SLENDER;
        beam.width = Beam::LENGTH / (CELLS * aspect);
        if (mesh) beam.cells[0] = {setup.resolution, CELLS * setup.resolution};
        const ModelPtr model = make_beam(beam, setup);
        const double P = 3 * SMALL * stiffness_of(beam, setup);
        Bent bent(model, setup, session, 1, [=](Trial& t, double share) { t.push_end({P * share, 0, 0}, {0, 0, 0}); });
        const double down = bent.trial().middle(Beam::LENGTH).x;
        error = std::max(error, std::abs(down / SMALL - 1));
        values.push_back({"aspect " + std::to_string(aspect) + ": deflection / formula", down / SMALL, 1});
        outcome = outcome_of(bent.trial(), error, values, bent.cpu_per_second);
    }
    return outcome;
}

// A light push makes an upright column lean by d; 1/d decreases with its weight and vanishes where it buckles. That
// weight is found by the secant method.
Outcome run_greenhill(const Setup& setup, Session& session) {
    const ModelPtr model = make_beam(SLENDER, setup);
    const double EI = stiffness_of(SLENDER, setup), per_g = weight_of(SLENDER, setup, 1) / EI;
    const double known = greenhill_number(cap_mass(SLENDER, setup.body, *model));
    constexpr double PUSH = 3e-4;
    const auto load_of = [&](double w) -> LoadFunction {
        return [=](Trial& t, double share) {
            t.set_gravity({0, -w / per_g * share, 0});
            t.push_end({PUSH * EI, 0, 0}, {0, 0, 0});
        };
    };
    const auto firmness = [&](double w) { return 1 / settle(model, setup, 1, load_of(w))->middle(Beam::LENGTH).x; };
    double w0 = 0, f0 = firmness(w0), w1 = 0.3 * known, f1 = firmness(w1);
    const int rounds = session.effort == Effort::TINY ? 2 : 4;
    double critical = 0;
    for (int i = 0; i < rounds; i++) {
        if (!(f0 - f1 > 1e-3 * f0)) throw SceneError("it does not buckle: weight does not soften it");
        critical = w1 + (w1 - w0) * f1 / (f0 - f1);
        // Approach from below, so that the lean stays small.
        const double next = critical - 0.3 * (critical - w1);
        w0 = w1;
        f0 = f1;
        w1 = next;
        f1 = firmness(w1);
    }
    Bent bent(model, setup, session, 1, load_of(w0));
    return outcome_of(bent.trial(), std::abs(std::cbrt(critical / known) - 1), {{"w L^3/(E I)", critical, known}},
                      bent.cpu_per_second);
}

Outcome run_peers(const Setup& setup, Session& session) {
    const Beam beam = peers_beam();
    const ModelPtr model = make_beam(beam, setup);
    constexpr double G = 9.81;
    Bent bent(model, setup, session, 2, [=](Trial& t, double share) { t.set_gravity({G * share, 0, 0}); });
    const double k = weight_of(beam, setup, G) / stiffness_of(beam, setup);
    const Droop known = droop_of(k * cap_mass(beam, setup.body, *model), k);
    const frond_vec3 end = bent.trial().middle(Beam::LENGTH);
    return outcome_of(
        bent.trial(), place_error(end, known),
        {{"droop of the end [m]", end.x, known.down}, {"CPU ms per 1/60 s", 1e3 / 60 * bent.cpu_per_second, NAN}},
        bent.cpu_per_second);
}

}  // namespace frond::study
