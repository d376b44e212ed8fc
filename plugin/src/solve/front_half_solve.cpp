// In: the factor of one matrix and a right-hand side of few nodes. Out: its half-solve.
//
// A half-solve reaches only the rows of the fronts on the paths to the root (Gilbert, Peierls 1988, "Sparse partial
// pivoting in time proportional to arithmetic operations").
#include <algorithm>

#include "core/assert.hpp"
#include "core/lanes.hpp"
#include "solve/fronts.hpp"

namespace frond {

namespace {

// Eliminates a front's columns from the rows below them, and adds its own rows to the compliance.
struct TakeFront {
    const FrontPlan& plan;
    const Front& front;
    const FrontFactor& factor;
    double *sparse, *left, *right;
    // Takes three columns at a time. L is stored with zeros on and above its diagonal.
    template <class S>
    FROND_INLINE void run() const {
        const int stride = stride_of(front), own = 3 * front.own, begin_further = padded(front.own);
        const double* L = factor.columns.data() + front.columns;
        const int* rows = plan.rows.data() + front.row;
        double* mine = sparse + 4 * 3 * front.first;
        for (int k = 0; k < own; k += 3, L += 3 * stride) {
            FourLanes y[3];
            const auto rest = [&](const double* from, int row, int columns) FROND_INLINED {
                FourLanes left_over = load<FourLanes>(from);
                for (int c = 0; c < columns; ++c) left_over -= L[c * stride + row] * y[c];
                return left_over;
            };
            for (int c = 0; c < 3; ++c) {
                y[c] = rest(mine + 4 * (k + c), k + c, c);
                store(y[c], left + 4 * (k + c));
                store(FourLanes(y[c] * factor.inverse[size_t(3 * front.first + k + c)]), right + 4 * (k + c));
            }
            for (int i = k + 3; i < own; ++i) store(rest(mine + 4 * i, i, 3), mine + 4 * i);
            for (int i = 0; i < front.rows; ++i)
                for (int r = 0; r < 3; ++r) {
                    double* below = sparse + 4 * (3 * rows[i] + r);
                    store(rest(below, begin_further + 3 * i + r, 3), below);
                }
        }
        std::fill_n(mine, 4 * own, 0.0);
    }
};

}  // namespace

void half_solve(const FrontPlan& plan, FrontFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance) {
    FROND_ASSERT(factor.lanes == 1);
    const Eigen::Index n = 3 * Eigen::Index(plan.order.size());
    if (factor.sparse.cols() != n) {
        factor.sparse.setZero(4, n);
        factor.reached.assign(plan.fronts.size(), 0);
    }
    std::vector<int> path;
    Eigen::Index count = 0;
    for (const NodeBlock& given : right_side) {
        const int place = plan.place[size_t(given.node)];
        for (int r = 0; r < 3; ++r) factor.sparse.col(3 * place + r).head<3>() += given.block.row(r).transpose();
        for (int f = plan.front_of[size_t(place)]; f >= 0 && !factor.reached[size_t(f)];
             f = plan.fronts[size_t(f)].parent) {
            factor.reached[size_t(f)] = 1;
            path.push_back(f);
            count += 3 * plan.fronts[size_t(f)].own;
        }
    }
    std::sort(path.begin(), path.end());
    compliance.rows.clear();
    compliance.left.resize(4, count);
    compliance.right.resize(4, count);
    Eigen::Index at = 0;
    for (const int f : path) {
        const Front& front = plan.fronts[size_t(f)];
        run_in_lanes(TakeFront{plan, front, factor, factor.sparse.data(), compliance.left.data() + 4 * at,
                               compliance.right.data() + 4 * at});
        for (int k = 0; k < 3 * front.own; ++k) compliance.rows.push_back(3 * front.first + k);
        at += 3 * front.own;
        factor.reached[size_t(f)] = 0;
    }
}

}  // namespace frond
