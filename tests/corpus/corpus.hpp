// What a person sees in the files of the corpus, and what Frond finds in them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "skeleton/chain.hpp"

namespace frond::test {

// Kinds of organs as a person counts them; petioles and ribs are not counted.
enum Seen { LEAVES, STEMS, SOLIDS, FLOWERS, CROWNS, SUPPORTS, SEEN_COUNT };

struct Row {
    std::string file;
    std::array<std::array<int, 2>, SEEN_COUNT> counts;  // fewest and most
    double height, mass;                                // [m], [kg]
};

// Reads tests/corpus/seen.csv.
std::vector<Row> read_seen();
// FROND_CORPUS=Corn leaves only files with that in their names to the long tests, and prints their organs.
bool is_wanted(const Row& row);
std::string path_of(const Row& row);

struct Found {
    std::array<int, SEEN_COUNT> counts = {};
    double root = 0;  // height of the highest root above the lowest point, as a share of the height
    double ms = 0;    // time for organs [ms]
};

// Loads a file: as it is, or bare, as one part without a name, a material or a colour.
Surface load(const Row& row, bool bare);
// Finds the organs of a file's surface.
Found find(const Row& row, Surface surface);

// Organs of a kind are right as far as their number is: the smaller of what is seen and found, and the larger.
struct Score {
    int right = 0, all = 0;
    bool leaves = true;  // their number is right within 20 %
};
Score compare(const Row& row, const std::array<int, SEEN_COUNT>& counts);

}  // namespace frond::test
