// Hash: finds overlapping boxes by cells of space. The layouts are rows of a table; all of them, brute force too,
// always give the same pairs.
#pragma once

#include <cmath>

#include "core/types.hpp"
#include "frond/frond.h"

namespace frond {

struct HashSettings {
    frond_hash_layout layout = FROND_HASH_LAYOUT_GRID;
    int table_size = 0;    // n, buckets of FROND_HASH_LAYOUT_PAPER; 0 chooses
    double cell_size = 0;  // l [m]; 0 chooses one and a half mean edges. Never below an eighth of the mean edge
};

// Boxes of one group are not paired with each other.
struct BoxSet {
    struct Bounds {
        double lower[3], upper[3];  // [m]
        int group;
    };
    // Returns the box around nothing.
    static Bounds none() { return {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0}; }
    std::vector<Bounds> boxes;
};

// Memory that is kept between searches.
struct HashMemory {
    std::vector<std::array<int, 2>> entries;  // a cell or bucket, and an item in it
    std::vector<int> owner, start, items, next;
};

// Adds pairs (item, query) of boxes that overlap or touch and are of different groups, each once, in any order.
struct HashRow {
    const char* name;
    // Drops boxes (0 in `kept`) that have none of another owner near them, though not all such; null: drops none.
    void (*cull)(const BoxSet& boxes, const std::vector<int>& owner, double cell_size, HashMemory& memory,
                 std::vector<uint8_t>& kept);
    void (*find)(const BoxSet& items, const BoxSet& queries, int table_size, double cell_size, HashMemory& memory,
                 std::vector<std::array<int, 2>>& out);
};
const HashRow& hash_row(frond_hash_layout layout);

// Returns a cell size so large that boxes touch little more than a hundred cells on average; infinite for infinite
// boxes.
double bearable_cell_size(const BoxSet& items, const BoxSet& queries, double cell_size);

// The rows.
void cull_by_grid(const BoxSet& boxes, const std::vector<int>& owner, double cell_size, HashMemory& memory,
                  std::vector<uint8_t>& kept);
void find_pairs_by_grid(const BoxSet& items, const BoxSet& queries, int table_size, double cell_size,
                        HashMemory& memory, std::vector<std::array<int, 2>>& out);
void find_pairs_by_table(const BoxSet& items, const BoxSet& queries, int table_size, double cell_size,
                         HashMemory& memory, std::vector<std::array<int, 2>>& out);
void find_pairs_by_trying(const BoxSet& items, const BoxSet& queries, int table_size, double cell_size,
                          HashMemory& memory, std::vector<std::array<int, 2>>& out);

inline bool boxes_meet(const BoxSet::Bounds& a, const BoxSet::Bounds& b) {
    return a.group != b.group && a.lower[0] <= b.upper[0] && b.lower[0] <= a.upper[0] && a.lower[1] <= b.upper[1] &&
           b.lower[1] <= a.upper[1] && a.lower[2] <= b.upper[2] && b.lower[2] <= a.upper[2];
}

}  // namespace frond
