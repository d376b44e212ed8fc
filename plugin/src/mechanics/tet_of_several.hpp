// One T4 tet of several plants at once, one plant a lane: the batched counterpart of FourTets. Each number of a vector
// or matrix is stored once a lane.
#pragma once

#include "mechanics/tet_point.hpp"

namespace frond {

template <class Lanes>
struct TetOfSeveral {
    static constexpr size_t TETS = 1;  // of as many plants as there are lanes
    using S = Lanes;
    const TetElements& elements;
    size_t tet;

    FROND_INLINE TetOfSeveral(const TetElements& elements, size_t tet) : elements(elements), tet(tet) {}

    template <class Value>
    FROND_INLINE S of_each(const Value& value) const {
        return constant<S>(value(tet));
    }
    FROND_INLINE S of_tets(const std::vector<double>& numbers) const { return constant<S>(numbers[tet]); }
    FROND_INLINE Lanes33<S> at_rest() const {
        const double* inverse = rest_inverse(elements, tet, 0, 1).data();
        const auto at = [&](int i) FROND_INLINED { return constant<S>(inverse[i]); };
        return {{{at(0), at(3), at(6)}, {at(1), at(4), at(7)}, {at(2), at(5), at(8)}}};
    }
    FROND_INLINE TetShareLanes<S> share() const {
        const Vec3& axis = elements.grain_axis[tet];
        return {at_rest(),
                of_tets(elements.volume),
                of_tets(elements.lambda),
                of_tets(elements.mu),
                {constant<S>(axis.x()), constant<S>(axis.y()), constant<S>(axis.z())},
                of_tets(elements.grain)};
    }
    FROND_INLINE Lanes33<S> edges(const double* x) const {
        const auto corner = [&](size_t a) FROND_INLINED { return load3<S>(x, 3 * elements.ordered[tet][a]); };
        const Lanes3<S> first = corner(0);
        return transposed(Lanes33<S>{{corner(1) - first, corner(2) - first, corner(3) - first}});
    }
    FROND_INLINE void add_force(const TetShareLanes<S>& share, const Lanes33<S>& P, double* f) const {
        const Lanes33<S> forces = (share.volume * share.rest_inverse) * transposed(P);  // one row a corner
        const Lanes3<S> first = forces.r[0] + forces.r[1] + forces.r[2];
        const Tet& nodes = elements.ordered[tet];
        const auto at = [&](size_t a) FROND_INLINED { return load3<S>(f, 3 * nodes[a]); };
        for (size_t a = 1; a < 4; ++a) store3(at(a) - forces.r[a - 1], f, 3 * nodes[a]);
        store3(at(0) + first, f, 3 * nodes[0]);
    }
};

}  // namespace frond
