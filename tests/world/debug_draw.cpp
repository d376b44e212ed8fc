// A host's btIDebugDraw draws plants, and the host's own flags on its objects are kept.
#include <LinearMath/btIDebugDraw.h>
#include <btBulletDynamicsCommon.h>

#include <vector>

#include "frond/frond_bullet.hpp"
#include "support/stems.hpp"

namespace debug_draw_tests {

struct Drawer : btIDebugDraw {
    int mode = 0;
    std::vector<btVector3> ends, contacts;
    void drawLine(const btVector3& from, const btVector3& to, const btVector3&) override {
        ends.push_back(from);
        ends.push_back(to);
    }
    void drawContactPoint(const btVector3& point, const btVector3&, btScalar, int, const btVector3&) override {
        contacts.push_back(point);
    }
    void reportErrorWarning(const char*) override {}
    void draw3dText(const btVector3&, const char*) override {}
    void setDebugMode(int wanted) override { mode = wanted; }
    int getDebugMode() const override { return mode; }
};

int lines_of(SmallWorld& small, Drawer& drawer, int mode) {
    drawer.ends.clear();
    drawer.contacts.clear();
    drawer.setDebugMode(mode);
    btDynamicsWorld* bullet = frond::bullet_world(small.world);
    bullet->setDebugDrawer(&drawer);
    bullet->debugDrawWorld();
    bullet->setDebugDrawer(nullptr);
    return int(drawer.ends.size() / 2);
}

TEST(DebugDraw, ShowsCageAndContactsWhereTheyAre) {
    SmallWorld small(frond_default_plant_def(), 0, FROND_REST_STANDS_AS_MODELLED);
    Drawer drawer;
    EXPECT_EQ(lines_of(small, drawer, btIDebugDraw::DBG_NoDebug), 0);
    const int still = lines_of(small, drawer, btIDebugDraw::DBG_DrawWireframe);
    frond_cage_view cage;
    ASSERT_EQ(frond_model_get_cage(small.model, &cage), FROND_OK);
    EXPECT_GT(still, cage.node_count);
    EXPECT_TRUE(drawer.contacts.empty());

    // A ball presses on it from the left, and the lines follow.
    frond_rigid_def def = frond_default_rigid_def();
    def.mass = 0;
    def.state.position = {-0.1, 0.5, 0};
    frond_rigid ball;
    ASSERT_EQ(frond_rigid_create(small.world, &def, &ball), FROND_OK);
    frond_rigid_state state = def.state;
    for (int i = 0; i < 30; i++) {
        state.position.x += 0.003;
        ASSERT_EQ(frond_rigid_set_state(ball, &state), FROND_OK);
        ASSERT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
    }
    lines_of(small, drawer, btIDebugDraw::DBG_DrawWireframe | btIDebugDraw::DBG_DrawContactPoints);
    ASSERT_FALSE(drawer.contacts.empty());
    bool has_node = false;
    std::vector<double> xyz(size_t(3 * cage.node_count));
    ASSERT_EQ(frond_plant_get_state(small.plant, xyz.data(), nullptr, cage.node_count), FROND_OK);
    const btVector3 last = {btScalar(xyz[xyz.size() - 3]), btScalar(xyz[xyz.size() - 2]),
                            btScalar(xyz[xyz.size() - 1])};
    for (const btVector3& end : drawer.ends) has_node |= (end - last).length() < btScalar(1e-5);
    EXPECT_TRUE(has_node);
}

TEST(DebugDraw, LeavesTheHostsMarksAlone) {
    SmallWorld small;
    btCollisionObject* object = frond::bullet_object(small.plant);
    int mine = 0;
    object->setUserPointer(&mine);
    object->setUserIndex(7);
    object->setUserIndex2(8);
    for (int i = 0; i < 10; i++) ASSERT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
    EXPECT_EQ(object->getUserPointer(), &mine);
    EXPECT_EQ(object->getUserIndex(), 7);
    EXPECT_EQ(object->getUserIndex2(), 8);
}

}  // namespace debug_draw_tests
