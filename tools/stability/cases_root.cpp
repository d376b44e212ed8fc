// Cases: violent motion of the plant's foot, of gravity and of the air.
#include <cmath>

#include "stability/bench.hpp"

namespace frond::stability {
namespace {

constexpr double HELD = 0.05;  // height up to which the herb is held [m]

struct Held {
    frond_plant plant;
    std::vector<int> foot;
    Places rest;
};

// Holds the herb by pins around its foot, which can be moved.
Held hold_herb(Bench& bench) {
    bench.plant_def.root_height = -1;
    const frond_plant plant = bench.add(herb());
    return {plant, bench.hold(plant, HELD), bench.places(plant)};
}

void teleport(Bench& bench) {
    bench.box = 30;
    const Held herb = hold_herb(bench);
    const frond_vec3 way = {10, 0, 0};
    bench.run(0.2);
    bench.move(herb.plant, herb.foot, [&](const frond_vec3& p) { return p + way; });
    bench.run(COME_BACK);
    Places rest = herb.rest;
    for (frond_vec3& p : rest) p = p + way;
    bench.expect_shape(herb.plant, rest, NEAR_DRIVEN);
}

// Moves the foot to positions that depend on time, then back.
void drive(Bench& bench, const std::function<frond_vec3(const frond_vec3&, double)>& where, double duration) {
    const Held herb = hold_herb(bench);
    bench.run(duration, [&](double time) {
        bench.move(herb.plant, herb.foot, [&](const frond_vec3& p) { return where(p, time + bench.cell.dt); });
    });
    bench.move(herb.plant, herb.foot, [](const frond_vec3& p) { return p; });
    bench.run(COME_BACK);
    bench.expect_shape(herb.plant, herb.rest, NEAR_DRIVEN);
}

void spin(Bench& bench) {
    constexpr double SPEED = 100;  // [rad/s]
    drive(
        bench,
        [](const frond_vec3& p, double time) {
            const double c = std::cos(SPEED * time), s = std::sin(SPEED * time);
            return frond_vec3{c * p.x + s * p.z, p.y, c * p.z - s * p.x};
        },
        16 * 2 * M_PI / SPEED);
}

void shake(Bench& bench) {
    drive(
        bench,
        [](const frond_vec3& p, double time) {
            return p + frond_vec3{0.05 * std::sin(2 * M_PI * 60 * time + 1), 0, 0.05 * std::cos(2 * M_PI * 47 * time)};
        },
        1);
}

// The foot is turned over once and set down again.
void somersault(Bench& bench) {
    drive(
        bench,
        [](const frond_vec3& p, double time) {
            const double angle = 2 * M_PI * time, c = std::cos(angle), s = std::sin(angle);
            return frond_vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
        },
        1);
}

void gravity_for(Bench& bench, const std::function<frond_vec3(double)>& gravity) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    bench.run(2, [&](double time) { must(frond_world_set_gravity(bench.world(), gravity(time))); });
    must(frond_world_set_gravity(bench.world(), {0, -9.81, 0}));
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, NEAR_DRIVEN);
}

void gravity_100(Bench& bench) {
    gravity_for(bench, [](double) { return frond_vec3{0, -981, 0}; });
}
void gravity_100000(Bench& bench) {
    gravity_for(bench, [](double) { return frond_vec3{0, -981e3, 0}; });
}
void gravity_up(Bench& bench) {
    gravity_for(bench, [](double) { return frond_vec3{0, 9.81, 0}; });
}
void gravity_tumbling(Bench& bench) {
    gravity_for(bench, [&](double) {
        return frond_vec3{bench.between(-98, 98), bench.between(-98, 98), bench.between(-98, 98)};
    });
}

void gravity_off(Bench& bench) {
    bench.add(herb());
    bench.run(0.5);
    must(frond_world_set_gravity(bench.world(), {0, 0, 0}));
    bench.step(bench.cell.dt);
    bench.expect_no_energy_from_nothing(3, 0);
}

void gust(Bench& bench) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    frond_wind_def wind = frond_default_wind_def();
    wind.profile = FROND_WIND_PROFILE_UNIFORM;
    wind.velocity = {60, 0, 0};
    must(frond_world_set_wind(bench.world(), &wind));
    bench.run(2);
    must(frond_world_set_wind(bench.world(), nullptr));
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, NEAR_DRIVEN);
}

// The wind reverses at full strength in each step.
void squall(Bench& bench) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    double sign = 1;
    bench.run(2, [&](double) {
        frond_wind_def wind = frond_default_wind_def();
        wind.profile = FROND_WIND_PROFILE_UNIFORM;
        wind.velocity = {40 * sign, 0, 20 * sign};
        sign = -sign;
        must(frond_world_set_wind(bench.world(), &wind));
    });
    must(frond_world_set_wind(bench.world(), nullptr));
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, NEAR_DRIVEN);
}

}  // namespace

std::vector<Case> root_cases() {
    const char* back = "finite; 4 s later no tet inside out, nodes within 0.25 of its size of where they stood";
    return {
        {"teleported", "the foot of a herb put 10 m away within a step", back, teleport},
        {"spun", "the foot of a herb turned at 100 rad/s for 16 turns, stopped", back, spin},
        {"shaken", "the foot of a herb shaken at 60 and 47 Hz by 5 cm for a second", back, shake},
        {"somersault", "the foot of a herb turned over once in a second", back, somersault},
        {"gravity_100_g", "100 times gravity for 2 s", back, gravity_100},
        {"gravity_1e5_g", "100,000 times gravity for 2 s", back, gravity_100000},
        {"gravity_reversed", "gravity upwards for 2 s", back, gravity_up},
        {"gravity_tumbling", "up to 10 times gravity in another direction in each step", back, gravity_tumbling},
        {"gravity_off", "gravity taken away", "no energy out of nothing in 3 s", gravity_off},
        {"gust", "a gust of 60 m/s for 2 s", back, gust},
        {"squall", "a wind of 45 m/s that turns round in each step", back, squall},
    };
}

}  // namespace frond::stability
