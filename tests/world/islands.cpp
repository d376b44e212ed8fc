// Contact islands are answered each by itself: what happens in one changes no number of another.
#include <gtest/gtest.h>

#include "support/stand.hpp"

namespace frond::test {
namespace islands_tests {

// Two corn plants that come at each other, and, if asked, two more far away, that come faster and miss more contacts.
struct Pairs : Stand {
    Pairs(frond_mechanics mechanics, bool with_others) {
        load_corn();
        add_pair(mechanics, 0, 1.5);
        if (with_others) add_pair(mechanics, 40, 9);
    }
    void add_pair(frond_mechanics mechanics, double at, double speed) {
        frond_plant_def def = plant_def();
        def.mechanics = mechanics;
        throw_plant(add(def, {at - 0.3, 0, 0}), {speed, 0, 0});
        throw_plant(add(def, {at + 0.3, 0, 0.05}, 0.4), {-speed, 0, 0});
    }
};

struct Islands : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Mechanics, Islands, testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD),
                         [](const auto& info) { return frond_mechanics_name(info.param); });

TEST_P(Islands, DoNotChangeEachOther) {
    Pairs alone(GetParam(), false), beside(GetParam(), true);
    int contacts = 0;
    for (int i = 0; i < 40; i++) {
        alone.steps(1);
        beside.steps(1);
        contacts += alone.report().plant_contact_count;
        for (size_t k = 0; k < 2; k++)
            ASSERT_EQ(alone.places(alone.plants[k]), beside.places(beside.plants[k]))
                << "plant " << k << ", step " << i;
    }
    EXPECT_GT(contacts, 40);
}

}  // namespace islands_tests
}  // namespace frond::test
