// In: a body's stiffness and masses. Out: its first modes.
//
// Lanczos's method on K^-1 M from an equal displacement of all nodes in a direction (Nour-Omid, Clough 1984, "Dynamic
// analysis of structures using Lanczos co-ordinates"): few solves find the modes that a push along it excites, each
// with its part in the push; the many modes of single leaves do not come up. Modes that lie close together are
// combined.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "calibration/firm_tets.hpp"
#include "calibration/sway.hpp"
#include "core/elementary.hpp"

namespace frond {

std::vector<uint8_t> still_nodes(const Model& model, const Elements& elements, bool moves_chain) {
    if (moves_chain) {
        std::vector<uint8_t> still(size_t(elements.node_count), 0);
        for (size_t i = 0; i < model.chain.nodes.size(); i++)
            if (model.chain.nodes[i].parent < 0) still[2 * i] = still[2 * i + 1] = 1;
        return still;
    }
    std::vector<uint8_t> held = find_held_nodes(model.cage, model.root);
    // A foot so slender that it counts as a hinge holds nothing: then the root is held as given.
    if (std::all_of(held.begin(), held.end(), [](uint8_t h) { return h; })) held = model.root;
    return with_middles(static_cast<const TetElements&>(elements).nodes, held);
}

// Returns every node's mass times its displacement, zero for those that do not move.
static VecX times_mass(const VecX& node_mass, const std::vector<uint8_t>& still, VecX x) {
    for (int i = 0; i < int(still.size()); i++) point(x, i) *= still[size_t(i)] ? 0 : node_mass[i];
    return x;
}

static VecX move_along(const Vec3& direction, const std::vector<uint8_t>& still) {
    VecX x = VecX::Zero(3 * Eigen::Index(still.size()));
    for (int i = 0; i < int(still.size()); i++)
        if (!still[size_t(i)]) point(x, i) = direction;
    return x;
}

static Sway first_sway(BlockFactor& stiffness, const VecX& node_mass, const std::vector<uint8_t>& still,
                       const std::vector<uint8_t>& left_out, const Vec3& direction) {
    constexpr int MOST_STEPS = 12;  // of Lanczos: the modes that a push excites, and few more
    constexpr double CLOSE = 0.3;   // width in logarithms of frequencies' squares within which modes are combined [-]
    std::vector<VecX> basis, weighted;  // normalised to unit mass; the same times the masses
    VecX next = move_along(direction, left_out);
    VecX diagonal = VecX::Zero(MOST_STEPS),
         beside = VecX::Zero(MOST_STEPS);  // tridiagonal matrix in that basis
    int steps = 0;
    for (double size = 0; steps < MOST_STEPS; steps++) {
        const VecX product = times_mass(node_mass, still, next);
        const double own = std::sqrt(next.dot(product));
        if (!(own > 1e-6 * size) || !std::isfinite(own)) break;
        basis.push_back(next / own);
        weighted.push_back(product / own);
        solve(stiffness, weighted.back(), next);
        size = std::sqrt(next.dot(times_mass(node_mass, still, next)));
        // Orthogonalize against all before, twice, since remainders grow.
        for (int pass = 0; pass < 2; pass++)
            for (int j = 0; j <= steps; j++) {
                const double common = weighted[size_t(j)].dot(next);
                if (j == steps) diagonal[j] += common;
                if (j == steps - 1) beside[j] += common;
                next -= common * basis[size_t(j)];
            }
    }
    if (steps == 0) return {};
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes;
    modes.computeFromTridiagonal(diagonal.head(steps), beside.head(steps - 1));
    // A mode's part in the static displacement is its part in the push over the square of its frequency.
    const Eigen::ArrayXd push = modes.eigenvectors().row(0).transpose().array(), inverse = modes.eigenvalues().array();
    const auto near = [&](Eigen::Index j) -> Eigen::ArrayXd {
        return (-((inverse / inverse[j]).max(1e-9).unaryExpr(&frond::log) / CLOSE).square()).unaryExpr(&frond::exp);
    };
    Eigen::Index best = 0;
    double largest = 0;
    for (Eigen::Index j = 0; j < steps; j++) {
        const double part = inverse[j] > 0 ? (near(j) * push.square() * inverse).sum() : 0;
        if (part <= largest) continue;
        largest = part;
        best = j;
    }
    const Eigen::ArrayXd shares = push * inverse * near(best);
    VecX load = VecX::Zero(next.size());
    for (int j = 0; j < steps; j++)
        load += modes.eigenvectors().row(j).dot((shares / inverse[best]).matrix()) * weighted[size_t(j)];
    Sway sway;
    solve(stiffness, load, sway.shape);
    sway.shape /= std::sqrt(sway.shape.dot(times_mass(node_mass, still, sway.shape)));
    sway.square = (shares.square() / inverse).sum() / shares.square().sum();
    sway.direction = direction;
    if (!(sway.square > 0) || !sway.shape.allFinite()) return {};
    return sway;
}

std::array<Sway, 2> first_sways(BlockFactor& stiffness, const VecX& node_mass, const std::vector<uint8_t>& still) {
    return first_sways(stiffness, node_mass, still, still);
}

std::array<Sway, 2> first_sways(BlockFactor& stiffness, const VecX& node_mass, const std::vector<uint8_t>& still,
                                const std::vector<uint8_t>& left_out) {
    const VecX load_x = times_mass(node_mass, still, move_along(Vec3::UnitX(), left_out));
    const VecX load_z = times_mass(node_mass, still, move_along(Vec3::UnitZ(), left_out));
    VecX move_x, move_z;
    solve(stiffness, load_x, move_x);
    solve(stiffness, load_z, move_z);
    const double angle = 0.5 * frond::atan2(2 * load_x.dot(move_z), load_x.dot(move_x) - load_z.dot(move_z));
    const Vec3 softest(frond::cos(angle), 0, frond::sin(angle));
    std::array<Sway, 2> sways = {first_sway(stiffness, node_mass, still, left_out, softest),
                                 first_sway(stiffness, node_mass, still, left_out, softest.cross(Vec3::UnitY()))};
    if (sways[1].square < sways[0].square) std::swap(sways[0], sways[1]);
    return sways;
}

}  // namespace frond
