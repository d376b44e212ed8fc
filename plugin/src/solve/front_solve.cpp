// In: factors and a right-hand side. Out: the solution, or the half-solve of a right-hand side of few nodes.
//
// A half-solve reaches only the rows of the fronts on the paths to the root (Gilbert, Peierls 1988, "Sparse partial
// pivoting in time proportional to arithmetic operations").
#include <algorithm>

#include "core/lanes.hpp"
#include "solve/fronts.hpp"

namespace frond {

namespace {

constexpr int ROWS_AT_ONCE = 4;  // numbers of a column

struct SolveFronts {
    const FrontPlan& plan;
    const FrontFactor& factor;
    double *all, *y;  // numbers in elimination order, and those of one front's rows

    // Takes three columns at a time. L is stored with zeros on and above its diagonal.
    FROND_INLINE void down(const Front& front, const double* L) const {
        const int stride = stride_of(front), own = 3 * front.own;
        std::copy_n(all + 3 * front.first, own, y);
        std::fill_n(y + own, stride - own, 0.0);
        for (int k = 0; k < own; k += 3, L += 3 * stride) {
            const double y0 = y[k], y1 = y[k + 1] - L[k + 1] * y0;
            const double y2 = (y[k + 2] - L[k + 2] * y0) - L[stride + k + 2] * y1;
            for (int i = k / ROWS_AT_ONCE * ROWS_AT_ONCE; i < stride; i += ROWS_AT_ONCE) {
                FourLanes rest = load<FourLanes>(y + i);
                rest -= load<FourLanes>(L + i) * y0;
                rest -= load<FourLanes>(L + stride + i) * y1;
                rest -= load<FourLanes>(L + 2 * stride + i) * y2;
                store(rest, y + i);
            }
        }
        std::copy_n(y, own, all + 3 * front.first);
        const int* place = plan.rows.data() + front.row;
        const double* further = y + padded(front.own);
        for (int k = 0; k < front.rows; ++k)
            for (int r = 0; r < 3; ++r) all[3 * place[k] + r] += further[3 * k + r];
    }

    FROND_INLINE void up(const Front& front, const double* L) const {
        const int stride = stride_of(front), own = 3 * front.own;
        std::fill_n(y, stride, 0.0);
        const int* place = plan.rows.data() + front.row;
        double* further = y + padded(front.own);
        for (int k = 0; k < front.rows; ++k)
            for (int r = 0; r < 3; ++r) further[3 * k + r] = all[3 * place[k] + r];
        double* mine = all + 3 * front.first;
        const double* inverse = factor.inverse.data() + 3 * front.first;
        for (int k = own - 3; k >= 0; k -= 3) {
            const double* column = L + k * stride;
            FourLanes sum[3] = {};
            for (int i = k / ROWS_AT_ONCE * ROWS_AT_ONCE; i < stride; i += ROWS_AT_ONCE) {
                const FourLanes x = load<FourLanes>(y + i);
                for (int c = 0; c < 3; ++c) sum[c] += load<FourLanes>(column + c * stride + i) * x;
            }
            const double x2 = mine[k + 2] * inverse[k + 2] - total(sum[2]);
            const double x1 = (mine[k + 1] * inverse[k + 1] - total(sum[1])) - column[stride + k + 2] * x2;
            const double x0 = ((mine[k] * inverse[k] - total(sum[0])) - column[k + 1] * x1) - column[k + 2] * x2;
            mine[k] = y[k] = x0;
            mine[k + 1] = y[k + 1] = x1;
            mine[k + 2] = y[k + 2] = x2;
        }
    }

    FROND_INLINE static double total(const FourLanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

    template <class S>
    FROND_INLINE void run() const {
        const double* columns = numbers_of(factor.columns);
        for (const Front& front : plan.fronts) down(front, columns + front.columns);
        for (size_t f = plan.fronts.size(); f-- > 0;) up(plan.fronts[f], columns + plan.fronts[f].columns);
    }
};

// Eliminates a front's columns from the rows below them, and appends its own rows to the compliance.
void take_front(const FrontPlan& plan, const Front& front, FrontFactor& factor, Eigen::Index at,
                NodeCompliance& compliance) {
    const int stride = stride_of(front), own = 3 * front.own;
    const double* L = numbers_of(factor.columns) + front.columns;
    const double* further = L + padded(front.own);
    for (int k = 0; k < own; ++k, L += stride, further += stride) {
        const int column = 3 * front.first + k;
        const Vec3 y = factor.sparse.col(column);
        compliance.rows.push_back(column);
        compliance.left.col(at + k) = y;
        compliance.right.col(at + k) = y * factor.inverse[column];
        for (int i = k + 1; i < own; ++i) factor.sparse.col(3 * front.first + i) -= L[i] * y;
        for (int i = 0; i < front.rows; ++i)
            for (int r = 0; r < 3; ++r)
                factor.sparse.col(3 * plan.rows[size_t(front.row + i)] + r) -= further[3 * i + r] * y;
    }
    factor.sparse.middleCols(3 * front.first, own).setZero();
}

}  // namespace

void solve(const FrontPlan& plan, FrontFactor& factor, const VecX& b, VecX& x) {
    factor.ordered.resize(b.size());
    factor.front.resize(Eigen::Index(plan.longest));
    for (size_t k = 0; k < plan.order.size(); ++k) point(factor.ordered, int(k)) = point(b, plan.order[k]);
    run_in_lanes(SolveFronts{plan, factor, factor.ordered.data(), factor.front.data()});
    x.resize(b.size());
    for (size_t k = 0; k < plan.order.size(); ++k) point(x, plan.order[k]) = point(factor.ordered, int(k));
}

void half_solve(const FrontPlan& plan, FrontFactor& factor, const std::vector<NodeBlock>& right_side,
                NodeCompliance& compliance) {
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
