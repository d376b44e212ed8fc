// The same plants drawn otherwise weigh the same, and their tips bend as far.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "calibration/sway_frequency.hpp"
#include "changes.hpp"
#include "core/error.hpp"
#include "corpus.hpp"
#include "modelling/build.hpp"
#include "support/model_def.hpp"

namespace frond::test {

struct Measures {
    double mass = 0;  // [kg]
    double tip = 0;   // how far its weight, applied sideways, bends the first sway, over the height [-]
};

static Measures measure(Surface surface) {
    const frond_model_def def = model_def();
    const auto model = build_from_surface(std::move(surface), def);
    const double omega = 2 * M_PI * sway_frequency(model);
    return {model->mass(), 9.81 / (omega * omega) / model->surface.height()};
}

static std::map<std::string, Measures> as_drawn;  // by file, once it was measured

class Alike : public testing::TestWithParam<int> {};

TEST_P(Alike, WeighAndBendTheSame) {
    constexpr double NEAR = 0.05;
    const Variant& one = variants()[size_t(GetParam())];
    int count = 0, right = 0;
    for (const Row& row : read_seen()) {
        if (!is_wanted(row)) continue;
        const Surface surface = load(row, false);
        Surface changed = surface;
        std::mt19937 random(7);
        one.change(changed, random);
        // As it is, it is another file's: in metres, y up, whatever the unit and the axes of this one are.
        changed.up = Vec3::UnitY();
        changed.scale = 1;
        changed.placed = false;
        const auto known = as_drawn.find(row.file);
        const Measures before = known == as_drawn.end() ? measure(surface) : known->second, after = measure(changed);
        as_drawn.emplace(row.file, before);
        const bool weighs = std::abs(after.mass - before.mass) < NEAR * before.mass,
                   bends = std::abs(after.tip - before.tip) < NEAR * std::max(1.0, before.tip);
        std::printf("%-28s %-9.3g -> %-9.3g kg, tip %-8.2g -> %-8.2g %s%s\n", row.file.c_str(), before.mass, after.mass,
                    before.tip, after.tip, weighs ? "" : "W", bends ? "" : "T");
        count++;
        right += weighs && bends;
    }
    std::printf("%s: mass and tip within 5 %% in %d of %d files\n", one.name, right, count);
    EXPECT_GE(right, one.alike * count);
}

INSTANTIATE_TEST_SUITE_P(Corpus, Alike, testing::Range(0, int(variants().size())),
                         [](const auto& info) { return std::string(variants()[size_t(info.param)].name); });

}  // namespace frond::test
