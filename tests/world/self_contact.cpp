// Self-contact of plants: in their modelled shape nothing touches and nothing moves, and they do not pass through
// themselves.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/stand.hpp"
#include "support/stems.hpp"

namespace self_contact_tests {

using frond::test::must;
using frond::test::Stand;

struct SelfContact : testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Plants, SelfContact, testing::Range(0, int(FROND_MECHANICS_COUNT)), [](const auto& info) {
    return std::string(frond_mechanics_name(frond_mechanics(info.param)));
});

void step(frond_world world, frond_plant plant, int node_count, double most) {
    std::vector<double> before(size_t(3 * node_count)), after(size_t(3 * node_count));
    ASSERT_EQ(frond_plant_get_state(plant, before.data(), nullptr, node_count), FROND_OK);
    for (int i = 0; i < 30; i++) ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK);
    ASSERT_EQ(frond_plant_get_state(plant, after.data(), nullptr, node_count), FROND_OK);
    for (size_t k = 0; k < before.size(); k++) ASSERT_NEAR(after[k], before[k], most);
    frond_report report;
    ASSERT_EQ(frond_world_get_report(world, &report), FROND_OK);
    EXPECT_EQ(report.trouble, 0u);
}

TEST_P(SelfContact, MovesNothingAtRest) {
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = frond_mechanics(GetParam());
    def.effects = FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_GRAVITY);
    SmallWorld small(def);
    step(small.world, small.plant, frond_plant_get_node_count(small.plant), 1e-6);
}

TEST_P(SelfContact, LetsTheCornStand) {
    const frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    model_def.cage_size = 0.24;
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = frond_mechanics(GetParam());
    def.effects = FROND_EFFECT_ALL;
    frond_world world;
    frond_model model;
    frond_plant plant;
    ASSERT_EQ(frond_world_create(&world_def, &world), FROND_OK);
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &model_def, &model), FROND_OK)
        << frond_last_error();
    ASSERT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    // Springs have no shape without gravity, so they droop.
    step(world, plant, frond_plant_get_node_count(plant), GetParam() == FROND_MECHANICS_SPRING_CHAIN ? 0.2 : 0.002);
    frond_world_destroy(world);
    frond_model_destroy(model);
}

double distance_of(const frond_capsule& a, const frond_capsule& b) {
    constexpr int COUNT = 20;
    const auto at = [](const frond_capsule& c, int i) {
        const double share = double(i) / COUNT;
        return std::array<double, 3>{c.begin.x + share * (c.end.x - c.begin.x),
                                     c.begin.y + share * (c.end.y - c.begin.y),
                                     c.begin.z + share * (c.end.z - c.begin.z)};
    };
    double least = INFINITY;
    for (int i = 0; i <= COUNT; i++)
        for (int k = 0; k <= COUNT; k++) {
            const auto p = at(a, i), q = at(b, k);
            least = std::min(least, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        }
    return least;
}

// Two prongs of a fork are pressed together until they would cross: round ones slip past each other in the end, but
// their axes stay as far apart as they are thick.
TEST(SelfContactOfAFork, LetsNoProngThroughTheOther) {
    constexpr double RADIUS = 0.012, HIGH = 0.3;  // [m]
    const auto closest = [](bool with_contact) {
        frond_world_def world_def = frond_default_world_def();
        world_def.gravity = {0, 0, 0};
        Stand stand(world_def);
        stand.make_stems({{-1, {0, 0, 0}, {0, 0.2, 0}, 0.02, 0.02},
                          {0, {0, 0.2, 0}, {0.15, 0.6, 0}, RADIUS, RADIUS},
                          {0, {0, 0.2, 0}, {-0.15, 0.6, 0}, RADIUS, RADIUS}},
                         5e7);
        frond_plant_def def = stand.plant_def();
        def.effects = FROND_EFFECT_DEFAULT | (with_contact ? uint32_t(FROND_EFFECT_SELF_CONTACT) : 0u);
        const frond_plant plant = stand.add(def, {0, 0, 0});
        stand.steps(5);
        EXPECT_EQ(stand.report().plant_contact_count, 0);  // nothing touches as modelled
        frond_grab left = {}, right = {};
        must(frond_grab_create(plant, {-0.15, 0.6, 0}, 30, &left));
        must(frond_grab_create(plant, {0.15, 0.6, 0}, 30, &right));
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
        std::vector<int32_t> organs(capsules.size());
        must(frond_model_get_capsule_organs(stand.model, organs.data(), int(organs.size())));
        int touched = 0;
        double least = INFINITY;
        for (int i = 0; i < 120; i++) {
            const double way = 0.45 * std::min(1.0, i / 60.0);
            must(frond_grab_move(left, {-0.15 + way, 0.6, 0}));
            must(frond_grab_move(right, {0.15 - way, 0.6, 0}));
            stand.steps(1);
            touched += stand.report().plant_contact_count > 0;
            must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
            for (size_t a = 0; a < capsules.size(); a++)
                for (size_t b = 0; b < capsules.size(); b++)
                    if (organs[a] == 1 && organs[b] == 2 && capsules[a].begin.y > HIGH && capsules[b].begin.y > HIGH)
                        least = std::min(least, distance_of(capsules[a], capsules[b]));
        }
        EXPECT_EQ(touched > 0, with_contact);
        return least;
    };
    EXPECT_GT(closest(true), 0.75 * 2 * RADIUS);
    EXPECT_LT(closest(false), 0.4 * 2 * RADIUS);
}

}  // namespace self_contact_tests
