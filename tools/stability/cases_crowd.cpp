// Cases: plants that overlap.
#include <algorithm>
#include <cmath>

#include "stability/bench.hpp"

namespace frond::stability {
namespace {

// Two plants at the same place, or nearly, come apart without flying off, except for their feet.
void together(Bench& bench, const frond_vec3& second) {
    constexpr double CALM = 5, DEPTH = 0.005, FEET = 0.2;  // [m/s], [m], [m]
    const frond_plant first = bench.add(herb());
    bench.add(herb(), second);
    bench.run(3, [&](double) { bench.expect(bench.fastest() <= CALM, "speed [m/s]", bench.fastest(), CALM); });
    const double depth = tools::contact_depth(first, FEET);
    bench.expect(depth <= DEPTH, "depth in each other [m]", depth, DEPTH);
}

void same_place(Bench& bench) {
    together(bench, {0, 0, 0});
}
void nearly_same_place(Bench& bench) {
    together(bench, {0.01, 0, 0.003});
}

void pile(Bench& bench) {
    constexpr int COUNT = 10;
    constexpr double CALM = 20;  // [m/s]
    bench.plant_def.root_height = -1;
    frond_rigid_def ground = frond_default_rigid_def();
    ground.shape = FROND_SHAPE_PLANE;
    bench.add(ground);
    for (int i = 0; i < COUNT; i++) {
        const double half = bench.between(0, M_PI);
        bench.plant_def.rotation = {std::sin(half), 0, 0, std::cos(half)};
        bench.add(herb(), {bench.between(-0.05, 0.05), 0.7 + 0.1 * i, bench.between(-0.05, 0.05)});
    }
    bench.run(1.5, [&](double) { bench.expect(bench.fastest() <= CALM, "speed [m/s]", bench.fastest(), CALM); });
}

// One plant is thrown through the other.
void thrown_through(Bench& bench) {
    const frond_plant stands = bench.add(herb());
    const Places rest = bench.places(stands);
    bench.plant_def.root_height = -1;
    const frond_plant flies = bench.add(herb(), {-0.8, 0, 0});
    bench.push(flies, Places(bench.places(flies).size(), {20, 1, 0}));
    bench.box = 200;
    bench.run(1.5);
    bench.remove(flies);
    bench.run(3);
    bench.expect_shape(stands, rest, 0.25);
}

void self_contact(Bench& bench) {
    bench.plant_def.effects |= FROND_EFFECT_SELF_CONTACT;
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    frond_grab grab = {};
    must(frond_grab_create(plant, {0.2, 0.45, 0}, 1e3, &grab));
    bench.run(1.5, [&](double time) {
        must(frond_grab_move(grab, {0.2 * std::cos(6 * time), 0.45, 0.2 * std::sin(6 * time)}));
    });
    frond_grab_destroy(grab);
    bench.run(4);
    bench.expect_shape(plant, rest, 0.3);
}

}  // namespace

std::vector<Case> crowd_cases() {
    const char* calm = "never faster than 5 m/s; after 3 s above 0.2 m no deeper in each other than 5 mm";
    return {
        {"same_place", "two plants made at the same place", calm, same_place, true},
        {"nearly_same_place", "two plants made 1 cm apart", calm, nearly_same_place, true},
        {"pile_of_ten", "ten plants that nothing holds, dropped on each other", "never faster than 20 m/s", pile, true},
        {"thrown_through", "a plant thrown at another at 20 m/s",
         "finite; the other is back within 0.25 of its size, no tet inside out", thrown_through},
        {"self_contact", "a branch wound around its own stem, let go",
         "finite; after 4 s no tet inside out, nodes within 0.3 of its size", self_contact},
    };
}

}  // namespace frond::stability
