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
        const Found found = find(row, bare);
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
    EXPECT_GT(total.kinds, 0.8);
    EXPECT_GT(total.leaves, 0.8);
    EXPECT_GT(total.feet, 0.9);
}

TEST(Corpus, OrgansAreToldByShapeAlone) {
    const Total total = print_table(true);
    EXPECT_GT(total.kinds, 0.75);
    EXPECT_GT(total.leaves, 0.7);
    EXPECT_GT(total.feet, 0.9);
}

// Leaves and stems of a plant of Frond's own without its names; silk and tassel are not told from leaves by their
// shape.
TEST(Corpus, CornHasItsLeavesWithoutNames) {
    const Row row = {"../../models/corn/corn.obj", {}, 0, 0};
    const Found named = find(row, false), bare = find(row, true);
    EXPECT_EQ(named.counts[LEAVES], 11);
    EXPECT_GE(bare.counts[LEAVES], 11);
    EXPECT_LE(bare.counts[LEAVES], 30);
    EXPECT_EQ(bare.counts[STEMS], 1);
}

}  // namespace frond::test
