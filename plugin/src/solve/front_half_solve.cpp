// In: the factor of one matrix and a right-hand side of few nodes. Out: its half-solve.
//
// A half-solve reaches only the rows of the fronts on the paths to the root (Gilbert, Peierls 1988, "Sparse partial
// pivoting in time proportional to arithmetic operations").
#include <algorithm>

#include "core/assert.hpp"
#include "solve/fronts.hpp"

namespace frond {

// Eliminates a front's columns from the rows below them, and appends its own rows to the compliance.
static void take_front(const FrontPlan& plan, const Front& front, FrontFactor& factor, Eigen::Index at,
                       NodeCompliance& compliance) {
    const int stride = stride_of(front), own = 3 * front.own;
    const double* L = factor.columns.data() + front.columns;
    const double* further = L + padded(front.own);
    for (int k = 0; k < own; ++k, L += stride, further += stride) {
        const int column = 3 * front.first + k;
        const Vec3 y = factor.sparse.col(column);
        compliance.rows.push_back(column);
        compliance.left.col(at + k) = y;
        compliance.right.col(at + k) = y * factor.inverse[size_t(column)];
        for (int i = k + 1; i < own; ++i) factor.sparse.col(3 * front.first + i) -= L[i] * y;
        for (int i = 0; i < front.rows; ++i)
            for (int r = 0; r < 3; ++r)
                factor.sparse.col(3 * plan.rows[size_t(front.row + i)] + r) -= further[3 * i + r] * y;
    }
    factor.sparse.middleCols(3 * front.first, own).setZero();
}

void half_solve(const FrontPlan& plan, FrontFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance) {
    FROND_ASSERT(factor.lanes == 1);
    const Eigen::Index n = 3 * Eigen::Index(plan.order.size());
    if (factor.sparse.cols() != n) {
        factor.sparse.setZero(3, n);
        factor.reached.assign(plan.fronts.size(), 0);
    }
    std::vector<int> path;
    Eigen::Index count = 0;
    for (const NodeBlock& given : right_side) {
        const int place = plan.place[size_t(given.node)];
        for (int r = 0; r < 3; ++r) factor.sparse.col(3 * place + r) += given.block.row(r).transpose();
        for (int f = plan.front_of[size_t(place)]; f >= 0 && !factor.reached[size_t(f)];
             f = plan.fronts[size_t(f)].parent) {
            factor.reached[size_t(f)] = 1;
            path.push_back(f);
            count += 3 * plan.fronts[size_t(f)].own;
        }
    }
    std::sort(path.begin(), path.end());
    compliance.rows.clear();
    compliance.left.resize(3, count);
    compliance.right.resize(3, count);
    Eigen::Index at = 0;
    for (const int f : path) {
        const Front& front = plan.fronts[size_t(f)];
        take_front(plan, front, factor, at, compliance);
        at += 3 * front.own;
        factor.reached[size_t(f)] = 0;
    }
}

}  // namespace frond
