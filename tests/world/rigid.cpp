// Bodies made by Frond: they fall, rest and carry plants along, in Frond's own world.
#include <cmath>
#include <vector>

#include "support/stems.hpp"

namespace rigid_tests {

frond_rigid add(frond_world world, frond_shape shape, frond_vec3 size, double mass, frond_vec3 place) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = shape;
    def.size = size;
    def.mass = mass;
    def.state.position = place;
    frond_rigid rigid = {};
    EXPECT_EQ(frond_rigid_create(world, &def, &rigid), FROND_OK) << frond_last_error();
    return rigid;
}

struct EveryShape : testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Rigid, EveryShape, testing::Range(0, int(FROND_SHAPE_PLANE)),
                         [](const auto& info) { return std::string(frond_shape_name(frond_shape(info.param))); });

TEST_P(EveryShape, FallsOntoAPlaneAndRests) {
    SmallWorld small;
    add(small.world, FROND_SHAPE_PLANE, {}, 0, {0, 0, 0});
    const frond_rigid body = add(small.world, frond_shape(GetParam()), {0.1, 0.1, 0.1}, 1, {2, 0.5, 0});
    for (int i = 0; i < 180; i++) ASSERT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
    frond_rigid_state state;
    ASSERT_EQ(frond_rigid_get_state(body, &state), FROND_OK);
    EXPECT_GT(state.position.y, 0.05);
    EXPECT_LT(state.position.y, 0.21);
    EXPECT_LT(std::abs(state.velocity.y), 0.05);
}

TEST_P(EveryShape, PushesAPlantThatIsInItsWay) {
    SmallWorld small;
    frond_vec3 before, after;
    ASSERT_EQ(frond_plant_get_tip(small.plant, &before), FROND_OK);
    const frond_rigid body = add(small.world, frond_shape(GetParam()), {0.08, 0.08, 0.08}, 0, {-0.2, 0.55, 0});
    frond_rigid_state state;
    ASSERT_EQ(frond_rigid_get_state(body, &state), FROND_OK);
    double pushed = 0;
    for (int i = 0; i < 40; i++) {
        state.position.x += 0.006;
        ASSERT_EQ(frond_rigid_set_state(body, &state), FROND_OK);
        ASSERT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
        std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(small.plant)));
        ASSERT_EQ(frond_plant_get_contacts(small.plant, contacts.data(), int(contacts.size())), FROND_OK);
        for (const frond_contact& contact : contacts) {
            EXPECT_EQ(contact.body, frond_rigid_get_body(body));
            pushed += contact.impulse.x;
        }
    }
    ASSERT_EQ(frond_plant_get_tip(small.plant, &after), FROND_OK);
    EXPECT_GT(after.x - before.x, 0.05);
    EXPECT_GT(pushed, 0);
}

}  // namespace rigid_tests
