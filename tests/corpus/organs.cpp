// Organs of plants that nobody tuned to: their kinds, numbers and roots, with names and without.
#include <gtest/gtest.h>

#include <cstdio>

#include "corpus.hpp"

namespace frond::test {

struct Total {
    double kinds = 0, leaves = 0, feet = 0;  // shares that are right
};

static Total print_table(bool bare) {
    constexpr double AT_THE_FOOT = 0.15;
    const std::vector<Row> rows = read_seen();
    Total total;
    std::printf("%-28s leaves  stems  solids flowers crowns supports  right  root   ms\n",
                bare ? "bare" : "as they are");
    for (const Row& row : rows) {
        const Found found = find(row, load(row, bare));
        const Score score = compare(row, found.counts);
        std::printf("%-28s", row.file.c_str());
        for (size_t kind = 0; kind < SEEN_COUNT; kind++) {
            const auto& [fewest, most] = row.counts[kind];
            std::printf(fewest == most ? " %3d/%d  " : " %3d/%d-%d", found.counts[kind], fewest, most);
        }
        std::printf(" %2d/%-2d %s %.2f %6.1f\n", score.right, score.all, score.leaves ? " " : "L", found.root,
                    found.ms);
        total.kinds += double(score.right) / std::max(1, score.all) / double(rows.size());
        total.leaves += double(score.leaves) / double(rows.size());
        total.feet += double(found.root < AT_THE_FOOT) / double(rows.size());
    }
    std::printf("kinds right %.3f, count of leaves right in %.3f of files, rooted at the foot %.3f\n", total.kinds,
                total.leaves, total.feet);
    return total;
}

TEST(Corpus, OrgansAreWhatAPersonSees) {
    const Total total = print_table(false);
    EXPECT_GT(total.kinds, 0.9);
    EXPECT_GT(total.leaves, 0.85);
    EXPECT_GT(total.feet, 0.9);
}

TEST(Corpus, OrgansAreToldByShapeAlone) {
    const Total total = print_table(true);
    EXPECT_GT(total.kinds, 0.9);
    EXPECT_GT(total.leaves, 0.85);
    EXPECT_GT(total.feet, 0.9);
}

// Frond's own plants without their names: silk, awns, husks, petals and tendrils are no leaves.
TEST(Corpus, OwnPlantsHaveTheirLeavesWithoutNames) {
    const struct {
        const char* file;
        int leaves, stems;
    } plants[] = {{"corn", 11, 1}, {"wheat", 15, 5}, {"sunflower", 12, 1}, {"cucumber", 20, 1}};
    for (const auto& plant : plants) {
        const std::string name = plant.file;
        const Row row = {"../../models/" + name + "/" + name + ".obj", {}, 0, 0};
        const Found bare = find(row, load(row, true));
        EXPECT_NEAR(bare.counts[LEAVES], plant.leaves, 0.2 * plant.leaves) << name;
        EXPECT_EQ(bare.counts[STEMS], plant.stems) << name;
    }
    const Row corn = {"../../models/corn/corn.obj", {}, 0, 0};
    EXPECT_EQ(find(corn, load(corn, false)).counts[LEAVES], 11);
}

}  // namespace frond::test
