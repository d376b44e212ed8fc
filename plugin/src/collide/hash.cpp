// The table of layouts: one row for each frond_hash_layout; the twin that tries every pair is short enough to stand here.
#include "collide/hash.hpp"

namespace frond {

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
