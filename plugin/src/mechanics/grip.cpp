// In: a grip and where the nodes are. Out: where its point is, and forces and stiffness on it as the nodes feel them.
#include "mechanics/grip.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/rotation.hpp"

namespace frond {

namespace {

// The arm of node k as it is turned now.
Vec3 turned_arm(const Grip& grip, int k, const VecX& x) {
    return rotation_of<double>(point(x, grip.node[size_t(k)] + 1)) * grip.arm[size_t(k)];
}

// How the point follows the rotation vector of node k.
Mat3 turn_derivative(const Grip& grip, int k, const VecX& x) {
    return -cross_matrix<double>(turned_arm(grip, k, x)) * rate_matrix<double>(point(x, grip.node[size_t(k)] + 1));
}

}  // namespace

GripDerivative derivative_at(const Grip& grip, const VecX& x) {
    GripDerivative out;
    const auto add = [&](int node, const Mat3& by) {
        out.node[size_t(out.count)] = node;
        out.by[size_t(out.count++)] = by;
    };
    for (int k = 0; k < grip.count; ++k) {
        add(grip.node[size_t(k)], grip.weight[size_t(k)] * Mat3::Identity());
        if (grip.turns) add(grip.node[size_t(k)] + 1, turn_derivative(grip, k, x));
    }
    return out;
}

Grip tet_grip(const TetPlace& place) {
    Grip grip;
    grip.count = place.count;
    std::copy_n(place.node.begin(), place.count, grip.node.begin());
    std::copy_n(place.weight.begin(), place.count, grip.weight.begin());
    return grip;
}

bool is_sound(const Grip& grip, int node_count) {
    if (grip.count < 1 || grip.count > (grip.turns ? 2 : Grip::MOST)) return false;
    for (int k = 0; k < grip.count; ++k) {
        if (grip.node[size_t(k)] < 0 || grip.node[size_t(k)] + grip.turns >= node_count) return false;
        if (!std::isfinite(grip.weight[size_t(k)])) return false;
    }
    return grip.arm[0].allFinite() && grip.arm[1].allFinite();
}

Vec3 grip_place(const Grip& grip, const VecX& x) {
    Vec3 place = Vec3::Zero();
    for (int k = 0; k < grip.count; ++k) {
        place += grip.weight[size_t(k)] * point(x, grip.node[size_t(k)]);
        if (grip.turns) place += turned_arm(grip, k, x);
    }
    return place;
}

Vec3 grip_velocity(const Grip& grip, const VecX& x, const VecX& v) {
    Vec3 velocity = Vec3::Zero();
    if (!grip.turns) {
        for (int k = 0; k < grip.count; ++k) velocity += grip.weight[size_t(k)] * point(v, grip.node[size_t(k)]);
        return velocity;
    }
    const GripDerivative d = derivative_at(grip, x);
    for (int k = 0; k < d.count; ++k) velocity += d.by[size_t(k)] * point(v, d.node[size_t(k)]);
    return velocity;
}

void add_grip_force(const Grip& grip, const VecX& x, const Vec3& force, VecX& f) {
    if (!grip.turns) {
        for (int k = 0; k < grip.count; ++k) point(f, grip.node[size_t(k)]) += grip.weight[size_t(k)] * force;
        return;
    }
    const GripDerivative d = derivative_at(grip, x);
    for (int k = 0; k < d.count; ++k) point(f, d.node[size_t(k)]) += d.by[size_t(k)].transpose() * force;
}

void add_grip_block(const Grip& grip, const VecX& x, const Mat3& block, BlockMatrix& A) {
    // The lower triangle is all there is.
    if (!grip.turns) {
        for (int r = 0; r < grip.count; ++r)
            for (int c = 0; c < grip.count; ++c) {
                const int i = grip.node[size_t(r)], j = grip.node[size_t(c)];
                if (i >= j) A.block(A.pattern->slot(i, j)) += grip.weight[size_t(r)] * grip.weight[size_t(c)] * block;
            }
        return;
    }
    const GripDerivative d = derivative_at(grip, x);
    for (int r = 0; r < d.count; ++r)
        for (int c = 0; c < d.count; ++c) {
            const int i = d.node[size_t(r)], j = d.node[size_t(c)];
            if (i < j) continue;
            A.block(A.pattern->slot(i, j)) += d.by[size_t(r)].transpose() * block * d.by[size_t(c)];
        }
}

void add_grip_stiffness(const Grip& grip, const VecX& x, double stiffness, BlockMatrix& A) {
    add_grip_block(grip, x, stiffness * Mat3::Identity(), A);
}

}  // namespace frond
