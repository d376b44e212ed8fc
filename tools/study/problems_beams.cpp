// Beams that the others do not cover: heavy, tapered, curved, narrow, free, carried, and one that a block slides down.
// Each is a stem of Frond's own; `resolution` is its capsules or cells from foot to tip.
#include <cmath>

#include "frond/frond_robot.h"
#include "study/known.hpp"
#include "study/problems.hpp"

namespace frond::study {
namespace {

constexpr double LITTLE = 0.01;  // deflection over length that counts as small

// A stem of pieces in a row, the first one from the origin upwards.
struct Row {
    std::vector<frond_stem> stems;
    std::vector<frond_stem_section> sections;  // empty: round ones
    double length = 1;                         // [m]
    double young = 1e8, density = 1000, poisson = 0.3, friction = 0.45;
};

Row straight(double radius, double radius_end) {
    Row row;
    row.stems = {{-1, {0, 0, 0}, {0, row.length, 0}, radius, radius_end}};
    return row;
}

// Returns a circular arc that begins upright and bends towards x.
Row arc(double radius_of_arc, double angle, double radius, int pieces) {
    Row row;
    row.length = radius_of_arc * angle;
    const auto place = [&](int i) -> frond_vec3 {
        const double turned = angle * i / pieces;
        return {radius_of_arc * (1 - std::cos(turned)), radius_of_arc * std::sin(turned), 0};
    };
    for (int i = 0; i < pieces; i++) row.stems.push_back({i - 1, place(i), place(i + 1), radius, radius});
    return row;
}

// Returns an upright strip, thin towards x.
Row strip(double width, double thickness) {
    Row row = straight(width / 2, width / 2);
    row.sections = {{FROND_OUTLINE_RECTANGLE, width, thickness, {1, 0, 0}, 0, 0, 0, 0}};
    return row;
}

ModelPtr make(const Row& row, const Setup& setup) {
    frond_organ_material organ = {"stem", {}};
    organ.material.density = row.density;
    organ.material.young = row.young;
    organ.material.poisson = row.poisson;
    organ.material.thickness = row.length / 1e3;
    organ.material.friction = row.friction;
    frond_model_def def = frond_default_model_def();
    def.scale = 1;
    def.up = {0, 1, 0};
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = &organ;
    def.organ_count = 1;
    (moves_chain(setup.plant.mechanics) ? def.capsule_height : def.cage_size) = row.length / setup.resolution;
    frond_model model = {};
    const int count = int(row.stems.size());
    must(row.sections.empty()
             ? frond_model_from_stems(row.stems.data(), count, &def, &model)
             : frond_model_from_stem_sections(row.stems.data(), row.sections.data(), count, &def, &model));
    return std::make_shared<const Model>(model);
}

double round_inertia(double radius) {
    return M_PI / 4 * std::pow(radius, 4);
}

frond_vec3 last_end(const Trial& trial) {
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(trial.plant)));
    must(frond_plant_get_capsules(trial.plant, capsules.data(), int(capsules.size())));
    return capsules.back().end;
}

void push_tip(Trial& trial, const frond_vec3& force) {
    must(frond_plant_add_chain_load(trial.plant, frond_plant_get_chain_node_count(trial.plant) - 1, force, {0, 0, 0}));
}

double apart(const frond_vec3& a, const frond_vec3& b) {
    return std::hypot(std::hypot(a.x - b.x, a.y - b.y), a.z - b.z);
}

// Settles a row under loads and returns it with the cost of the setup's own steps.
struct Rests {
    std::unique_ptr<Trial> trial;
    double cpu;
    Rests(const ModelPtr& model, const Setup& setup, const Session& session, int ramp, const LoadFunction& load)
        : trial(settle(model, setup, ramp, load)), cpu(time_from(*trial, setup, session.effort, load)) {}
};

// Finds the load at which a strip buckles sideways. A light push makes it lean by d; 1/d decreases with the square of
// the load and vanishes there, which the secant method finds.
double lateral_load(const ModelPtr& model, const Setup& setup, const Session& session, double about,
                    const std::function<LoadFunction(double)>& load_of) {
    const auto firmness = [&](double load) { return 1 / last_end(*settle(model, setup, 4, load_of(load))).x; };
    double s0 = 0, f0 = firmness(0), s1 = std::pow(0.6 * about, 2), f1 = firmness(0.6 * about), critical = 0;
    const int rounds = session.effort == Effort::TINY ? 1 : 3;
    for (int i = 0; i < rounds; i++) {
        if (!(f0 - f1 > 1e-3 * f0)) throw SceneError("it does not buckle: the load does not soften it");
        critical = s1 + (s1 - s0) * f1 / (f0 - f1);
        s0 = s1;
        f0 = f1;
        s1 = critical - 0.3 * (critical - s1);
        f1 = firmness(std::sqrt(s1));
    }
    if (!(f0 - f1 > 1e-3 * f0)) throw SceneError("it does not buckle: the load does not soften it");
    return std::sqrt(s1 + (s1 - s0) * f1 / (f0 - f1));
}

// A strip that bends 1600 times as easily to one side, so that what the load bends it first is as good as none.
constexpr double WIDE = 0.04, THIN = 0.001;
double thin_stiffness(const Row& row) {
    return row.young * WIDE * std::pow(THIN, 3) / 12;
}
double twist_stiffness(const Row& row) {
    // Saint-Venant's strip, with its ends' correction.
    return row.young / (2 * (1 + row.poisson)) * WIDE * std::pow(THIN, 3) * (1.0 / 3 - 0.21 * THIN / WIDE);
}

// Returns the error of P L^2 / sqrt(EI GJ), or of w L^3 over that.
Outcome lateral(const Setup& setup, Session& session, const char* name, double known,
                const std::function<LoadFunction(const Row& row, double push)>& load_of) {
    Row row = strip(WIDE, THIN);
    row.young = 1e10;
    const ModelPtr model = make(row, setup);
    const double scale = std::sqrt(thin_stiffness(row) * twist_stiffness(row)), side = 1e-3 * thin_stiffness(row);
    const auto load_at = [&](double load) -> LoadFunction {
        const LoadFunction main = load_of(row, load * scale);
        return [=](Trial& trial, double share) {
            main(trial, share);
            push_tip(trial, {side, 0, 0});
        };
    };
    const double found = lateral_load(model, setup, session, known, load_at);
    Rests rests(model, setup, session, 4, load_at(0.5 * known));
    return outcome_of(*rests.trial, std::abs(found / known - 1), {{name, found, known}}, rests.cpu);
}

}  // namespace

Setup stem_baseline() {
    Setup setup = static_baseline();
    setup.body = Body::PLANT;
    setup.resolution = 20;
    setup.plant.mechanics = FROND_MECHANICS_ROD;
    return setup;
}

Outcome run_heavy_cantilever(const Setup& setup, Session& session) {
    constexpr double RADIUS = 0.005;
    const Row row = straight(RADIUS, RADIUS);
    const ModelPtr model = make(row, setup);
    const double per_g = row.density * M_PI * RADIUS * RADIUS / (row.young * round_inertia(RADIUS));
    std::vector<double> loads = {8};
    if (session.effort != Effort::TINY) loads = {1, 8, 64, 1000};
    Outcome outcome;
    double error = 0;
    std::vector<Value> values;
    for (const double load : loads) {
        Rests rests(model, setup, session, 20, [=](Trial& t, double share) {
            t.set_gravity({load / per_g * share, 0, 0});
        });
        const Droop known = droop_of(0, load);
        const frond_vec3 tip = last_end(*rests.trial);
        values.push_back({"drop / width at " + std::to_string(int(load)), tip.x / tip.y, known.down / known.along});
        error = std::max(error, std::abs(tip.x / tip.y / (known.down / known.along) - 1));
        outcome = outcome_of(*rests.trial, error, values, rests.cpu);
    }
    return outcome;
}

Outcome run_cone(const Setup& setup, Session& session) {
    constexpr double RADIUS = 0.02;
    Outcome outcome;
    double error = 0;
    std::vector<Value> values;
    for (const double ratio : {2.0, 5.0, 10.0}) {
        const Row row = straight(RADIUS, RADIUS / ratio);
        const double force = 3 * LITTLE * row.young * round_inertia(RADIUS) / ratio;
        Rests rests(make(row, setup), setup, session, 1, [=](Trial& t, double share) {
            push_tip(t, {force * share, 0, 0});
        });
        const double down = last_end(*rests.trial).x / LITTLE;
        values.push_back({"deflection / formula at " + std::to_string(int(ratio)) + ":1", down, 1});
        error = std::max(error, std::abs(down - 1));
        outcome = outcome_of(*rests.trial, error, values, rests.cpu);
    }
    return outcome;
}

// Bathe and Bolourchi's bend: a round section with the square's E I, which with nu = 0 is its G J too.
Outcome run_bend_45(const Setup& setup, Session& session) {
    constexpr double ARC = 100, FORCE = 600;
    const double radius = std::pow(1.0 / 12 * 4 / M_PI, 0.25);
    Row row = arc(ARC, M_PI / 4, radius, std::max(1, setup.resolution / 2));
    row.young = 1e7;
    row.poisson = 0;
    row.density = 1;
    Rests rests(make(row, setup), setup, session, 30, [=](Trial& t, double share) {
        push_tip(t, {0, 0, FORCE * share});
    });
    const frond_vec3 tip = last_end(*rests.trial), begin = row.stems.back().end;
    const frond_vec3 moved = {tip.x - begin.x, tip.y - begin.y, tip.z - begin.z};
    const frond_vec3 known = {-13.7208, -23.6460, 53.5776};
    return outcome_of(*rests.trial, apart(moved, known) / row.length,
                      {{"towards the centre", moved.x, known.x},
                       {"along the clamp", moved.y, known.y},
                       {"along the force", moved.z, known.z}},
                      rests.cpu);
}

// Castigliano: P R^3 ((pi/4) / E I + (3 pi/4 - 2) / G J) at the end of a quarter of a circle.
Outcome run_arc(const Setup& setup, Session& session) {
    constexpr double ARC = 1, RADIUS = 0.01;
    const Row row = arc(ARC, M_PI / 2, RADIUS, std::max(1, setup.resolution / 2));
    const double EI = row.young * round_inertia(RADIUS), GJ = EI / (1 + row.poisson);
    const double flexibility = M_PI / 4 / EI + (3 * M_PI / 4 - 2) / GJ, force = LITTLE / flexibility;
    Rests rests(make(row, setup), setup, session, 1, [=](Trial& t, double share) {
        push_tip(t, {0, 0, force * share});
    });
    const double down = last_end(*rests.trial).z / LITTLE;
    return outcome_of(*rests.trial, std::abs(down - 1), {{"deflection / formula", down, 1}}, rests.cpu);
}

Outcome run_lateral_tip(const Setup& setup, Session& session) {
    return lateral(setup, session, "P L^2/sqrt(E I G J)", 4.01260, [](const Row&, double force) -> LoadFunction {
        return [=](Trial& t, double share) { push_tip(t, {0, 0, force * share}); };
    });
}

Outcome run_lateral_weight(const Setup& setup, Session& session) {
    return lateral(setup, session, "w L^3/sqrt(E I G J)", 12.8538, [](const Row& row, double weight) -> LoadFunction {
        const double g = weight / (row.density * WIDE * THIN);
        return [=](Trial& t, double share) { t.set_gravity({0, 0, g * share}); };
    });
}

Setup free_stem_baseline() {
    Setup setup = stem_baseline();
    setup.plant.root_height = -1;
    return setup;
}

// A free rod turns about an axis across it, past half a turn and on.
Outcome run_spinning_rod(const Setup& setup, Session& session) {
    constexpr double SPIN = 3, RADIUS = 0.01;
    Trial trial(make(straight(RADIUS, RADIUS), setup), setup);
    Trial::State state = trial.state();
    for (size_t i = 0; i < state.x.size(); i += 3) {
        state.v[i] = -SPIN * (state.x[i + 1] - 0.5);
        state.v[i + 1] = SPIN * state.x[i];
    }
    trial.set_state(state);
    frond_energy begin, end;
    must(frond_plant_get_energy(trial.plant, &begin));
    const double time = session.effort == Effort::FULL ? 20 : 4;
    for (double t = 0; t < time; t += setup.dt) trial.step(setup.dt);
    must(frond_plant_get_energy(trial.plant, &end));
    return outcome_of(trial, std::abs(end.kinetic / begin.kinetic - 1),
                      {{"kinetic energy [J]", end.kinetic, begin.kinetic}}, trial.cpu / time);
}

// With damping, which pins that move jerkily turn into force.
Setup carried_baseline() {
    Setup setup;
    setup.body = Body::PLANT;
    setup.resolution = 20;
    setup.plant.mass_damping = 0;
    return setup;
}

Outcome run_moving_root(const Setup& setup, Session& session) {
    constexpr double RADIUS = 0.0113, FASTER = 5;  // [m], [m/s^2]
    Row row = straight(RADIUS, RADIUS);
    row.young = 1e10;
    Trial trial(make(row, setup), setup);
    trial.set_gravity({0, -G, 0});
    const std::vector<double> x = trial.state().x;
    std::vector<int> foot;
    for (int i = 0; i < int(x.size()) / 3; i++)
        if (frond_plant_move_pin(trial.plant, i, {x[3 * size_t(i)], x[3 * size_t(i) + 1], x[3 * size_t(i) + 2]}) ==
            FROND_OK)
            foot.push_back(i);
    const int count = int(std::lround((session.effort == Effort::FULL ? 2 : 1) / setup.dt));
    frond_vec3 mean = {0, 0, 0};
    for (int step = 1; step <= count; step++) {
        const double t = step * setup.dt, way = 0.5 * FASTER * t * t;
        for (const int i : foot) {
            const double* p = &x[3 * size_t(i)];
            must(frond_plant_move_pin(trial.plant, i, {p[0] + way, p[1], p[2]}));
        }
        trial.step(setup.dt);
        frond_vec3 force;
        must(frond_plant_get_root_force(trial.plant, {0, 0, 0}, &force, nullptr));
        if (2 * step <= count) continue;
        mean.x += force.x / (count - count / 2);
        mean.y += force.y / (count - count / 2);
    }
    const double mass = trial.model->info().mass;
    return outcome_of(trial, std::hypot(mean.x - mass * FASTER, mean.y - mass * G) / (mass * G),
                      {{"force along the way [N]", mean.x, mass * FASTER}, {"upwards [N]", mean.y, mass * G}},
                      trial.cpu / (count * setup.dt));
}

// Down a stem that leans by 30 degrees, over the joints of its capsules.
Outcome run_sliding_block(const Setup& setup, Session&) {
    constexpr double RADIUS = 0.02, HALF = 0.03, ANGLE = M_PI / 6, FROM = 2.6, LONG = 3, RUBS = 0.3;
    const double sine = std::sin(ANGLE), cosine = std::cos(ANGLE);
    Row row;
    row.stems = {{-1, {0, 0, 0}, {LONG * cosine, LONG * sine, 0}, RADIUS, RADIUS}};
    row.length = LONG;
    row.friction = 1;
    Trial trial(make(row, setup), setup);
    for (int i = 0; i < frond_plant_get_node_count(trial.plant); i++) must(frond_plant_pin(trial.plant, i));
    trial.set_gravity({0, -G, 0});
    frond_rigid_def block = frond_default_rigid_def();
    block.shape = FROND_SHAPE_BOX;
    block.size = {2 * HALF, HALF, 2 * HALF};
    block.mass = 0.5;
    block.friction = RUBS;
    block.state.position = {FROM * cosine - (RADIUS + HALF) * sine, FROM * sine + (RADIUS + HALF) * cosine, 0};
    block.state.rotation = {0, 0, std::sin(ANGLE / 2), std::cos(ANGLE / 2)};
    frond_rigid rigid = {};
    must(frond_rigid_create(trial.world, &block, &rigid));
    const auto speed = [&] {
        frond_rigid_state state;
        must(frond_rigid_get_state(rigid, &state));
        return -(state.velocity.x * cosine + state.velocity.y * sine);
    };
    // It first comes to lie on the stem.
    const int settled = int(std::ceil(0.15 / setup.dt)), sliding = 3 * settled;
    for (int i = 0; i < settled; i++) trial.step(setup.dt);
    const double before = speed();
    for (int i = 0; i < sliding; i++) trial.step(setup.dt);
    const double found = (speed() - before) / (sliding * setup.dt), known = G * (sine - RUBS * cosine);
    return outcome_of(trial, std::abs(found / known - 1), {{"acceleration [m/s^2]", found, known}},
                      trial.cpu / ((settled + sliding) * setup.dt));
}

}  // namespace frond::study
