// Cases: long times, irregular time steps, settings that change while a plant moves.
#include <cmath>

#include "stability/bench.hpp"

namespace frond::stability {
namespace {

// Returns a column that carries a share of its buckling load; its height is Greenhill's times the share's cube root.
frond_model column(double share) {
    constexpr double RADIUS = 0.01;
    const frond_material material = plain_material();
    const double greenhill = std::cbrt(7.8373 * material.young * RADIUS * RADIUS / 4 / (9.81 * material.density));
    const double height = greenhill * std::cbrt(share);
    const frond_organ_material organ = {"stem", material};
    const frond_stem stem = {-1, {0, 0, 0}, {0, height, 0}, RADIUS, RADIUS};
    frond_model_def def = frond_default_model_def();
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.cage_size = def.capsule_height = height / 8;
    def.organs = &organ;
    def.organ_count = 1;
    frond_model model = {};
    must(frond_model_from_stems(&stem, 1, &def, &model));
    return model;
}

// Returns the tip's position a minute after a light push.
frond_vec3 tip_of_column(Bench& bench, double share, double& height) {
    const frond_plant plant = bench.add(bench.keep(column(share)));
    frond_vec3 tip = {};
    must(frond_plant_get_tip(plant, &tip));
    height = tip.y;
    const Places rest = bench.places(plant);
    size_t top = 0;
    for (size_t i = 0; i < rest.size(); i++)
        if (rest[i].y > rest[top].y) top = i;
    bench.run(0.2, [&](double) { must(frond_plant_add_force(plant, int(top), {1e-3, 0, 0})); });
    bench.box = 3 * height;
    bench.run(60);
    const Places now = bench.places(plant);
    return now[top];
}

void below_buckling(Bench& bench) {
    double height = 0;
    const frond_vec3 tip = tip_of_column(bench, 0.7, height);
    bench.expect(std::hypot(tip.x, tip.z) <= 0.1 * height, "leans [m]", std::hypot(tip.x, tip.z), 0.1 * height);
}
void above_buckling(Bench& bench) {
    double height = 0;
    const frond_vec3 tip = tip_of_column(bench, 1.6, height);
    bench.expect(tip.y <= 0.95 * height, "height of the tip [m]", tip.y, 0.95 * height);
    bench.expect(bench.fastest() <= 1, "speed [m/s]", bench.fastest(), 1);
}

// The beam is bent to and fro by its tip, beyond its yield strain.
void cycle_plasticity(Bench& bench) {
    constexpr int CYCLES = 1000;
    frond_material material = plain_material();
    material.yield_strain = 0.02;
    material.creep_rate = 10;
    bench.plant_def.root_height = FOOT;
    bench.plant_def.effects |= FROND_EFFECT_PLASTICITY;
    const frond_plant plant = bench.add(bench.keep(model_of(make_lattice(0.1, 1, even_heights(1, 8)), material)));
    frond_grab grab = {};
    must(frond_grab_create(plant, {0, 1, 0}, 1e4, &grab));
    for (int i = 0; i < CYCLES; i++)
        for (int side = -1; side <= 1; side += 2) {
            must(frond_grab_move(grab, {0.6 * side, 0.7, 0}));
            must(frond_world_step(bench.world(), bench.cell.dt));
            if (i % 20 == 0) bench.check();
        }
    frond_grab_destroy(grab);
    bench.run(4);
    bench.expect(bench.fastest() <= 2, "speed [m/s]", bench.fastest(), 2);
}

void switch_effects(Bench& bench) {
    bench.plant_def.effects = FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_BREAKING);
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {5, 0, 0};
    must(frond_world_set_wind(bench.world(), &wind));
    bench.run(3, [&](double) {
        must(frond_plant_set_effects(plant,
                                     uint32_t(bench.random()) & FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_BREAKING)));
    });
    must(frond_plant_set_effects(plant, FROND_EFFECT_DEFAULT));
    must(frond_world_set_wind(bench.world(), nullptr));
    bench.run(4);
    bench.expect_shape(plant, rest, 0.25);
}

// The mechanics changes in each step while the plant is pulled aside, and is the cell's at the end.
void switch_mechanics(Bench& bench) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    frond_grab grab = {};
    must(frond_grab_create(plant, {0, 0.6, 0}, 50, &grab));
    int turn = 0;
    bench.run(2, [&](double time) {
        must(frond_grab_move(grab, {0.2 * std::sin(3 * time), 0.55, 0}));
        must(frond_plant_set_mechanics(plant, frond_mechanics(turn++ % FROND_MECHANICS_COUNT)));
    });
    frond_grab_destroy(grab);
    must(frond_plant_set_mechanics(plant, bench.cell.mechanics));
    bench.run(4);
    bench.expect_shape(plant, rest, 0.25);
}

void rest_for(Bench& bench, int steps, frond_model model) {
    constexpr double DRIFT = 0.01;
    bench.world_def.sleep_distance = 0;
    bench.plant_def.root_height = FOOT;
    const frond_plant plant = bench.add(model);
    bench.run(2);
    const Places before = bench.places(plant);
    for (int i = 0; i < steps; i++) {
        must(frond_world_step(bench.world(), bench.cell.dt));
        if (i % 1000 == 0) bench.check();
    }
    const Places after = bench.places(plant);
    double most = 0;
    for (size_t i = 0; i < before.size(); i++) most = std::max(most, length(after[i] - before[i]));
    bench.expect(most <= DRIFT, "drift [m]", most, DRIFT);
}

void rest_10000(Bench& bench) {
    rest_for(bench, 10000, bench.keep(model_of(make_lattice(0.1, 1, even_heights(1, 5)), plain_material())));
}
void rest_million(Bench& bench) {
    if (bench.cell.integrator != FROND_INTEGRATOR_BDF2 || bench.cell.dt != 1.0 / 60)
        throw DoesNotApply("run with the default integrator at 1/60 s only");
    rest_for(bench, 1000000, bench.keep(model_of(make_lattice(0.1, 1, even_heights(0.3, 2)), plain_material())));
}

void swing_with(Bench& bench, const std::function<double()>& step) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    frond_grab grab = {};
    must(frond_grab_create(plant, {0, 0.6, 0}, 50, &grab));
    must(frond_grab_move(grab, {0.3, 0.5, 0}));
    for (double time = 0; time < 1; time += bench.cell.dt) bench.step(step());
    frond_grab_destroy(grab);
    for (double time = 0; time < 6; time += bench.cell.dt) bench.step(step());
    bench.expect_shape(plant, rest, 0.25);
}

// Every third step is zero; others are from a thousandth of the cell's step to all of it.
void odd_steps(Bench& bench) {
    int count = 0;
    swing_with(bench, [&] { return count++ % 3 == 0 ? 0.0 : bench.cell.dt * std::pow(10, bench.between(-3, 0)); });
}

void loose_solver(Bench& bench) {
    bench.plant_def.tuning.linear_solver = FROND_LINEAR_SOLVER_PCG_JACOBI;
    bench.plant_def.tuning.linear_tolerance = 0.5;
    bench.plant_def.tuning.linear_iterations = 3;
    swing_with(bench, [&] { return bench.cell.dt; });
}

void loose_newton(Bench& bench) {
    bench.plant_def.tuning.newton_iterations = 100;
    bench.plant_def.tuning.newton_tolerance = 1;
    swing_with(bench, [&] { return bench.cell.dt; });
}

void undamped(Bench& bench) {
    bench.plant_def.mass_damping = bench.plant_def.stiffness_damping = bench.plant_def.material_damping = 0;
    bench.plant_def.root_height = FOOT;
    const frond_plant plant = bench.add(beam());
    const double at_rest = bench.energy();
    Places x = bench.places(plant);
    for (frond_vec3& p : x)
        if (p.y > FOOT) p = {std::sin(p.y) + p.x * std::cos(p.y), 1 - std::cos(p.y) + p.y * 0.5, p.z};
    bench.put(plant, x);
    bench.expect_no_energy_from_nothing(10, at_rest);
}

}  // namespace

std::vector<Case> time_cases() {
    const char* back = "finite; after 4 s no tet inside out, nodes within 0.25 of its size of where they stood";
    return {
        {"below_buckling", "a column with 0.7 of the load under which it topples, for a minute",
         "its tip leans by less than a tenth of its height", below_buckling, true},
        {"above_buckling", "a column with 1.6 times that load, for a minute",
         "its tip is below 0.95 of its height and slower than 1 m/s", above_buckling, true},
        {"plasticity_cycled", "bent to and fro by its tip 1000 times, beyond its yield strain",
         "finite; slower than 2 m/s 4 s later", cycle_plasticity},
        {"effects_switched", "other effects in each step, in wind", back, switch_effects},
        {"mechanics_switched", "other mechanics in each step, pulled aside meanwhile", back, switch_mechanics},
        {"rest_10000", "10,000 steps at rest, without sleep", "no node moves by more than 1 cm", rest_10000, true},
        {"rest_million", "a million steps at rest, without sleep", "no node moves by more than 1 cm", rest_million,
         true},
        {"odd_steps", "pulled aside and let go; every third step is zero, others 1e-3 to 1 times the cell's",
         "finite; no tet inside out, nodes within 0.25 of its size of where they stood", odd_steps},
        {"loose_solver",
         "pulled aside and let go; conjugate gradients that stop after 3 rounds or at half the residual",
         "finite; no tet inside out, nodes within 0.25 of its size of where they stood", loose_solver},
        {"loose_newton", "pulled aside and let go; 100 Newton iterations with a tolerance of 1",
         "finite; no tet inside out, nodes within 0.25 of its size of where they stood", loose_newton},
        {"undamped", "a beam without any damping, let go from a far bend", "no energy out of nothing in 10 s",
         undamped},
    };
}

}  // namespace frond::stability
