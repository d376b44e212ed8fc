// In: matrices of a tree's pattern, one a lane. Out: factors and solutions. tree_factor.cpp has the numbers of a row in
// lanes; here the same numbers are added in the same order.
#include "solve/tree_batch.hpp"

#include <cmath>
#include <limits>

#include "core/lanes.hpp"

namespace frond {

namespace {

constexpr int OWN = 0, TO_PARENT = 36, INVERSE = 72, NUMBERS = 78;  // offsets and count of a pair's numbers

template <class S>
FROND_INLINE const double* entry_at(const BlockMatrix& A, int slot, int i) {
    alignas(LINE) static constexpr double ZERO[MOST_LANES] = {};
    return slot < 0 ? ZERO : A.values.data() + LANES<S> * size_t(9 * slot + i);
}
template <class S>
FROND_INLINE S entry(const BlockMatrix& A, int slot, int i) {
    return load<S>(entry_at<S>(A, slot, i));
}

// Returns a . b, summed in the order of the lanes of a row in tree_factor.cpp.
template <class S>
FROND_INLINE S dot_of_six(const S* a, const S* b) {
    const S even = (a[0] * b[0] + a[2] * b[2]) + a[4] * b[4], odd = (a[1] * b[1] + a[3] * b[3]) + a[5] * b[5];
    return even + odd;
}

// All loops are unrolled: only then do six numbers stay in registers.
struct FactorizeTreeBatch {
    const TreePlan& plan;
    const BlockMatrix& A;
    double* numbers;
    uint8_t* begun;  // one a pair: the elimination of a child has changed it
    unsigned& failed;

    template <class S>
    FROND_INLINE double* of(size_t pair, int first) const {
        return numbers + LANES<S> * (NUMBERS * pair + size_t(first));
    }
    // Returns entry (r, c) of a pair's own block, with the children eliminated so far. Only the upper triangle counts.
    template <class S>
    FROND_INLINE S own_now(size_t i, int r, int c) const {
        const std::array<int, 3>& slots = plan.pairs[i].own;
        return load<S>(begun[i] ? of<S>(i, OWN + SIX * r + c)
                       : r >= 3 ? entry_at<S>(A, slots[2], r - 3 + 3 * (c - 3))
                       : c < 3  ? entry_at<S>(A, slots[0], r + 3 * c)
                                : entry_at<S>(A, slots[1], 3 * r + c - 3));
    }
    // Factorizes a pair's own block to L', with inverse pivots beside it. Returns lanes of `before` with valid pivots.
    template <class S>
    FROND_INLINE S factorize_own(size_t i, S (&own)[SIX][SIX], S (&inverse)[SIX], const S& before) const {
        S sound = before;
        double* at = of<S>(i, OWN);
#pragma GCC unroll 6
        for (int r = 0; r < SIX; ++r)
#pragma GCC unroll 6
            for (int c = r; c < SIX; ++c) own[r][c] = own_now<S>(i, r, c);
#pragma GCC unroll 6
        for (int k = 0; k < SIX; ++k) {
            const S d = own[k][k];
            inverse[k] = 1.0 / d;
            // The pivot is above zero and finite: an infinite one would make this product NaN.
            sound = select(inverse[k] > 0.0, select(d * inverse[k] > 0.0, sound, S{}), S{});
#pragma GCC unroll 6
            for (int r = k + 1; r < SIX; ++r) {
                const S times = own[k][r] * inverse[k];
#pragma GCC unroll 6
                for (int c = r; c < SIX; ++c) own[r][c] -= times * own[k][c];
            }
#pragma GCC unroll 6
            for (int c = 0; c < SIX; ++c) {
                own[k][c] = c > k ? S(own[k][c] * inverse[k]) : S{};
                store(own[k][c], at + LANES<S> * (SIX * k + c));
            }
            store(inverse[k], of<S>(i, INVERSE + k));
        }
        return sound;
    }
    // Eliminates a pair, column by column of its block with the parent.
    template <class S>
    FROND_INLINE void eliminate(size_t i, const S (&own)[SIX][SIX], const S (&inverse)[SIX]) const {
        const TreePlan::Pair& place = plan.pairs[i];
        S C[SIX][SIX], over[SIX][SIX];
#pragma GCC unroll 6
        for (int c = 0; c < SIX; ++c) {
            S y[SIX];
#pragma GCC unroll 6
            for (int r = 0; r < SIX; ++r) y[r] = entry<S>(A, place.link[size_t(r / 3 + c / 3 * 2)], r % 3 + c % 3 * 3);
#pragma GCC unroll 6
            for (int k = 0; k < SIX; ++k) {
#pragma GCC unroll 6
                for (int r = k + 1; r < SIX; ++r) y[r] -= own[k][r] * y[k];
                C[k][c] = y[k];
                over[k][c] = y[k] * inverse[k];
                store(over[k][c], of<S>(i, TO_PARENT + SIX * k + c));
            }
        }
        double* parent = of<S>(size_t(place.parent), OWN);
#pragma GCC unroll 6
        for (int r = 0; r < SIX; ++r)
#pragma GCC unroll 6
            for (int c = r; c < SIX; ++c) {
                S sum = own_now<S>(size_t(place.parent), r, c);
#pragma GCC unroll 6
                for (int k = 0; k < SIX; ++k) sum -= over[k][r] * C[k][c];
                store(sum, parent + LANES<S> * (SIX * r + c));
            }
        begun[place.parent] = 1;
    }
    template <class S>
    FROND_INLINE void run() const {
        S sound = constant<S>(1);
        for (size_t i = plan.pairs.size(); i-- > 0;) {
            S own[SIX][SIX];
            S inverse[SIX];
            sound = factorize_own(i, own, inverse, sound);
            if (plan.pairs[i].parent >= 0) eliminate(i, own, inverse);
        }
        failed = bits_of(sound == 0.0);
    }
};

struct SolveTreeBatch {
    const TreePlan& plan;
    const double* numbers;
    double* y;

    template <class S>
    FROND_INLINE S at(size_t pair, int i) const {
        return load<S>(numbers + LANES<S> * (NUMBERS * pair + size_t(i)));
    }
    template <class S>
    struct Six {
        S at[SIX];
        FROND_INLINE explicit Six(const double* from) {
            for (int k = 0; k < SIX; ++k) at[k] = load<S>(from + LANES<S> * k);
        }
        FROND_INLINE void put(double* to) const {
            for (int k = 0; k < SIX; ++k) store(at[k], to + LANES<S> * k);
        }
    };
    template <class S>
    FROND_INLINE double* of(size_t pair) const {
        return y + LANES<S> * SIX * pair;
    }
    template <class S>
    FROND_INLINE void down() const {
        for (size_t i = plan.pairs.size(); i-- > 0;) {
            Six<S> own(of<S>(i));
#pragma GCC unroll 6
            for (int k = 0; k + 1 < SIX; ++k)
#pragma GCC unroll 6
                for (int c = 0; c < SIX; ++c)
                    if (c != k) own.at[c] -= own.at[k] * at<S>(i, OWN + SIX * k + c);
            own.put(of<S>(i));
            if (plan.pairs[i].parent < 0) continue;
            double* to = of<S>(size_t(plan.pairs[i].parent));
            Six<S> sum(to);
#pragma GCC unroll 6
            for (int k = 0; k < SIX; ++k)
#pragma GCC unroll 6
                for (int c = 0; c < SIX; ++c) sum.at[c] -= own.at[k] * at<S>(i, TO_PARENT + SIX * k + c);
            sum.put(to);
        }
    }
    template <class S>
    FROND_INLINE void up() const {
        for (size_t i = 0; i < plan.pairs.size(); ++i) {
            Six<S> own(of<S>(i));
            for (int k = 0; k < SIX; ++k) own.at[k] *= at<S>(i, INVERSE + k);
            if (plan.pairs[i].parent >= 0) {
                const Six<S> parent(of<S>(size_t(plan.pairs[i].parent)));
#pragma GCC unroll 6
                for (int k = 0; k < SIX; ++k) {
                    const Six<S> row(numbers + LANES<S> * (NUMBERS * i + size_t(TO_PARENT + SIX * k)));
                    own.at[k] -= dot_of_six(parent.at, row.at);
                }
            }
#pragma GCC unroll 6
            for (int k = SIX - 2; k >= 0; --k) {
                const Six<S> row(numbers + LANES<S> * (NUMBERS * i + size_t(OWN + SIX * k)));
                own.at[k] -= dot_of_six(own.at, row.at);
            }
            own.put(of<S>(i));
        }
    }
    template <class S>
    FROND_INLINE void run() const {
        down<S>();
        up<S>();
    }
};

struct FindResiduals {
    const BlockMatrix& A;
    const NumbersInLines &b, &x;
    NumbersInLines& left;
    double* out;
    template <class S>
    FROND_INLINE void run() const {
        const BlockPattern& pattern = *A.pattern;
        left = b;
        for (int j = 0; j < pattern.node_count; ++j) {
            const Lanes3<S> x_j = load3<S>(x.data(), 3 * j);
            Lanes3<S> left_j = load3<S>(left.data(), 3 * j);
            for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
                const int i = pattern.row[size_t(k)];
                const double* a = A.values.data() + LANES<S> * 9 * size_t(k);
                // Blocks are stored by columns, so read as rows this is the transpose.
                const Lanes33<S> over = {{load3<S>(a, 0), load3<S>(a, 3), load3<S>(a, 6)}};
                if (i == j) {
                    left_j = left_j - transposed_times(over, x_j);
                    continue;
                }
                store3(load3<S>(left.data(), 3 * i) - transposed_times(over, x_j), left.data(), 3 * i);
                left_j = left_j - over * load3<S>(x.data(), 3 * i);
            }
            store3(left_j, left.data(), 3 * j);
        }
        S rest = {}, all = {};
        for (int i = 0; i < pattern.node_count; ++i) {
            const Lanes3<S> of_rest = load3<S>(left.data(), 3 * i), of_all = load3<S>(b.data(), 3 * i);
            rest += dot(of_rest, of_rest);
            all += dot(of_all, of_all);
        }
        for (int lane = 0; lane < LANES<S>; ++lane)
            out[lane] = all[lane] > 0     ? std::sqrt(rest[lane] / all[lane])
                        : rest[lane] == 0 ? 0
                                          : std::numeric_limits<double>::infinity();
    }
};

}  // namespace

// Returns the number of lanes of batched matrices.
static int lanes_of(const BlockMatrix& A) {
    return int(A.values.size() / (9 * size_t(A.pattern->block_count())));
}

unsigned factorize(const TreePlan& plan, const BlockMatrix& A, TreeBatch& factor) {
    factor.lanes = lanes_of(A);
    make_room(factor.numbers, size_t(factor.lanes) * NUMBERS * plan.pairs.size());
    unsigned failed = 0;
    factor.begun.assign(plan.pairs.size(), 0);
    run_in_lanes(factor.lanes, FactorizeTreeBatch{plan, A, factor.numbers.data(), factor.begun.data(), failed});
    return failed;
}

void solve(const TreePlan& plan, const TreeBatch& factor, const NumbersInLines& b, NumbersInLines& x) {
    x = b;
    run_in_lanes(factor.lanes, SolveTreeBatch{plan, factor.numbers.data(), x.data()});
}

void relative_residuals(const BlockMatrix& A, const NumbersInLines& b, const NumbersInLines& x, NumbersInLines& left,
                        double* out) {
    run_in_lanes(lanes_of(A), FindResiduals{A, b, x, left, out});
}

}  // namespace frond
