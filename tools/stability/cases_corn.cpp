// Cases: a real plant on the ground, with light leaves on a stem, driven far out of any natural shape.
#include <cmath>

#include "stability/bench.hpp"

namespace frond::stability {
namespace {

constexpr double CORN_BACK = 5;  // time to return [s]
constexpr double SIZE = 2.2;     // size of the corn plant [m]
constexpr double BLOWS = 0.4;    // duration of the loads [s]

frond_model model_of_corn() {
    static const frond_model made = [] {
        const frond_model_def def = frond_default_model_def();
        frond_model model = {};
        must(frond_model_load(tools::model_path("corn/corn.obj").c_str(), &def, &model));
        return model;
    }();
    return made;
}

struct StandingCorn {
    frond_plant plant;
    std::vector<int> foot;
    Places rest;
};

StandingCorn stand_on_ground(Bench& bench) {
    bench.box = 1e6;
    frond_rigid_def ground = frond_default_rigid_def();
    ground.shape = FROND_SHAPE_PLANE;
    bench.add(ground);
    StandingCorn corn = {bench.add(model_of_corn()), {}, {}};
    corn.rest = bench.places(corn.plant);
    // Only pinned nodes can be moved.
    for (size_t i = 0; i < corn.rest.size(); i++)
        if (frond_plant_move_pin(corn.plant, int(i), corn.rest[i]) == FROND_OK) corn.foot.push_back(int(i));
    return corn;
}

void come_back(Bench& bench, const StandingCorn& corn) {
    bench.run(CORN_BACK);
    bench.expect_shape(corn.plant, corn.rest, NEAR_DRIVEN);
}

void scatter_corn(Bench& bench) {
    const StandingCorn corn = stand_on_ground(bench);
    Places places = corn.rest;
    for (frond_vec3& p : places)
        p = p + SIZE * frond_vec3{bench.between(-0.5, 0.5), bench.between(-0.5, 0.5), bench.between(-0.5, 0.5)};
    for (int node : corn.foot) places[size_t(node)] = corn.rest[size_t(node)];
    bench.put(corn.plant, places);
    come_back(bench, corn);
}

// The plant is struck by forces of up to ten million times a leaf's weight.
void strike(Bench& bench) {
    constexpr int NODES = 5;
    const StandingCorn corn = stand_on_ground(bench);
    bench.run(BLOWS, [&](double) {
        for (int i = 0; i < NODES; i++) {
            const size_t node = bench.random() % corn.rest.size();
            const double most = std::pow(10, bench.between(0, 6));
            must(frond_plant_add_force(
                corn.plant, int(node),
                {bench.between(-most, most), bench.between(-most, most), bench.between(-most, most)}));
        }
    });
    come_back(bench, corn);
}

// The plant is dragged at single points, by springs soft to hard, to and fro by more than its length.
void drag(Bench& bench) {
    constexpr int TIMES = 3;
    const StandingCorn corn = stand_on_ground(bench);
    for (int i = 0; i < TIMES; i++) {
        const size_t node = bench.random() % corn.rest.size();
        const frond_vec3 way = {bench.between(-3, 3), bench.between(-1, 3), bench.between(-3, 3)};
        frond_grab grab = {};
        must(frond_grab_create(corn.plant, bench.places(corn.plant)[node], std::pow(10, bench.between(2, 7)), &grab));
        bench.run(BLOWS, [&](double time) {
            must(frond_grab_move(grab, SIZE * frond_vec3{way.x * std::sin(30 * time), way.y, way.z}));
        });
        frond_grab_destroy(grab);
    }
    come_back(bench, corn);
}

// The foot is moved by less than the plant's size, so that this does not count as a teleport.
void jerk(Bench& bench) {
    const StandingCorn corn = stand_on_ground(bench);
    for (const frond_vec3& way : {frond_vec3{0.6 * SIZE, 0.6 * SIZE, 0}, frond_vec3{}}) {
        bench.move(corn.plant, corn.foot, [&](const frond_vec3& p) { return p + way; });
        bench.run(BLOWS);
    }
    come_back(bench, corn);
}

// The plant is flung sideways by a hundred times gravity, with plasticity.
void fling(Bench& bench) {
    // Mean displacement over size, as it may lie on the ground [-]; of a leaf's tip, whose speed is 0.8 to 0.9 m/s
    // after this time with steps of 20 Newton iterations [m/s].
    constexpr double LIES = 1, SLOW = 1.5;
    bench.plant_def.effects |= FROND_EFFECT_PLASTICITY;
    const StandingCorn corn = stand_on_ground(bench);
    must(frond_world_set_gravity(bench.world(), {650, 50, 850}));
    bench.run(BLOWS);
    must(frond_world_set_gravity(bench.world(), {0, -9.81, 0}));
    bench.run(CORN_BACK);
    bench.expect_shape(corn.plant, corn.rest, LIES);
    bench.expect(bench.fastest() < SLOW, "speed [m/s]", bench.fastest(), SLOW);
}

}  // namespace

std::vector<Case> corn_cases() {
    const char* back = "finite; after 5 s no tet inside out, nodes within 0.25 of its size";
    return {
        {"corn_scattered", "each node of a corn plant up to half its length from its place, in the ground too", back,
         scatter_corn},
        {"corn_struck", "five nodes of a corn plant pushed by up to 1 MN in each step for 0.4 s", back, strike},
        {"corn_dragged", "a corn plant drawn to and fro by three times its length at 30 rad/s, three times, let go",
         back, drag},
        {"corn_jerked", "the foot of a corn plant put 0.85 of its size away within a step, and back", back, jerk},
        {"corn_flung", "100 g sideways on a corn plant with plasticity for 0.4 s",
         "finite; after 5 s no tet inside out, nodes within its size as it may lie, slower than 1.5 m/s", fling},
    };
}

}  // namespace frond::stability
