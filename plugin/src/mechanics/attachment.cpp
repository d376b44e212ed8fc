// In: an attachment and the nodes' positions. Out: the position of its point, and forces and stiffness at the point,
// distributed over the nodes.
#include "mechanics/attachment.hpp"

#include <algorithm>
#include <cmath>

#include "core/assert.hpp"
#include "mechanics/rotation.hpp"

namespace frond {

namespace {

// Returns the derivative of the point by the rotation vector of node k.
Mat3 turn_derivative(const Attachment& attachment, int k, const VecX& x) {
    const Vec3 turn = point(x, attachment.node[size_t(k)] + 1);
    return -cross_matrix<double>(rotation_of<double>(turn) * attachment.arm[size_t(k)]) * rate_matrix<double>(turn);
}

// Places attachments one after the other. Those that follow each other mostly hang on the same nodes, whose rotation is
// then found once.
class LastTurns {
public:
    explicit LastTurns(const VecX& x) : x(x) {}
    Vec3 place_of(const Attachment& attachment) {
        Vec3 place = Vec3::Zero();
        for (size_t k = 0; k < size_t(attachment.count); ++k) {
            place += attachment.weight[k] * point(x, attachment.node[k]);
            if (attachment.turns) place += turn_of(k, attachment.node[k]) * attachment.arm[k];
        }
        return place;
    }

private:
    const Mat3& turn_of(size_t k, int node) {
        if (nodes[k] != node) turns[k] = rotation_of<double>(point(x, node + 1));
        nodes[k] = node;
        return turns[k];
    }
    const VecX& x;
    std::array<int, 2> nodes = {-1, -1};
    std::array<Mat3, 2> turns;
};

// Returns the second derivative of g . (R a) by the rotation vector v of R. By the square q of its angle
//   R a = c a + s (v x a) + h (v . a) v,  c = cos,  s = sin / angle,  h = (1 - cos) / q,
// whose derivatives by q follow from 2 c' = -s, 2 q s' = c - s and q h' = s / 2 - h.
Mat3 turn_second_derivative(const Vec3& v, const Vec3& a, const Vec3& g) {
    constexpr double SMALL = 1e-4;  // [rad^2]
    const double q = v.squaredNorm(), half = std::sqrt(q) / 2;
    double s = 1, ds = -1.0 / 6, dds = 1.0 / 60, h = 0.5, dh = -1.0 / 24, ddh = 1.0 / 360;
    if (q > SMALL) {
        const double c = cos(2 * half);
        s = sin(2 * half) / (2 * half);
        h = 2 * sin(half) * sin(half) / q;
        ds = (c - s) / (2 * q);
        dds = (-s / 2 - 3 * ds) / (2 * q);
        dh = (s / 2 - h) / q;
        ddh = (ds / 2 - 2 * dh) / q;
    }
    const auto both = [](const Vec3& left, const Vec3& right) {
        const Mat3 one = left * right.transpose();
        return Mat3(one + one.transpose());
    };
    const Vec3 moment = a.cross(g);
    const double along = g.dot(v) * a.dot(v);
    const double first = -0.5 * s * g.dot(a) + ds * v.dot(moment) + dh * along;
    const double second = -0.5 * ds * g.dot(a) + dds * v.dot(moment) + ddh * along;
    return 2 * first * Mat3::Identity() + 4 * second * v * v.transpose() + 2 * ds * both(v, moment) +
           2 * dh * both(v, a.dot(v) * g + g.dot(v) * a) + h * both(g, a);
}

}  // namespace

AttachmentDerivative derivative_at(const Attachment& attachment, const VecX& x) {
    AttachmentDerivative out;
    const auto add = [&](int node, const Mat3& by) {
        out.node[size_t(out.count)] = node;
        out.by[size_t(out.count++)] = by;
    };
    for (int k = 0; k < attachment.count; ++k) {
        add(attachment.node[size_t(k)], attachment.weight[size_t(k)] * Mat3::Identity());
        if (attachment.turns) add(attachment.node[size_t(k)] + 1, turn_derivative(attachment, k, x));
    }
    return out;
}

Attachment tet_attachment(const TetPlace& place) {
    FROND_ASSERT(place.count >= 1 && place.count <= Attachment::MOST);
    Attachment attachment;
    attachment.count = place.count;
    std::copy_n(place.node.begin(), place.count, attachment.node.begin());
    std::copy_n(place.weight.begin(), place.count, attachment.weight.begin());
    return attachment;
}

Attachment node_attachment(int node, const Vec3& arm) {
    Attachment attachment;
    attachment.turns = true;
    attachment.count = 1;
    attachment.node[0] = 2 * node;
    attachment.weight[0] = 1;
    attachment.arm[0] = arm;
    return attachment;
}

Attachment centre_line_attachment(int begin, int end, const Vec3& axis, double along, const Vec3& across) {
    const double s = along, w = s * s * (3 - 2 * s);
    Attachment attachment;
    attachment.turns = true;
    attachment.count = 2;
    attachment.node = {2 * begin, 2 * end};
    attachment.weight = {1 - w, w};
    attachment.arm = {Vec3(s * (1 - s) * (1 - s) * axis + (1 - w) * across), Vec3(s * s * (s - 1) * axis + w * across)};
    return attachment;
}

bool is_sound(const Attachment& attachment, int node_count) {
    if (attachment.count < 1 || attachment.count > (attachment.turns ? 2 : Attachment::MOST)) return false;
    for (int k = 0; k < attachment.count; ++k) {
        if (attachment.node[size_t(k)] < 0 || attachment.node[size_t(k)] + attachment.turns >= node_count) return false;
        if (!std::isfinite(attachment.weight[size_t(k)])) return false;
    }
    return attachment.arm[0].allFinite() && attachment.arm[1].allFinite();
}

Vec3 attachment_place(const Attachment& attachment, const VecX& x) {
    LastTurns turns(x);
    return turns.place_of(attachment);
}

void attachment_places(const std::vector<Attachment>& attachments, const VecX& x, const Mat3& turn, const Vec3& shift,
                       std::vector<Vec3>& out) {
    LastTurns turns(x);
    out.resize(attachments.size());
    for (size_t i = 0; i < out.size(); ++i) out[i] = turn * turns.place_of(attachments[i]) + shift;
}

Vec3 attachment_velocity(const Attachment& attachment, const VecX& x, const VecX& v) {
    Vec3 velocity = Vec3::Zero();
    if (!attachment.turns) {
        for (int k = 0; k < attachment.count; ++k)
            velocity += attachment.weight[size_t(k)] * point(v, attachment.node[size_t(k)]);
        return velocity;
    }
    const AttachmentDerivative d = derivative_at(attachment, x);
    for (int k = 0; k < d.count; ++k) velocity += d.by[size_t(k)] * point(v, d.node[size_t(k)]);
    return velocity;
}

void add_attachment_force(const Attachment& attachment, const VecX& x, const Vec3& force, VecX& f) {
    if (!attachment.turns) {
        for (int k = 0; k < attachment.count; ++k)
            point(f, attachment.node[size_t(k)]) += attachment.weight[size_t(k)] * force;
        return;
    }
    const AttachmentDerivative d = derivative_at(attachment, x);
    for (int k = 0; k < d.count; ++k) point(f, d.node[size_t(k)]) += d.by[size_t(k)].transpose() * force;
}

void add_attachment_block(const Attachment& attachment, const VecX& x, const Mat3& block, BlockMatrix& A) {
    // The matrix has only its lower triangle.
    if (!attachment.turns) {
        for (int r = 0; r < attachment.count; ++r)
            for (int c = 0; c < attachment.count; ++c) {
                const int i = attachment.node[size_t(r)], j = attachment.node[size_t(c)];
                if (i < j) continue;
                const int slot = A.pattern->slot(i, j);
                FROND_ASSERT(slot >= 0);
                A.block(slot) += attachment.weight[size_t(r)] * attachment.weight[size_t(c)] * block;
            }
        return;
    }
    const AttachmentDerivative d = derivative_at(attachment, x);
    for (int r = 0; r < d.count; ++r)
        for (int c = 0; c < d.count; ++c) {
            const int i = d.node[size_t(r)], j = d.node[size_t(c)];
            if (i < j) continue;
            const int slot = A.pattern->slot(i, j);
            FROND_ASSERT(slot >= 0);
            A.block(slot) += d.by[size_t(r)].transpose() * block * d.by[size_t(c)];
        }
}

void add_attachment_turning(const Attachment& attachment, const VecX& x, const Vec3& force, double scale,
                            BlockMatrix& A) {
    for (int k = 0; attachment.turns && k < attachment.count; ++k) {
        const int node = attachment.node[size_t(k)] + 1;
        A.block(A.pattern->slot(node, node)) -=
            scale * turn_second_derivative(point(x, node), attachment.arm[size_t(k)], force);
    }
}

void add_attachment_stiffness(const Attachment& attachment, const VecX& x, double stiffness, BlockMatrix& A) {
    add_attachment_block(attachment, x, stiffness * Mat3::Identity(), A);
}

}  // namespace frond
