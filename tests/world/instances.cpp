// Instances: memory that plants of one model take, counted by the allocator.
#include <gtest/gtest.h>
#include <malloc.h>

#include <string>
#include <vector>

#include "frond/frond.h"
#include "support/must.hpp"
#include "support/sanitized.hpp"

namespace instances_tests {

using frond::test::must;

constexpr double H = 1.0 / 60;

double kilobytes() {
    const struct mallinfo2 info = mallinfo2();
    return double(info.uordblks + info.hblkhd) / 1024;
}

// Corn in rows, far apart.
struct Rows {
    frond_world world = {};
    frond_model model = {};
    std::vector<frond_plant> plants;

    explicit Rows(double capsule_height) {
        const frond_world_def def = frond_default_world_def();
        must(frond_world_create(&def, &world));
        frond_model_def model_def = frond_default_model_def();
        model_def.capsule_height = capsule_height;
        must(frond_model_load((std::string(FROND_SOURCE_DIR) + "/models/corn/corn.obj").c_str(), &model_def, &model));
    }
    ~Rows() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    void add(int count, frond_mechanics mechanics, bool asleep) {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = mechanics;
        def.starts_asleep = asleep;
        for (int i = 0; i < count; i++) {
            def.position = {3.0 * double(plants.size() % 20), 0, 3.0 * double(plants.size() / 20)};
            frond_plant plant = {};
            must(frond_plant_create(world, model, &def, &plant));
            plants.push_back(plant);
        }
    }
    int awake() const {
        frond_report report = {};
        must(frond_world_get_report(world, &report));
        return report.awake_count;
    }
    void settle() {
        int steps = 0;
        do must(frond_world_step(world, H));
        while (awake() > 0 && ++steps < 1200);
        ASSERT_EQ(awake(), 0);
    }
};

constexpr double FEW_PIECES = 0.4;  // capsule height with which the corn has 41 capsules [m]
// Memory of one plant beyond its model [kB]. Bullet's share, soft body and proxy, is larger in double precision.
#ifdef BT_USE_DOUBLE_PRECISION
constexpr double ROD_ASLEEP = 5, CAGE_AWAKE = 1024;
#else
constexpr double ROD_ASLEEP = 4, CAGE_AWAKE = 1024;
#endif

TEST(Instances, OfRodsThatSleepKeepLittleWhetherTheyEverMovedOrNot) {
    if (SANITIZED) GTEST_SKIP() << "another allocator";
    constexpr int COUNT = 100;
    Rows rows(FEW_PIECES);
    rows.add(8, FROND_MECHANICS_ROD, false);  // batched, so that memory needed once per thread is already allocated
    rows.settle();
    ASSERT_NEAR(frond_plant_get_capsule_count(rows.plants[0]), 41, 5);
    const double before = kilobytes();
    rows.add(COUNT, FROND_MECHANICS_ROD, true);
    const double never_moved = (kilobytes() - before) / COUNT;
    EXPECT_LT(never_moved, ROD_ASLEEP);

    for (int i = 0; i < COUNT; i++) must(frond_plant_wake(rows.plants[size_t(i)]));
    must(frond_world_step(rows.world, H));
    EXPECT_EQ(rows.awake(), COUNT);
    rows.settle();
    const double settled = (kilobytes() - before) / COUNT;
    EXPECT_LT(settled, ROD_ASLEEP);
    RecordProperty("never_moved_bytes", int(1024 * never_moved));
    RecordProperty("settled_bytes", int(1024 * settled));
    std::printf("a rod plant that sleeps: %.2f kB, %.2f kB if it moved before\n", never_moved, settled);
}

TEST(Instances, OfCagesThatMoveKeepLessThanAMegabyte) {
    if (SANITIZED) GTEST_SKIP() << "another allocator";
    constexpr int COUNT = 10;
    Rows rows(0);
    rows.add(1, FROND_MECHANICS_TET_COROTATIONAL, false);
    must(frond_world_step(rows.world, H));
    const double before = kilobytes();
    rows.add(COUNT, FROND_MECHANICS_TET_COROTATIONAL, false);
    for (int i = 0; i < 5; i++) must(frond_world_step(rows.world, H));
    EXPECT_EQ(rows.awake(), COUNT + 1);
    const double each = (kilobytes() - before) / COUNT;
    EXPECT_LT(each, CAGE_AWAKE);
    std::printf("a caged plant that moves: %.0f kB\n", each);
}

// Reading a sleeping plant decompresses it, and the next substep compresses it again.
TEST(Instances, ThatAreLookedAtAreFoldedAgain) {
    if (SANITIZED) GTEST_SKIP() << "another allocator";
    Rows rows(FEW_PIECES);
    rows.add(50, FROND_MECHANICS_ROD, true);
    must(frond_world_step(rows.world, H));
    const double before = kilobytes();
    std::vector<double> x(3 * size_t(frond_plant_get_node_count(rows.plants[0])));
    for (frond_plant plant : rows.plants) must(frond_plant_get_state(plant, x.data(), nullptr, int(x.size() / 3)));
    EXPECT_GT(kilobytes() - before, 50 * ROD_ASLEEP);
    must(frond_world_step(rows.world, H));
    EXPECT_LT((kilobytes() - before) / 50, 1);
}

}  // namespace instances_tests
