// Four T4 tets at once.
#pragma once

#include "mechanics/nine.hpp"
#include "mechanics/tet_point.hpp"

namespace frond {

struct FourTets {
    static constexpr size_t TETS = 4;  // one a lane
    using S = FourLanes;
    const TetElements& elements;
    size_t tet[TETS];  // the last one is repeated past the end
    int count;

    FROND_INLINE FourTets(const TetElements& elements, size_t first)
        : elements(elements), count(int(std::min(TETS, elements.tets.size() - first))) {
        for (int lane = 0; lane < int(TETS); ++lane) tet[lane] = first + size_t(std::min(lane, count - 1));
    }

    template <class Value>
    FROND_INLINE S of_each(const Value& value) const {
        return gather<S>([&](int l) { return value(tet[l]); });
    }
    FROND_INLINE S of_tets(const std::vector<double>& numbers) const {
        return of_each([&](size_t e) { return numbers[e]; });
    }
    template <class Mask>
    FROND_INLINE int count_tets(const Mask& mask) const {
        int sum = 0;
        for (int l = 0; l < count; ++l) sum += mask[l] != 0;
        return sum;
    }
    FROND_INLINE double sum(const S& of_each) const {
        double sum = 0;
        for (int l = 0; l < count; ++l) sum += of_each[l];
        return sum;
    }
    FROND_INLINE Lanes33<S> at_rest() const {
        const double* inverse[TETS];
        for (size_t l = 0; l < TETS; ++l) inverse[l] = rest_inverse(elements, tet[l], 0, 1).data();
        const auto at = [&](int i) FROND_INLINED { return gather<S>([&](int l) { return inverse[l][i]; }); };
        return {{{at(0), at(3), at(6)}, {at(1), at(4), at(7)}, {at(2), at(5), at(8)}}};
    }
    FROND_INLINE TetShareLanes<S> share() const {
        const auto axis = [&](int r) FROND_INLINED {
            return of_each([&](size_t e) { return elements.grain_axis[e][r]; });
        };
        return {at_rest(),
                of_tets(elements.volume),
                of_tets(elements.lambda),
                of_tets(elements.mu),
                {axis(0), axis(1), axis(2)},
                of_tets(elements.grain)};
    }
    // Takes values at nodes; returns the differences from the first corner, as columns.
    FROND_INLINE Lanes33<S> edges(const double* x) const {
        Lanes33<S> out;
        for (int r = 0; r < 3; ++r) {
            const auto corner = [&](size_t a) FROND_INLINED {
                return gather<S>([&](int l) { return x[3 * elements.ordered[tet[l]][a] + r]; });
            };
            const S first = corner(0);
            out.r[r] = {corner(1) - first, corner(2) - first, corner(3) - first};
        }
        return out;
    }
    // Adds the nodes' forces -V P b by the stress P; they add up to zero.
    FROND_INLINE void add_force(const TetShareLanes<S>& share, const Lanes33<S>& P, VecX& f) const {
        const Lanes33<S> forces = (share.volume * share.rest_inverse) * transposed(P);  // one row a corner
        const Lanes3<S> first = forces.r[0] + forces.r[1] + forces.r[2];
        for (int l = 0; l < count; ++l) {
            const Tet& nodes = elements.ordered[tet[l]];
            const auto add = [&](size_t a, const Lanes3<S>& force, double sign) FROND_INLINED {
                double* to = f.data() + 3 * nodes[a];
                to[0] += sign * force.x[l], to[1] += sign * force.y[l], to[2] += sign * force.z[l];
            };
            for (size_t a = 1; a < 4; ++a) add(a, forces.r[a - 1], -1);
            add(0, first, 1);
        }
    }
    FROND_INLINE void add_block(size_t slot, const Lanes33<S>& k, BlockMatrix& K) const {
        Nine blocks[TETS];
        lane_by_lane(k, blocks);
        for (int l = 0; l < count; ++l) add_to(K.values.data() + 9 * size_t(elements.slots[tet[l]][slot]), blocks[l]);
    }
    FROND_INLINE void add_stiffness(const TetStiffnessLanes<S>& k, BlockMatrix& K) const {
        const FirstCorner<S> first = first_corner(k);
        add_block(0, first.k00, K);
        add_block(1, first.k10, K);
        add_block(2, k.k11, K);
        add_block(3, first.k20, K);
        add_block(4, k.k21, K);
        add_block(5, k.k22, K);
        add_block(6, first.k30, K);
        add_block(7, k.k31, K);
        add_block(8, k.k32, K);
        add_block(9, k.k33, K);
    }
};

}  // namespace frond
