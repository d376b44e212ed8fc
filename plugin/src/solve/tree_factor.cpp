// In: symmetric matrices over pairs of nodes connected as a tree. Out: their factors L D L^T and solutions.
//
// A tree eliminated from the tips to the root has no fill (Parter 1961, "The use of linear graphs in Gauss
// elimination"), so that the factor is dense blocks of six by six: each pair's own, and one to its parent.
//
// One matrix has the six numbers of a row side by side in registers; several have a register for each number, with one
// matrix a lane. The algorithm takes a row by strips, which are the whole row or one number of it.
#include "solve/tree_factor.hpp"

#include "core/lanes.hpp"

namespace frond {

namespace {

// A row of one matrix.
template <class S>
struct Row;
template <>
struct Row<TwoLanes> {
    TwoLanes a, b, c;
    FROND_INLINE static Row from(const double* at) {
        return {load<TwoLanes>(at), load<TwoLanes>(at + 2), load<TwoLanes>(at + 4)};
    }
    template <class Value>
    FROND_INLINE static Row of(const Value& value) {
        return {TwoLanes{value(0), value(1)}, TwoLanes{value(2), value(3)}, TwoLanes{value(4), value(5)}};
    }
    FROND_INLINE void put(double* to) const { store(a, to), store(b, to + 2), store(c, to + 4); }
    FROND_INLINE double operator[](int i) const { return i < 2 ? a[i] : i < 4 ? b[i - 2] : c[i - 4]; }
    FROND_INLINE Row operator-(const Row& x) const { return {a - x.a, b - x.b, c - x.c}; }
    FROND_INLINE Row operator*(double by) const { return {a * by, b * by, c * by}; }
    FROND_INLINE double dot(const Row& x) const {
        const TwoLanes sum = (a * x.a + b * x.b) + c * x.c;
        return sum[0] + sum[1];
    }
};
template <>
struct Row<FourLanes> {
    FourLanes a;
    TwoLanes c;
    FROND_INLINE static Row from(const double* at) { return {load<FourLanes>(at), load<TwoLanes>(at + 4)}; }
    template <class Value>
    FROND_INLINE static Row of(const Value& value) {
        return {FourLanes{value(0), value(1), value(2), value(3)}, TwoLanes{value(4), value(5)}};
    }
    FROND_INLINE void put(double* to) const { store(a, to), store(c, to + 4); }
    FROND_INLINE double operator[](int i) const { return i < 4 ? a[i] : c[i - 4]; }
    FROND_INLINE Row operator-(const Row& x) const { return {a - x.a, c - x.c}; }
    FROND_INLINE Row operator*(double by) const { return {a * by, c * by}; }
    FROND_INLINE double dot(const Row& x) const {
        const FourLanes by = a * x.a;
        const TwoLanes sum = (TwoLanes{by[0], by[1]} + TwoLanes{by[2], by[3]}) + c * x.c;
        return sum[0] + sum[1];
    }
};

// An entry of a matrix: a number of a block, which is stored by columns.
struct Entry {
    int slot, number;
};
// Returns entry (r, c) of a pair's own block; only its upper triangle counts.
FROND_INLINE Entry own_entry(const TreePlan::Pair& pair, int r, int c) {
    if (r >= 3) return {pair.own[2], r - 3 + 3 * (c % 3)};
    return c < 3 ? Entry{pair.own[0], r + 3 * c} : Entry{pair.own[1], 3 * r + c - 3};
}
FROND_INLINE Entry link_entry(const TreePlan::Pair& pair, int r, int c) {
    return {pair.link[size_t(r / 3 + c / 3 * 2)], r % 3 + c % 3 * 3};
}

// Numbers of one matrix: a strip is a row.
template <class S>
struct OfOne {
    using Number = double;
    using Strip = Row<S>;
    static constexpr int LANES = 1, STRIPS = 1;
    FROND_INLINE static int first_from(int) { return 0; }
    FROND_INLINE static Number number(const Strip* row, int c) { return (*row)[c]; }
    template <class Where>
    FROND_INLINE static Strip entries(const BlockMatrix& A, const Where& where, int) {
        return Strip::of([&](int c) FROND_INLINED {
            const Entry entry = where(c);
            return entry.slot < 0 ? 0.0 : A.values[size_t(9 * entry.slot + entry.number)];
        });
    }
    FROND_INLINE static Strip strip(const double* row, int) { return Strip::from(row); }
    FROND_INLINE static void put(const Strip& strip, double* row, int) { strip.put(row); }
    // A pair's six numbers.
    struct Vector {
        double* at;
        FROND_INLINE explicit Vector(double* at) : at(at) {}
        FROND_INLINE Number& operator[](int k) { return at[k]; }
        FROND_INLINE void take_off(Number times, const double* row, int) {
            (Strip::from(at) - Strip::from(row) * times).put(at);
        }
        FROND_INLINE Number dot(const double* row) const { return Strip::from(at).dot(Strip::from(row)); }
        FROND_INLINE void put() const {}
    };
};

// Numbers of several matrices, one a lane: a strip is one number of a row.
template <class S>
struct OfSeveral {
    using Number = S;
    using Strip = S;
    static constexpr int LANES = frond::LANES<S>, STRIPS = SIX;
    FROND_INLINE static int first_from(int column) { return column; }
    FROND_INLINE static Number number(const Strip* row, int c) { return row[c]; }
    template <class Where>
    FROND_INLINE static Strip entries(const BlockMatrix& A, const Where& where, int c) {
        alignas(LINE) static constexpr double ZERO[MOST_LANES] = {};
        const Entry entry = where(c);
        return load<S>(entry.slot < 0 ? ZERO : A.values.data() + LANES * size_t(9 * entry.slot + entry.number));
    }
    FROND_INLINE static Strip strip(const double* row, int c) { return load<S>(row + LANES * c); }
    FROND_INLINE static void put(const Strip& strip, double* row, int c) { store(strip, row + LANES * c); }
    struct Vector {
        double* to;
        S at[SIX];
        FROND_INLINE explicit Vector(double* from) : to(from) {
            for (int c = 0; c < SIX; ++c) at[c] = strip(from, c);
        }
        FROND_INLINE Number& operator[](int k) { return at[k]; }
        // `own` is the place of `times`, where the row is zero.
        FROND_INLINE void take_off(const Number& times, const double* row, int own) {
#pragma GCC unroll 6
            for (int c = 0; c < SIX; ++c)
                if (c != own) at[c] -= times * strip(row, c);
        }
        // Sums in the order of a row's registers.
        FROND_INLINE Number dot(const double* row) const {
            S by[SIX];
            for (int c = 0; c < SIX; ++c) by[c] = at[c] * strip(row, c);
            return ((by[0] + by[2]) + by[4]) + ((by[1] + by[3]) + by[5]);
        }
        FROND_INLINE void put() const {
            for (int c = 0; c < SIX; ++c) OfSeveral::put(at[c], to, c);
        }
    };
};

// All loops are unrolled: only then do six numbers stay in registers.
template <template <class> class Of>
struct FactorizeTree {
    const TreePlan& plan;
    const BlockMatrix& A;
    TreeFactor& factor;
    unsigned& failed;

    template <class O>
    FROND_INLINE double* row(size_t pair, int first, int r) const {
        return factor.numbers.data() + O::LANES * (TreeFactor::NUMBERS * pair + size_t(first + SIX * r));
    }
    // Returns a strip of a pair's own block, with the children eliminated so far.
    template <class O>
    FROND_INLINE typename O::Strip own_now(size_t i, int r, int s) const {
        if (factor.begun[i]) return O::strip(row<O>(i, TreeFactor::OWN, r), s);
        return O::entries(
            A, [&](int c) FROND_INLINED { return own_entry(plan.pairs[i], r, c); }, s);
    }
    // Factorizes a pair's own block to L' and D.
    template <class O>
    FROND_INLINE void factorize_own(size_t i, typename O::Strip (&own)[SIX][O::STRIPS],
                                    typename O::Number (&inverse)[SIX], typename O::Number& sound) const {
        using Number = typename O::Number;
#pragma GCC unroll 6
        for (int r = 0; r < SIX; ++r)
#pragma GCC unroll 6
            for (int s = O::first_from(r); s < O::STRIPS; ++s) own[r][s] = own_now<O>(i, r, s);
#pragma GCC unroll 6
        for (int k = 0; k < SIX; ++k) {
            const Number d = O::number(own[k], k);
            inverse[k] = 1.0 / d;
            // The pivot is above zero and finite: an infinite one would make this product NaN.
            sound = select(inverse[k] > 0.0, select(d * inverse[k] > 0.0, sound, Number{}), Number{});
#pragma GCC unroll 6
            for (int r = k + 1; r < SIX; ++r) {
                const Number times = O::number(own[k], r) * inverse[k];
#pragma GCC unroll 6
                for (int s = O::first_from(r); s < O::STRIPS; ++s) own[r][s] = own[r][s] - own[k][s] * times;
            }
            double* to = row<O>(i, TreeFactor::OWN, k);
#pragma GCC unroll 6
            for (int s = O::first_from(k); s < O::STRIPS; ++s) {
                own[k][s] = own[k][s] * inverse[k];
                O::put(own[k][s], to, s);
            }
#pragma GCC unroll 6
            for (int c = 0; c <= k; ++c) store(Number{}, to + O::LANES * c);
            store(inverse[k], row<O>(i, TreeFactor::INVERSE, 0) + O::LANES * k);
            if constexpr (O::LANES == 1) factor.pivot[Eigen::Index(SIX * i) + k] = d;
        }
    }
    // Eliminates a pair with its block C to the parent, strip by strip: takes C' A^-1 C off the parent's own block.
    template <class O>
    FROND_INLINE void eliminate(size_t i, const typename O::Strip (&own)[SIX][O::STRIPS],
                                const typename O::Number (&inverse)[SIX]) const {
        const TreePlan::Pair& place = plan.pairs[i];
        typename O::Strip C[SIX][O::STRIPS], over[SIX][O::STRIPS];
#pragma GCC unroll 6
        for (int s = 0; s < O::STRIPS; ++s) {
            typename O::Strip y[SIX];
#pragma GCC unroll 6
            for (int r = 0; r < SIX; ++r)
                y[r] = O::entries(
                    A, [&](int c) FROND_INLINED { return link_entry(place, r, c); }, s);
#pragma GCC unroll 6
            for (int k = 0; k < SIX; ++k) {
#pragma GCC unroll 6
                for (int r = k + 1; r < SIX; ++r) y[r] = y[r] - y[k] * O::number(own[k], r);
                C[k][s] = y[k];
                over[k][s] = y[k] * inverse[k];
                O::put(over[k][s], row<O>(i, TreeFactor::TO_PARENT, k), s);
            }
        }
#pragma GCC unroll 6
        for (int r = 0; r < SIX; ++r)
#pragma GCC unroll 6
            for (int s = O::first_from(r); s < O::STRIPS; ++s) {
                typename O::Strip sum = own_now<O>(size_t(place.parent), r, s);
#pragma GCC unroll 6
                for (int k = 0; k < SIX; ++k) sum = sum - C[k][s] * O::number(over[k], r);
                O::put(sum, row<O>(size_t(place.parent), TreeFactor::OWN, r), s);
            }
        factor.begun[size_t(place.parent)] = 1;
    }
    template <class S>
    FROND_INLINE void run() const {
        using O = Of<S>;
        typename O::Number sound = 1.0 + typename O::Number{};
        for (size_t i = plan.pairs.size(); i-- > 0;) {
            typename O::Strip own[SIX][O::STRIPS];
            typename O::Number inverse[SIX];
            factorize_own<O>(i, own, inverse, sound);
            if (plan.pairs[i].parent >= 0) eliminate<O>(i, own, inverse);
        }
        failed = bits_of(sound == 0.0);
    }
};

template <template <class> class Of>
struct SolveTree {
    const TreePlan& plan;
    const TreeFactor& factor;
    double* y;

    template <class O>
    FROND_INLINE const double* row(size_t pair, int first, int r) const {
        return factor.numbers.data() + O::LANES * (TreeFactor::NUMBERS * pair + size_t(first + SIX * r));
    }
    template <class O>
    FROND_INLINE typename O::Vector of(size_t pair) const {
        return typename O::Vector(y + O::LANES * SIX * pair);
    }
    template <class O>
    FROND_INLINE void down() const {
        for (size_t i = plan.pairs.size(); i-- > 0;) {
            typename O::Vector own = of<O>(i);
#pragma GCC unroll 6
            for (int k = 0; k + 1 < SIX; ++k) own.take_off(own[k], row<O>(i, TreeFactor::OWN, k), k);
            own.put();
            if (plan.pairs[i].parent < 0) continue;
            typename O::Vector parent = of<O>(size_t(plan.pairs[i].parent));
#pragma GCC unroll 6
            for (int k = 0; k < SIX; ++k) parent.take_off(own[k], row<O>(i, TreeFactor::TO_PARENT, k), -1);
            parent.put();
        }
    }
    template <class O>
    FROND_INLINE void up() const {
        for (size_t i = 0; i < plan.pairs.size(); ++i) {
            typename O::Vector own = of<O>(i);
            const double* inverse = row<O>(i, TreeFactor::INVERSE, 0);
            for (int k = 0; k < SIX; ++k) own[k] = own[k] * load<typename O::Number>(inverse + O::LANES * k);
            if (plan.pairs[i].parent >= 0) {
                const typename O::Vector parent = of<O>(size_t(plan.pairs[i].parent));
#pragma GCC unroll 6
                for (int k = 0; k < SIX; ++k) own[k] = own[k] - parent.dot(row<O>(i, TreeFactor::TO_PARENT, k));
            }
#pragma GCC unroll 6
            for (int k = SIX - 2; k >= 0; --k) own[k] = own[k] - own.dot(row<O>(i, TreeFactor::OWN, k));
            own.put();
        }
    }
    template <class S>
    FROND_INLINE void run() const {
        down<Of<S>>();
        up<Of<S>>();
    }
};

}  // namespace

unsigned factorize(const TreePlan& plan, const BlockMatrix& A, TreeFactor& factor) {
    factor.lanes = A.lanes();
    make_room(factor.numbers, size_t(factor.lanes) * TreeFactor::NUMBERS * plan.pairs.size());
    factor.begun.assign(plan.pairs.size(), 0);
    unsigned failed = 0;
    if (factor.lanes == 1) {
        factor.pivot.resize(SIX * Eigen::Index(plan.pairs.size()));
        run_in_lanes(FactorizeTree<OfOne>{plan, A, factor, failed});
    } else {
        run_in_lanes(factor.lanes, FactorizeTree<OfSeveral>{plan, A, factor, failed});
    }
    return failed;
}

void solve(const TreePlan& plan, const TreeFactor& factor, double* x) {
    if (factor.lanes == 1)
        run_in_lanes(SolveTree<OfOne>{plan, factor, x});
    else
        run_in_lanes(factor.lanes, SolveTree<OfSeveral>{plan, factor, x});
}

}  // namespace frond
