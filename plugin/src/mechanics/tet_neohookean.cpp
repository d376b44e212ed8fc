// In: the gradient of deformation at a point. Out: energy, stress and stiffness of the stable neo-Hookean solid of
// Smith, de Goes, Kim 2018 ("Stable neo-Hookean flesh simulation"), with I = |F|^2 and J = det F
//   W = m/2 (I - 3) - m/2 log((I + 1)/4) + l/2 (J - a)^2 - l/2 (1 - a)^2,  a = 1 + 3 m / (4 l).
// It is finite and has a force that leads back wherever a tet is turned inside out. m = 4/3 mu and l = lambda + 5/6 mu
// make it agree with Lame's constants at small strain.
//
// The positive stiffness takes the negative parts out of the second derivative of W by F, in closed form in the frame
// of the stretches: three pairs of shear and turn, and a 3x3 matrix for the stretches themselves.
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

#include "mechanics/tet_row.hpp"

namespace frond {

namespace {

// What energy and its derivatives are made of.
struct Strain {
    Mat3 F, cofactor;
    double m, l;     // the material's own constants [Pa]
    double I, J;     // |F|^2, det F
    double pull;     // m (1 - 1/(I+1)): stress along F
    double bend;     // 2 m / (I+1)^2: its derivative by I, doubled
    double squeeze;  // l (J - a): stress along the cofactor
};

Strain strain_of(const TetShare& tet, const Mat3& F) {
    Strain s;
    s.F = F;
    s.cofactor.col(0) = s.F.col(1).cross(s.F.col(2));
    s.cofactor.col(1) = s.F.col(2).cross(s.F.col(0));
    s.cofactor.col(2) = s.F.col(0).cross(s.F.col(1));
    s.m = 4.0 / 3 * tet.mu;
    s.l = tet.lambda + 5.0 / 6 * tet.mu;
    s.I = s.F.squaredNorm();
    s.J = s.F.col(0).dot(s.cofactor.col(0));
    s.pull = s.m * s.I / (s.I + 1);
    s.bend = 2 * s.m / ((s.I + 1) * (s.I + 1));
    s.squeeze = s.l * (s.J - 1) - 0.75 * s.m;
    return s;
}

// The constants of rest are taken out term by term, so that little is lost to rounding near rest.
double energy_density(const Strain& s) {
    const double stretch = s.I - 3, swell = s.J - 1;
    return 0.5 * s.m * (stretch - std::log1p(stretch / 4)) + 0.5 * s.l * swell * swell - 0.75 * s.m * swell;
}

// K_ab = V (pull b_a.b_b I + bend (F b_a)(F b_b)^T + l (C b_a)(C b_b)^T - squeeze [F (b_a x b_b)]), C the cofactor and
// [.] the cross product: the derivative of C.
TetStiffness exact_stiffness(const TetShare& tet, const Strain& s, double scale) {
    const Mat3& B = tet.rest_inverse;
    const double V = scale * tet.volume;
    const Mat3 FB = s.F * B.transpose(), CB = s.cofactor * B.transpose();
    const auto block = [&](int a, int b) {
        Mat3 k = FB.col(a) * (V * s.bend * FB.col(b)).transpose() + CB.col(a) * (V * s.l * CB.col(b)).transpose();
        k.diagonal().array() += V * s.pull * B.row(a).dot(B.row(b));
        if (a != b) {
            const Vec3 w = V * s.squeeze * (s.F * B.row(a).transpose().cross(B.row(b).transpose()));
            k(0, 1) += w.z(), k(1, 0) -= w.z();
            k(0, 2) -= w.y(), k(2, 0) += w.y();
            k(1, 2) += w.x(), k(2, 1) -= w.x();
        }
        return k;
    };
    return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
}

// F = U diag(stretch) V^T with U and V of determinant one, so that the stretches' product is J.
struct Frame {
    Mat3 U, V;
    Vec3 stretch;
};

Frame principal_frame(const Mat3& F) {
    Frame frame;
    const Eigen::SelfAdjointEigenSolver<Mat3> squares(F.transpose() * F);
    const Vec3 values = squares.eigenvalues();
    if (values[0] > 1e-6 * values[2] && values[2] > 0) {
        frame.V = squares.eigenvectors();
        frame.U = F * frame.V * values.cwiseSqrt().cwiseInverse().asDiagonal();
    } else {
        // Nearly flat: the squares have lost the digits of the smallest stretch.
        const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
        frame.U = svd.matrixU();
        frame.V = svd.matrixV();
    }
    if (frame.U.determinant() < 0) frame.U.col(0) *= -1;
    if (frame.V.determinant() < 0) frame.V.col(0) *= -1;
    frame.stretch = (frame.U.transpose() * F * frame.V).diagonal();
    return frame;
}

Mat3 without_negative_part(const Mat3& A) {
    const Eigen::SelfAdjointEigenSolver<Mat3> parts(A);
    if (parts.eigenvalues()[0] >= 0) return A;
    return parts.eigenvectors() * parts.eigenvalues().cwiseMax(0).asDiagonal() * parts.eigenvectors().transpose();
}

// Tension resists turning. A solve far from rest needs that; but damping is made of this stiffness too, and must let a
// body turn as a whole. So tension counts only beyond this share of the modulus.
constexpr double FREE_TURN = 0.05;

TetStiffness positive_stiffness(const TetShare& tet, const Strain& s, double scale) {
    const Frame frame = principal_frame(s.F);
    const Vec3& z = frame.stretch;

    // Stretches: second derivatives of W by z. Shears and turns in the plane of i and j: pull -+ squeeze z_k.
    Mat3 A, straight = Mat3::Zero(), crossed = Mat3::Zero();
    const Vec3 c(z[1] * z[2], z[2] * z[0], z[0] * z[1]);
    A = s.bend * z * z.transpose() + s.l * c * c.transpose();
    A.diagonal().array() += s.pull;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        A(i, j) += s.squeeze * z[k];
        A(j, i) += s.squeeze * z[k];
        const double shear = std::max(s.pull - s.squeeze * z[k], 0.0);
        const double turn = std::max(s.pull + s.squeeze * z[k] - FREE_TURN * s.m, 0.0);
        straight(i, j) = straight(j, i) = 0.5 * (shear + turn);
        crossed(i, j) = crossed(j, i) = 0.5 * (shear - turn);
    }
    A = without_negative_part(A);

    // With b in that frame: K_ij = A_ij b_i b'_j + crossed_ij b_j b'_i, and straight_ij b_j b'_j on the diagonal.
    const Mat3 G = frame.V.transpose() * tet.rest_inverse.transpose();
    const double V = scale * tet.volume;
    const auto block = [&](int a, int b) {
        Mat3 k = G.col(a) * (V * G.col(b)).transpose();
        const Vec3 diagonal = straight * k.diagonal();
        k = Mat3(A.cwiseProduct(k) + crossed.cwiseProduct(k.transpose()));
        k.diagonal() += diagonal;
        return Mat3(frame.U * k * frame.U.transpose());
    };
    return {block(0, 0), block(1, 0), block(2, 0), block(1, 1), block(2, 1), block(2, 2)};
}

struct Neohookean {
    static Strain strain(const TetShare& tet, const Mat3& F) { return strain_of(tet, F); }
    static double energy(const TetShare&, const Strain& s) { return energy_density(s); }
    static Mat3 stress(const TetShare&, const Strain& s) { return s.pull * s.F + s.squeeze * s.cofactor; }

    static TetStiffness stiffness(const TetShare& tet, const Strain& s, Tangent tangent, double scale) {
        // Not finite: the exact one says so too, and needs no frame.
        if (tangent == Tangent::exact || !std::isfinite(s.I)) return exact_stiffness(tet, s, scale);
        return positive_stiffness(tet, s, scale);
    }

    static bool inverted(const Strain& s) { return s.J < 0; }
};

}  // namespace

Mechanics tet_neohookean(int order) {
    return tet_row<Neohookean>("tet_neohookean", order, true);
}

}  // namespace frond
