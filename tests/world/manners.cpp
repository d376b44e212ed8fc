// Checks what a host expects of a guest in its Bullet world: zones in its profiler, memory from its allocators, and all
// of it returned.
#include <LinearMath/btAlignedAllocator.h>
#include <LinearMath/btQuickprof.h>
#include <btBulletDynamicsCommon.h>

#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/stems.hpp"
#include "support/system.hpp"

namespace manners_tests {

std::vector<std::string> open_zones;
std::set<std::string> seen_zones;  // "outer/inner"
void enter_zone(const char* name) {
    open_zones.push_back(name);
    seen_zones.insert(open_zones.size() > 1 ? open_zones[open_zones.size() - 2] + "/" + name : name);
}
void leave_zone() {
    open_zones.pop_back();
}

// Simulates a plant with a ball that rests against it.
void play(int steps) {
    SmallWorld small;
    frond_rigid_def def = frond_default_rigid_def();
    def.state.position = {-0.11, 0.4, 0};
    def.state.velocity = {0.5, 0, 0};
    frond_rigid ball;
    ASSERT_EQ(frond_rigid_create(small.world, &def, &ball), FROND_OK);
    int touches = 0;
    for (int i = 0; i < steps; i++) {
        ASSERT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
        touches += frond_plant_get_contact_count(small.plant);
    }
    EXPECT_GT(touches, 0);
}

TEST(Manners, PartsOfAStepAreZonesOfBulletsProfiler) {
    btEnterProfileZoneFunc* enter = btGetCurrentEnterProfileZoneFunc();
    btLeaveProfileZoneFunc* leave = btGetCurrentLeaveProfileZoneFunc();
    seen_zones.clear();
    btSetCustomEnterProfileZoneFunc(enter_zone);
    btSetCustomLeaveProfileZoneFunc(leave_zone);
    play(10);
    btSetCustomEnterProfileZoneFunc(enter);
    btSetCustomLeaveProfileZoneFunc(leave);
    EXPECT_TRUE(open_zones.empty());
    for (const char* zone : {"frond/frond collide", "frond/frond solve", "frond/frond respond", "frond/frond settle"})
        EXPECT_TRUE(seen_zones.count(zone)) << zone;
    EXPECT_TRUE(seen_zones.count("updateActions/frond"));
}

int64_t taken = 0, given_back = 0, crooked = 0;
void* take_aligned(size_t size, int alignment) {
    void* memory = allocate_aligned(size, size_t(alignment));
    taken += memory != nullptr;
    return memory;
}
void give_back_aligned(void* memory) {
    if (memory) given_back++;
    if (reinterpret_cast<uintptr_t>(memory) % 16) crooked++;
    free_aligned(memory);
}

// Bullet's own objects choose their allocator by their operator new.
TEST(Manners, BulletsObjectsLiveInBulletsMemoryAndAllOfItIsGivenBack) {
    btAlignedAllocSetCustomAligned(take_aligned, give_back_aligned);
    taken = given_back = crooked = 0;
    {
        frond_world world;
        const frond_world_def def = frond_default_world_def();
        ASSERT_EQ(frond_world_create(&def, &world), FROND_OK);
        const frond_model model = make_small_model();
        const frond_plant_def plant_def = frond_default_plant_def();
        frond_plant plant;
        const int64_t before = taken;
        ASSERT_EQ(frond_plant_create(world, model, &plant_def, &plant), FROND_OK);
        // At least a body, a compound shape, and one shape per capsule.
        EXPECT_GT(taken - before, 2 + frond_plant_get_capsule_count(plant));
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    play(5);
    EXPECT_EQ(taken, given_back);
    EXPECT_EQ(crooked, 0);
    btAlignedAllocSetCustomAligned(nullptr, nullptr);
}

}  // namespace manners_tests
