// Every layout of the hash finds the pairs that brute force finds, with any cell size and table size.
#include "collide/hash.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "collide/sweep.hpp"
#include "core/lanes.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace hash_tests {

using Pairs = std::vector<std::array<int, 2>>;

Pairs pairs_of(frond_hash_layout layout, const BoxSet& items, const BoxSet& queries, int table_size, double cell_size) {
    HashMemory memory;
    Pairs pairs;
    // Run twice, so that leftovers in reused memory would show.
    for (int n = 0; n < 2; ++n) {
        pairs.clear();
        hash_row(layout).find(items, queries, table_size, cell_size, memory, pairs);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

BoxSet random_boxes(Dice& dice, int count, double extent, double size, int groups) {
    BoxSet set;
    for (int n = 0; n < count; ++n) {
        BoxSet::Bounds box;
        for (int k = 0; k < 3; ++k) {
            box.lower[k] = dice.uniform(-extent, extent);
            box.upper[k] = box.lower[k] + dice.uniform(0, size);
        }
        box.group = int(dice.uniform(0, groups));
        set.boxes.push_back(box);
    }
    return set;
}

TEST(Hash, EveryLayoutFindsThePairsThatTryingFinds) {
    Dice dice(1);
    size_t found = 0;
    for (int n = 0; n < 8; ++n) {
        const double shift = n % 4 == 3 ? 1e4 : 0;
        BoxSet items = random_boxes(dice, 200, 1, n % 2 ? 0 : 0.3, 3), queries = random_boxes(dice, 200, 1.2, 0.4, 3);
        for (BoxSet* set : {&items, &queries})
            for (BoxSet::Bounds& box : set->boxes) {
                box.lower[1] += shift;
                box.upper[1] += shift;
            }
        const Pairs expected = pairs_of(FROND_HASH_LAYOUT_BRUTE_FORCE, items, queries, 0, 0.1);
        found += expected.size();
        for (int layout = 0; layout < FROND_HASH_LAYOUT_COUNT; ++layout)
            for (const double cell_size : {0.1, 0.37, 10.0})
                for (const int table_size : {0, 97, 10007})
                    EXPECT_EQ(pairs_of(frond_hash_layout(layout), items, queries, table_size, cell_size), expected)
                        << hash_row(frond_hash_layout(layout)).name << ", cells of " << cell_size << ", table of "
                        << table_size;
        EXPECT_EQ(pairs_of(FROND_HASH_LAYOUT_PAPER, items, queries, 1, 10), expected);
    }
    EXPECT_GT(found, 300u);
}

TEST(Hash, BoxesThatTouchAreAPairAndThoseOfAGroupAreNot) {
    for (int layout = 0; layout < FROND_HASH_LAYOUT_COUNT; ++layout) {
        const BoxSet items = {{{{0, 0, 0}, {1, 1, 1}, 0}, {{0, 0, 0}, {1, 1, 1}, 1}}};
        const BoxSet queries = {{{{1, 1, 1}, {2, 2, 2}, 1}, {{1.1, 0, 0}, {2, 1, 1}, 5}}};
        EXPECT_EQ(pairs_of(frond_hash_layout(layout), items, queries, 0, 0.25), (Pairs{{0, 0}}));
        EXPECT_TRUE(pairs_of(frond_hash_layout(layout), items, {}, 0, 0.25).empty());
        EXPECT_TRUE(pairs_of(frond_hash_layout(layout), {}, queries, 0, 0.25).empty());
    }
}

// Boxes as far apart as doubles reach, and beyond.
TEST(Hash, EveryLayoutTakesBoxesWhoseWayApartIsNoNumber) {
    const double far = 1.7e308;
    for (const double farthest : {1e18, far, double(INFINITY)}) {
        const BoxSet items = {{{{-farthest, 0, 0}, {farthest, 1, 1}, 0}, {{0, 0, 0}, {1, 1, 1}, 1}}};
        const BoxSet queries = {{{{-farthest, 0, 0}, {farthest, 1, 1}, 5}, {{0, 5, 0}, {1, 6, 1}, 6}}};
        const Pairs expected = pairs_of(FROND_HASH_LAYOUT_BRUTE_FORCE, items, queries, 0, 0.25);
        EXPECT_EQ(pairs_of(FROND_HASH_LAYOUT_GRID, items, queries, 0, 0.25), expected);
        EXPECT_EQ(pairs_of(FROND_HASH_LAYOUT_PAPER, items, queries, 0, 0.25), expected);
        EXPECT_EQ(expected.size(), 2u);
    }
}

// Cells are made larger then: boxes that are thousands of cells wide would take minutes.
TEST(Hash, BoxesOfAPlantThatIsDrawnOutToAThousandTimesItsSizeAreFoundInAWhile) {
    Dice dice(2);
    const BoxSet items = random_boxes(dice, 1500, 1e3, 1e3, 2), queries = random_boxes(dice, 1500, 1e3, 1e3, 2);
    const Pairs expected = pairs_of(FROND_HASH_LAYOUT_BRUTE_FORCE, items, queries, 0, 0.1);
    EXPECT_GT(expected.size(), 10000u);
    for (const frond_hash_layout layout : {FROND_HASH_LAYOUT_GRID, FROND_HASH_LAYOUT_PAPER}) {
        const auto start = std::chrono::steady_clock::now();
        EXPECT_EQ(pairs_of(layout, items, queries, 0, 0.1), expected);
        EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10)
            << hash_row(layout).name;
    }
}

// A pair is reported once, however many cells and buckets its boxes share.
TEST(Hash, ATableOfOneBucketTellsEachPairOnce) {
    Dice dice(3);
    const BoxSet items = random_boxes(dice, 50, 1, 1, 2), queries = random_boxes(dice, 50, 1, 1, 2);
    const Pairs expected = pairs_of(FROND_HASH_LAYOUT_BRUTE_FORCE, items, queries, 0, 0.3);
    for (const int table_size : {1, 7, 1009}) {
        HashMemory memory;
        Pairs pairs;
        find_pairs_by_table(items, queries, table_size, 0.3, memory, pairs);
        EXPECT_EQ(pairs.size(), expected.size()) << table_size;
    }
}

// In lanes of any width, with boxes that reach to infinity and one whose ends are no numbers.
TEST(Hash, TheSweepFindsThePairsThatTryingFinds) {
    Dice dice(4);
    const int most = most_lanes();
    for (int n = 0; n < 40; ++n) {
        BoxSet set = random_boxes(dice, int(dice.uniform(0, 60)), 1, n % 2 ? 0.5 : 0.1, 4);
        set.boxes.push_back({{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}, 9});
        set.boxes.push_back({{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 10});
        Pairs expected;
        for (int a = 0; a < int(set.boxes.size()); ++a)
            for (int b = a + 1; b < int(set.boxes.size()); ++b)
                if (boxes_meet(set.boxes[size_t(a)], set.boxes[size_t(b)])) expected.push_back({a, b});
        for (const int lanes : {2, most}) {
            most_lanes() = lanes;
            EXPECT_EQ(find_pairs_by_sweep(set), expected);
        }
        most_lanes() = most;
    }
}

}  // namespace hash_tests

}  // namespace frond::test
