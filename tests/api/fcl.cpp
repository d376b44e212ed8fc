// FCL sees plants: a straight reach is free without the plant, blocked by it, and free again once the plant is bent
// aside.
#include "frond/frond_fcl.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <gtest/gtest.h>

#include "support/stems.hpp"

namespace fcl_tests {

struct Touch {
    bool found = false;
};
bool look(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    static_cast<Touch*>(data)->found |= fcl::collide(a, b, request, result) > 0;
    return static_cast<Touch*>(data)->found;
}

// Returns whether a sphere with a radius of 3 cm can go straight from one point to another.
bool is_free(fcl::BroadPhaseCollisionManagerd& manager, const fcl::Vector3d& from, const fcl::Vector3d& to) {
    fcl::CollisionObjectd hand(std::make_shared<fcl::Sphered>(0.03));
    for (int i = 0; i <= 100; i++) {
        hand.setTranslation(from + 0.01 * i * (to - from));
        hand.computeAABB();
        Touch touch;
        manager.collide(&hand, &touch, look);
        if (touch.found) return false;
    }
    return true;
}

struct FclParts : testing::TestWithParam<frond::FclParts> {};
INSTANTIATE_TEST_SUITE_P(Fcl, FclParts, testing::Values(frond::FclParts::CAPSULES, frond::FclParts::CAGE));

TEST_P(FclParts, BlockAReachAndGiveWayWhenTheyAreBentAside) {
    SmallWorld small(frond_default_plant_def(), 0, FROND_REST_STANDS_AS_MODELLED);
    frond::FclPlant<double> plant(small.plant, small.model, GetParam());
    fcl::DynamicAABBTreeCollisionManagerd manager;
    manager.setup();
    const fcl::Vector3d from(0, 0.55, 0.3), to(0, 0.55, -0.3);
    EXPECT_TRUE(is_free(manager, from, to));
    plant.add_to(manager);
    manager.setup();
    EXPECT_FALSE(is_free(manager, from, to));
    EXPECT_TRUE(is_free(manager, from + fcl::Vector3d(0.4, 0, 0), to + fcl::Vector3d(0.4, 0, 0)));

    // The user pulls the stem aside; FCL's objects follow when they are updated.
    frond_grab grab;
    ASSERT_EQ(frond_grab_create(small.plant, {0, 0.6, 0}, 3000, &grab), FROND_OK);
    ASSERT_EQ(frond_grab_move(grab, {0.25, 0.5, 0}), FROND_OK);
    for (int i = 0; i < 120; i++) ASSERT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
    const fcl::CollisionObjectd* first = plant.collision_objects().front().get();
    EXPECT_FALSE(is_free(manager, from, to));
    plant.update();
    manager.update();
    EXPECT_TRUE(is_free(manager, from, to));
    EXPECT_EQ(plant.collision_objects().front().get(), first);
    plant.remove_from(manager);
    EXPECT_EQ(manager.size(), 0u);
}

TEST(FclPlant, TellsOfAPlantThatIsGone) {
    SmallWorld small;
    frond::FclPlant<double> plant(small.plant, small.model);
    frond_plant_destroy(small.plant);
    EXPECT_THROW(plant.update(), std::runtime_error);
}

}  // namespace fcl_tests
