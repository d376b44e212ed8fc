// Plants created where another one stands: they part, except for their feet.
#include <algorithm>
#include <vector>

#include "support/stems.hpp"

namespace one_place_tests {

struct OnePlace : testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Plants, OnePlace, testing::Range(0, int(FROND_MECHANICS_COUNT)), [](const auto& info) {
    return std::string(frond_mechanics_name(frond_mechanics(info.param)));
});

// Returns the largest contact depth above a height [m].
double depth_above(frond_plant plant, double height) {
    std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
    EXPECT_EQ(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())), FROND_OK);
    double depth = 0;
    for (const frond_contact& contact : contacts)
        if (contact.point.y > height) depth = std::max(depth, -contact.gap);
    return depth;
}

// The second plant is 1 cm beside the first, or in the same place, where no direction of separation is preferred.
TEST_P(OnePlace, LetsPlantsPartAboveTheirFeet) {
    constexpr double DEPTH = 0.005;  // [m]
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = frond_mechanics(GetParam());
    struct Placing {
        frond_vec3 second;
        double h, duration, feet;  // [s], [s], [m]
    };
    for (const auto& [place, h, duration, feet] :
         {Placing{{0.01, 0, 0.003}, 1.0 / 60, 3, 0.2}, Placing{{0, 0, 0}, 1.0 / 240, 3, 0.3}}) {
        def.position = {0, 0, 0};
        SmallWorld small(def, 0, FROND_REST_STANDS_AS_MODELLED);
        def.position = place;
        frond_plant second = {};
        ASSERT_EQ(frond_plant_create(small.world, small.model, &def, &second), FROND_OK) << frond_last_error();
        ASSERT_EQ(frond_world_step(small.world, h), FROND_OK);
        EXPECT_GT(depth_above(small.plant, feet), 2 * DEPTH);
        for (int i = 0; i < int(duration / h + 0.5); i++) ASSERT_EQ(frond_world_step(small.world, h), FROND_OK);
        EXPECT_LT(depth_above(small.plant, feet), DEPTH) << "at " << place.x << " m, " << h << " s";
        frond_report report;
        ASSERT_EQ(frond_world_get_report(small.world, &report), FROND_OK);
        EXPECT_EQ(report.trouble & FROND_TROUBLE_REWOUND, 0u);
    }
}

}  // namespace one_place_tests
