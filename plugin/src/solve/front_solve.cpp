// In: factors and right-hand sides. Out: the solutions.
#include "solve/front_rows.hpp"

namespace frond {

namespace {

template <template <class> class Of>
struct SolveFronts {
    const FrontPlan& plan;
    const FrontFactor& factor;
    double *all, *y;  // numbers in elimination order, and those of one front's rows

    template <class O>
    FROND_INLINE static typename O::Number get(const double* from, int i) {
        return O::number(from + O::LANES * i);
    }
    template <class O>
    FROND_INLINE static void put(const typename O::Number& value, double* to, int i) {
        store(value, to + O::LANES * i);
    }

    // Takes three columns at a time. L is stored with zeros on and above its diagonal.
    template <class O>
    FROND_INLINE void down(const Front& front, const double* L) const {
        using Number = typename O::Number;
        using Rows = typename O::Rows;
        const int stride = stride_of(front), own = 3 * front.own;
        double* mine = all + O::LANES * 3 * front.first;
        std::copy_n(mine, O::LANES * own, y);
        std::fill_n(y + O::LANES * own, O::LANES * (stride - own), 0.0);
        for (int k = 0; k < own; k += 3, L += O::LANES * 3 * stride) {
            const Number y0 = get<O>(y, k), y1 = get<O>(y, k + 1) - get<O>(L, k + 1) * y0;
            const Number y2 = (get<O>(y, k + 2) - get<O>(L, k + 2) * y0) - get<O>(L, stride + k + 2) * y1;
            for (int i = O::first_row(k); i < stride; i += O::ROWS) {
                Rows rest = load<Rows>(y + O::LANES * i);
                rest -= load<Rows>(L + O::LANES * i) * y0;
                rest -= load<Rows>(L + O::LANES * (stride + i)) * y1;
                rest -= load<Rows>(L + O::LANES * (2 * stride + i)) * y2;
                store(rest, y + O::LANES * i);
            }
        }
        std::copy_n(y, O::LANES * own, mine);
        const int* place = plan.rows.data() + front.row;
        const double* further = y + O::LANES * padded(front.own);
        for (int k = 0; k < front.rows; ++k)
            for (int r = 0; r < 3; ++r) {
                const int at = 3 * place[k] + r;
                put<O>(get<O>(all, at) + get<O>(further, 3 * k + r), all, at);
            }
    }

    template <class O>
    FROND_INLINE void up(const Front& front, const double* L) const {
        using Number = typename O::Number;
        const int stride = stride_of(front), own = 3 * front.own;
        std::fill_n(y, O::LANES * stride, 0.0);
        const int* place = plan.rows.data() + front.row;
        double* further = y + O::LANES * padded(front.own);
        for (int k = 0; k < front.rows; ++k)
            for (int r = 0; r < 3; ++r) put<O>(get<O>(all, 3 * place[k] + r), further, 3 * k + r);
        double* mine = all + O::LANES * 3 * front.first;
        const double* inverse = factor.inverse.data() + O::LANES * 3 * front.first;
        for (int k = own - 3; k >= 0; k -= 3) {
            const double* column = L + O::LANES * k * stride;
            typename O::Sums sums[3];
            for (int i = floor_to_rows(k); i < stride; i += ROWS_AT_ONCE) {
                const typename O::Sums x = O::four_rows(y + O::LANES * i);
#pragma GCC unroll 3
                for (int c = 0; c < 3; ++c) sums[c].add(column + O::LANES * (c * stride + i), x);
            }
            const auto rest = [&](int c) FROND_INLINED {
                return Number(get<O>(mine, k + c) * get<O>(inverse, k + c) - sums[c].total());
            };
            const Number x2 = rest(2);
            const Number x1 = rest(1) - get<O>(column, stride + k + 2) * x2;
            const Number x0 = (rest(0) - get<O>(column, k + 1) * x1) - get<O>(column, k + 2) * x2;
            const Number found[3] = {x0, x1, x2};
            for (int c = 0; c < 3; ++c) {
                put<O>(found[c], mine, k + c);
                put<O>(found[c], y, k + c);
            }
        }
    }

    template <class S>
    FROND_INLINE void run() const {
        using O = Of<S>;
        const double* columns = factor.columns.data();
        for (const Front& front : plan.fronts) down<O>(front, columns + O::LANES * front.columns);
        for (size_t f = plan.fronts.size(); f-- > 0;)
            up<O>(plan.fronts[f], columns + O::LANES * plan.fronts[f].columns);
    }
};

}  // namespace

void solve(const FrontPlan& plan, FrontFactor& factor, double* x) {
    const size_t lanes = size_t(factor.lanes), three = 3 * lanes;
    make_room(factor.ordered, three * plan.order.size());
    make_room(factor.front, lanes * plan.longest);
    for (size_t k = 0; k < plan.order.size(); ++k)
        std::copy_n(x + three * size_t(plan.order[k]), three, factor.ordered.data() + three * k);
    if (lanes == 1)
        run_in_lanes(SolveFronts<RowsOfOne>{plan, factor, factor.ordered.data(), factor.front.data()});
    else
        run_in_lanes(factor.lanes,
                     SolveFronts<RowsOfSeveral>{plan, factor, factor.ordered.data(), factor.front.data()});
    for (size_t k = 0; k < plan.order.size(); ++k)
        std::copy_n(factor.ordered.data() + three * k, three, x + three * size_t(plan.order[k]));
}

}  // namespace frond
