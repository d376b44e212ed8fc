// In: rods at rest and where their nodes are. Out: energy, force and stiffness.
//
// Geometrically exact rods (Simo 1985; Simo, Vu-Quoc 1986) with two nodes a piece and one point of integration:
//   strain G = F^T R^T (x2 - x1) / L,  curvature k = F^T log(R1^T R2) / L,
//   U = L/2 (G - G0) . C (G - G0) + L/2 (k - k0) . B (k - k0),
// F the piece's frame in the modelled shape, R = R1 exp(log(R1^T R2) / 2) the rotation half way. The resistance to
// shear is the residual bending flexibility, 12 EI / L^2 (MacNeal 1978): for small turns the piece then is the
// Euler-Bernoulli beam with cubic shape functions, exact at its ends.
#include "mechanics/dual.hpp"
#include "mechanics/rod_elements.hpp"
#include "mechanics/rotation.hpp"
#include "mechanics/rows.hpp"

namespace frond {

namespace {

using Twelve = Eigen::Matrix<double, 12, 1>;

// A node as its rods see it.
template <class S>
struct RodNode {
    Vec3of<S> place;
    Mat3of<S> rotation, rate;  // and from the rate of its vector to its angular velocity
};

template <class S>
RodNode<S> node_at(const Vec3of<S>& place, const Vec3of<S>& turn) {
    return {place, rotation_of<S>(turn), rate_matrix<S>(turn)};
}

// What follows from the places of the two ends.
template <class S>
struct Bent {
    Vec3of<S> chord;           // x2 - x1 [m]
    Vec3of<S> turn;            // log(R1^T R2)
    Mat3of<S> middle;          // R F
    Vec3of<S> strain, curvature;  // over the rest's
};

template <class S>
Bent<S> bend_between(const RodSegment& rod, const RodNode<S>& a, const RodNode<S>& b) {
    Bent<S> out;
    out.chord = b.place - a.place;
    out.turn = rotation_vector<S>(a.rotation.transpose() * b.rotation);
    const Vec3of<S> half = out.turn * S(0.5);
    out.middle = a.rotation * rotation_of<S>(half) * rod.frame.cast<S>();
    const S over = S(1 / rod.length);
    out.strain = out.middle.transpose() * out.chord * over - rod.rest_strain.cast<S>();
    out.curvature = rod.frame.transpose().cast<S>() * out.turn * over - rod.rest_curvature.cast<S>();
    return out;
}

// How the rotation half way follows that of the second end, in the frame of the room: R1 (1 + exp(turn/2))^-1 R1^T.
template <class S>
Mat3of<S> middle_share(const RodNode<S>& a, const Vec3of<S>& turn) {
    using std::sqrt;
    using std::tan;
    const S square = turn.squaredNorm();
    // tan(angle/4) / angle
    const S slope = square < 1e-8 ? S(S(0.25) + square / 192.) : S(tan(0.25 * sqrt(square)) / sqrt(square));
    const S scale = -0.5 * slope;
    Mat3of<S> share = scale * cross_matrix<S>(a.rotation * turn);
    share.diagonal().array() += S(0.5);
    return share;
}

// Gradient of the energy by the four nodes of the mechanics.
template <class S>
Eigen::Matrix<S, 12, 1> gradient(const RodSegment& rod, const RodNode<S>& a, const RodNode<S>& b,
                                 const Bent<S>& bent) {
    const Vec3of<S> force = bent.middle * Vec3of<S>(rod.stretch.cast<S>().cwiseProduct(bent.strain));
    const Vec3of<S> middle_moment = force.cross(bent.chord);
    const Vec3of<S> couple = rod.frame.cast<S>() * Vec3of<S>(rod.bend.cast<S>().cwiseProduct(bent.curvature));
    const Vec3of<S> end_moment = a.rotation * (inverse_rate_matrix<S>(bent.turn).transpose() * couple);
    const Vec3of<S> second = middle_share(a, bent.turn).transpose() * middle_moment;
    Eigen::Matrix<S, 12, 1> g;
    g.template segment<3>(0) = -force;
    g.template segment<3>(3) = a.rate.transpose() * (middle_moment - second - end_moment);
    g.template segment<3>(6) = force;
    g.template segment<3>(9) = b.rate.transpose() * (second + end_moment);
    return g;
}

double energy_of(const RodSegment& rod, const RodNode<double>& a, const RodNode<double>& b) {
    const Bent<double> bent = bend_between(rod, a, b);
    return 0.5 * rod.length *
           (rod.stretch.dot(bent.strain.cwiseAbs2()) + rod.bend.dot(bent.curvature.cwiseAbs2()));
}

// Lower blocks (r, c), c <= r, of the stiffness between the four nodes of the mechanics, at [r (r + 1) / 2 + c].
using Blocks = std::array<Mat3, 10>;

// The part of the stiffness that is never negative: how strains change with the nodes, weighted with resistance. The
// strain changes by T^T (move of b - move of a) + A (turn of a) + B (turn of b), T the frame half way.
Blocks positive_stiffness(const RodSegment& rod, const RodNode<double>& a, const RodNode<double>& b,
                          const Bent<double>& bent) {
    const Mat3 share = middle_share(a, bent.turn), chord = cross_matrix<double>(bent.chord);
    const Mat3 seen = bent.middle.transpose() * chord, by_share = seen * share;
    const Mat3 A = (seen - by_share) * a.rate, B = by_share * b.rate;
    const Mat3 turning = rod.frame.transpose() * inverse_rate_matrix<double>(bent.turn) * a.rotation.transpose();
    const Mat3 turn_a = turning * a.rate, turn_b = turning * b.rate;
    const Vec3 stretch = rod.stretch / rod.length, bend = rod.bend / rod.length;
    const Mat3 pulled = stretch.asDiagonal() * bent.middle.transpose();
    const Mat3 weighted_A = stretch.asDiagonal() * A, weighted_B = stretch.asDiagonal() * B;
    const Mat3 bent_a = bend.asDiagonal() * turn_a, bent_b = bend.asDiagonal() * turn_b;
    Blocks K;
    K[0] = bent.middle * pulled;
    K[1] = -A.transpose() * pulled;
    K[2] = A.transpose() * weighted_A + turn_a.transpose() * bent_a;
    K[3] = -K[0];
    K[4] = -K[1].transpose();
    K[5] = K[0];
    K[6] = -B.transpose() * pulled;
    K[7] = B.transpose() * weighted_A - turn_b.transpose() * bent_a;
    K[8] = -K[6];
    K[9] = B.transpose() * weighted_B + turn_b.transpose() * bent_b;
    return K;
}

// The derivative of the gradient, by forward differentiation of its own code.
Blocks exact_stiffness(const RodSegment& rod, const VecX& x) {
    Vec3of<Dual> v[4];
    for (int n = 0; n < 4; ++n)
        for (int c = 0; c < 3; ++c)
            v[n][c] = Dual::variable(x[3 * (2 * (n < 2 ? rod.a : rod.b) + n % 2) + c], 3 * n + c);
    const RodNode<Dual> a = node_at<Dual>(v[0], v[1]), b = node_at<Dual>(v[2], v[3]);
    const Eigen::Matrix<Dual, 12, 1> g = gradient<Dual>(rod, a, b, bend_between(rod, a, b));
    const auto slope = [&](int r, int c) { return 0.5 * (g[r].slope[c] + g[c].slope[r]); };
    Blocks K;
    for (int r = 0, k = 0; r < 4; ++r)
        for (int c = 0; c <= r; ++c, ++k)
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) K[size_t(k)](i, j) = slope(3 * r + i, 3 * c + j);
    return K;
}

std::vector<RodNode<double>> nodes_at(const VecX& x) {
    std::vector<RodNode<double>> nodes(size_t(x.size()) / 6);
    for (size_t i = 0; i < nodes.size(); ++i)
        nodes[i] = node_at<double>(point(x, int(2 * i)), point(x, int(2 * i + 1)));
    return nodes;
}

void scatter_force(const RodSegment& rod, const Twelve& g, VecX& f) {
    f.segment<6>(6 * Eigen::Index(rod.a)) -= g.head<6>();
    f.segment<6>(6 * Eigen::Index(rod.b)) -= g.tail<6>();
}

void scatter_stiffness(const RodSegment& rod, const Blocks& stiffness, double scale, BlockMatrix& K) {
    for (size_t r = 0, k = 0; r < 4; ++r)
        for (size_t c = 0; c <= r; ++c, ++k) K.block(rod.slots[4 * r + c]) += scale * stiffness[k];
}

}  // namespace

std::vector<RodStrain> rod_strains(const RodElements& elements, const VecX& x) {
    // Strains alone need no rates.
    std::vector<RodNode<double>> nodes;
    nodes.reserve(size_t(x.size()) / 6);
    for (int i = 0; i < x.size() / 3; i += 2)
        nodes.push_back({point(x, i), rotation_of<double>(point(x, i + 1)), Mat3::Zero()});
    std::vector<RodStrain> strains;
    strains.reserve(elements.segments.size());
    for (const RodSegment& rod : elements.segments) {
        const Bent<double> bent = bend_between(rod, nodes[size_t(rod.a)], nodes[size_t(rod.b)]);
        strains.push_back({bent.strain, bent.curvature});
    }
    return strains;
}

double rod_energy(const Elements& body, const VecX& x) {
    const std::vector<RodNode<double>> nodes = nodes_at(x);
    double energy = 0;
    for (const RodSegment& rod : as_rods(body).segments)
        energy += energy_of(rod, nodes[size_t(rod.a)], nodes[size_t(rod.b)]);
    return energy;
}

int rod_add_force(const Elements& body, const VecX& x, VecX& f) {
    const std::vector<RodNode<double>> nodes = nodes_at(x);
    for (const RodSegment& rod : as_rods(body).segments) {
        const RodNode<double>&a = nodes[size_t(rod.a)], &b = nodes[size_t(rod.b)];
        scatter_force(rod, gradient(rod, a, b, bend_between(rod, a, b)), f);
    }
    return 0;
}

void rod_add_stiffness(const Elements& body, const VecX& x, Tangent tangent, double scale, BlockMatrix& K) {
    const std::vector<RodNode<double>> nodes = nodes_at(x);
    for (const RodSegment& rod : as_rods(body).segments) {
        const RodNode<double>&a = nodes[size_t(rod.a)], &b = nodes[size_t(rod.b)];
        const Blocks stiffness = tangent == Tangent::exact ? exact_stiffness(rod, x)
                                                           : positive_stiffness(rod, a, b, bend_between(rod, a, b));
        scatter_stiffness(rod, stiffness, scale, K);
    }
}

int rod_add_both(const Elements& body, const VecX& x, Tangent tangent, VecX& f, BlockMatrix& K) {
    const std::vector<RodNode<double>> nodes = nodes_at(x);
    for (const RodSegment& rod : as_rods(body).segments) {
        const RodNode<double>&a = nodes[size_t(rod.a)], &b = nodes[size_t(rod.b)];
        const Bent<double> bent = bend_between(rod, a, b);
        scatter_force(rod, gradient(rod, a, b, bent), f);
        scatter_stiffness(
            rod, tangent == Tangent::exact ? exact_stiffness(rod, x) : positive_stiffness(rod, a, b, bent), 1, K);
    }
    return 0;
}

int rod_add_damped(const Elements& body, const VecX& x, const std::vector<double>& damping, VecX& f, BlockMatrix& K,
                   BlockMatrix& D) {
    const std::vector<RodNode<double>> nodes = nodes_at(x);
    const std::vector<RodSegment>& segments = as_rods(body).segments;
    for (size_t s = 0; s < segments.size(); ++s) {
        const RodSegment& rod = segments[s];
        const RodNode<double>&a = nodes[size_t(rod.a)], &b = nodes[size_t(rod.b)];
        const Bent<double> bent = bend_between(rod, a, b);
        scatter_force(rod, gradient(rod, a, b, bent), f);
        const Blocks stiffness = positive_stiffness(rod, a, b, bent);
        scatter_stiffness(rod, stiffness, 1, K);
        scatter_stiffness(rod, stiffness, damping[s], D);
    }
    return 0;
}

void rod_inertia(const Elements& body, const VecX& x, std::vector<Mat3>& out) {
    const RodElements& elements = as_rods(body);
    out.resize(elements.inertia.size());
    for (size_t i = 0; i < out.size(); ++i) {
        // To the rate in the node's own frame: R(v)^T T(v) = T(-v).
        const Mat3 rate = rate_matrix<double>(-point(x, int(2 * i + 1)));
        out[i] = rate.transpose() * elements.inertia[i] * rate;
    }
}

bool rods_are_calm(const Elements& body, const VecX& from, const VecX& to) {
    constexpr double LARGEST_TURN = 0.35;     // of a node [rad]
    constexpr double LARGEST_STRETCH = 0.5;  // change of a piece's ends over its length [-]
    const RodElements& elements = as_rods(body);
    for (int i = 1; i < elements.node_count; i += 2)
        if (!((point(to, i) - point(from, i)).squaredNorm() < LARGEST_TURN * LARGEST_TURN)) return false;
    for (const RodSegment& rod : elements.segments) {
        const Vec3 change = point(to, 2 * rod.b) - point(to, 2 * rod.a) - point(from, 2 * rod.b) + point(from, 2 * rod.a);
        if (!(change.norm() < LARGEST_STRETCH * rod.length)) return false;
    }
    return true;
}

}  // namespace frond
