// --set key=value: numbers that a scene cannot accept are reported, with the allowed range.
#include <gtest/gtest.h>

#include "scenes/scene.hpp"

using namespace frond::tools;

static std::string refusal_of(const char* assignment) {
    Settings settings;
    try {
        apply_setting(settings, assignment);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

TEST(Settings, CountsAreWholeNumbersInTheirRange) {
    EXPECT_EQ(refusal_of("threads=100000"), "threads: 100000 is not between 1 and 256");
    EXPECT_EQ(refusal_of("threads=-5"), "threads: -5 is not between 1 and 256");
    EXPECT_EQ(refusal_of("threads=1e12"), "threads: 1e12 is not between 1 and 256");
    EXPECT_EQ(refusal_of("plants=-5"), "plants: -5 is not between 0 and 100000");
    EXPECT_EQ(refusal_of("plants=1.5"), "plants: 1.5 is not a whole number");
    EXPECT_EQ(refusal_of("walkers=-1"), "walkers: -1 is not between 0 and 1000");
    EXPECT_EQ(refusal_of("detail=7"), "detail: 7 is not between 0 and 1");
    EXPECT_EQ(refusal_of("newton_iterations=1.5"), "newton_iterations: 1.5 is not a whole number");
    EXPECT_NE(refusal_of("max_substeps=1e12"), "");
}

TEST(Settings, TimesAreInTheirRange) {
    EXPECT_EQ(refusal_of("budget=-7"), "budget: -7 is not between 0 and 1000");
    EXPECT_EQ(refusal_of("dt=0"), "dt: 0 is not between 1e-06 and 1");
    EXPECT_EQ(refusal_of("dt=1.5"), "dt: 1.5 is not between 1e-06 and 1");
    EXPECT_NE(refusal_of("dt=nan"), "");
}

TEST(Settings, NumbersInRangeAreTaken) {
    Settings settings;
    for (const char* assignment : {"threads=2", "plants=100000", "walkers=0", "detail=0", "budget=1.5", "dt=0.01",
                                   "newton_iterations=3", "max_substeps=1e1"})
        apply_setting(settings, assignment);
    EXPECT_EQ(settings.threads, 2);
    EXPECT_EQ(settings.plants, 100000);
    EXPECT_EQ(settings.walkers, 0);
    EXPECT_FALSE(settings.detail);
    EXPECT_EQ(settings.budget, 1.5);
    EXPECT_EQ(settings.dt, 0.01);
    EXPECT_EQ(settings.plant.tuning.newton_iterations, 3);
    EXPECT_EQ(settings.plant.tuning.max_substeps, 10);
}
