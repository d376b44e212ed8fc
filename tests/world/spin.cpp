// Rods that nothing holds, in free flight: they spin past half a turn and on, and keep their energy.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "frond/frond.h"
#include "support/stems.hpp"

namespace spin_tests {

struct Spin {
    int axis;
    double rate, steps_a_second;  // [rad/s], [1/s]
};

class EverySpin : public testing::TestWithParam<Spin> {};

TEST_P(EverySpin, OfAFreeRodKeepsItsEnergy) {
    const auto [axis, rate, steps_a_second] = GetParam();
    const frond_model model = make_small_model();
    frond_world_def world_def = frond_default_world_def();
    world_def.gravity = {0, 0, 0};
    world_def.max_substep = 1 / steps_a_second;
    world_def.sleep_distance = 0;
    frond_world world;
    ASSERT_EQ(frond_world_create(&world_def, &world), FROND_OK) << frond_last_error();
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    def.root_height = -1;
    def.effects &= ~frond_effects(FROND_EFFECT_GRAVITY | FROND_EFFECT_DAMPING);
    frond_plant plant;
    ASSERT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    frond_cage_view cage;
    ASSERT_EQ(frond_model_get_cage(model, &cage), FROND_OK);
    std::vector<double> x(3 * size_t(cage.node_count)), v(x.size());
    ASSERT_EQ(frond_plant_get_state(plant, x.data(), v.data(), cage.node_count), FROND_OK);
    for (size_t i = 0; i < x.size(); i += 3) {
        const double place[] = {x[i], x[i + 1] - 0.3, x[i + 2]};
        const size_t next = size_t(axis + 1) % 3, last = size_t(axis + 2) % 3;
        v[i + next] = -rate * place[last];
        v[i + last] = rate * place[next];
    }
    ASSERT_EQ(frond_plant_set_state(plant, x.data(), v.data(), cage.node_count), FROND_OK);
    const auto energy = [&] {
        frond_energy now = {};
        EXPECT_EQ(frond_plant_get_energy(plant, &now), FROND_OK);
        return now.kinetic + now.elastic;
    };
    const double start = energy();
    for (int step = 0; step < 6 * steps_a_second; step++) {
        ASSERT_EQ(frond_world_step(world, 1 / steps_a_second), FROND_OK);
        frond_report report;
        ASSERT_EQ(frond_world_get_report(world, &report), FROND_OK);
        ASSERT_EQ(report.trouble, 0u) << "step " << step;
        ASSERT_LT(energy(), 1.02 * start) << "step " << step;
        ASSERT_GT(energy(), 0.85 * start) << "step " << step;
    }
    frond_world_destroy(world);
    frond_model_destroy(model);
}

std::vector<Spin> spins() {
    std::vector<Spin> all;
    for (const int axis : {0, 1, 2})
        for (const double rate : {1.0, 3.0, 8.0})
            for (const double steps_a_second : {60.0, 240.0}) all.push_back({axis, rate, steps_a_second});
    return all;
}
INSTANTIATE_TEST_SUITE_P(Rods, EverySpin, testing::ValuesIn(spins()), [](const auto& info) {
    return std::string("about_") + "xyz"[info.param.axis] + "_at_" + std::to_string(int(info.param.rate)) + "_by_" +
           std::to_string(int(info.param.steps_a_second));
});

}  // namespace spin_tests
