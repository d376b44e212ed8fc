// Pairs of boxes by a table of buckets: boxes come in, pairs that overlap go out (Teschner, Heidelberger, Mueller,
// Pomeranets, Gross 2003, "Optimized Spatial Hashing for Collision Detection of Deformable Objects"): first pass items,
// second pass queries; cells of many places share a bucket.
#include <algorithm>
#include <cmath>
#include <utility>

#include "collide/hash.hpp"

namespace frond {

static size_t bucket_of(int64_t x, int64_t y, int64_t z, size_t table_size) {
    const uint64_t hash = (uint64_t(x) * 73856093u) ^ (uint64_t(y) * 19349663u) ^ (uint64_t(z) * 83492791u);
    return size_t(hash % table_size);
}

// Rounding is monotone: a point within a box is in a cell within the box's cells. Distant places end in the last ones.
static int64_t cell_at(double place, double cell_size) {
    constexpr double FARTHEST = 1e15;  // [cells], exact in a double and an int64_t
    if (!std::isfinite(cell_size)) return 0;
    return int64_t(std::clamp(std::floor(place / cell_size), -FARTHEST, FARTHEST));
}

// Calls visit(bucket) for each cell that a box touches.
template <class Visit>
static void visit_buckets(const BoxSet::Bounds& box, double cell_size, size_t table_size, Visit&& visit) {
    int64_t low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = cell_at(box.lower[k], cell_size);
        high[k] = cell_at(box.upper[k], cell_size);
    }
    for (int64_t z = low[2]; z <= high[2]; ++z)
        for (int64_t y = low[1]; y <= high[1]; ++y)
            for (int64_t x = low[0]; x <= high[0]; ++x) visit(bucket_of(x, y, z, table_size));
}

static size_t bucket_of_pair(const BoxSet::Bounds& a, const BoxSet::Bounds& b, double cell_size, size_t table_size) {
    const auto first = [&](int k) { return cell_at(std::max(a.lower[k], b.lower[k]), cell_size); };
    return bucket_of(first(0), first(1), first(2), table_size);
}

void find_pairs_by_table(const BoxSet& items, const BoxSet& queries, int wanted_size, double cell_size,
                         HashMemory& memory, std::vector<std::array<int, 2>>& out) {
    cell_size = bearable_cell_size(items, queries, cell_size);
    const size_t table_size = wanted_size > 0 ? size_t(wanted_size) : 2 * items.boxes.size() + 1;

    // First pass: items, in linked lists from buckets, once in each.
    std::vector<int>& first = memory.start;
    first.assign(table_size, -1);
    memory.items.clear();
    memory.next.clear();
    for (size_t i = 0; i < items.boxes.size(); ++i)
        visit_buckets(items.boxes[i], cell_size, table_size, [&](size_t bucket) {
            if (first[bucket] >= 0 && memory.items[size_t(first[bucket])] == int(i)) return;
            memory.next.push_back(first[bucket]);
            first[bucket] = int(memory.items.size());
            memory.items.push_back(int(i));
        });

    // Second pass: queries, each once in a bucket, report pairs in the bucket of the pair's first cell.
    std::vector<int>& last = memory.owner;
    last.assign(table_size, -1);
    for (size_t q = 0; q < queries.boxes.size(); ++q)
        visit_buckets(queries.boxes[q], cell_size, table_size, [&](size_t bucket) {
            if (std::exchange(last[bucket], int(q)) == int(q)) return;
            for (int k = first[bucket]; k >= 0; k = memory.next[size_t(k)]) {
                const int item = memory.items[size_t(k)];
                const BoxSet::Bounds &a = items.boxes[size_t(item)], &b = queries.boxes[q];
                if (boxes_meet(a, b) && bucket_of_pair(a, b, cell_size, table_size) == bucket)
                    out.push_back({item, int(q)});
            }
        });
}

}  // namespace frond
