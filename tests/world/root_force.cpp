// The force at the root of a plant whose pins move: its weight, and what its acceleration takes.
#include <gtest/gtest.h>

#include <cmath>

#include "frond/frond_robot.h"
#include "support/stand.hpp"

namespace frond::test {
namespace root_force_tests {

constexpr double G = 9.81;
constexpr double DRAG = 0.1;  // default mass damping [1/s]

struct Carried {
    frond_mechanics mechanics;
    frond_integrator integrator;
    double h;  // [s]
};
std::vector<Carried> every_way() {
    std::vector<Carried> all;
    for (const frond_mechanics mechanics : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD})
        for (int i = 0; i < FROND_INTEGRATOR_SYMPLECTIC_EULER; i++)
            for (const double h : {1.0 / 60, 1.0 / 240}) all.push_back({mechanics, frond_integrator(i), h});
    return all;
}

// A stem of 1 m whose foot is carried: all of its pins move alike.
struct RootForce : testing::TestWithParam<Carried> {
    Stand stand;
    frond_plant plant = {};
    std::vector<double> modelled;
    std::vector<int> foot;
    double mass = 0;

    void SetUp() override {
        const Carried& way = GetParam();
        stand.h = way.h;
        stand.make_stems({{-1, {0, 0, 0}, {0, 1, 0}, 0.0113, 0.0113}}, 1e10);
        frond_plant_def def = stand.plant_def();
        def.mechanics = way.mechanics;
        def.integrator = way.integrator;
        plant = stand.add(def, {0, 0, 0});
        modelled = stand.places(plant);
        for (int i = 0; i < int(modelled.size()) / 3; i++)
            if (frond_plant_move_pin(plant, i, place(i, {0, 0, 0})) == FROND_OK) foot.push_back(i);
        frond_model_info info = {};
        must(frond_model_get_info(stand.model, &info));
        mass = info.mass;
    }
    frond_vec3 place(int node, const frond_vec3& way) const {
        const double* p = &modelled[3 * size_t(node)];
        return {p[0] + way.x, p[1] + way.y, p[2] + way.z};
    }
    // Carries the plant for two seconds, from a velocity on; returns the mean force at the root in the second half.
    frond_vec3 mean_force(const frond_vec3& v, const frond_vec3& a) {
        stand.throw_plant(plant, v);
        const int count = int(std::lround(2 / stand.h));
        frond_vec3 sum = {};
        for (int step = 1; step <= count; step++) {
            const double t = step * stand.h, s = 0.5 * t * t;
            for (const int i : foot)
                must(frond_plant_move_pin(plant, i, place(i, {v.x * t + a.x * s, v.y * t + a.y * s, 0})));
            stand.steps(1);
            if (step <= count / 2) continue;
            frond_vec3 force = {};
            must(frond_plant_get_root_force(plant, {0, 0, 0}, &force, nullptr));
            sum = {sum.x + force.x / (count / 2), sum.y + force.y / (count / 2), 0};
        }
        return sum;
    }
};
INSTANTIATE_TEST_SUITE_P(EveryWay, RootForce, testing::ValuesIn(every_way()));

TEST_P(RootForce, OfAPlantThatIsCarriedEvenlyIsItsWeight) {
    ASSERT_GE(foot.size(), 3u);
    const frond_vec3 force = mean_force({1, 0.5, 0}, {0, 0, 0});
    EXPECT_NEAR(force.y, mass * (G + DRAG * 0.5), 0.01 * mass * G);
    EXPECT_NEAR(force.x, mass * DRAG, 0.01 * mass * G);
}

TEST_P(RootForce, OfAPlantThatIsAcceleratedEvenlyIsWhatThatTakes) {
    const frond_vec3 force = mean_force({0, 0, 0}, {5, 2, 0});
    EXPECT_NEAR(force.x, mass * (5 + DRAG * 7.5), 0.02 * mass * G);
    EXPECT_NEAR(force.y, mass * (G + 2 + DRAG * 3), 0.02 * mass * G);
}

}  // namespace root_force_tests
}  // namespace frond::test
