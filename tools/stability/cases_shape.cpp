// Cases: a plant is let go from a shape that it cannot have reached by itself.
#include <cmath>

#include "stability/bench.hpp"

namespace frond::stability {
namespace {

// Lets the beam go from the node positions that `to` gives; its foot stays in place.
void come_back_from(Bench& bench, const std::function<frond_vec3(const frond_vec3&)>& to) {
    bench.plant_def.root_height = FOOT;
    const frond_plant plant = bench.add(beam());
    const Places rest = bench.places(plant);
    const double at_rest = bench.energy();
    Places x = rest;
    for (frond_vec3& p : x)
        if (p.y > FOOT) p = to(p);
    bench.put(plant, x);
    bench.expect_no_energy_from_nothing(COME_BACK, at_rest);
    bench.expect_shape(plant, rest, NEAR_LET_GO);
}

void crush_to_point(Bench& bench) {
    come_back_from(bench, [](const frond_vec3&) { return frond_vec3{0, 0.5, 0}; });
}

void crush_to_plane(Bench& bench) {
    come_back_from(bench, [](const frond_vec3& p) { return frond_vec3{0, p.y, p.z}; });
}

void crush_to_line(Bench& bench) {
    come_back_from(bench, [](const frond_vec3& p) { return frond_vec3{0, p.y, 0}; });
}

void mirror(Bench& bench) {
    come_back_from(bench, [](const frond_vec3& p) { return frond_vec3{-p.x, p.y, p.z}; });
}

void scatter(Bench& bench) {
    come_back_from(bench, [&](const frond_vec3& p) {
        return p + frond_vec3{bench.between(-0.5, 0.5), bench.between(-0.5, 0.5), bench.between(-0.5, 0.5)};
    });
}

// The beam that other programs were tested with: level, drooping by its weight, every free node at a random position.
void scramble(Bench& bench) {
    constexpr int FRAMES = 120;
    const Lattice lattice = make_lattice(0.1, 3, even_heights(1, 26));
    frond_material material = plain_material();
    material.damping_ratio = 0;
    const frond_model model = bench.keep(model_of(lattice, material));
    bench.plant_def.root_height = FOOT;
    bench.plant_def.rotation = {0, 0, -std::sqrt(0.5), std::sqrt(0.5)};  // +y becomes +x
    const frond_plant plant = bench.add(model);
    Places x = bench.places(plant);
    // Find the hanging shape by long steps of an integrator that damps.
    Cell calm = bench.cell;
    calm.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    calm.dt = 0.1;
    Bench other(calm);
    other.plant_def.root_height = FOOT;
    other.plant_def.rotation = bench.plant_def.rotation;
    other.plant_def.mass_damping = 5;
    const frond_plant hanging = other.add(model);
    other.run(4);
    const Places rest = other.places(hanging);
    for (frond_vec3& p : x)
        if (p.x > FOOT) p = {bench.between(0, 1), bench.between(-0.5, 0.5), bench.between(-0.5, 0.5)};
    bench.put(plant, x);
    bench.run(FRAMES / 60.0);
    bench.expect_shape(plant, rest, 0.05);
}

void fold(Bench& bench) {
    come_back_from(bench, [](const frond_vec3& p) { return p.y <= 0.5 ? p : frond_vec3{0.15 - p.x, 1 - p.y, p.z}; });
}

void wring(Bench& bench) {
    come_back_from(bench, [](const frond_vec3& p) {
        const double angle = 4 * 2 * M_PI * p.y;
        return frond_vec3{std::cos(angle) * p.x - std::sin(angle) * p.z, p.y,
                          std::sin(angle) * p.x + std::cos(angle) * p.z};
    });
}

// Not quite in line: without rounding errors of its own, a chain that is exactly straight stays folded onto itself, in
// an unstable balance.
void shrink(Bench& bench) {
    constexpr double OFF = 1e-6;  // [m]
    come_back_from(bench, [&](const frond_vec3& p) {
        return 0.01 * p + frond_vec3{bench.between(-OFF, OFF), 0, bench.between(-OFF, OFF)};
    });
}

void blow_up(Bench& bench) {
    come_back_from(bench, [](const frond_vec3& p) { return frond_vec3{5 * p.x, 5 * p.y, 5 * p.z}; });
}

void kick(Bench& bench) {
    bench.plant_def.root_height = FOOT;
    const frond_plant plant = bench.add(beam());
    const Places rest = bench.places(plant);
    const double at_rest = bench.energy();
    Places v(rest.size());
    for (frond_vec3& one : v) one = {bench.between(-100, 100), bench.between(-100, 100), bench.between(-100, 100)};
    bench.push(plant, v);
    bench.expect_no_energy_from_nothing(COME_BACK, at_rest);
    bench.expect_shape(plant, rest, NEAR_LET_GO);
}

// The beam is stretched by a spring that is stiffer than itself.
void stretch(Bench& bench) {
    constexpr double TIMES = 100;
    bench.plant_def.root_height = FOOT;
    bench.box = 3 * TIMES;
    const frond_plant plant = bench.add(beam());
    const Places rest = bench.places(plant);
    frond_grab grab = {};
    must(frond_grab_create(plant, {0, 1, 0}, 1e9, &grab));
    bench.run(2, [&](double time) { must(frond_grab_move(grab, {0, 1 + TIMES * std::min(1.0, time), 0})); });
    frond_grab_destroy(grab);
    bench.run(10);
    bench.expect_shape(plant, rest, NEAR_LET_GO);
}

// A pinned node of the tip goes once around the stem and through the loop; then it is let go.
void tie_knot(Bench& bench) {
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    size_t tip = 0;
    for (size_t i = 0; i < rest.size(); i++)
        if (rest[i].y > rest[tip].y) tip = i;
    must(frond_plant_pin(plant, int(tip)));
    bench.run(2, [&](double time) {
        const double turn = 2 * M_PI * time, radius = 0.25;
        must(frond_plant_move_pin(plant, int(tip),
                                  {radius * std::sin(2 * turn), 0.35 + 0.2 * std::cos(turn), radius * std::sin(turn)}));
    });
    must(frond_plant_unpin(plant, int(tip)));
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, 0.3);
}

// The ends of two branches are pulled apart by pins, by ten sizes of the plant.
void tear_apart(Bench& bench) {
    constexpr double WAY = 8;  // [m]
    bench.box = 3 * WAY;
    const frond_plant plant = bench.add(herb());
    const Places rest = bench.places(plant);
    size_t ends[2] = {};
    for (size_t i = 0; i < rest.size(); i++) {
        if (rest[i].x < rest[ends[0]].x) ends[0] = i;
        if (rest[i].x > rest[ends[1]].x) ends[1] = i;
    }
    for (size_t end : ends) must(frond_plant_pin(plant, int(end)));
    bench.run(1.5, [&](double time) {
        const double way = WAY * std::min(1.0, time + bench.cell.dt);
        for (int k = 0; k < 2; k++)
            must(frond_plant_move_pin(plant, int(ends[k]), rest[ends[k]] + frond_vec3{(2 * k - 1) * way, 0, 0}));
    });
    for (size_t end : ends) must(frond_plant_unpin(plant, int(end)));
    bench.run(COME_BACK);
    bench.expect_shape(plant, rest, 0.25);
}

}  // namespace

std::vector<Case> shape_cases() {
    const char* back = "no energy out of nothing; after 4 s no tet inside out, nodes within 0.15 of its size";
    return {
        {"crushed_to_point", "all free nodes of a beam at one point, let go", back, crush_to_point},
        {"crushed_to_plane", "all nodes of a beam in one plane", back, crush_to_plane},
        {"crushed_to_line", "all nodes of a beam on its axis", back, crush_to_line},
        {"mirrored", "a beam that is its own mirror image but for its foot", back, mirror},
        {"scattered", "each node of a beam up to half its length from its place", back, scatter},
        {"scrambled_beam", "the peers' beam of 1170 tets, level, nodes thrown to random places",
         "after 120 frames of 1/60 s no tet inside out, nodes within 0.05 of its size of the static shape", scramble,
         true},
        {"folded_double", "the upper half of a beam folded down on the lower one", back, fold},
        {"wrung", "a beam wrung by four turns", back, wring},
        {"shrunk", "a beam at a hundredth of its size", back, shrink},
        {"blown_up", "a beam at five times its size", back, blow_up},
        {"kicked", "each node of a beam at up to 100 m/s in a direction of its own", back, kick},
        {"stretched", "a beam drawn out to 100 times its length by a stiff grab, let go",
         "finite; after 10 s back within 0.15 of its size, no tet inside out", stretch},
        {"knotted", "the tip of a herb led around its stem and through by a pin, let go",
         "finite; after 4 s no tet inside out, nodes within 0.3 of its size", tie_knot},
        {"torn_by_pins", "the ends of two branches drawn apart by ten sizes of the herb, let go",
         "finite; after 4 s no tet inside out, nodes within 0.25 of its size", tear_apart},
    };
}

}  // namespace frond::stability
