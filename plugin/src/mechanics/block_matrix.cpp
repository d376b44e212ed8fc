// In: pairs of nodes that share an element. Out: the pattern of their 3x3 blocks, and products with such a matrix.
#include "mechanics/block_matrix.hpp"

#include <algorithm>

#include "core/assert.hpp"
#include "core/lanes.hpp"
#include "core/lists.hpp"

namespace frond {

int BlockPattern::slot(int i, int j) const {
    FROND_ASSERT(i >= 0 && j >= 0 && i < node_count && j < node_count);
    if (i < j) std::swap(i, j);
    const auto begin = row.begin() + start[size_t(j)], end = row.begin() + start[size_t(j) + 1];
    const auto found = std::lower_bound(begin, end, i);
    return found != end && *found == i ? int(found - row.begin()) : -1;
}

template <size_t N>
BlockPattern make_block_pattern(int node_count, const std::vector<std::array<int, N>>& elements) {
    // Each node's neighbours of higher index, itself first, sorted and without duplicates.
    std::vector<std::vector<int>> neighbours(static_cast<size_t>(node_count));
    for (int j = 0; j < node_count; ++j) neighbours[size_t(j)].push_back(j);
    for (const auto& element : elements)
        for (int i : element)
            for (int j : element)
                if (i > j) neighbours[size_t(j)].push_back(i);

    BlockPattern pattern;
    pattern.node_count = node_count;
    pattern.start.push_back(0);
    for (auto& rows : neighbours) {
        sort_unique(rows);
        pattern.row.insert(pattern.row.end(), rows.begin(), rows.end());
        pattern.start.push_back(int(pattern.row.size()));
    }
    return pattern;
}
template BlockPattern make_block_pattern(int, const std::vector<std::array<int, 4>>&);
template BlockPattern make_block_pattern(int, const std::vector<std::array<int, 10>>&);

void BlockMatrix::set_pattern(const BlockPattern& new_pattern) {
    pattern = &new_pattern;
    values.resize(9 * new_pattern.row.size());
}

void BlockMatrix::set_zero() {
    std::fill(values.begin(), values.end(), 0.0);
}

// Takes two rows of a block at once and the third by itself.
void BlockMatrix::multiply(const VecX& x, VecX& y) const {
    FROND_ASSERT(pattern && x.size() == 3 * pattern->node_count);
    FROND_ASSERT(values.size() == 9 * pattern->row.size());
    y.setZero(x.size());
    const double* a = values.data();
    for (int j = 0; j < pattern->node_count; ++j) {
        const double *xj = x.data() + 3 * j, x0 = xj[0], x1 = xj[1], x2 = xj[2];
        // The diagonal block, which comes first in its column.
        TwoLanes own = x0 * load<TwoLanes>(a) + x1 * load<TwoLanes>(a + 3) + x2 * load<TwoLanes>(a + 6);
        double own2 = a[2] * x0 + a[5] * x1 + a[8] * x2;
        a += 9;
        // Each block below it is used twice: as stored for its row, transposed for this column.
        TwoLanes sum0 = {}, sum1 = {}, sum2 = {};
        for (int k = pattern->start[size_t(j)] + 1; k < pattern->start[size_t(j) + 1]; ++k, a += 9) {
            const int i = 3 * pattern->row[size_t(k)];
            const TwoLanes a0 = load<TwoLanes>(a), a1 = load<TwoLanes>(a + 3), a2 = load<TwoLanes>(a + 6);
            double* yi = y.data() + i;
            store(TwoLanes(load<TwoLanes>(yi) + (x0 * a0 + x1 * a1 + x2 * a2)), yi);
            yi[2] += a[2] * x0 + a[5] * x1 + a[8] * x2;
            const double* xi = x.data() + i;
            const TwoLanes xi01 = load<TwoLanes>(xi);
            sum0 += a0 * xi01;
            sum1 += a1 * xi01;
            sum2 += a2 * xi01;
            own += TwoLanes{a[2], a[5]} * xi[2];
            own2 += a[8] * xi[2];
        }
        own += TwoLanes{sum0[0] + sum0[1], sum1[0] + sum1[1]};
        double* yj = y.data() + 3 * j;
        store(TwoLanes(load<TwoLanes>(yj) + own), yj);
        yj[2] += own2 + (sum2[0] + sum2[1]);
    }
}

}  // namespace frond
