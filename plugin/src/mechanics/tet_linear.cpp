// In: tets at rest and where their nodes are. Out: energy, force and stiffness of linear elasticity with displacements
// u = x - x0, equation (1) of the paper: right for small deflections, and a large turn makes the body swell.
#include "mechanics/rows.hpp"
#include "mechanics/tet_element.hpp"

namespace frond {

namespace {

Mat3 small_strain(const Mat3& F) {
    return 0.5 * (F + F.transpose()) - Mat3::Identity();
}

}  // namespace

double tet_linear_energy(const Elements& body, const VecX& x) {
    const TetElements& elements = as_tets(body);
    double energy = 0;
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const Mat3 strain = small_strain(deformation_gradient(elements, e, x));
        const double trace = strain.trace();
        energy +=
            elements.volume[e] * (elements.mu[e] * strain.squaredNorm() + 0.5 * elements.lambda[e] * trace * trace);
    }
    return energy;
}

int tet_linear_add_force(const Elements& body, const VecX& x, VecX& f) {
    const TetElements& elements = as_tets(body);
    int inverted = 0;
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const Mat3 F = deformation_gradient(elements, e, x);
        const Mat3 strain = small_strain(F);
        Mat3 stress = 2 * elements.mu[e] * strain;
        stress.diagonal().array() += elements.lambda[e] * strain.trace();
        scatter_force(elements, e, stress, f);
        inverted += F.determinant() < 0;
    }
    return inverted;
}

// Constant, so that the two tangents are one.
void tet_linear_add_stiffness(const Elements& body, const VecX&, Tangent, double scale, BlockMatrix& K) {
    const TetElements& elements = as_tets(body);
    for (size_t e = 0; e < elements.tets.size(); ++e)
        scatter_stiffness(elements, e, warped_stiffness(elements, e, Mat3::Identity(), scale), K);
}

int tet_linear_add_both(const Elements& body, const VecX& x, Tangent tangent, VecX& f, BlockMatrix& K) {
    const TetElements& elements = as_tets(body);
    tet_linear_add_stiffness(elements, x, tangent, 1, K);
    return tet_linear_add_force(elements, x, f);
}

}  // namespace frond
