// Weights of plants that nobody tuned to, and how much stiffer than their materials they were made.
#include <gtest/gtest.h>

#include <cstdio>

#include "corpus.hpp"
#include "modelling/build.hpp"
#include "support/model_def.hpp"

namespace frond::test {

TEST(Corpus, PlantsHaveTheirWeightAndCarryThemselves) {
    constexpr double FACTOR = 3;
    int right = 0, carried = 0, count = 0;
    std::printf("%-28s kg      seen    stiffer  organs  ms\n", "");
    frond_model_def def = model_def();
    def.scale = 0;
    def.up = {0, 0, 0};
    for (const Row& row : read_seen()) {
        const auto model = build_from_file(path_of(row), def);
        const double mass = model->mass(), ratio = mass / row.mass;
        const bool is_right = ratio < FACTOR && ratio > 1 / FACTOR, is_carried = model->stiffening_factor <= FACTOR;
        std::printf("%-28s %-7.3g %-7.3g %-8.3g %-6zu %5.0f %s%s\n", row.file.c_str(), mass, row.mass,
                    model->stiffening_factor, model->organs.size(), model->ms_total, is_right ? " " : "W",
                    is_carried ? " " : "S");
        std::fflush(stdout);
        right += is_right;
        carried += is_carried;
        count++;
    }
    std::printf("weight right within %g times in %.3f of files, stiffer by no more than %g in %.3f\n", FACTOR,
                double(right) / count, FACTOR, double(carried) / count);
    EXPECT_GT(right, 0.9 * count);
    EXPECT_GT(carried, 0.85 * count);
}

// A petiole may weigh next to nothing and carry a leaf; this one is drawn to a point.
TEST(Corpus, NoOrganThatCarriesOthersIsStiffenedInSilence) {
    frond_model_def def = model_def();
    def.scale = 0;
    def.up = {0, 0, 0};
    const auto model = build_from_file(path_of({"cropcraft/bean_medium.obj", {}, 0, 0}), def);
    for (size_t o = 0; o < model->organs.size(); o++)
        EXPECT_LE(model->organ_stiffer[o], model->stiffening_factor) << model->organs[o].name;
    EXPECT_LT(model->stiffening_factor, 3);
}

}  // namespace frond::test
