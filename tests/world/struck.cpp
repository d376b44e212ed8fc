// A ball strikes a plant: the plant gains no more energy than the ball had.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "support/sanitized.hpp"
#include "support/stand.hpp"

namespace struck_tests {

using frond::test::must;
using frond::test::Stand;

constexpr double RADIUS = 0.11, MASS = 1.4, SPEED = 6;  // [m], [kg], [m/s]
constexpr double START = 0.5 * MASS * SPEED * SPEED;    // [J]

// Without gravity, so that only the ball brings energy.
struct StruckCorn : Stand {
    frond_rigid ball = {};
    StruckCorn(frond_mechanics mechanics, double step, const frond_vec3& from, const frond_vec3& way)
        : Stand(frond::test::weightless(step)) {
        h = step;
        frond_model_def def = frond_default_model_def();
        def.rest = FROND_REST_WITHOUT_GRAVITY;
        must(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &def, &model));
        frond_plant_def plant = plant_def();
        plant.mechanics = mechanics;
        add(plant, {0, 0, 0});
        frond_rigid_def rigid = frond_default_rigid_def();
        rigid.size.x = RADIUS;
        rigid.mass = MASS;
        rigid.state.position = from;
        rigid.state.velocity = {SPEED * way.x, SPEED * way.y, SPEED * way.z};
        must(frond_rigid_create(world, &rigid, &ball));
    }
    double plant_energy() const {
        frond_energy energy = {};
        must(frond_plant_get_energy(plants[0], &energy));
        return energy.kinetic + energy.elastic;
    }
    double ball_energy() const {
        frond_rigid_state state = {};
        must(frond_rigid_get_state(ball, &state));
        const auto squared = [](const frond_vec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; };
        return 0.5 * MASS * squared(state.velocity) + 0.2 * MASS * RADIUS * RADIUS * squared(state.angular_velocity);
    }
};

struct Struck : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Plants, Struck,
                         testing::Values(FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL,
                                         FROND_MECHANICS_TET_NEOHOOKEAN, FROND_MECHANICS_ROD,
                                         FROND_MECHANICS_SPRING_CHAIN),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

// The ball is dropped on the plant, or thrown at it from the side, at random.
TEST_P(Struck, GetsNoMoreEnergyThanTheBallHad) {
    const bool is_chain = GetParam() == FROND_MECHANICS_ROD || GetParam() == FROND_MECHANICS_SPRING_CHAIN;
    const int count = SANITIZED ? 1 : is_chain ? 6 : 2;
    int rewound = 0;
    for (const int steps_a_second : {30, 60, 120, 240}) {
        std::mt19937 random(1);
        const auto draw = [&](double low, double high) {
            return low + (high - low) * double(random()) / double(std::mt19937::max());
        };
        for (int k = 0; k < count; k++) {
            const double away = draw(0.02, 0.5), angle = draw(0, 2 * M_PI), height = draw(0.3, 1.3),
                         beside = draw(-0.15, 0.15);
            const double x = std::cos(angle), z = std::sin(angle);
            const bool falls = k % 2 == 0;
            StruckCorn corn(
                GetParam(), 1.0 / steps_a_second,
                falls ? frond_vec3{away * x, 1.9, away * z} : frond_vec3{-x - beside * z, height, -z + beside * x},
                falls ? frond_vec3{0, -1, 0} : frond_vec3{x, 0, z});
            double most = 0;
            for (int i = 0; i < steps_a_second / 2; i++) {
                corn.steps(1);
                rewound += (corn.report().trouble & FROND_TROUBLE_REWOUND) != 0;
                const double plant = corn.plant_energy();
                most = std::max(most, plant);
                ASSERT_LT(plant, START) << k << " at 1/" << steps_a_second << " s, step " << i;
                ASSERT_LT(plant + corn.ball_energy(), 1.02 * START)
                    << k << " at 1/" << steps_a_second << " s, step " << i;
            }
            EXPECT_GT(most, 0.002 * START) << k << " at 1/" << steps_a_second;  // it was struck
        }
    }
    EXPECT_LE(rewound, 10);  // of 1350 steps
}

}  // namespace struck_tests
