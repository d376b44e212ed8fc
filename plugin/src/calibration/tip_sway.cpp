// In: a model's rods. Out: the modes that a force on the tip excites.
#include "calibration/tip_sway.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "calibration/static_stiffness.hpp"
#include "calibration/sway.hpp"
#include "core/elementary.hpp"
#include "core/error.hpp"
#include "solve/system.hpp"

namespace frond {

namespace {

struct Rods {
    const System& system;
    const Elements& elements;
    std::vector<uint8_t> still;
    std::vector<Mat3> inertia;
    StaticStiffness stiffness;
    int tip;  // node of the mechanics
    Rods(const System& system, const Model& model)
        : system(system),
          elements(elements_of(system)),
          still(still_nodes(model, elements, true)),
          stiffness(elements.pattern),
          tip(2 * find_tip(model)) {
        mechanics(FROND_MECHANICS_ROD).rotary_inertia(elements, elements.modelled, inertia);
        if (!stiffness.set(elements, still, FROND_MECHANICS_ROD, Tangent::exact, elements.modelled) &&
            !stiffness.set(elements, still, FROND_MECHANICS_ROD, Tangent::positive, elements.modelled))
            fail(FROND_RESULT_BAD_GEOMETRY, "the plant's rods have no stiffness; check its materials and radii");
    }
    void hold(VecX& x) const {
        for (int i = 0; i < elements.node_count; i++)
            if (still[size_t(i)]) point(x, i).setZero();
    }
    VecX times_mass(const VecX& x) const {
        VecX y;
        multiply_mass(system, inertia, x, y);
        hold(y);
        return y;
    }
    // Returns the displacements by a force on the tip [m].
    VecX bend(const Vec3& force) {
        VecX load = VecX::Zero(elements.modelled.size()), x;
        point(load, tip) = force;
        hold(load);
        solve(stiffness.factor, load, x);
        hold(x);
        return x;
    }
};

Vec3 softest_direction(Rods& rods) {
    const VecX by_x = rods.bend(Vec3::UnitX()), by_z = rods.bend(Vec3::UnitZ());
    const double xx = point(by_x, rods.tip).x(), zz = point(by_z, rods.tip).z(), xz = point(by_z, rods.tip).x();
    const double angle = 0.5 * frond::atan2(2 * xz, xx - zz);
    return {frond::cos(angle), 0, frond::sin(angle)};
}

// Returns vectors of unit mass that are orthogonal by the masses, from the static shape on.
std::vector<VecX> span_sways(Rods& rods, const VecX& first) {
    constexpr double NOTHING_NEW = 1e-9;  // length of a remainder over that of the vector [-]
    std::vector<VecX> basis, weighted;
    VecX next = first;
    while (int(basis.size()) < MOST_SWAYS) {
        const double whole = std::sqrt(next.dot(rods.times_mass(next)));
        // Orthogonalize twice, since remainders of rounding grow.
        for (int pass = 0; pass < 2; pass++)
            for (size_t j = 0; j < basis.size(); j++) next -= weighted[j].dot(next) * basis[j];
        const VecX product = rods.times_mass(next);
        const double own = std::sqrt(next.dot(product));
        if (!(own > NOTHING_NEW * whole) || !std::isfinite(own)) break;
        basis.push_back(next / own);
        weighted.push_back(product / own);
        solve(rods.stiffness.factor, weighted.back(), next);
        rods.hold(next);
    }
    return basis;
}

// Returns the products of the vectors with a matrix between them.
Eigen::MatrixXd project(const std::vector<VecX>& basis, const BlockMatrix& K) {
    const Eigen::Index count = Eigen::Index(basis.size());
    Eigen::MatrixXd out(count, count);
    VecX product;
    for (Eigen::Index j = 0; j < count; j++) {
        K.multiply(basis[size_t(j)], product);
        for (Eigen::Index i = 0; i < count; i++) out(i, j) = basis[size_t(i)].dot(product);
    }
    return 0.5 * (out + out.transpose());
}

Eigen::MatrixXd gram_of(const std::vector<VecX>& basis) {
    const Eigen::Index count = Eigen::Index(basis.size());
    Eigen::MatrixXd out(count, count);
    for (Eigen::Index j = 0; j < count; j++)
        for (Eigen::Index i = 0; i < count; i++) out(i, j) = basis[size_t(i)].dot(basis[size_t(j)]);
    return out;
}

}  // namespace

int find_tip(const Model& model) {
    constexpr double AS_FAR = 1e-6;  // share of the way within which tips are as far as each other [-]
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    double farthest = 0;
    for (const ChainNode& node : nodes) farthest = std::max(farthest, node.distance);
    size_t tip = 0;
    while (!(nodes[tip].distance >= (1 - AS_FAR) * farthest)) tip++;
    return int(tip);
}

TipSway find_tip_sway(const std::shared_ptr<const Model>& model, frond_mass mass, const Vec3* direction) {
    const std::shared_ptr<const System> system = make_system(model, FROND_MECHANICS_ROD, mass);
    Rods rods(*system, *model);
    TipSway sway;
    sway.direction = direction ? *direction : softest_direction(rods);
    const VecX bent = rods.bend(sway.direction);
    const std::vector<VecX> basis = span_sways(rods, bent);
    if (basis.empty())
        fail(FROND_RESULT_BAD_GEOMETRY, "the plant has no part that could sway: its chain is a root alone");
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(project(basis, rods.stiffness.K));
    const Eigen::MatrixXd& turn = modes.eigenvectors();
    sway.square = modes.eigenvalues();
    TipMatrix tips(3, turn.rows());
    for (Eigen::Index j = 0; j < turn.rows(); j++) tips.col(j) = point(basis[size_t(j)], rods.tip);
    sway.tip = tips * turn;
    const VecX weighted = rods.times_mass(bent);
    VecX shares(turn.rows());
    for (Eigen::Index j = 0; j < turn.rows(); j++) shares[j] = basis[size_t(j)].dot(weighted);
    sway.start = turn.transpose() * shares;
    sway.gram = turn.transpose() * gram_of(basis) * turn;
    if (!model->stands_as_modelled) return sway;
    rods.stiffness.K.set_zero();
    mechanics(FROND_MECHANICS_ROD)
        .add_stiffness(rods.elements, rods.elements.modelled, Tangent::positive, 1, rods.stiffness.K);
    sway.positive = turn.transpose() * project(basis, rods.stiffness.K) * turn;
    return sway;
}

double main_frequency(const TipSway& sway) {
    constexpr double CLOSE = 0.2;  // width in logarithms of frequencies' squares within which modes are combined [-]
    // Shares are of the displacement along the force: none is below zero.
    const Sways shares = (sway.direction.transpose() * sway.tip).transpose().cwiseProduct(sway.start);
    double largest = 0, best = sway.square[0];
    for (Eigen::Index k = 0; k < shares.size(); k++) {
        double sum = 0, squares = 0;
        for (Eigen::Index j = 0; j < shares.size(); j++) {
            const double off = frond::log(std::max(1e-9, sway.square[j] / sway.square[k])) / CLOSE;
            const double part = frond::exp(-off * off) * shares[j];
            sum += part;
            squares += part * sway.square[j];
        }
        if (!(sum > largest)) continue;
        largest = sum;
        best = squares / sum;
    }
    return std::sqrt(best) / (2 * PI);
}

}  // namespace frond
