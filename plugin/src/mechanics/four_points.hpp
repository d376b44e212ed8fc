// The four integration points of a quadratic tet at once.
//
// At point q a node's weight in a corner is C if it is that corner, E if it is the middle of one of its edges, and M
// more if it is the node between that corner and corner q (see tet_element.hpp). So blocks k_q between corners i and j
// at point q are summed to the nodes with these weights:
//   C, E: the sum over all points T_ij = sum of k_q,   M: single points.
#pragma once

#include "mechanics/nine.hpp"
#include "mechanics/tet_point.hpp"

namespace frond {

struct FourPoints {
    static constexpr size_t TETS = 1;  // whose four points are the lanes
    static constexpr double C = QuadraticTetElement::CORNER, E = QuadraticTetElement::EDGE,
                            M = QuadraticTetElement::MORE;
    using S = FourLanes;
    const TetElements& elements;
    size_t tet;

    FROND_INLINE FourPoints(const TetElements& elements, size_t tet) : elements(elements), tet(tet) {}

    FROND_INLINE S of_tets(const std::vector<double>& numbers) const { return constant<S>(numbers[tet]); }
    template <class Mask>
    FROND_INLINE int count_tets(const Mask& mask) const {
        return any(mask);
    }
    FROND_INLINE double sum(const S& of_each) const { return (of_each[0] + of_each[1]) + (of_each[2] + of_each[3]); }
    FROND_INLINE TetShareLanes<S> share() const {
        const auto at = [&](int i) FROND_INLINED {
            return gather<S>([&](int q) { return rest_inverse(elements, tet, q, 4).data()[i]; });
        };
        const auto axis = [&](int r) FROND_INLINED {
            return gather<S>([&](int q) { return elements.grain_axis[4 * tet + size_t(q)][r]; });
        };
        const S volume = gather<S>([&](int q) { return elements.point_volume[4 * tet + size_t(q)]; });
        return {{{{at(0), at(3), at(6)}, {at(1), at(4), at(7)}, {at(2), at(5), at(8)}}},
                volume,
                of_tets(elements.lambda),
                of_tets(elements.mu),
                {axis(0), axis(1), axis(2)},
                of_tets(elements.grain)};
    }
    // Takes values at nodes; returns the differences from the first corner at each point, as columns.
    FROND_INLINE Lanes33<S> edges(const double* x) const {
        const QuadraticTet& nodes = elements.nodes.of_tet[tet];
        Lanes33<S> out;
        for (int r = 0; r < 3; ++r) {
            double at[10];
            for (size_t n = 0; n < 10; ++n) at[n] = x[3 * nodes[n] + r] - x[3 * nodes[0] + r];
            S corner[4];
            for (int c = 0; c < 4; ++c) {
                double sum = C * at[c];
                for (int d = 0; d < 4; ++d)
                    if (d != c) sum += E * at[TET_BETWEEN[c][d]];
                corner[c] = sum + M * S{at[TET_BETWEEN[c][0]], at[TET_BETWEEN[c][1]], at[TET_BETWEEN[c][2]],
                                        at[TET_BETWEEN[c][3]]};
            }
            out.r[r] = {corner[1] - corner[0], corner[2] - corner[0], corner[3] - corner[0]};
        }
        return out;
    }
    // Adds the corners' forces -V P b by the stress P to the nodes.
    FROND_INLINE void add_force(const TetShareLanes<S>& share, const Lanes33<S>& P, VecX& f) const {
        const QuadraticTet& nodes = elements.nodes.of_tet[tet];
        const Lanes33<S> forces = -((share.volume * share.rest_inverse) * transposed(P));  // one row a corner
        const auto add = [&](int r, const S& f1, const S& f2, const S& f3) FROND_INLINED {
            const S corner[4] = {-(f1 + f2 + f3), f1, f2, f3};
            double total[4];
            for (int c = 0; c < 4; ++c) total[c] = (corner[c][0] + corner[c][1]) + (corner[c][2] + corner[c][3]);
            for (int c = 0; c < 4; ++c) f.data()[3 * nodes[size_t(c)] + r] += C * total[c] + M * corner[c][c];
            for (size_t k = 0; k < 6; ++k) {
                const int a = TET_EDGES[k][0], b = TET_EDGES[k][1];
                f.data()[3 * nodes[4 + k] + r] += E * (total[a] + total[b]) + M * (corner[a][b] + corner[b][a]);
            }
        };
        add(0, forces.r[0].x, forces.r[1].x, forces.r[2].x);
        add(1, forces.r[0].y, forces.r[1].y, forces.r[2].y);
        add(2, forces.r[0].z, forces.r[1].z, forces.r[2].z);
    }

    // Between corners i and j: k_q at each point q, their sum T, and E^2 T / 2 + E M k_q.
    struct Between {
        Nine k[4], all, half[4];
        FROND_INLINE explicit Between(const Lanes33<S>& lanes) {
            lane_by_lane(lanes, k);
            all = (k[0] + k[1]) + (k[2] + k[3]);
            for (int q = 0; q < 4; ++q) half[q] = (0.5 * E * E) * all + (E * M) * k[q];
        }
        Between() = default;
    };
    FROND_INLINE void add_stiffness(const TetStiffnessLanes<S>& s, BlockMatrix& K) const {
        Between of[4][4];
        const FirstCorner<S> first = first_corner(s);
        const Lanes33<S>* below[] = {&first.k10, &s.k11, &first.k20, &s.k21, &s.k22,
                                     &first.k30, &s.k31, &s.k32,     &s.k33};
        of[0][0] = Between(first.k00);
#pragma GCC unroll 1
        for (int i = 1, n = 0; i < 4; ++i)
#pragma GCC unroll 1
            for (int j = 0; j <= i; ++j, ++n) {
                of[i][j] = Between(*below[n]);
                if (i != j) of[j][i] = Between(transposed(*below[n]));
            }
        const int* slot = elements.quadratic_slots[tet].data();
        const auto add = [&](const Nine& block) FROND_INLINED { add_to(K.values.data() + 9 * size_t(*slot++), block); };
#pragma GCC unroll 1
        for (int a = 0; a < 4; ++a)
#pragma GCC unroll 1
            for (int b = 0; b <= a; ++b) {
                const Between& k = of[a][b];
                Nine block = (C * C) * k.all + (C * M) * (k.k[a] + k.k[b]);
                if (a == b) block = block + (M * M) * k.k[a];
                add(block);
            }
#pragma GCC unroll 1
        for (int n = 0; n < 6; ++n) {
            const int a = TET_EDGES[size_t(n)][0], b = TET_EDGES[size_t(n)][1];
#pragma GCC unroll 1
            for (int c = 0; c < 4; ++c) add(edge_and_corner(of, a, b, c));
#pragma GCC unroll 1
            for (int m = 0; m <= n; ++m) {
                const int c = TET_EDGES[size_t(m)][0], d = TET_EDGES[size_t(m)][1];
                add((ends(of, a, b, c, d) + ends(of, a, b, d, c)) + (ends(of, b, a, c, d) + ends(of, b, a, d, c)));
            }
        }
    }
    // Returns the block between the middle of edge ab and corner c.
    FROND_INLINE static Nine edge_and_corner(const Between (&of)[4][4], int a, int b, int c) {
        Nine block = (C * E) * (of[a][c].all + of[b][c].all) + (C * M) * (of[a][c].k[b] + of[b][c].k[a]) +
                     (M * E) * (of[a][c].k[c] + of[b][c].k[c]);
        if (b == c) block = block + (M * M) * of[a][c].k[c];
        if (a == c) block = block + (M * M) * of[b][c].k[c];
        return block;
    }
    // Returns the share of corners a and c in the block between the middles of edges ab and cd.
    FROND_INLINE static Nine ends(const Between (&of)[4][4], int a, int b, int c, int d) {
        const Between& k = of[a][c];
        const Nine block = k.half[b] + k.half[d];
        return b == d ? block + (M * M) * k.k[b] : block;
    }
};

}  // namespace frond
