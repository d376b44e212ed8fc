// Plants of a world, batched where possible, move as each does in a world of its own, to the last bit, with any number
// of threads, while they are woken one by one and one of them is hit.
#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "frond/frond.h"
#include "frond/frond_bullet.hpp"
#include "frond/frond_snapshot.h"
#include "support/stems.hpp"

namespace batch_tests {

constexpr double H = 1.0 / 60;
constexpr int COUNT = 7, HIT = 3;

void parallel_for(int count, frond_job_fn* job, void* data, void* user) {
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) job(data, i);
    };
    std::vector<std::thread> others;
    for (int i = 1; i < *static_cast<int*>(user); i++) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
}

// Some of the plants, each always in the same place, and the ball that hits one of them if that is included.
struct Garden {
    frond_world world = {};
    std::vector<frond_plant> plants;
    std::vector<int> which;
    int contacts = 0;

    Garden(frond_model model, const std::vector<int>& of, int* threads, frond_mechanics mechanics) : which(of) {
        frond_world_def def = frond_default_world_def();
        if (threads) {
            def.parallel_for = parallel_for;
            def.parallel_user = threads;
        }
        EXPECT_EQ(frond_world_create(&def, &world), FROND_OK);
        for (const int i : of) {
            frond_plant_def plant_def = frond_default_plant_def();
            plant_def.mechanics = mechanics;
            plant_def.position = {3.0 * i, 0, 0.5 * i};
            plant_def.rotation = {0, std::sin(0.4 * i), 0, std::cos(0.4 * i)};
            plant_def.starts_asleep = true;
            plants.emplace_back();
            EXPECT_EQ(frond_plant_create(world, model, &plant_def, &plants.back()), FROND_OK);
            if (i == HIT) add_ball();
        }
    }
    ~Garden() { frond_world_destroy(world); }
    void add_ball() {
        frond_rigid_def ball = frond_default_rigid_def();
        ball.size = {0.05, 0, 0};
        ball.mass = 0.1;
        ball.state.position = {3.0 * HIT - 2.5, 1.2, 0.5 * HIT};
        ball.state.velocity = {3, 3, 0};
        frond_rigid rigid = {};
        EXPECT_EQ(frond_rigid_create(world, &ball, &rigid), FROND_OK);
    }
    void step(int number) {
        for (size_t i = 0; i < plants.size(); i++)
            if (number == 5 * which[i]) {
                EXPECT_EQ(frond_plant_wake(plants[i]), FROND_OK);
            }
        // Sleeping plants would feel the wind in turns that depend on their number.
        if (number == 5 * COUNT) {
            frond_wind_def wind = frond_default_wind_def();
            wind.velocity = {4, 0, 1};
            EXPECT_EQ(frond_world_set_wind(world, &wind), FROND_OK);
        }
        EXPECT_EQ(frond_world_step(world, H), FROND_OK) << frond_last_error();
        frond_report report = {};
        EXPECT_EQ(frond_world_get_report(world, &report), FROND_OK);
        contacts += report.contact_count;
    }
    std::vector<double> state(size_t i) const {
        const int nodes = frond_plant_get_node_count(plants[i]);
        std::vector<double> x(size_t(3 * nodes)), v(x.size());
        EXPECT_EQ(frond_plant_get_state(plants[i], x.data(), v.data(), nodes), FROND_OK);
        x.insert(x.end(), v.begin(), v.end());
        return x;
    }
};

struct BatchBy : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(BatchedPlants, BatchBy,
                         testing::Values(FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL));

TEST_P(BatchBy, PlantsOfAWorldGoAsEachAlone) {
    const int steps = GetParam() == FROND_MECHANICS_ROD ? 200 : 100;
    const frond_model model = make_small_model(2e6, FROND_REST_STANDS_AS_MODELLED);
    std::vector<std::vector<double>> alone;
    for (int i = 0; i < COUNT; i++) {
        Garden garden(model, {i}, nullptr, GetParam());
        for (int k = 0; k < steps; k++) garden.step(k);
        alone.push_back(garden.state(0));
        EXPECT_EQ(garden.contacts > 0, i == HIT);
    }
    std::vector<int> all;
    for (int i = 0; i < COUNT; i++) all.push_back(i);
    for (int threads : {1, 2, 3, 4}) {
        Garden garden(model, all, &threads, GetParam());
        for (int k = 0; k < steps; k++) garden.step(k);
        for (size_t i = 0; i < COUNT; i++)
            EXPECT_EQ(garden.state(i), alone[i]) << "plant " << i << ", threads " << threads;
    }
    frond_model_destroy(model);
}

// Corn in wind. Only plants with the same settings are batched; a direct solver ignores the tolerance.
struct Row {
    frond_world world = {};
    frond_model model = {};
    std::vector<frond_plant> plants;

    explicit Row(bool is_batched, frond_mechanics which = FROND_MECHANICS_ROD, double apart = 0.7,
                 bool is_touching = false) {
        frond_model_def model_def = frond_default_model_def();
        model_def.capsule_height = 0.4;
        EXPECT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &model_def, &model), FROND_OK);
        const frond_world_def def = frond_default_world_def();
        EXPECT_EQ(frond_world_create(&def, &world), FROND_OK);
        frond_wind_def wind = frond_default_wind_def();
        wind.velocity = {9, 0, 0};
        EXPECT_EQ(frond_world_set_wind(world, &wind), FROND_OK);
        for (int i = 0; i < COUNT; i++) {
            frond_plant_def plant_def = frond_default_plant_def();
            plant_def.mechanics = which;
            if (!is_touching) plant_def.effects &= ~uint32_t(FROND_EFFECT_PLANT_CONTACT);
            plant_def.position = {apart * i, 0, 0};
            plant_def.rotation = {0, std::sin(0.4 * i), 0, std::cos(0.4 * i)};
            if (!is_batched) plant_def.tuning.linear_tolerance *= 1 + 1e-3 * i;
            plants.emplace_back();
            EXPECT_EQ(frond_plant_create(world, model, &plant_def, &plants.back()), FROND_OK);
        }
    }
    ~Row() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    btCompoundShape& shape(size_t i) const {
        return static_cast<btCompoundShape&>(*frond::bullet_object(plants[i])->getCollisionShape());
    }
    uint64_t hash() const {
        uint64_t hash = 0;
        EXPECT_EQ(frond_world_get_state_hash(world, &hash), FROND_OK);
        return hash;
    }
    // Returns the frames of all collision shapes, and the box around them.
    std::vector<btScalar> pieces(size_t i) const {
        std::vector<btScalar> numbers;
        const auto add = [&](const btVector3& v) { numbers.insert(numbers.end(), {v.x(), v.y(), v.z()}); };
        for (int child = 0; child < shape(i).getNumChildShapes(); child++) {
            const btTransform& frame = shape(i).getChildTransform(child);
            for (int r = 0; r < 3; r++) add(frame.getBasis()[r]);
            add(frame.getOrigin());
        }
        btVector3 lower, upper;
        shape(i).getAabb(btTransform::getIdentity(), lower, upper);
        add(lower), add(upper);
        return numbers;
    }
    // Checks that Bullet's tree contains each collision shape by its extent; its box would be wider.
    void check_tree(size_t i) const {
        constexpr btScalar NEAR = btScalar(1e-4);  // [m]
        for (int child = 0; child < shape(i).getNumChildShapes(); child++) {
            const btTransform& frame = shape(i).getChildTransform(child);
            const auto& piece = static_cast<const btConvexShape&>(*shape(i).getChildShape(child));
            btVector3 lower, upper;
            for (int c = 0; c < 3; c++) {
                const btVector3 along = frame.getBasis()[c];
                upper[c] = (frame * piece.localGetSupportingVertex(along))[c] - NEAR;
                lower[c] = (frame * piece.localGetSupportingVertex(-along))[c] + NEAR;
            }
            for (const btDbvtNode* node = shape(i).getChildList()[child].m_node; node; node = node->parent)
                EXPECT_TRUE(node->volume.Contain(btDbvtVolume::FromMM(lower, upper)))
                    << "plant " << i << ", piece " << child;
        }
    }
};

TEST_P(BatchBy, PiecesAreWhereThoseOfEachAloneAre) {
    Row batched(true, GetParam()), alone(false, GetParam());
    ASSERT_GT(batched.shape(0).getNumChildShapes(), frond_plant_get_capsule_count(batched.plants[0])) << "no plates";
    for (int k = 0; k < 90; k++) {
        for (Row* row : {&batched, &alone}) ASSERT_EQ(frond_world_step(row->world, H), FROND_OK);
        for (size_t i = 0; i < COUNT; i++) {
            ASSERT_EQ(batched.pieces(i), alone.pieces(i)) << "plant " << i << ", step " << k;
            batched.check_tree(i);
        }
    }
}

// Batched plants store the end of their last step once, others twice; snapshots do not differ.
TEST_P(BatchBy, PlantsThatGoBackToASnapshotGoTheSameWayAgain) {
    Row batched(true, GetParam()), alone(false, GetParam());
    const auto step = [](const Row& row, int count) {
        for (int k = 0; k < count; k++) ASSERT_EQ(frond_world_step(row.world, H), FROND_OK) << frond_last_error();
    };
    for (const Row* row : {&batched, &alone}) step(*row, 20);
    std::vector<char> bytes(frond_world_get_snapshot_size(batched.world));
    EXPECT_EQ(bytes.size(), frond_world_get_snapshot_size(alone.world));
    ASSERT_EQ(frond_world_save(batched.world, bytes.data(), bytes.size()), FROND_OK) << frond_last_error();
    for (const Row* row : {&batched, &alone}) step(*row, 20);
    ASSERT_EQ(frond_world_restore(batched.world, bytes.data(), bytes.size()), FROND_OK) << frond_last_error();
    step(batched, 20);
    EXPECT_EQ(batched.hash(), alone.hash());
}

// Plants that touch wait for each other's contacts, with their own factors from the batch.
TEST_P(BatchBy, PlantsThatTouchGoAsEachAlone) {
    constexpr double APART = 0.25;  // [m]
    Row batched(true, GetParam(), APART, true), alone(false, GetParam(), APART, true);
    int contacts = 0;
    for (int k = 0; k < 60; k++) {
        for (const Row* row : {&batched, &alone})
            ASSERT_EQ(frond_world_step(row->world, H), FROND_OK) << frond_last_error();
        ASSERT_EQ(batched.hash(), alone.hash()) << "step " << k;
        frond_report report = {};
        ASSERT_EQ(frond_world_get_report(batched.world, &report), FROND_OK);
        contacts += report.plant_contact_count;
    }
    EXPECT_GT(contacts, 100);
}

// Cages near the viewer and rods farther away are batched separately while the viewer comes and goes.
TEST(BatchedPlants, PlantsGoAsAloneWhileTheirDetailChanges) {
    Row batched(true, FROND_MECHANICS_TET_COROTATIONAL), alone(false, FROND_MECHANICS_TET_COROTATIONAL);
    const double far = frond_default_detail_def().rod_from;
    int rods = 0, cages = 0;
    for (int k = 0; k < 80; k++) {
        for (const Row* row : {&batched, &alone}) {
            ASSERT_EQ(frond_world_set_viewer(row->world, {0.35 * COUNT, 0, far * (0.7 + 0.6 * (k / 10 % 2))}),
                      FROND_OK);
            ASSERT_EQ(frond_world_step(row->world, H), FROND_OK) << frond_last_error();
        }
        ASSERT_EQ(batched.hash(), alone.hash()) << "step " << k;
        for (frond_plant plant : batched.plants) {
            frond_detail detail = {};
            ASSERT_EQ(frond_plant_get_detail(plant, &detail), FROND_OK);
            ++(detail == FROND_DETAIL_FULL ? cages : rods);
        }
    }
    EXPECT_GT(rods, 10 * COUNT);
    EXPECT_GT(cages, 10 * COUNT);
}

}  // namespace batch_tests
