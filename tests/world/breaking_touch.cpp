// What came off touches what is left, and other plants; what is left goes on touching.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/stems.hpp"

namespace breaking_touch_tests {

constexpr double H = 1.0 / 120;

struct Broken : testing::TestWithParam<frond_mechanics> {
    frond_world world = {};
    std::vector<frond_model> models;
    Broken() {
        const frond_world_def def = frond_default_world_def();
        EXPECT_EQ(frond_world_create(&def, &world), FROND_OK);
    }
    ~Broken() override {
        frond_world_destroy(world);
        for (const frond_model model : models) frond_model_destroy(model);
    }
    frond_plant add(const std::vector<frond_stem>& stems, double x) {
        models.push_back(make_stems(stems.data(), int(stems.size()), 1e9, FROND_REST_STANDS_AS_MODELLED));
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = GetParam();
        def.effects |= FROND_EFFECT_BREAKING;
        def.position = {x, 0, 0};
        frond_plant plant = {};
        EXPECT_EQ(frond_plant_create(world, models.back(), &def, &plant), FROND_OK) << frond_last_error();
        return plant;
    }
    void step(int count) const {
        for (int i = 0; i < count; i++) ASSERT_EQ(frond_world_step(world, H), FROND_OK) << frond_last_error();
    }
    // Returns the capsule whose middle is nearest to a point.
    int capsule_at(frond_plant plant, double x, double y) const {
        std::vector<frond_capsule> all(size_t(frond_plant_get_capsule_count(plant)));
        EXPECT_EQ(frond_plant_get_capsules(plant, all.data(), int(all.size())), FROND_OK);
        int nearest = -1;
        double least = INFINITY;
        for (size_t i = 0; i < all.size(); i++) {
            const double away =
                std::hypot(0.5 * (all[i].begin.x + all[i].end.x) - x, 0.5 * (all[i].begin.y + all[i].end.y) - y);
            if (away < least) nearest = int(i);
            least = std::min(least, away);
        }
        return nearest;
    }
    double height_of_fragment(frond_plant plant) const {
        frond_fragment fragment = {};
        EXPECT_EQ(frond_plant_get_fragment(plant, 0, &fragment), FROND_OK) << frond_last_error();
        frond_rigid_state state = {};
        EXPECT_EQ(frond_rigid_get_state(fragment.rigid, &state), FROND_OK);
        return state.position.y;
    }
};
INSTANTIATE_TEST_SUITE_P(Breaking, Broken, testing::Values(FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL),
                         [](const auto& info) { return frond_mechanics_name(info.param); });

// A branch of a trellis breaks off and comes to lie on the two below it.
TEST_P(Broken, BranchLiesOnThoseBelowIt) {
    const frond_plant plant = add({{-1, {0, 0, 0}, {0, 0.5, 0}, 0.02, 0.02},
                                   {0, {0, 0.25, 0}, {0.3, 0.25, 0.12}, 0.01, 0.01},
                                   {0, {0, 0.25, 0}, {0.3, 0.25, -0.12}, 0.01, 0.01},
                                   {0, {0, 0.5, 0}, {0.15, 0.5, 0}, 0.01, 0.01},
                                   {3, {0.15, 0.5, 0}, {0.15, 0.5, 0.15}, 0.01, 0.01},
                                   {3, {0.15, 0.5, 0}, {0.15, 0.5, -0.15}, 0.01, 0.01}},
                                  0);
    step(2);
    ASSERT_EQ(frond_plant_break(plant, capsule_at(plant, 0.05, 0.5)), FROND_OK) << frond_last_error();
    const double before = height_of_fragment(plant);
    EXPECT_NEAR(before, 0.5, 0.02);
    step(120);
    EXPECT_GT(height_of_fragment(plant), 0.2);
    EXPECT_LT(height_of_fragment(plant), 0.35);
}

// A stem with a cross bar, whose tip came off, still stops its neighbour, which is pulled against the bar.
TEST_P(Broken, StemStopsItsNeighbour) {
    const std::vector<frond_stem> stem = {{-1, {0, 0, 0}, {0, 0.6, 0}, 0.01, 0.01}};
    const frond_plant broken = add({{-1, {0, 0, 0}, {0, 0.6, 0}, 0.01, 0.01},
                                    {0, {0, 0.4, 0}, {0, 0.4, 0.15}, 0.01, 0.01},
                                    {0, {0, 0.4, 0}, {0, 0.4, -0.15}, 0.01, 0.01}},
                                   0),
                      pulled = add(stem, 0.06);
    step(2);
    ASSERT_EQ(frond_plant_break(broken, capsule_at(broken, 0, 0.58)), FROND_OK) << frond_last_error();
    frond_grab grab = {};
    ASSERT_EQ(frond_grab_create(pulled, {0.06, 0.4, 0}, 200, &grab), FROND_OK) << frond_last_error();
    ASSERT_EQ(frond_grab_move(grab, {-0.06, 0.4, 0}), FROND_OK);
    int contacts = 0;
    for (int i = 0; i < 120; i++) {
        step(1);
        frond_report report = {};
        ASSERT_EQ(frond_world_get_report(world, &report), FROND_OK);
        contacts += report.plant_contact_count;
    }
    EXPECT_GT(contacts, 0);
    const auto x_at = [&](frond_plant plant) {
        std::vector<frond_capsule> all(size_t(frond_plant_get_capsule_count(plant)));
        EXPECT_EQ(frond_plant_get_capsules(plant, all.data(), int(all.size())), FROND_OK);
        double x = 0, least = INFINITY;
        for (const frond_capsule& capsule : all)
            if (std::abs(capsule.end.y - 0.4) < least) {
                least = std::abs(capsule.end.y - 0.4);
                x = capsule.end.x;
            }
        return x;
    };
    EXPECT_GT(x_at(pulled) - x_at(broken), 0.017);
    EXPECT_LT(x_at(broken), -0.005);
}

}  // namespace breaking_touch_tests
