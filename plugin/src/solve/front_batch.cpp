// In: matrices of a pattern, one a lane, and the plan of their fronts. Out: factors and solutions. front_factor.cpp
// subtracts products of columns from several rows at once, and front_solve.cpp adds up rows by fours; here the same
// numbers are subtracted and added in the same order.
#include "solve/front_batch.hpp"

#include <algorithm>
#include <array>

#include "core/lanes_of_plants.hpp"
#include "solve/front_corner.hpp"

namespace frond {

namespace {

constexpr int PARTS = 4;  // parts of a sum over rows, see front_solve.cpp

// A tile of three columns.
template <class S, int ROWS>
struct BatchTile {
    S at[3][ROWS];

    FROND_INLINE void get(const double* from, size_t stride) {
#pragma GCC unroll 3
        for (int c = 0; c < 3; ++c)
#pragma GCC unroll 6
            for (int r = 0; r < ROWS; ++r) at[c][r] = load<S>(from + LANES<S> * (size_t(c) * stride + size_t(r)));
    }
    FROND_INLINE void put(double* to, size_t stride) const {
#pragma GCC unroll 3
        for (int c = 0; c < 3; ++c)
#pragma GCC unroll 6
            for (int r = 0; r < ROWS; ++r) store(at[c][r], to + LANES<S> * (size_t(c) * stride + size_t(r)));
    }
    // Subtracts the sum over k < count of left(k) times right(k).
    FROND_INLINE void take_off(const double* left, const double* right, size_t stride, int count) {
        for (int k = 0; k < count; ++k, left += LANES<S> * stride, right += LANES<S> * stride) {
            S by[3];
#pragma GCC unroll 3
            for (int c = 0; c < 3; ++c) by[c] = load<S>(right + LANES<S> * c);
#pragma GCC unroll 6
            for (int r = 0; r < ROWS; ++r) {
                const S row = load<S>(left + LANES<S> * r);
#pragma GCC unroll 3
                for (int c = 0; c < 3; ++c) at[c][r] -= row * by[c];
            }
        }
    }
};

// Calls work.tile<ROWS>(row) for the rows of `nodes` nodes, from `row` on.
template <class S, class Work>
FROND_INLINE void for_rows(int row, int nodes, const Work& work) {
    // Only eight lanes have registers for more than three rows.
    if constexpr (LANES<S> == 8)
        for (; nodes >= 2; nodes -= 2, row += 6) work.template tile<6>(row);
    for (; nodes > 0; --nodes, row += 3) work.template tile<3>(row);
}

template <class S>
struct BatchPanel {
    double *L, *LD;
    size_t stride;
    int column;
    const Corner<S>& corner;
    template <int ROWS>
    FROND_INLINE void tile(int row) const {
        const size_t at = size_t(LANES<S>) * (size_t(column) * stride + size_t(row));
        BatchTile<S, ROWS> a;
        a.get(L + at, stride);
        a.take_off(L + LANES<S> * row, LD + LANES<S> * column, stride, column);
        BatchTile<S, ROWS> l;
#pragma GCC unroll 6
        for (int r = 0; r < ROWS; ++r) {
            l.at[0][r] = a.at[0][r] * corner.inverse[0];
            a.at[1][r] -= l.at[0][r] * corner.below[0];
            l.at[1][r] = a.at[1][r] * corner.inverse[1];
            a.at[2][r] -= l.at[0][r] * corner.below[1];
            a.at[2][r] -= l.at[1][r] * corner.below[2];
            l.at[2][r] = a.at[2][r] * corner.inverse[2];
        }
        l.put(L + at, stride);
        a.put(LD + at, stride);
    }
};

template <class S>
struct BatchUpdate {
    double* update;
    const double *L, *LD;  // the further rows
    size_t update_stride, stride;
    int column, count;
    template <int ROWS>
    FROND_INLINE void tile(int row) const {
        double* at = update + size_t(LANES<S>) * (size_t(column) * update_stride + size_t(row));
        BatchTile<S, ROWS> a;
        a.get(at, update_stride);
        a.take_off(L + LANES<S> * row, LD + LANES<S> * column, stride, count);
        a.put(at, update_stride);
    }
};

struct FactorizeFrontBatch {
    const FrontPlan& plan;
    const BlockMatrix& A;
    FrontBatch& factor;
    double *updates, *products;
    unsigned& failed;

    // Initialises a front, from the diagonal on: zero, then the numbers of the matrix.
    template <class S>
    FROND_INLINE void begin(const Front& front, double* columns, double* update) const {
        const size_t stride = size_t(stride_of(front)), update_stride = size_t(padded(front.rows));
        const auto clear = [](double* of, size_t length, size_t column) FROND_INLINED {
            const size_t first = column / 3 * 3 / PARTS * PARTS;
            std::fill_n(of + LANES<S> * (column * length + first), LANES<S> * (length - first), 0.0);
        };
        for (size_t k = 0; k < size_t(3 * front.own); ++k) clear(columns, stride, k);
        for (size_t k = 0; k < size_t(3 * front.rows); ++k) clear(update, update_stride, k);
        const FrontPlan::Entry* entry = plan.entries.data() + front.entry;
        for (int k = 0; k < front.entries; ++k, ++entry) {
            const double* from = A.values.data() + LANES<S> * (9 * size_t(entry->slot));
            double* to = columns + LANES<S> * size_t(entry->to);
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r)
                    store(load<S>(from + LANES<S> * (entry->is_turned ? c + 3 * r : r + 3 * c)),
                          to + LANES<S> * (size_t(c) * stride + size_t(r)));
        }
    }

    // Adds three columns of a child's update to the parent's corresponding columns.
    template <class S>
    FROND_INLINE void add_columns(const Front& child, int column, const double* from, const Front& front, double* to,
                                  int to_stride, int skipped) const {
        const int stride = padded(child.rows), own = padded(front.own);
        for (int k = column; k < child.rows;) {
            const FrontPlan::Landing& landing = plan.landings[size_t(child.row + k)];
            const int row = landing.to < front.own ? 3 * landing.to : own + 3 * (landing.to - front.own);
            const double* source = from + LANES<S> * (3 * k);
            double* target = to + LANES<S> * (row - skipped);
            for (int c = 0; c < 3; ++c, source += LANES<S> * stride, target += LANES<S> * to_stride)
                for (int i = 0; i < LANES<S> * 3 * landing.count; i += LANES<S>)
                    store(S(load<S>(target + i) + load<S>(source + i)), target + i);
            k += landing.count;
        }
    }

    template <class S>
    FROND_INLINE void add_update(const Front& child, const Front& front, double* columns, double* update) const {
        const int own = padded(front.own);
        for (int k = 0; k < child.rows; ++k) {
            const int to = plan.landings[size_t(child.row + k)].to;
            const double* from = updates + LANES<S> * (child.update + size_t(3 * k * padded(child.rows)));
            if (to < front.own)
                add_columns<S>(child, k, from, front, columns + LANES<S> * (3 * to * stride_of(front)),
                               stride_of(front), 0);
            else
                add_columns<S>(child, k, from, front, update + LANES<S> * (3 * (to - front.own) * padded(front.rows)),
                               padded(front.rows), own);
        }
    }

    // Returns the lanes of `before` whose pivots are all valid.
    template <class S>
    FROND_INLINE S eliminate(const Front& front, double* L, double* update, const S& before) const {
        const size_t stride = size_t(stride_of(front));
        const int own = padded(front.own), count = 3 * front.own;
        S sound = before;
        for (int column = 0; column < count; column += 3) {
            BatchTile<S, 3> a;
            a.get(L + LANES<S> * (size_t(column) * stride + size_t(column)), stride);
            a.take_off(L + LANES<S> * column, products + LANES<S> * column, stride, column);
            const Corner<S> corner =
                corner_of<S>(a.at[0][0], a.at[0][1], a.at[0][2], a.at[1][1], a.at[1][2], a.at[2][2]);
            const BatchPanel<S> panel = {L, products, stride, column, corner};
            for_rows<S>(column, front.own - column / 3, panel);
            for_rows<S>(own, front.rows, panel);
            const size_t at = size_t(3 * front.first + column);
            for (size_t c = 0; c < 3; ++c) {
                std::fill_n(L + LANES<S> * ((size_t(column) + c) * stride + size_t(column)), LANES<S> * (c + 1), 0.0);
                store(corner.pivot[c], factor.pivot.data() + LANES<S> * (at + c));
                store(corner.inverse[c], factor.inverse.data() + LANES<S> * (at + c));
                sound = select(corner.pivot[c] > 0.0, select(corner.pivot[c] <= LARGEST_PIVOT, sound, S{}), S{});
            }
        }
        const double *further = L + LANES<S> * own, *further_products = products + LANES<S> * own;
        for (int k = 0; k < front.rows; ++k)
            for_rows<S>(
                3 * k, front.rows - k,
                BatchUpdate<S>{update, further, further_products, size_t(padded(front.rows)), stride, 3 * k, count});
        return sound;
    }

    template <class S>
    FROND_INLINE void run() const {
        S sound = constant<S>(1);
        for (const Front& front : plan.fronts) {
            double* columns = factor.columns.data() + LANES<S> * front.columns;
            double* update = updates + LANES<S> * front.update;
            begin<S>(front, columns, update);
            for (int c = 0; c < front.children; ++c)
                add_update<S>(plan.fronts[size_t(plan.children[size_t(front.child + c)])], front, columns, update);
            sound = eliminate<S>(front, columns, update, sound);
        }
        failed = bits_of(sound == 0.0);
    }
};

struct SolveFrontBatch {
    const FrontPlan& plan;
    const FrontBatch& factor;
    double *all, *y;  // numbers in elimination order, and those of one front's rows

    template <class S>
    FROND_INLINE static S get(const double* from, size_t i) {
        return load<S>(from + LANES<S> * i);
    }
    template <class S>
    FROND_INLINE static void put(const S& value, double* to, size_t i) {
        store(value, to + LANES<S> * i);
    }
    // L is stored with zeros on and above its diagonal.
    template <class S>
    FROND_INLINE void down(const Front& front, const double* L) const {
        const size_t stride = size_t(stride_of(front)), own = size_t(3 * front.own);
        double* mine = all + LANES<S> * size_t(3 * front.first);
        std::copy_n(mine, LANES<S> * own, y);
        std::fill_n(y + LANES<S> * own, LANES<S> * (stride - own), 0.0);
        for (size_t k = 0; k < own; k += 3, L += LANES<S> * (3 * stride)) {
            const S y0 = get<S>(y, k), y1 = get<S>(y, k + 1) - get<S>(L, k + 1) * y0;
            const S y2 = (get<S>(y, k + 2) - get<S>(L, k + 2) * y0) - get<S>(L, stride + k + 2) * y1;
            for (size_t i = k; i < stride; ++i) {
                S rest = get<S>(y, i);
                rest -= get<S>(L, i) * y0;
                rest -= get<S>(L, stride + i) * y1;
                rest -= get<S>(L, 2 * stride + i) * y2;
                put(rest, y, i);
            }
        }
        std::copy_n(y, LANES<S> * own, mine);
        const int* place = plan.rows.data() + front.row;
        const double* further = y + LANES<S> * padded(front.own);
        for (size_t k = 0; k < size_t(front.rows); ++k)
            for (size_t r = 0; r < 3; ++r) {
                const size_t at = size_t(3 * place[k]) + r;
                put(S(get<S>(all, at) + get<S>(further, 3 * k + r)), all, at);
            }
    }
    template <class S>
    FROND_INLINE static S total(const S (&a)[PARTS]) {
        return (a[0] + a[1]) + (a[2] + a[3]);
    }
    template <class S>
    FROND_INLINE void up(const Front& front, const double* L) const {
        const size_t stride = size_t(stride_of(front)), own = size_t(3 * front.own);
        std::fill_n(y, LANES<S> * stride, 0.0);
        const int* place = plan.rows.data() + front.row;
        double* further = y + LANES<S> * padded(front.own);
        for (size_t k = 0; k < size_t(front.rows); ++k)
            for (size_t r = 0; r < 3; ++r) put(get<S>(all, size_t(3 * place[k]) + r), further, 3 * k + r);
        double* mine = all + LANES<S> * size_t(3 * front.first);
        const double* inverse = factor.inverse.data() + LANES<S> * size_t(3 * front.first);
        for (size_t k = own; k > 0;) {
            k -= 3;
            const double* column = L + LANES<S> * (k * stride);
            S sum[3][PARTS] = {};
            for (size_t i = k / PARTS * PARTS; i < stride; i += PARTS)
#pragma GCC unroll 4
                for (size_t part = 0; part < PARTS; ++part) {
                    const S x = get<S>(y, i + part);
#pragma GCC unroll 3
                    for (size_t c = 0; c < 3; ++c) sum[c][part] += get<S>(column, c * stride + i + part) * x;
                }
            const auto scaled = [&](size_t i) FROND_INLINED { return S(get<S>(mine, k + i) * get<S>(inverse, k + i)); };
            const S x2 = scaled(2) - total(sum[2]);
            const S x1 = (scaled(1) - total(sum[1])) - get<S>(column, stride + k + 2) * x2;
            const S x0 = ((scaled(0) - total(sum[0])) - get<S>(column, k + 1) * x1) - get<S>(column, k + 2) * x2;
            const S found[3] = {x0, x1, x2};
            for (size_t c = 0; c < 3; ++c) {
                put(found[c], mine, k + c);
                put(found[c], y, k + c);
            }
        }
    }
    template <class S>
    FROND_INLINE void run() const {
        for (const Front& front : plan.fronts) down<S>(front, factor.columns.data() + LANES<S> * front.columns);
        for (size_t f = plan.fronts.size(); f-- > 0;)
            up<S>(plan.fronts[f], factor.columns.data() + LANES<S> * plan.fronts[f].columns);
    }
};

void make_large_enough(NumbersInLines& numbers, size_t count) {
    if (numbers.size() < count) numbers.resize(count);
}

struct TakeApart {
    const NumbersInLines& numbers;
    double* const* out;
    template <class S>
    FROND_INLINE void run() const {
        static thread_local NumbersInLines nowhere;
        const size_t count = numbers.size() / size_t(LANES<S>);
        make_large_enough(nowhere, count);
        double* to[LANES<S>];
        for (int lane = 0; lane < LANES<S>; ++lane) to[lane] = out[lane] ? out[lane] : nowhere.data();
        put_apart<S>(numbers.data(), count, to);
    }
};

// Scratch of factorize().
struct BatchRoom {
    NumbersInLines updates, products;
};

}  // namespace

unsigned factorize(const FrontPlan& plan, const BlockMatrix& A, FrontBatch& factor) {
    static thread_local BatchRoom room;
    const size_t lanes = size_t(A.lanes());
    factor.lanes = int(lanes);
    make_large_enough(room.updates, lanes * plan.update_size);
    make_large_enough(room.products, lanes * plan.largest);
    make_room(factor.columns, lanes * plan.column_size);
    make_room(factor.pivot, lanes * 3 * plan.order.size());
    make_room(factor.inverse, factor.pivot.size());
    unsigned failed = 0;
    run_in_lanes(factor.lanes, FactorizeFrontBatch{plan, A, factor, room.updates.data(), room.products.data(), failed});
    return failed;
}

void solve(const FrontPlan& plan, FrontBatch& factor, const NumbersInLines& b, NumbersInLines& x) {
    const size_t lanes = size_t(factor.lanes), three = 3 * lanes;
    make_room(factor.ordered, b.size());
    make_room(factor.front, lanes * plan.longest);
    for (size_t k = 0; k < plan.order.size(); ++k)
        std::copy_n(b.data() + three * size_t(plan.order[k]), three, factor.ordered.data() + three * k);
    run_in_lanes(factor.lanes, SolveFrontBatch{plan, factor, factor.ordered.data(), factor.front.data()});
    x.resize(b.size());
    for (size_t k = 0; k < plan.order.size(); ++k)
        std::copy_n(factor.ordered.data() + three * k, three, x.data() + three * size_t(plan.order[k]));
}

void take_apart(const FrontBatch& factor, FrontFactor* const* out) {
    std::array<double*, MOST_LANES> columns, pivot, inverse;
    for (size_t lane = 0; lane < size_t(factor.lanes); ++lane) {
        columns[lane] = pivot[lane] = inverse[lane] = nullptr;
        if (!out[lane]) continue;
        FrontFactor& own = *out[lane];
        own.columns.resize(factor.columns.size() / size_t(4 * factor.lanes) + 1);
        own.pivot.resize(Eigen::Index(factor.pivot.size()) / factor.lanes);
        own.inverse.resize(own.pivot.size());
        columns[lane] = numbers_of(own.columns);
        pivot[lane] = own.pivot.data();
        inverse[lane] = own.inverse.data();
    }
    run_in_lanes(factor.lanes, TakeApart{factor.columns, columns.data()});
    run_in_lanes(factor.lanes, TakeApart{factor.pivot, pivot.data()});
    run_in_lanes(factor.lanes, TakeApart{factor.inverse, inverse.data()});
}

}  // namespace frond
