// In: a symmetric matrix of 3x3 blocks and the plan of its fronts. Out: its factors.
//
// A front's columns are eliminated three at a time, and its update is formed from all of them at once. Both subtract
// products of columns from rows, twelve rows by three columns in registers; no product is fused with a sum, so that the
// numbers are the same on every processor.
#include <algorithm>
#include <cmath>

#include "core/lanes.hpp"
#include "solve/front_corner.hpp"
#include "solve/fronts.hpp"

namespace frond {

namespace {

constexpr int ROWS = 4;  // numbers in a vector register

// A tile of three columns.
template <int V>
struct Tile {
    FourLanes at[3][V];
};

template <int V>
FROND_INLINE Tile<V> load_tile(const double* from, int stride) {
    Tile<V> tile;
    for (int c = 0; c < 3; ++c)
        for (int v = 0; v < V; ++v) tile.at[c][v] = load<FourLanes>(from + c * stride + ROWS * v);
    return tile;
}

template <int V>
FROND_INLINE void store_tile(const Tile<V>& tile, double* to, int stride) {
    for (int c = 0; c < 3; ++c)
        for (int v = 0; v < V; ++v) store(tile.at[c][v], to + c * stride + ROWS * v);
}

// Subtracts the sum over k < count of left(k) times right(k) from a tile; right holds its three columns' factors.
template <int V>
FROND_INLINE void take_off(Tile<V>& tile, const double* left, const double* right, int stride, int count) {
    for (int k = 0; k < count; ++k, left += stride, right += stride) {
        FourLanes rows[V];
        for (int v = 0; v < V; ++v) rows[v] = load<FourLanes>(left + ROWS * v);
        for (int c = 0; c < 3; ++c) {
            const double by = right[c];
            for (int v = 0; v < V; ++v) tile.at[c][v] -= rows[v] * by;
        }
    }
}

// Calls work.tile<V>(row) for rows begin .. end, both multiples of four.
template <class Work>
FROND_INLINE void for_rows(int begin, int end, const Work& work) {
    int row = begin;
    for (; row + 3 * ROWS <= end; row += 3 * ROWS) work.template tile<3>(row);
    if (row + 2 * ROWS <= end)
        work.template tile<2>(row);
    else if (row < end)
        work.template tile<1>(row);
}

bool is_pivot(double d) {
    return d > 0 && d <= LARGEST_PIVOT;
}

FROND_INLINE bool factorize_corner(const Tile<1>& a, Corner<double>& out) {
    out = corner_of<double>(a.at[0][0][0], a.at[0][0][1], a.at[0][0][2], a.at[1][0][1], a.at[1][0][2], a.at[2][0][2]);
    return is_pivot(out.pivot[0]) && is_pivot(out.pivot[1]) && is_pivot(out.pivot[2]);
}

// Eliminates three columns of a front, at `column`: subtracts the products of the columns before them and divides by
// their triangle. L times D is kept beside L, for the columns and the update that follow.
struct Panel {
    double *L, *LD;
    int stride, column;
    const Corner<double>& corner;
    template <int V>
    FROND_INLINE void tile(int row) const {
        double* at = L + column * stride + row;
        Tile<V> a = load_tile<V>(at, stride);
        take_off(a, L + row, LD + column, stride, column);
        for (int v = 0; v < V; ++v) {
            const FourLanes l0 = a.at[0][v] * corner.inverse[0];
            a.at[1][v] -= l0 * corner.below[0];
            const FourLanes l1 = a.at[1][v] * corner.inverse[1];
            a.at[2][v] -= l0 * corner.below[1];
            a.at[2][v] -= l1 * corner.below[2];
            const FourLanes l2 = a.at[2][v] * corner.inverse[2];
            store(l0, at + ROWS * v);
            store(l1, at + stride + ROWS * v);
            store(l2, at + 2 * stride + ROWS * v);
        }
        store_tile(a, LD + column * stride + row, stride);
    }
};

// Computes three columns of the update likewise.
struct Update {
    double* update;
    const double *L, *LD;  // the further rows
    int update_stride, stride, column, count;
    template <int V>
    FROND_INLINE void tile(int row) const {
        double* at = update + column * update_stride + row;
        Tile<V> a = load_tile<V>(at, update_stride);
        take_off(a, L + row, LD + column, stride, count);
        store_tile(a, at, update_stride);
    }
};

int floor_to_rows(int row) {
    return row / ROWS * ROWS;
}

// Adds the rows of NODES nodes in three columns; the count is a constant, so that nothing branches.
template <int NODES>
FROND_INLINE void add_block(const double* from, int stride, double* to, int to_stride) {
    constexpr int COUNT = 3 * NODES, BY_FOURS = COUNT / ROWS * ROWS, BY_TWOS = COUNT / 2 * 2;
    for (int c = 0; c < 3; ++c, from += stride, to += to_stride) {
        for (int i = 0; i < BY_FOURS; i += ROWS)
            store(FourLanes(load<FourLanes>(to + i) + load<FourLanes>(from + i)), to + i);
        if (BY_FOURS < BY_TWOS)
            store(TwoLanes(load<TwoLanes>(to + BY_FOURS) + load<TwoLanes>(from + BY_FOURS)), to + BY_FOURS);
        if (BY_TWOS < COUNT) to[BY_TWOS] += from[BY_TWOS];
    }
}

// Scratch of factorize().
struct Room {
    std::vector<Quad> updates, products;
};

struct FactorizeFronts {
    const FrontPlan& plan;
    const BlockMatrix& A;
    FrontFactor& factor;
    double *updates, *products;
    bool& ok;

    FROND_INLINE void gather(const Front& front, double* columns) const {
        const int stride = stride_of(front);
        const FrontPlan::Entry* entry = plan.entries.data() + front.entry;
        for (int k = 0; k < front.entries; ++k, ++entry) {
            const double* from = A.values.data() + 9 * size_t(entry->slot);
            double* to = columns + entry->to;
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) to[c * stride + r] = entry->is_turned ? from[c + 3 * r] : from[r + 3 * c];
        }
    }

    // Adds three columns of a child's update to the parent's corresponding columns.
    FROND_INLINE void add_columns(const Front& child, int column, const double* from, const Front& front, double* to,
                                  int to_stride, int skipped) const {
        const int stride = padded(child.rows), own = padded(front.own);
        for (int k = column; k < child.rows;) {
            const FrontPlan::Landing& landing = plan.landings[size_t(child.row + k)];
            const int row = landing.to < front.own ? 3 * landing.to : own + 3 * (landing.to - front.own);
            const double* source = from + 3 * k;
            double* target = to + row - skipped;
            int left = landing.count;
            for (; left >= 4; left -= 4, source += 12, target += 12) add_block<4>(source, stride, target, to_stride);
            if (left == 3) add_block<3>(source, stride, target, to_stride);
            if (left == 2) add_block<2>(source, stride, target, to_stride);
            if (left == 1) add_block<1>(source, stride, target, to_stride);
            k += landing.count;
        }
    }

    FROND_INLINE void add_update(const Front& child, const Front& front, double* columns, double* update) const {
        const int stride = padded(child.rows), own = padded(front.own);
        for (int k = 0; k < child.rows; ++k) {
            const int to = plan.landings[size_t(child.row + k)].to;
            const double* from = updates + child.update + size_t(3 * k * stride);
            if (to < front.own)
                add_columns(child, k, from, front, columns + 3 * to * stride_of(front), stride_of(front), 0);
            else
                add_columns(child, k, from, front, update + 3 * (to - front.own) * padded(front.rows),
                            padded(front.rows), own);
        }
    }

    FROND_INLINE bool eliminate(const Front& front, double* L, double* update) const {
        const int stride = stride_of(front), own = padded(front.own);
        for (int column = 0; column < 3 * front.own; column += 3) {
            Tile<1> a = load_tile<1>(L + column * stride + column, stride);
            take_off(a, L + column, products + column, stride, column);
            Corner<double> corner;
            if (!factorize_corner(a, corner)) return false;
            for_rows(floor_to_rows(column), stride, Panel{L, products, stride, column, corner});
            // Rows above the diagonal were computed along with the others.
            for (int c = 0; c < 3; ++c) {
                for (int row = floor_to_rows(column); row <= column + c; ++row) L[(column + c) * stride + row] = 0;
                factor.pivot[3 * front.first + column + c] = corner.pivot[c];
                factor.inverse[3 * front.first + column + c] = corner.inverse[c];
            }
        }
        for (int column = 0; column < 3 * front.rows; column += 3)
            for_rows(floor_to_rows(column), padded(front.rows),
                     Update{update, L + own, products + own, padded(front.rows), stride, column, 3 * front.own});
        return true;
    }

    template <class S>
    FROND_INLINE void run() const {
        ok = false;
        for (const Front& front : plan.fronts) {
            double* columns = numbers_of(factor.columns) + front.columns;
            double* update = updates + front.update;
            std::fill_n(columns, size_t(stride_of(front)) * size_t(3 * front.own), 0.0);
            std::fill_n(update, size_t(padded(front.rows)) * size_t(3 * front.rows), 0.0);
            gather(front, columns);
            for (int c = 0; c < front.children; ++c)
                add_update(plan.fronts[size_t(plan.children[size_t(front.child + c)])], front, columns, update);
            if (!eliminate(front, columns, update)) return;
        }
        ok = true;
    }
};

}  // namespace

bool factorize(const FrontPlan& plan, const BlockMatrix& A, FrontFactor& factor) {
    static thread_local Room room;
    const auto quads = [](size_t numbers) { return (numbers + 3) / 4 + 1; };
    if (room.updates.size() < quads(plan.update_size)) room.updates.resize(quads(plan.update_size));
    if (room.products.size() < quads(plan.largest)) room.products.resize(quads(plan.largest));
    factor.columns.resize(quads(plan.column_size));
    factor.pivot.resize(3 * Eigen::Index(plan.order.size()));
    factor.inverse.resize(factor.pivot.size());
    bool ok = false;
    run_in_lanes(FactorizeFronts{plan, A, factor, numbers_of(room.updates), numbers_of(room.products), ok});
    return ok;
}

}  // namespace frond
