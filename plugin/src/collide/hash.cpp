// The table of layouts: one row for each frond_hash_layout; the brute-force search is short and stands here.
#include "collide/hash.hpp"

#include <cmath>

namespace frond {

static double cells_of(const BoxSet& set, double cells_per_metre) {
    double sum = 0;
    for (const BoxSet::Bounds& box : set.boxes) {
        double cells = 1;
        for (int k = 0; k < 3; ++k) cells *= (box.upper[k] - box.lower[k]) * cells_per_metre + 1;
        sum += cells;
    }
    return sum;
}

double bearable_cell_size(const BoxSet& items, const BoxSet& queries, double cell_size) {
    constexpr double MOST = 128;  // cells a box in the mean, which bounds memory and time [-]
    const double most = MOST * double(items.boxes.size() + queries.boxes.size());
    while (std::isfinite(cell_size) && !(cells_of(items, 1 / cell_size) + cells_of(queries, 1 / cell_size) <= most))
        cell_size *= 2;
    return cell_size;
}

const HashRow& hash_row(frond_hash_layout layout) {
    static const HashRow TABLE[] = {
        {"grid", cull_by_grid, find_pairs_by_grid},
        {"paper", nullptr, find_pairs_by_table},
        {"brute_force", nullptr, find_pairs_by_trying},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_HASH_LAYOUT_COUNT, "every layout needs its row");
    return TABLE[layout];
}

void find_pairs_by_trying(const BoxSet& items, const BoxSet& queries, int, double, HashMemory&,
                          std::vector<std::array<int, 2>>& out) {
    for (size_t q = 0; q < queries.boxes.size(); ++q)
        for (size_t i = 0; i < items.boxes.size(); ++i)
            if (boxes_meet(items.boxes[i], queries.boxes[q])) out.push_back({int(i), int(q)});
}

}  // namespace frond
