// Rows of fronts in registers: four rows of one matrix in each, or one row of several matrices, one a lane. The
// algorithms of fronts are written once for both; no product is fused with a sum and sums are taken in the same order,
// so that the numbers are the same on every processor, alone and in lanes.
#pragma once

#include "core/lanes.hpp"
#include "solve/fronts.hpp"

namespace frond {

constexpr int ROWS_AT_ONCE = 4;  // as many as lanes

inline int floor_to_rows(int row) {
    return row / ROWS_AT_ONCE * ROWS_AT_ONCE;
}

// One matrix; any S.
template <class S>
struct RowsOfOne {
    using Number = double;
    using Rows = FourLanes;
    static constexpr int LANES = 1, ROWS = ROWS_AT_ONCE;
    static constexpr int CORNER = 1;  // registers that hold three rows
    FROND_INLINE static Number number(const double* from) { return *from; }
    FROND_INLINE static Number row_of(const Rows* rows, int r) { return rows[0][r]; }
    FROND_INLINE static int first_row(int column) { return floor_to_rows(column); }

    // Calls work.tile<V>(row) for rows begin .. end, both multiples of four.
    template <class Work>
    FROND_INLINE static void for_rows(int begin, int end, const Work& work) {
        int row = begin;
        for (; row + 3 * ROWS <= end; row += 3 * ROWS) work.template tile<3>(row);
        if (row + 2 * ROWS <= end)
            work.template tile<2>(row);
        else if (row < end)
            work.template tile<1>(row);
    }
    // The same for the rows of a front from a column's diagonal on, and for those of its update.
    template <class Work>
    FROND_INLINE static void for_rows_of(const Front& front, int column, const Work& work) {
        for_rows(first_row(column), stride_of(front), work);
    }
    template <class Work>
    FROND_INLINE static void for_rows_of_update(const Front& front, int column, const Work& work) {
        for_rows(first_row(column), padded(front.rows), work);
    }

    // Adds the rows of `nodes` nodes in three columns.
    FROND_INLINE static void add_nodes(const double* from, int stride, double* to, int to_stride, int nodes) {
        for (; nodes >= 4; nodes -= 4, from += 12, to += 12) add_block<4>(from, stride, to, to_stride);
        if (nodes == 3) add_block<3>(from, stride, to, to_stride);
        if (nodes == 2) add_block<2>(from, stride, to, to_stride);
        if (nodes == 1) add_block<1>(from, stride, to, to_stride);
    }
    // The count is a constant, so that nothing branches.
    template <int NODES>
    FROND_INLINE static void add_block(const double* from, int stride, double* to, int to_stride) {
        constexpr int COUNT = 3 * NODES, BY_FOURS = COUNT / ROWS * ROWS, BY_TWOS = COUNT / 2 * 2;
        for (int c = 0; c < 3; ++c, from += stride, to += to_stride) {
            for (int i = 0; i < BY_FOURS; i += ROWS)
                store(FourLanes(load<FourLanes>(to + i) + load<FourLanes>(from + i)), to + i);
            if (BY_FOURS < BY_TWOS)
                store(TwoLanes(load<TwoLanes>(to + BY_FOURS) + load<TwoLanes>(from + BY_FOURS)), to + BY_FOURS);
            if (BY_TWOS < COUNT) to[BY_TWOS] += from[BY_TWOS];
        }
    }

    // Four sums over rows, one for each row of four.
    struct Sums {
        FourLanes of = {};
        FROND_INLINE void add(const double* column, const Sums& x) { of += load<FourLanes>(column) * x.of; }
        FROND_INLINE Number total() const { return (of[0] + of[1]) + (of[2] + of[3]); }
    };
    FROND_INLINE static Sums four_rows(const double* from) { return {load<FourLanes>(from)}; }
};

// Several matrices, one a lane.
template <class S>
struct RowsOfSeveral {
    using Number = S;
    using Rows = S;
    static constexpr int LANES = frond::LANES<S>, ROWS = 1, CORNER = 3;
    FROND_INLINE static Number number(const double* from) { return load<S>(from); }
    FROND_INLINE static Number row_of(const Rows* rows, int r) { return rows[r]; }
    FROND_INLINE static int first_row(int column) { return column; }

    // Calls work.tile<V>(row) for the rows of `nodes` nodes.
    template <class Work>
    FROND_INLINE static void for_rows(int row, int nodes, const Work& work) {
        // Only eight lanes have registers for more than three rows.
        if constexpr (LANES == 8)
            for (; nodes >= 2; nodes -= 2, row += 6) work.template tile<6>(row);
        for (; nodes > 0; --nodes, row += 3) work.template tile<3>(row);
    }
    template <class Work>
    FROND_INLINE static void for_rows_of(const Front& front, int column, const Work& work) {
        for_rows(column, front.own - column / 3, work);
        for_rows(padded(front.own), front.rows, work);
    }
    template <class Work>
    FROND_INLINE static void for_rows_of_update(const Front& front, int column, const Work& work) {
        for_rows(column, front.rows - column / 3, work);
    }

    FROND_INLINE static void add_nodes(const double* from, int stride, double* to, int to_stride, int nodes) {
        for (int c = 0; c < 3; ++c, from += LANES * stride, to += LANES * to_stride)
            for (int i = 0; i < LANES * 3 * nodes; i += LANES) store(S(load<S>(to + i) + load<S>(from + i)), to + i);
    }

    struct Sums {
        S of[ROWS_AT_ONCE] = {};
        FROND_INLINE void add(const double* column, const Sums& x) {
#pragma GCC unroll 4
            for (int r = 0; r < ROWS_AT_ONCE; ++r) of[r] += load<S>(column + LANES * r) * x.of[r];
        }
        FROND_INLINE Number total() const {
            return (of[0] + of[1]) + (of[2] + of[3]);
        }
    };
    FROND_INLINE static Sums four_rows(const double* from) {
        Sums rows;
#pragma GCC unroll 4
        for (int r = 0; r < ROWS_AT_ONCE; ++r) rows.of[r] = load<S>(from + LANES * r);
        return rows;
    }
};

}  // namespace frond
