// In: the deformation gradient at a point. Out: energy, stress and stiffness of linear elasticity with displacements
// u = x - x0, equation (1) of the paper: valid for small deflections; a large rotation makes the body swell.
#include "mechanics/tet_row.hpp"
#include "mechanics/warped_stiffness.hpp"

namespace frond {

namespace {

struct Linear {
    static constexpr bool GOES_AHEAD = true;
    static constexpr bool TURNS = false;

    template <class S>
    struct Strain {
        Lanes33<S> F, small;
    };

    template <class S>
    FROND_INLINE static Strain<S> strain(const Lanes33<S>& F) {
        Strain<S> s = {F, constant<S>(0.5) * (F + transposed(F))};
        add_to_diagonal(constant<S>(-1), s.small);
        return s;
    }

    template <class S>
    FROND_INLINE static S energy(const TetShareLanes<S>& tet, const Strain<S>& s) {
        const S swell = trace(s.small);
        return tet.mu * dot(s.small, s.small) + 0.5 * tet.lambda * swell * swell;
    }

    template <class S>
    FROND_INLINE static Lanes33<S> stress(const TetShareLanes<S>& tet, const Strain<S>& s) {
        Lanes33<S> stress = (2.0 * tet.mu) * s.small;
        add_to_diagonal(S(tet.lambda * trace(s.small)), stress);
        return stress;
    }

    template <class S>
    FROND_INLINE static Lanes33<S> identity() {
        Lanes33<S> one = {};
        add_to_diagonal(constant<S>(1), one);
        return one;
    }

    template <class S>
    FROND_INLINE static Lanes33<S> stress_of_change(const TetShareLanes<S>& tet, const Strain<S>&,
                                                    const Lanes33<S>& dF) {
        return warped_stress(tet, identity<S>(), dF);
    }

    // The stiffness is constant, so both tangents are the same.
    template <class S>
    FROND_INLINE static TetStiffnessLanes<S> stiffness(const TetShareLanes<S>& tet, const Strain<S>&, Tangent,
                                                       const S& scale) {
        return warped_stiffness(tet, identity<S>(), scale);
    }

    template <class S>
    FROND_INLINE static auto inverted(const Strain<S>& s) {
        return dot(s.F.r[0], cross(s.F.r[1], s.F.r[2])) < 0.0;
    }
};

}  // namespace

Mechanics tet_linear(int order) {
    Mechanics row = batched_tet_row<Linear>("tet_linear", order);
    row.turns = false;
    return row;
}

}  // namespace frond
