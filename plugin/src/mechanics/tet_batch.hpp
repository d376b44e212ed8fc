// In: tets of several plants, one plant a lane, and their nodes' positions. Out: what TetPass computes for each.
#pragma once

#include "mechanics/batch.hpp"
#include "mechanics/tet_looks.hpp"
#include "mechanics/tet_of_several.hpp"

namespace frond {

// Stiffness blocks of a few tets, before they are added to the matrix.
template <class S>
struct WaitingBlocks {
    static constexpr size_t MOST = 4, BLOCKS = 10;  // tets that one plant takes at once, and blocks of a tet
    S at[MOST][BLOCKS][9];

    FROND_INLINE void put(size_t tet, size_t slot, const Lanes33<S>& k) {
        for (int r = 0; r < 3; ++r) {
            at[tet][slot][r] = k.r[r].x;
            at[tet][slot][r + 3] = k.r[r].y;
            at[tet][slot][r + 6] = k.r[r].z;
        }
    }
    FROND_INLINE void put(size_t tet, const TetStiffnessLanes<S>& k) {
        const FirstCorner<S> first = first_corner(k);
        const Lanes33<S>* const blocks[BLOCKS] = {&first.k00, &first.k10, &k.k11, &first.k20, &k.k21,
                                                  &k.k22,     &first.k30, &k.k31, &k.k32,     &k.k33};
#pragma GCC unroll 10
        for (size_t slot = 0; slot < BLOCKS; ++slot) put(tet, slot, *blocks[slot]);
    }
};

template <class Law>
struct TetBatch {
    const TetElements& elements;
    const double* x;
    const Ahead& ahead;
    double* f;
    BlockMatrix& A;
    std::vector<uint8_t>& filled;  // blocks of A that are filled already
    int* inverted;                 // number of inverted tets, one a lane

    // Adds blocks in the order in which four tets of one plant add theirs.
    template <class S>
    FROND_INLINE void add_up(const WaitingBlocks<S>& waiting, size_t first, size_t count) const {
        for (size_t slot = 0; slot < WaitingBlocks<S>::BLOCKS; ++slot)
            for (size_t t = 0; t < count; ++t) {
                const size_t block = size_t(elements.slots[first + t][slot]);
                const S* from = waiting.at[t][slot];
                double* to = A.values.data() + LANES<S> * 9 * block;
                if (filled[block])
                    for (int i = 0; i < 9; ++i) store(S(load<S>(to + LANES<S> * i) + from[i]), to + LANES<S> * i);
                else
                    for (int i = 0; i < 9; ++i) store(S(S{} + from[i]), to + LANES<S> * i);
                filled[block] = 1;
            }
    }
    template <class S>
    FROND_INLINE void take(size_t e, size_t place, WaitingBlocks<S>& waiting, S& inside_out) const {
        const TetOfSeveral<S> tet(elements, e);
        const TetShareLanes<S> share = tet.share();
        const auto strain = Law::strain(share, tet.edges(x) * share.rest_inverse);
        inside_out += select(Law::inverted(strain), constant<S>(1), S{});
        double damped = ahead.element_damping.empty() ? 0 : ahead.element_damping[e];
        damped += ahead.damping;
        const S by = constant<S>(ahead.step * (ahead.step + damped));
        tet.add_force(share, stress_ahead<Law>(tet, share, strain, ahead, constant<S>(damped)), f);
        waiting.put(place, Law::stiffness(share, strain, Tangent::positive, by));
    }
    template <class S>
    FROND_INLINE void run() const {
        WaitingBlocks<S> waiting;
        S inside_out = {};
        const size_t tets = elements.tets.size();
        for (size_t first = 0; first < tets; first += waiting.MOST) {
            const size_t count = std::min(waiting.MOST, tets - first);
            for (size_t t = 0; t < count; ++t) take(first + t, t, waiting, inside_out);
            add_up(waiting, first, count);
        }
        for (int lane = 0; lane < LANES<S>; ++lane) inverted[lane] = int(inside_out[lane]);
    }
    // BatchMechanics::set_ahead.
    static void set_ahead(const Elements& body, const NumbersInLines& x, const Ahead& ahead, NumbersInLines& f,
                          BlockMatrix& A, std::vector<uint8_t>& filled, NumbersInLines&, int* inverted) {
        const int lanes = lanes_of(body, x);
        filled.assign(size_t(body.pattern.block_count()), 0);
        f.assign(x.size(), 0);
        run_in_lanes(lanes, TetBatch{as_tets(body), x.data(), ahead, f.data(), A, filled, inverted});
        leave_no_gaps(lanes, filled, A);
    }
};

}  // namespace frond
