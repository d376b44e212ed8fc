// Blades collide with their true width and thickness, though their capsules are narrower and thicker.
#include <cmath>
#include <string>
#include <vector>

#include "frond/frond.h"
#include "support/must.hpp"
#include "support/stems.hpp"

namespace blade_tests {

using frond::test::must;

constexpr double H = 1.0 / 60;
constexpr double LENGTH = 0.3, HALF_WIDTH = 0.06, HEIGHT = 0.5;  // [m]

// A blade of 12 by 30 cm, held at one end, that extends level along x.
struct Shelf {
    frond_world world = {};
    frond_model model = {};
    frond_plant plant = {};
    frond_rigid rigid = {};

    explicit Shelf(frond_mechanics mechanics) {
        const frond_world_def world_def = frond_default_world_def();
        must(frond_world_create(&world_def, &world));
        constexpr int LONG = 12, WIDE = 4;
        std::vector<float> xyz;
        std::vector<int32_t> indices;
        for (int i = 0; i <= LONG; i++)
            for (int k = 0; k <= WIDE; k++)
                for (const double value : {0.0, LENGTH * i / LONG, HALF_WIDTH * (2.0 * k / WIDE - 1)})
                    xyz.push_back(float(value));
        for (int i = 0; i < LONG; i++)
            for (int k = 0; k < WIDE; k++) {
                const int a = i * (WIDE + 1) + k, b = a + WIDE + 1;
                indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
            }
        frond_model_def def = frond_default_model_def();
        frond_organ_material blade = {"blade", {}};
        must(frond_material_preset("blade", &blade.material));
        blade.material.thickness = 3e-3;
        blade.material.young = 1e9;
        def.organs = &blade;
        def.organ_count = 1;
        def.scale = 1;
        def.up = {0, 1, 0};
        def.rest = FROND_REST_WITHOUT_GRAVITY;
        must(frond_model_from_triangles(xyz.data(), int(xyz.size() / 3), indices.data(), int(indices.size() / 3), &def,
                                        &model));
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = mechanics;
        plant_def.root_height = 0.03;
        plant_def.position = {0, HEIGHT, 0};
        plant_def.rotation = {0, 0, -std::sqrt(0.5), std::sqrt(0.5)};
        must(frond_plant_create(world, model, &plant_def, &plant));
    }
    ~Shelf() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    void add(frond_shape shape, const frond_vec3& size, double mass, const frond_vec3& place) {
        frond_rigid_def def = frond_default_rigid_def();
        def.shape = shape;
        def.size = size;
        def.mass = mass;
        def.state.position = place;
        must(frond_rigid_create(world, &def, &rigid));
    }
    void steps(int count) {
        for (int i = 0; i < count; i++) must(frond_world_step(world, H));
    }
    frond_rigid_state state() const {
        frond_rigid_state state = {};
        must(frond_rigid_get_state(rigid, &state));
        return state;
    }
    // Returns the position of the surface vertex nearest to a point as modelled: along the blade and across it.
    frond_vec3 place_of(double along, double across) const {
        frond_surface_view view = {};
        must(frond_plant_get_surface(plant, &view));
        const int i = int(std::lround(12 * along / LENGTH)), k = int(std::lround(2 * (across / HALF_WIDTH + 1)));
        const float* p = view.positions + 3 * (i * 5 + k);
        return {double(p[0]), double(p[1]), double(p[2])};
    }
};

struct Blade : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Contact, Blade, testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

// Beside the midrib, a box on the capsules along it would tip off.
TEST_P(Blade, BearsABoxBesideItsMidribAtRest) {
    Shelf shelf(GetParam());
    shelf.add(FROND_SHAPE_BOX, {0.03, 0.015, 0.025}, 0.01, {0.15, HEIGHT + 0.02, 0.028});
    shelf.steps(180);
    const frond_rigid_state before = shelf.state();
    // The box lies on the blade itself, not on its capsules, which are as thick as a third of its width.
    const frond_vec3 below = shelf.place_of(0.15, 0.03);
    EXPECT_NEAR(before.position.y - below.y, 0.015, 0.005);
    for (int i = 0; i < 60; i++) {
        shelf.steps(1);
        const frond_rigid_state now = shelf.state();
        const frond_vec3 &v = now.velocity, &p = now.position, &q = before.position;
        EXPECT_LT(std::hypot(v.x, v.y, v.z), 0.001) << i;  // no jitter above 1 mm/s
        EXPECT_LT(std::hypot(p.x - q.x, p.y - q.y, p.z - q.z), 0.001) << i;
    }
}

// A finger that moves down beside the rim takes it along and twists the blade.
TEST_P(Blade, IsFeltAtItsRim) {
    Shelf shelf(GetParam());
    const double finger = 0.01, beside = 0.85 * HALF_WIDTH;  // [m]
    shelf.add(FROND_SHAPE_SPHERE, {finger, 0, 0}, 0, {0.2, HEIGHT + 0.03, beside});
    const frond_vec3 near = shelf.place_of(0.2, HALF_WIDTH), far = shelf.place_of(0.2, -HALF_WIDTH);
    for (int i = 0; i < 60; i++) {
        frond_rigid_state state = shelf.state();
        state.position.y = HEIGHT + 0.03 - 0.05 * i / 60;
        must(frond_rigid_set_state(shelf.rigid, &state));
        shelf.steps(1);
        frond_report report = {};
        must(frond_world_get_report(shelf.world, &report));
        EXPECT_EQ(report.trouble & FROND_TROUBLE_REWOUND, 0u);
    }
    const double down = near.y - shelf.place_of(0.2, HALF_WIDTH).y, other = far.y - shelf.place_of(0.2, -HALF_WIDTH).y;
    EXPECT_GT(down, 0.02);
    EXPECT_GT(down - other, 0.0015);
}

}  // namespace blade_tests
