// A material law as plugin/manual/extending.md adds one: a struct that is made a row, without any other change.
#include <gtest/gtest.h>

#include "mechanics/tet_row.hpp"
#include "support/dense.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace own_law_tests {

// St. Venant and Kirchhoff's solid: with E = (F^T F - 1) / 2,
//   W = mu E:E + lambda/2 tr(E)^2,  stress F S with S = 2 mu E + lambda tr(E).
struct SaintVenant {
    static constexpr bool GOES_AHEAD = false;

    template <class S>
    struct Strain {
        Lanes33<S> F, E;
    };

    template <class S>
    FROND_INLINE static Strain<S> strain(const Lanes33<S>& F) {
        Strain<S> s = {F, constant<S>(0.5) * transposed_times(F, F)};
        add_to_diagonal(constant<S>(-0.5), s.E);
        return s;
    }

    template <class S>
    FROND_INLINE static S energy(const TetShareLanes<S>& tet, const Strain<S>& s) {
        return tet.mu * dot(s.E, s.E) + 0.5 * tet.lambda * trace(s.E) * trace(s.E);
    }

    template <class S>
    FROND_INLINE static Lanes33<S> pull(const TetShareLanes<S>& tet, const Strain<S>& s) {
        Lanes33<S> pull = (2.0 * tet.mu) * s.E;
        add_to_diagonal(S(tet.lambda * trace(s.E)), pull);
        return pull;
    }
    template <class S>
    FROND_INLINE static Lanes33<S> stress(const TetShareLanes<S>& tet, const Strain<S>& s) {
        return s.F * pull(tet, s);
    }

    // Between corners a and b, with the rows of the rest inverse as gradients g:
    //   V (lambda Fg_a Fg_b^T + mu Fg_b Fg_a^T + mu (g_a.g_b) F F^T) + V (g_a.S g_b) 1; the last part may be negative.
    template <class S>
    FROND_INLINE static TetStiffnessLanes<S> stiffness(const TetShareLanes<S>& tet, const Strain<S>& s, Tangent tangent,
                                                       const S& scale) {
        const Lanes33<S>& g = tet.rest_inverse;
        const Lanes33<S> Fg = g * transposed(s.F), FF = s.F * transposed(s.F), held = pull(tet, s);
        const S V = scale * tet.volume;
        const auto block = [&](int a, int b) FROND_INLINED {
            Lanes33<S> k = outer(Fg.r[a], S(V * tet.lambda) * Fg.r[b]) + outer(Fg.r[b], S(V * tet.mu) * Fg.r[a]) +
                           S(V * tet.mu * dot(g.r[a], g.r[b])) * FF;
            if (tangent == Tangent::exact) add_to_diagonal(S(V * dot(g.r[a], held * g.r[b])), k);
            return k;
        };
        return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
    }

    template <class S>
    FROND_INLINE static auto inverted(const Strain<S>& s) {
        return dot(s.F.r[0], cross(s.F.r[1], s.F.r[2])) < 0.0;
    }
};

struct OwnLaw : testing::TestWithParam<int> {
    const Mechanics row = tet_row<SaintVenant>("saint_venant", GetParam(), true);
    const TetElements elements = make_tet_elements(box_model(1, 1, 2, {1, 1, 2}), nullptr, GetParam());
};
INSTANTIATE_TEST_SUITE_P(Mechanics, OwnLaw, testing::Values(1, 2));

TEST_P(OwnLaw, HasForcesAndStiffnessThatAreDerivativesOfItsEnergy) {
    constexpr double H = 1e-6;
    Dice dice(5);
    VecX x = elements.rest_positions + dice.vector(elements.rest_positions.size(), 0.1);
    const auto force = [&] {
        VecX f = VecX::Zero(x.size());
        row.add_force(elements, x, f);
        return f;
    };
    BlockMatrix K;
    K.set_pattern(elements.pattern);
    K.set_zero();
    row.add_stiffness(elements, x, Tangent::exact, 1, K);
    const Eigen::MatrixXd stiffness = dense(K);
    const VecX f = force();
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double middle = x[i];
        x[i] = middle + H;
        const double energy_up = row.energy(elements, x);
        const VecX up = force();
        x[i] = middle - H;
        const double energy_down = row.energy(elements, x);
        const VecX down = force();
        x[i] = middle;
        EXPECT_NEAR(f[i], -(energy_up - energy_down) / (2 * H), 1e-6 * f.norm());
        EXPECT_NEAR((stiffness.col(i) + (up - down) / (2 * H)).norm(), 0, 1e-7 * stiffness.norm());
    }
}

TEST_P(OwnLaw, HasAPositiveStiffness) {
    Dice dice(6);
    const VecX x = elements.rest_positions + dice.vector(elements.rest_positions.size(), 0.3);
    BlockMatrix K;
    K.set_pattern(elements.pattern);
    K.set_zero();
    row.add_stiffness(elements, x, Tangent::positive, 1, K);
    const VecX values = eigenvalues_of(dense(K));
    EXPECT_GE(values.minCoeff(), -1e-12 * values.maxCoeff());
}

}  // namespace own_law_tests
}  // namespace frond::test
