// Cases: materials and tets at the limits of what is allowed, bent and let go.
#include <cmath>

#include "stability/bench.hpp"

namespace frond::stability {
namespace {

// The plant is pushed at its top for half a second, then let go: energy must not grow.
void bend(Bench& bench, frond_model model, double force) {
    bench.plant_def.root_height = FOOT;
    const frond_plant plant = bench.add(model);
    const Places rest = bench.places(plant);
    size_t top = 0;
    for (size_t i = 0; i < rest.size(); i++)
        if (rest[i].y > rest[top].y) top = i;
    const double at_rest = bench.energy();
    bench.run(0.5, [&](double) { must(frond_plant_add_force(plant, int(top), {force, 0, 0})); });
    bench.expect_no_energy_from_nothing(2, at_rest);
}

void bend_beam(Bench& bench, double frond_material::*field, double value, double force) {
    frond_material material = plain_material();
    material.*field = value;
    bend(bench, bench.keep(model_of(make_lattice(0.1, 2, even_heights(1, 10)), material)), force);
}

void soft(Bench& bench) {
    bend_beam(bench, &frond_material::young, 1e3, 1);
}
void stiff(Bench& bench) {
    bend_beam(bench, &frond_material::young, 1e11, 1e4);
}
void light(Bench& bench) {
    bend_beam(bench, &frond_material::density, 1, 50);
}
void heavy(Bench& bench) {
    bend_beam(bench, &frond_material::density, 2e4, 50);
}
void no_contraction(Bench& bench) {
    bend_beam(bench, &frond_material::poisson, 0, 50);
}
void incompressible(Bench& bench) {
    bend_beam(bench, &frond_material::poisson, 0.499, 50);
}

// The stem is a million times as stiff as its branch.
void stiffness_ratio(Bench& bench) {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.5, 0}, 0.02, 0.015},
                                {0, {0, 0.5, 0}, {0.3, 0.6, 0}, 0.008, 0.004}};
    frond_material hard = plain_material(), weak = plain_material();
    hard.young = 1e11;
    weak.young = 1e5;
    const frond_organ_material organs[] = {{"stem_0", hard}, {"stem_1", weak}};
    frond_model_def def = frond_default_model_def();
    def.cage_size = 0.08;
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = organs;
    def.organ_count = 2;
    frond_model model = {};
    must(frond_model_from_stems(stems, 2, &def, &model));
    bend(bench, bench.keep(model), 1);
}

void needles(Bench& bench) {
    bend(bench, bench.keep(model_of(make_lattice(0.005, 1, even_heights(1, 4)), plain_material())), 0.01);
}

// Every other layer of bricks is 0.2 mm high.
void slivers(Bench& bench) {
    std::vector<double> heights = {0};
    for (int i = 1; i <= 5; i++) {
        heights.push_back(0.2 * i - 0.0002);
        heights.push_back(0.2 * i);
    }
    bend(bench, bench.keep(model_of(make_lattice(0.1, 1, heights), plain_material())), 50);
}

// Each tet is split at a new node just above one of its faces.
void caps(Bench& bench) {
    constexpr double HIGH = 0.002;  // share of the tet's own height
    const Lattice whole = make_lattice(0.1, 1, even_heights(1, 6));
    Lattice split = whole;
    split.tets.clear();
    for (size_t t = 0; t < whole.tets.size(); t += 4) {
        const int32_t middle = int32_t(split.nodes.size() / 3);
        for (int axis = 0; axis < 3; axis++) {
            const auto corner = [&](int c) { return whole.nodes[size_t(3 * whole.tets[t + size_t(c)] + axis)]; };
            split.nodes.push_back((1 - HIGH) * (corner(0) + corner(1) + corner(2)) / 3 + HIGH * corner(3));
        }
        for (int left_out = 0; left_out < 4; left_out++)
            for (int c = 0; c < 4; c++) split.tets.push_back(c == left_out ? middle : whole.tets[t + size_t(c)]);
    }
    bend(bench, bench.keep(model_of(split, plain_material())), 50);
}

void one_tet(Bench& bench) {
    const Lattice tet = {{0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0, 0.3, 0}, {0, 1, 2, 3}};
    bend(bench, bench.keep(model_of(tet, plain_material())), 50);
}

void quadratic(Bench& bench) {
    if (bench.cell.mechanics == FROND_MECHANICS_ROD || bench.cell.mechanics == FROND_MECHANICS_SPRING_CHAIN)
        throw DoesNotApply("chains have no elements of order 2");
    bench.plant_def.element_order = 2;
    bench.plant_def.root_height = FOOT;
    const frond_plant plant =
        bench.add(bench.keep(model_of(make_lattice(0.1, 1, even_heights(1, 5)), plain_material())));
    const Places rest = bench.places(plant);
    const double at_rest = bench.energy();
    Places x = rest;
    for (frond_vec3& p : x)
        if (p.y > FOOT)
            p = p + frond_vec3{bench.between(-0.1, 0.1), bench.between(-0.1, 0.1), bench.between(-0.1, 0.1)};
    bench.put(plant, x);
    bench.expect_no_energy_from_nothing(4, at_rest);
    bench.expect_shape(plant, rest, 0.15);
}

}  // namespace

std::vector<Case> matter_cases() {
    const char* bounded = "finite; no energy out of nothing in the 2 s after it is let go";
    return {
        {"soft", "a beam of 1e3 Pa, which its weight crushes, pushed and let go", bounded, soft},
        {"stiff", "a beam of 1e11 Pa, pushed by 10 kN and let go", bounded, stiff},
        {"light", "a beam of 1 kg/m^3, pushed and let go", bounded, light},
        {"heavy", "a beam of 2e4 kg/m^3, pushed and let go", bounded, heavy},
        {"poisson_0", "a beam that does not contract across, pushed and let go", bounded, no_contraction},
        {"poisson_0.499", "a beam that keeps its volume, pushed and let go", bounded, incompressible},
        {"stiffness_ratio", "a stem of 1e11 Pa with a branch of 1e5 Pa, pushed and let go", bounded, stiffness_ratio},
        {"needles", "tets 50 times as long as wide, pushed and let go", bounded, needles},
        {"slivers", "layers of tets 500 times as wide as high, pushed and let go", bounded, slivers},
        {"caps", "tets split at a point 2e-3 of their height above a face, pushed and let go", bounded, caps},
        {"one_tet", "a cage of one tet, pushed by 50 N and let go", bounded, one_tet},
        {"quadratic_scattered", "a beam of ten-node tets, each node up to a brick's width from its place",
         "no energy out of nothing; after 4 s no tet inside out, nodes within 0.15 of its size", quadratic},
    };
}

}  // namespace frond::stability
