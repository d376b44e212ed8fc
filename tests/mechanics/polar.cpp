// The rotation nearest to a deformation gradient, compared with Eigen's singular values and by its own properties.
#include "mechanics/polar.hpp"

#include <gtest/gtest.h>

#include "core/decompose.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace polar_tests {

Mat3 rotation_by_svd(const Mat3& F) {
    const SingularParts svd = singular_parts(F);
    const double sign = (svd.U * svd.V.transpose()).determinant() < 0 ? -1 : 1;
    return svd.U * Vec3(1, 1, sign).asDiagonal() * svd.V.transpose();
}

// Returns a gradient with the given principal stretches.
Mat3 stretched(Dice& dice, const Vec3& stretches) {
    return dice.rotation() * stretches.asDiagonal() * dice.rotation();
}

void expect_rotation(const Mat3& R) {
    EXPECT_NEAR((R.transpose() * R - Mat3::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
}

TEST(Polar, AgreesWithSingularValuesOnRandomGradients) {
    Dice dice(1);
    int inverted = 0;
    for (int n = 0; n < 20000; ++n) {
        const Vec3 s(dice.uniform(0.05, 3), dice.uniform(0.05, 3), dice.uniform(-1.5, 3));
        const Mat3 F = stretched(dice, s);
        // If the two smallest values nearly cancel, the nearest rotation is not unique.
        Vec3 sorted = s.cwiseAbs();
        std::sort(sorted.data(), sorted.data() + 3);
        if (sorted[0] * (s.z() < 0 ? -1 : 1) + sorted[1] < 0.01) continue;
        const Polar polar = polar_decomposition(F);
        expect_rotation(polar.rotation);
        ASSERT_NEAR((polar.rotation - rotation_by_svd(F)).norm(), 0, 1e-10) << s.transpose();
        EXPECT_NEAR(polar.trace, (polar.rotation.transpose() * F).trace(), 1e-12 * F.norm());
        EXPECT_EQ(polar.determinant < 0, s.z() < 0);
        inverted += s.z() < 0;
    }
    EXPECT_GT(inverted, 2000);
}

TEST(Polar, TakesAnyScale) {
    Dice dice(2);
    for (double scale : {1e-100, 1e-40, 1e-12, 1e-3, 1e3, 1e12, 1e40}) {
        const Mat3 F = stretched(dice, {1.2, 0.9, 0.7});
        EXPECT_NEAR((polar_decomposition(scale * F).rotation - rotation_by_svd(F)).norm(), 0, 1e-12) << scale;
    }
}

TEST(Polar, GivesARotationAlsoWhereItIsNotUnique) {
    Dice dice(3);
    for (const Vec3& s : {Vec3(1, 1, -1), Vec3(1, 0.5, -0.5), Vec3(1, 0, 0), Vec3(-1, -1, -1), Vec3(0, 0, 0),
                          Vec3(1, 1, 0), Vec3(1, 1e-9, -1e-9), Vec3(1e-9, 1e-9, 1e-9), Vec3(1e6, 1, 1e-6)})
        for (int n = 0; n < 100; ++n) {
            const Mat3 F = stretched(dice, s);
            const Polar polar = polar_decomposition(F);
            expect_rotation(polar.rotation);
            // No other rotation has a larger trace.
            EXPECT_NEAR((polar.rotation.transpose() * F).trace(), (rotation_by_svd(F).transpose() * F).trace(),
                        1e-9 * (F.norm() + 1e-300))
                << s.transpose();
        }
}

TEST(Polar, HandsOnWhatIsNotFinite) {
    Mat3 F = Mat3::Identity();
    F(1, 2) = std::nan("");
    EXPECT_FALSE(polar_decomposition(F).rotation.allFinite());
    F(1, 2) = HUGE_VAL;
    EXPECT_FALSE(polar_decomposition(F).rotation.allFinite());
}

TEST(Polar, KnowsHowFarItIsFromWhereItIsNotUnique) {
    Dice dice(4);
    const Vec3 s(1.3, 0.8, -0.4);
    EXPECT_NEAR(polar_decomposition(stretched(dice, s)).gaps, (1.3 + 0.8) * (1.3 - 0.4) * (0.8 - 0.4), 1e-12);
}

}  // namespace polar_tests

}  // namespace frond::test
