// In: symmetric matrices of 3x3 blocks and the plan of their fronts. Out: their factors.
//
// A front's columns are eliminated three at a time, and its update is formed from all of them at once. Both subtract
// products of columns from rows, a tile of rows by three columns in registers.
#include "core/borrowed.hpp"
#include "core/lanes_of_plants.hpp"
#include "solve/front_rows.hpp"

namespace frond {

namespace {

// Rows of three columns.
template <class O, int V>
struct Tile {
    typename O::Rows at[3][V];

    FROND_INLINE void get(const double* from, int stride) {
#pragma GCC unroll 3
        for (int c = 0; c < 3; ++c)
#pragma GCC unroll 6
            for (int v = 0; v < V; ++v)
                at[c][v] = load<typename O::Rows>(from + O::LANES * (size_t(c) * size_t(stride) + size_t(O::ROWS * v)));
    }
    FROND_INLINE void put(double* to, int stride) const {
#pragma GCC unroll 3
        for (int c = 0; c < 3; ++c)
#pragma GCC unroll 6
            for (int v = 0; v < V; ++v)
                store(at[c][v], to + O::LANES * (size_t(c) * size_t(stride) + size_t(O::ROWS * v)));
    }
    // Subtracts the sum over k < count of left(k) times right(k); right holds its three columns' factors.
    FROND_INLINE void take_off(const double* left, const double* right, int stride, int count) {
        const size_t step = size_t(O::LANES) * size_t(stride);
        for (int k = 0; k < count; ++k, left += step, right += step) {
            typename O::Number by[3];
#pragma GCC unroll 3
            for (int c = 0; c < 3; ++c) by[c] = O::number(right + O::LANES * c);
#pragma GCC unroll 6
            for (int v = 0; v < V; ++v) {
                const typename O::Rows rows = load<typename O::Rows>(left + O::LANES * O::ROWS * v);
#pragma GCC unroll 3
                for (int c = 0; c < 3; ++c) at[c][v] -= rows * by[c];
            }
        }
    }
};

constexpr double LARGEST_PIVOT = 1e300;  // also refuses what is not finite

// The factorized triangle of three columns.
template <class O>
struct Corner {
    using Number = typename O::Number;
    Number below[3];  // unscaled: (1, 0), (2, 0), (2, 1)
    Number pivot[3], inverse[3];

    FROND_INLINE explicit Corner(const Tile<O, O::CORNER>& a) {
        const auto at = [&](int row, int column) FROND_INLINED { return O::row_of(a.at[column], row); };
        const Number i0 = 1.0 / at(0, 0), l10 = at(1, 0) * i0, l20 = at(2, 0) * i0;
        const Number left = at(2, 1) - l20 * at(1, 0);
        const Number d1 = at(1, 1) - l10 * at(1, 0), i1 = 1.0 / d1;
        const Number d2 = (at(2, 2) - l20 * at(2, 0)) - left * i1 * left;
        below[0] = at(1, 0), below[1] = at(2, 0), below[2] = left;
        pivot[0] = at(0, 0), pivot[1] = d1, pivot[2] = d2;
        inverse[0] = i0, inverse[1] = i1, inverse[2] = 1.0 / d2;
    }
    // Returns the lanes of `before` whose pivots are all above zero and finite.
    FROND_INLINE Number sound(Number before) const {
        for (const Number& d : pivot) before = select(d > 0.0, select(d <= LARGEST_PIVOT, before, Number{}), Number{});
        return before;
    }
};

// Eliminates three columns of a front, at `column`: subtracts the products of the columns before them and divides by
// their triangle. L times D is kept beside L, for the columns and the update that follow.
template <class O>
struct Panel {
    double *L, *LD;
    int stride, column;
    const Corner<O>& corner;
    template <int V>
    FROND_INLINE void tile(int row) const {
        const size_t at = size_t(O::LANES) * (size_t(column) * size_t(stride) + size_t(row));
        Tile<O, V> a, l;
        a.get(L + at, stride);
        a.take_off(L + O::LANES * row, LD + O::LANES * column, stride, column);
#pragma GCC unroll 6
        for (int v = 0; v < V; ++v) {
            l.at[0][v] = a.at[0][v] * corner.inverse[0];
            a.at[1][v] -= l.at[0][v] * corner.below[0];
            l.at[1][v] = a.at[1][v] * corner.inverse[1];
            a.at[2][v] -= l.at[0][v] * corner.below[1];
            a.at[2][v] -= l.at[1][v] * corner.below[2];
            l.at[2][v] = a.at[2][v] * corner.inverse[2];
        }
        l.put(L + at, stride);
        a.put(LD + at, stride);
    }
};

// Computes three columns of the update likewise.
template <class O>
struct Update {
    double* update;
    const double *L, *LD;  // the further rows
    int update_stride, stride, column, count;
    template <int V>
    FROND_INLINE void tile(int row) const {
        double* at = update + size_t(O::LANES) * (size_t(column) * size_t(update_stride) + size_t(row));
        Tile<O, V> a;
        a.get(at, update_stride);
        a.take_off(L + O::LANES * row, LD + O::LANES * column, stride, count);
        a.put(at, update_stride);
    }
};

template <template <class> class Of>
struct FactorizeFronts {
    const FrontPlan& plan;
    const BlockMatrix& A;
    FrontFactor& factor;
    double *updates, *products;
    unsigned& failed;

    // Initialises a front, from the diagonal on: zero, then the numbers of the matrix.
    template <class O>
    FROND_INLINE void begin(const Front& front, double* columns, double* update) const {
        const int stride = stride_of(front);
        const auto clear = [](double* of, int length, int count) FROND_INLINED {
            for (int k = 0; k < count; ++k, of += O::LANES * length) {
                const int first = floor_to_rows(k / 3 * 3);
                std::fill_n(of + O::LANES * first, O::LANES * (length - first), 0.0);
            }
        };
        clear(columns, stride, 3 * front.own);
        clear(update, padded(front.rows), 3 * front.rows);
        const FrontPlan::Entry* entry = plan.entries.data() + front.entry;
        for (int k = 0; k < front.entries; ++k, ++entry) {
            const double* from = A.values.data() + O::LANES * (9 * size_t(entry->slot));
            double* to = columns + O::LANES * size_t(entry->to);
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r)
                    store(O::number(from + O::LANES * (entry->is_turned ? c + 3 * r : r + 3 * c)),
                          to + O::LANES * (c * stride + r));
        }
    }

    // Adds three columns of a child's update to the parent's corresponding columns.
    template <class O>
    FROND_INLINE void add_columns(const Front& child, int column, const double* from, const Front& front, double* to,
                                  int to_stride, int skipped) const {
        const int own = padded(front.own);
        for (int k = column; k < child.rows;) {
            const FrontPlan::Landing& landing = plan.landings[size_t(child.row + k)];
            const int row = landing.to < front.own ? 3 * landing.to : own + 3 * (landing.to - front.own);
            O::add_nodes(from + O::LANES * (3 * k), padded(child.rows), to + O::LANES * (row - skipped), to_stride,
                         landing.count);
            k += landing.count;
        }
    }

    template <class O>
    FROND_INLINE void add_update(const Front& child, const Front& front, double* columns, double* update) const {
        for (int k = 0; k < child.rows; ++k) {
            const int to = plan.landings[size_t(child.row + k)].to;
            const double* from = updates + O::LANES * (child.update + size_t(3 * k * padded(child.rows)));
            if (to < front.own)
                add_columns<O>(child, k, from, front, columns + O::LANES * (3 * to * stride_of(front)),
                               stride_of(front), 0);
            else
                add_columns<O>(child, k, from, front, update + O::LANES * (3 * (to - front.own) * padded(front.rows)),
                               padded(front.rows), padded(front.own));
        }
    }

    // Returns the lanes of `before` whose pivots are all valid.
    template <class O>
    FROND_INLINE typename O::Number eliminate(const Front& front, double* L, double* update,
                                              typename O::Number sound) const {
        const int stride = stride_of(front), own = padded(front.own);
        for (int column = 0; column < 3 * front.own; column += 3) {
            Tile<O, O::CORNER> a;
            a.get(L + size_t(O::LANES) * (size_t(column) * size_t(stride) + size_t(column)), stride);
            a.take_off(L + O::LANES * column, products + O::LANES * column, stride, column);
            const Corner<O> corner(a);
            sound = corner.sound(sound);
            O::for_rows_of(front, column, Panel<O>{L, products, stride, column, corner});
            // Rows above the diagonal may have been computed along with the others.
            const size_t place = size_t(3 * front.first + column);
            for (int c = 0; c < 3; ++c) {
                const int first = O::first_row(column);
                std::fill_n(L + O::LANES * ((column + c) * stride + first), O::LANES * (column + c + 1 - first), 0.0);
                store(corner.pivot[c], factor.pivot.data() + O::LANES * (place + size_t(c)));
                store(corner.inverse[c], factor.inverse.data() + O::LANES * (place + size_t(c)));
            }
        }
        for (int column = 0; column < 3 * front.rows; column += 3)
            O::for_rows_of_update(front, column,
                                  Update<O>{update, L + O::LANES * own, products + O::LANES * own, padded(front.rows),
                                            stride, column, 3 * front.own});
        return sound;
    }

    template <class S>
    FROND_INLINE void run() const {
        using O = Of<S>;
        typename O::Number sound = 1.0 + typename O::Number{};
        for (const Front& front : plan.fronts) {
            double* columns = factor.columns.data() + O::LANES * front.columns;
            double* update = updates + O::LANES * front.update;
            begin<O>(front, columns, update);
            for (int c = 0; c < front.children; ++c)
                add_update<O>(plan.fronts[size_t(plan.children[size_t(front.child + c)])], front, columns, update);
            sound = eliminate<O>(front, columns, update, sound);
        }
        failed = bits_of(sound == 0.0);
    }
};

struct TakeApart {
    const NumbersInLines& numbers;
    double* const* out;
    NumbersInLines& nowhere;  // workspace: what no one asks for
    template <class S>
    FROND_INLINE void run() const {
        const size_t count = numbers.size() / size_t(LANES<S>);
        if (nowhere.size() < count) nowhere.resize(count);
        double* to[LANES<S>];
        for (int lane = 0; lane < LANES<S>; ++lane) to[lane] = out[lane] ? out[lane] : nowhere.data();
        put_apart<S>(numbers.data(), count, to);
    }
};

struct FactorRoom {
    NumbersInLines updates, products;
};

}  // namespace

unsigned factorize(const FrontPlan& plan, const BlockMatrix& A, FrontFactor& factor) {
    Borrowed<FactorRoom> room;
    NumbersInLines &updates = room->updates, &products = room->products;
    const size_t lanes = size_t(A.lanes()), beyond = size_t(ROWS_AT_ONCE);  // a corner reads a row too many
    factor.lanes = int(lanes);
    if (updates.size() < lanes * plan.update_size + beyond) updates.resize(lanes * plan.update_size + beyond);
    if (products.size() < lanes * plan.largest + beyond) products.resize(lanes * plan.largest + beyond);
    make_room(factor.columns, lanes * plan.column_size + beyond);
    make_room(factor.pivot, lanes * 3 * plan.order.size());
    make_room(factor.inverse, factor.pivot.size());
    unsigned failed = 0;
    if (lanes == 1)
        run_in_lanes(FactorizeFronts<RowsOfOne>{plan, A, factor, updates.data(), products.data(), failed});
    else
        run_in_lanes(factor.lanes,
                     FactorizeFronts<RowsOfSeveral>{plan, A, factor, updates.data(), products.data(), failed});
    return failed;
}

void take_apart(const FrontFactor& factor, FrontFactor* const* out) {
    Borrowed<NumbersInLines> nowhere;
    for (NumbersInLines FrontFactor::*numbers : {&FrontFactor::columns, &FrontFactor::pivot, &FrontFactor::inverse}) {
        const NumbersInLines& from = factor.*numbers;
        double* to[MOST_LANES] = {};
        for (int lane = 0; lane < factor.lanes; ++lane) {
            if (!out[lane]) continue;
            NumbersInLines& own = out[lane]->*numbers;
            own.resize(from.size() / size_t(factor.lanes) + size_t(ROWS_AT_ONCE));
            to[lane] = own.data();
        }
        run_in_lanes(factor.lanes, TakeApart{from, to, *nowhere});
    }
}

}  // namespace frond
