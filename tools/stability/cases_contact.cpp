// Cases: bodies that hit a plant, overlap it or press it.
#include <cmath>

#include "stability/bench.hpp"

namespace frond::stability {
namespace {

double mass_of(frond_model model) {
    frond_model_info info;
    must(frond_model_get_info(model, &info));
    return info.mass;
}

frond_rigid_def ball_of(double mass, const frond_vec3& from, const frond_vec3& velocity) {
    frond_rigid_def ball = frond_default_rigid_def();
    ball.size = {0.05, 0, 0};
    ball.mass = mass;
    ball.state.position = from;
    ball.state.velocity = velocity;
    return ball;
}

// A ball flies against the stem and is removed after a second; the plant returns. It is never faster than 5 times the
// sum of the ball's speed and 5 m/s.
void hit(Bench& bench, const frond_rigid_def& ball, const frond_vec3& at) {
    const frond_plant plant = bench.add(herb(), at);
    const Places rest = bench.places(plant);
    const frond_rigid rigid = bench.add(ball);
    const double fastest = 5 * (length(ball.state.velocity) + 5);
    bench.run(1, [&](double) { bench.expect(bench.fastest() <= fastest, "speed [m/s]", bench.fastest(), fastest); });
    frond_rigid_state state = {};
    must(frond_rigid_get_state(rigid, &state));
    bench.expect(std::isfinite(length(state.position)), "place of the ball [m]", length(state.position), 1e9);
    frond_rigid_destroy(rigid);
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, NEAR_DRIVEN);
}

void hit_by(Bench& bench, double mass_ratio, double speed) {
    hit(bench, ball_of(mass_ratio * mass_of(herb()), {-0.4, 0.35, 0}, {speed, 0, 0}), {});
}
void light_ball(Bench& bench) {
    const double least = 1e-6;  // mass that a body must have [kg]
    hit_by(bench, std::max(1e-4, least / mass_of(herb())), 5);
}
void equal_ball(Bench& bench) {
    hit_by(bench, 1, 5);
}
void heavy_ball(Bench& bench) {
    hit_by(bench, 1e4, 5);
}
void bullet(Bench& bench) {
    hit_by(bench, 0.5, 100);
}

// Everything is 10 km away, where Bullet's floats are a millimetre apart.
void far_away(Bench& bench) {
    const frond_vec3 at = {1e4, 0, 1e4};
    hit(bench, ball_of(0.5, at + frond_vec3{-0.4, 0.35, 0}, {5, 0, 0}), at);
}

// A plant that stands inside a body stays calm and in place.
void stand_in(Bench& bench, const frond_rigid_def& body) {
    constexpr double CALM = 3;  // [m/s]
    bench.add(body);
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    bench.run(2, [&](double) { bench.expect(bench.fastest() <= CALM, "speed [m/s]", bench.fastest(), CALM); });
    bench.expect_shape(plant, rest, NEAR_DRIVEN);
}

frond_rigid_def block(const frond_vec3& half, const frond_vec3& at) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_BOX;
    def.size = half;
    def.mass = 0;
    def.state.position = at;
    return def;
}

void in_a_box(Bench& bench) {
    stand_in(bench, block({0.5, 0.5, 0.5}, {0, 0.3, 0}));
}
void wall_through(Bench& bench) {
    stand_in(bench, block({0.02, 1, 1}, {0.1, 0.3, 0}));
}
void under_ground(Bench& bench) {
    frond_rigid_def ground = frond_default_rigid_def();
    ground.shape = FROND_SHAPE_PLANE;
    ground.state.position = {0, 0.35, 0};
    stand_in(bench, ground);
}

// The plant is squeezed between two plates that close to a tenth of their distance and are then removed.
void squeeze(Bench& bench) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    const double wide = 0.3, thick = 0.05;
    frond_rigid plates[2];
    for (int i = 0; i < 2; i++)
        plates[i] = bench.add(block({thick, 0.4, 0.5}, {(2 * i - 1) * (wide + thick), 0.55, 0}));
    bench.run(2, [&](double time) {
        for (int i = 0; i < 2; i++) {
            frond_rigid_state state = {};
            must(frond_rigid_get_state(plates[i], &state));
            state.position.x = (2 * i - 1) * (wide * std::max(0.1, 1 - time) + thick);
            must(frond_rigid_set_state(plates[i], &state));
        }
    });
    for (frond_rigid plate : plates) frond_rigid_destroy(plate);
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, NEAR_DRIVEN);
}

// The plant is pressed down by a plate to about half of its height.
void press(Bench& bench) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    const frond_rigid plate = bench.add(block({0.5, 0.05, 0.5}, {0, 0.8, 0}));
    bench.run(2, [&](double time) {
        frond_rigid_state state = {};
        must(frond_rigid_get_state(plate, &state));
        state.position.y = 0.8 - 0.4 * std::min(1.0, time);
        must(frond_rigid_set_state(plate, &state));
    });
    frond_rigid_destroy(plate);
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, NEAR_DRIVEN);
}

void drop(Bench& bench) {
    bench.plant_def.root_height = -1;
    frond_rigid_def ground = frond_default_rigid_def();
    ground.shape = FROND_SHAPE_PLANE;
    bench.add(ground);
    const frond_plant plant = bench.add(herb(), {0, 0.5, 0});
    bench.run(4);
    double lowest = 0;
    for (const frond_vec3& p : bench.places(plant)) lowest = std::min(lowest, p.y);
    bench.expect(lowest > -0.1, "under the ground [m]", -lowest, 0.1);
    bench.expect(bench.fastest() < 2, "speed where it lies [m/s]", bench.fastest(), 2);
}

// The plant is jerked about by a body to which it is bonded.
void tear(Bench& bench) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    frond_rigid_def hand = ball_of(0, {0, 0.7, 0.02}, {});
    const frond_rigid rigid = bench.add(hand);
    frond_bond bond = {};
    must(frond_bond_create(plant, {0, 0.6, 0.02}, rigid, &bond));
    bench.run(1, [&](double time) {
        frond_rigid_state state = {};
        must(frond_rigid_get_state(rigid, &state));
        state.position = {0.4 * std::sin(30 * time), 0.7, 0.02 + 0.4 * std::sin(23 * time)};
        must(frond_rigid_set_state(rigid, &state));
    });
    frond_bond_destroy(bond);
    frond_rigid_destroy(rigid);
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, NEAR_DRIVEN);
}

// Stems snap under balls of ten times the plant's mass, of which one lies on the rest.
void break_in_contact(Bench& bench) {
    bench.plant_def.effects |= FROND_EFFECT_BREAKING;
    bench.add(herb());
    frond_rigid_def ground = frond_default_rigid_def();
    ground.shape = FROND_SHAPE_PLANE;
    bench.add(ground);
    bench.add(ball_of(10 * mass_of(herb()), {-0.4, 0.35, 0}, {15, 0, 0}));
    bench.add(ball_of(10 * mass_of(herb()), {0.02, 1.2, 0}, {0, -5, 0}));
    bench.box = 100;  // fragments fly off
    bench.run(3);
    bench.expect(bench.fastest() < 50, "speed [m/s]", bench.fastest(), 50);
}

}  // namespace

std::vector<Case> contact_cases() {
    const char* back =
        "never faster than 5 times the ball and 5 m/s; 4 s after it is gone no tet inside out, nodes within 0.25 of "
        "its size";
    const char* calm = "never faster than 3 m/s; after 2 s no tet inside out, nodes within 0.25 of its size";
    const char* gone = "finite; 4 s later no tet inside out, nodes within 0.25 of its size of where they stood";
    return {
        {"ball_1e-4", "a ball of 1e-4 of the plant's mass, but at least 1 mg, at 5 m/s", back, light_ball},
        {"ball_1", "a ball of the plant's mass at 5 m/s", back, equal_ball},
        {"ball_1e4", "a ball of 1e4 times the plant's mass at 5 m/s", back, heavy_ball},
        {"ball_100_m/s", "a ball of half the plant's mass at 100 m/s", back, bullet},
        {"far_from_origin", "10 km from the origin, hit by a ball", back, far_away},
        {"in_a_box", "a plant made inside a block", calm, in_a_box},
        {"wall_through", "a plant made with a wall through its branch", calm, wall_through},
        {"under_ground", "a plant made with its lower half under the ground", calm, under_ground},
        {"squeezed", "squeezed between two plates to a tenth, let go", gone, squeeze},
        {"pressed", "pressed down by a plate to 0.35 m, let go", gone, press},
        {"dropped", "a plant that nothing holds, dropped on the ground",
         "after 4 s nothing is deeper than 0.1 m in the ground or faster than 2 m/s", drop},
        {"torn", "its top bound to a body that is carried about at 12 m/s for a second", gone, tear},
        {"broken_in_contact", "snapped by balls of ten times its mass", "finite; slower than 50 m/s after 3 s",
         break_in_contact},
    };
}

}  // namespace frond::stability
