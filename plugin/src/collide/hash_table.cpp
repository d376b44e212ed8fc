// Pairs of boxes by a table of buckets: boxes come in, pairs that overlap go out (Teschner, Heidelberger, Mueller,
// Pomeranets, Gross 2003, "Optimized Spatial Hashing for Collision Detection of Deformable Objects"): first pass items,
// second pass queries; cells of many places share a bucket, so that pairs may come several times.
#include <algorithm>
#include <cmath>

#include "collide/hash.hpp"

namespace frond {

static size_t bucket_of(int64_t x, int64_t y, int64_t z, size_t table_size) {
    const uint64_t hash = (uint64_t(x) * 73856093u) ^ (uint64_t(y) * 19349663u) ^ (uint64_t(z) * 83492791u);
    return size_t(hash % table_size);
}

// Calls visit(bucket) for each cell that a box touches.
template <class Visit>
static void visit_buckets(const BoxSet::Bounds& box, double cell_size, size_t table_size, Visit&& visit) {
    int64_t low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = int64_t(std::floor(box.lower[k] / cell_size));
        high[k] = int64_t(std::floor(box.upper[k] / cell_size));
    }
    for (int64_t z = low[2]; z <= high[2]; ++z)
        for (int64_t y = low[1]; y <= high[1]; ++y)
            for (int64_t x = low[0]; x <= high[0]; ++x) visit(bucket_of(x, y, z, table_size));
}

void find_pairs_by_table(const BoxSet& items, const BoxSet& queries, int wanted_size, double cell_size,
                         HashMemory& memory, std::vector<std::array<int, 2>>& out) {
    const size_t table_size = wanted_size > 0 ? size_t(wanted_size) : 2 * items.boxes.size() + 1;

    // First pass: items, as chains from buckets.
    std::vector<int>& first = memory.start;
    first.assign(table_size, -1);
    memory.items.clear();
    memory.next.clear();
    for (size_t i = 0; i < items.boxes.size(); ++i)
        visit_buckets(items.boxes[i], cell_size, table_size, [&](size_t bucket) {
            memory.next.push_back(first[bucket]);
            first[bucket] = int(memory.items.size());
            memory.items.push_back(int(i));
        });

    // Second pass: queries.
    for (size_t q = 0; q < queries.boxes.size(); ++q)
        visit_buckets(queries.boxes[q], cell_size, table_size, [&](size_t bucket) {
            for (int k = first[bucket]; k >= 0; k = memory.next[size_t(k)]) {
                const int item = memory.items[size_t(k)];
                if (boxes_meet(items.boxes[size_t(item)], queries.boxes[q])) out.push_back({item, int(q)});
            }
        });
}

}  // namespace frond
