// Events of plants, in one list per world.
#include <algorithm>
#include <cstring>
#include <vector>

#include "support/stems.hpp"

namespace events_tests {

void step(frond_world world, int count) {
    for (int i = 0; i < count; i++) ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK) << frond_last_error();
}

std::vector<frond_event_info> events_of(frond_world world) {
    std::vector<frond_event_info> list(size_t(frond_world_get_event_count(world)));
    EXPECT_EQ(frond_world_take_events(world, list.data(), int(list.size())), FROND_OK) << frond_last_error();
    EXPECT_EQ(frond_world_get_event_count(world), 0);
    return list;
}

// A world whose events are recorded from the beginning.
struct WatchedWorld : SmallWorld {
    explicit WatchedWorld(frond_rest rest = FROND_REST_WITHOUT_GRAVITY)
        : SmallWorld(frond_default_plant_def(), 0, rest) {
        EXPECT_EQ(frond_world_get_event_count(world), 0);
    }
};

int count_of(const std::vector<frond_event_info>& list, frond_event event) {
    return int(
        std::count_if(list.begin(), list.end(), [&](const frond_event_info& info) { return info.event == event; }));
}

frond_rigid drop_ball(frond_world world, const frond_vec3& place, const frond_vec3& velocity, double mass = 0.05) {
    frond_rigid_def def = frond_default_rigid_def();
    def.size.x = 0.03;
    def.mass = mass;
    def.state.position = place;
    def.state.velocity = velocity;
    frond_rigid ball = {};
    EXPECT_EQ(frond_rigid_create(world, &def, &ball), FROND_OK);
    return ball;
}

TEST(Events, HaveNames) {
    EXPECT_STREQ(frond_event_name(FROND_EVENT_BROKE), "broke");
    EXPECT_STREQ(frond_event_name(FROND_EVENT_FELL_ASLEEP), "fell_asleep");
    EXPECT_STREQ(frond_event_name(FROND_EVENT_COUNT), "?");
    EXPECT_STREQ(frond_event_name(frond_event(-1)), "?");
}

TEST(Events, AreKeptOnceSomebodyAsks) {
    SmallWorld small;
    ASSERT_EQ(frond_plant_break(small.plant, 1), FROND_OK);
    EXPECT_EQ(frond_world_get_event_count(small.world), 0);
    ASSERT_EQ(frond_plant_break(small.plant, 0), FROND_OK);
    EXPECT_EQ(frond_world_get_event_count(small.world), 1);
}

TEST(Events, AreNoneWhereNothingHappens) {
    WatchedWorld small;
    step(small.world, 5);
    EXPECT_TRUE(events_of(small.world).empty());
}

TEST(Events, TellOfSleepAndOfWaking) {
    WatchedWorld small(FROND_REST_STANDS_AS_MODELLED);
    int steps = 0;
    while (frond_plant_is_awake(small.plant) && steps < 600) step(small.world, 1), steps++;
    std::vector<frond_event_info> list = events_of(small.world);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].event, FROND_EVENT_FELL_ASLEEP);
    EXPECT_EQ(list[0].plant.id, small.plant.id);
    EXPECT_EQ(list[0].capsule, -1);
    EXPECT_EQ(list[0].body, nullptr);
    EXPECT_NEAR(list[0].time, steps / 60.0, 1e-6);  // time steps have Bullet's precision
    ASSERT_EQ(frond_plant_wake(small.plant), FROND_OK);
    ASSERT_EQ(frond_plant_wake(small.plant), FROND_OK);
    list = events_of(small.world);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].event, FROND_EVENT_WOKE);
}

TEST(Events, TellWhoTouchedAPlantOnce) {
    WatchedWorld small;
    const frond_rigid ball = drop_ball(small.world, {-0.3, 0.3, 0}, {3, 1, 0});
    step(small.world, 60);
    const std::vector<frond_event_info> list = events_of(small.world);
    ASSERT_GE(count_of(list, FROND_EVENT_TOUCHED), 1);
    EXPECT_LE(count_of(list, FROND_EVENT_TOUCHED), 3);  // it may touch again
    const auto touched = std::find_if(list.begin(), list.end(),
                                      [](const frond_event_info& info) { return info.event == FROND_EVENT_TOUCHED; });
    EXPECT_EQ(touched->plant.id, small.plant.id);
    EXPECT_EQ(touched->body, frond_rigid_get_body(ball));
    EXPECT_EQ(touched->other.id, 0u);
    EXPECT_GE(touched->capsule, 0);
    EXPECT_LT(touched->capsule, frond_plant_get_capsule_count(small.plant));
    EXPECT_GT(touched->time, 0.03);
}

TEST(Events, ABodyThatIsLeanedOnTouchesOnce) {
    WatchedWorld small;
    drop_ball(small.world, {-0.06, 0.55, 0}, {0, 0, 0}, 0);  // static
    frond_grab grab = {};
    ASSERT_EQ(frond_grab_create(small.plant, {0, 0.6, 0}, 100, &grab), FROND_OK);
    ASSERT_EQ(frond_grab_move(grab, {-0.2, 0.6, 0}), FROND_OK);
    step(small.world, 120);
    EXPECT_GT(frond_plant_get_contact_count(small.plant), 0);
    EXPECT_EQ(count_of(events_of(small.world), FROND_EVENT_TOUCHED), 1);
}

TEST(Events, OfTwoPlantsThatTouchEachHasOne) {
    WatchedWorld small;
    frond_plant_def def = frond_default_plant_def();
    def.position = {0.08, 0, 0};
    frond_plant other = {};
    ASSERT_EQ(frond_plant_create(small.world, small.model, &def, &other), FROND_OK);
    step(small.world, 20);
    const std::vector<frond_event_info> list = events_of(small.world);
    bool first = false, second = false;
    for (const frond_event_info& info : list) {
        if (info.event != FROND_EVENT_TOUCHED) continue;
        first |= info.plant.id == small.plant.id && info.other.id == other.id;
        second |= info.plant.id == other.id && info.other.id == small.plant.id;
    }
    EXPECT_TRUE(first);
    EXPECT_TRUE(second);
    // A plant's events are removed with it.
    ASSERT_EQ(frond_plant_break(other, 0), FROND_OK);
    EXPECT_EQ(frond_world_get_event_count(small.world), 1);
    frond_plant_destroy(other);
    for (const frond_event_info& info : events_of(small.world)) EXPECT_EQ(info.plant.id, small.plant.id);
    step(small.world, 5);
}

TEST(Events, TellWhichCapsuleBroke) {
    WatchedWorld small;
    const int last = frond_plant_get_capsule_count(small.plant) - 1;
    ASSERT_EQ(frond_plant_break(small.plant, last), FROND_OK);
    const std::vector<frond_event_info> list = events_of(small.world);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0].event, FROND_EVENT_BROKE);
    EXPECT_EQ(list[0].capsule, last);
    EXPECT_EQ(list[0].plant.id, small.plant.id);
}

TEST(Events, WrongCallsAreRefusedAndChangeNothing) {
    WatchedWorld small;
    ASSERT_EQ(frond_plant_break(small.plant, 0), FROND_OK);
    frond_event_info list[2] = {};
    EXPECT_EQ(frond_world_get_event_count({}), 0);
    EXPECT_EQ(frond_world_take_events({}, list, 1), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_world_take_events(small.world, list, 2), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(frond_last_error(), "event_count is 2; this world has 1"), nullptr);
    EXPECT_EQ(frond_world_take_events(small.world, nullptr, 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_world_get_event_count(small.world), 1);
    EXPECT_EQ(frond_world_take_events(small.world, list, 1), FROND_OK);
    EXPECT_EQ(frond_world_take_events(small.world, nullptr, 0), FROND_OK);
}

}  // namespace events_tests
