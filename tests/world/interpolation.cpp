// Surfaces are interpolated between the last two substeps, like the motion states of Bullet's bodies.
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/stems.hpp"

namespace interpolation_tests {

constexpr double H = 1.0 / 60;

std::vector<float> surface_of(frond_plant plant) {
    frond_surface_view view;
    EXPECT_EQ(frond_plant_get_surface(plant, &view), FROND_OK) << frond_last_error();
    return std::vector<float>(view.positions, view.positions + 3 * view.vertex_count);
}

double farthest(const std::vector<float>& a, const std::vector<float>& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); i++) most = std::max(most, std::abs(double(a[i]) - double(b[i])));
    return most;
}

// A Bullet world in which a ball falls beside a free plant.
struct Falling {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld bullet{&dispatcher, &broadphase, &solver, &configuration};
    btSphereShape sphere{btScalar(0.05)};
    btDefaultMotionState shown{btTransform(btQuaternion::getIdentity(), btVector3(5, 0, 0))};
    btRigidBody ball{1, &shown, &sphere, btVector3(1, 1, 1)};
    frond_world plants = {};
    frond_model model = make_small_model();
    frond_plant plant = {};

    explicit Falling(frond_mechanics mechanics) {
        bullet.setGravity(btVector3(0, btScalar(-9.81), 0));
        bullet.addRigidBody(&ball);
        EXPECT_EQ(frond::attach(&bullet, nullptr, &plants), FROND_OK) << frond_last_error();
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = mechanics;
        def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;  // falls as Bullet's bodies do
        def.root_height = -1;
        def.effects = FROND_EFFECT_GRAVITY | FROND_EFFECT_SURFACE | FROND_EFFECT_NORMALS;
        EXPECT_EQ(frond_plant_create(plants, model, &def, &plant), FROND_OK) << frond_last_error();
    }
    ~Falling() {
        frond_world_destroy(plants);
        frond_model_destroy(model);
        bullet.removeRigidBody(&ball);
    }
    double ball_height() {
        btTransform place;
        shown.getWorldTransform(place);
        return double(place.getOrigin().y());
    }
};

class Interpolation : public ::testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(World, Interpolation, ::testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

TEST_P(Interpolation, ShowsSurfacesWhereMotionStatesAre) {
    for (const bool lags : {true, false}) {
        Falling falling(GetParam());
        falling.bullet.setLatencyMotionStateInterpolation(lags);
        ASSERT_EQ(frond_world_set_interpolation(falling.plants, FROND_INTERPOLATION_AS_MOTION_STATES), FROND_OK);
        const float start = surface_of(falling.plant)[1];
        int between = 0;
        for (int frame = 0; frame < 60; frame++) {
            falling.bullet.stepSimulation(btScalar(0.007), 10, btScalar(H));
            const double fallen = double(surface_of(falling.plant)[1] - start);
            EXPECT_NEAR(fallen, falling.ball_height(), 2e-5) << frame;
            const double now = double(falling.ball.getWorldTransform().getOrigin().y());
            if (std::abs(fallen - now) > 1e-3) between++;
        }
        EXPECT_GT(between, 20);  // it was shown elsewhere than at its current position
    }
}

TEST_P(Interpolation, OfStepsOfAnyLengthIsNone) {
    Falling falling(GetParam());
    ASSERT_EQ(frond_world_set_interpolation(falling.plants, FROND_INTERPOLATION_AS_MOTION_STATES), FROND_OK);
    const float start = surface_of(falling.plant)[1];
    for (int frame = 0; frame < 10; frame++) falling.bullet.stepSimulation(btScalar(0.01), 0);
    const double now = double(falling.ball.getWorldTransform().getOrigin().y());
    EXPECT_NEAR(double(surface_of(falling.plant)[1] - start), now, 2e-5);
}

// A plant that is pulled and let go: the end of one step is shown where the next one begins.
TEST_P(Interpolation, GoesOnWithoutAJumpFromStepToStep) {
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = GetParam();
    SmallWorld small(def, 5e7);
    frond_grab grab;
    ASSERT_EQ(frond_grab_create(small.plant, {0, 0.6, 0}, 50, &grab), FROND_OK);
    ASSERT_EQ(frond_grab_move(grab, {0.5, 0.5, 0}), FROND_OK);
    const auto shown = [&](double fraction) {
        EXPECT_EQ(frond_world_set_interpolation(small.world, fraction), FROND_OK);
        return surface_of(small.plant);
    };
    double widest = 0;
    for (int i = 0; i < 60; i++) {
        if (i == 30) frond_grab_destroy(grab);
        const std::vector<float> end = shown(1);
        ASSERT_EQ(frond_world_step(small.world, H), FROND_OK);
        const std::vector<float> begin = shown(0), half = shown(0.5), now = shown(1), beyond = shown(2);
        EXPECT_LT(farthest(begin, end), 2e-6) << i;
        std::vector<float> middle = now, ahead = now;
        for (size_t k = 0; k < now.size(); k++) {
            middle[k] = 0.5f * (now[k] + end[k]);
            ahead[k] = 2 * now[k] - end[k];
        }
        // A cage's points go straight on. A chain's turn on: their ways are arcs, of more than 0.1 m here.
        const double way = farthest(now, end), square = GetParam() == FROND_MECHANICS_ROD ? way * way / 0.1 : 0;
        EXPECT_LT(farthest(half, middle), 2e-6 + square / 8) << i;
        EXPECT_LT(farthest(beyond, ahead), 4e-6 + square) << i;
        widest = std::max(widest, way);
    }
    EXPECT_GT(widest, 0.005);
    // A plant whose state was set is shown there at once.
    std::vector<double> xyz(size_t(3 * frond_plant_get_node_count(small.plant)));
    ASSERT_EQ(frond_plant_get_state(small.plant, xyz.data(), nullptr, int(xyz.size() / 3)), FROND_OK);
    ASSERT_EQ(frond_plant_set_state(small.plant, xyz.data(), nullptr, int(xyz.size() / 3)), FROND_OK);
    EXPECT_EQ(shown(0), shown(1));
}

TEST_P(Interpolation, TakesFragmentsAlong) {
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = GetParam();
    SmallWorld small(def);
    ASSERT_EQ(frond_plant_break(small.plant, 1), FROND_OK) << frond_last_error();
    for (int i = 0; i < 12; i++) ASSERT_EQ(frond_world_step(small.world, H), FROND_OK);
    const std::vector<float> before = surface_of(small.plant);
    ASSERT_EQ(frond_world_step(small.world, H), FROND_OK);
    const std::vector<float> now = surface_of(small.plant);
    ASSERT_EQ(frond_world_set_interpolation(small.world, 0), FROND_OK);
    const std::vector<float> begin = surface_of(small.plant);
    EXPECT_GT(farthest(now, begin), 0.02);
    EXPECT_LT(farthest(before, begin), 2e-4);
}

TEST(InterpolationSetting, IsChecked) {
    SmallWorld small;
    EXPECT_EQ(frond_world_set_interpolation({}, 0.5), FROND_RESULT_BAD_HANDLE);
    for (const double wrong : {-0.5, 2.1, std::nan(""), double(INFINITY)})
        EXPECT_EQ(frond_world_set_interpolation(small.world, wrong), FROND_RESULT_BAD_ARGUMENT) << wrong;
}

}  // namespace interpolation_tests
