// In: the gradient of deformation at a point. Out: energy, stress and stiffness of linear elasticity with displacements
// u = x - x0, equation (1) of the paper: right for small deflections, and a large turn makes the body swell.
#include "mechanics/tet_row.hpp"
#include "mechanics/warped_stiffness.hpp"

namespace frond {

namespace {

struct Linear {
    struct Strain {
        Mat3 F;
        Mat3 small() const { return 0.5 * (F + F.transpose()) - Mat3::Identity(); }
    };
    static Strain strain(const TetShare&, const Mat3& F) { return {F}; }

    static double energy(const TetShare& tet, const Strain& s) {
        const Mat3 small = s.small();
        const double trace = small.trace();
        return tet.mu * small.squaredNorm() + 0.5 * tet.lambda * trace * trace;
    }

    static Mat3 stress(const TetShare& tet, const Strain& s) {
        const Mat3 small = s.small();
        Mat3 stress = 2 * tet.mu * small;
        stress.diagonal().array() += tet.lambda * small.trace();
        return stress;
    }

    // Constant, so that the two tangents are one.
    static TetStiffness stiffness(const TetShare& tet, const Strain&, Tangent, double scale) {
        return warped_stiffness(tet, Mat3::Identity(), scale);
    }

    static bool inverted(const Strain& s) { return s.F.determinant() < 0; }
};

}  // namespace

Mechanics tet_linear(int order) {
    Mechanics row = tet_row<Linear>("tet_linear", order, false);
    row.turns = false;
    return row;
}

}  // namespace frond
