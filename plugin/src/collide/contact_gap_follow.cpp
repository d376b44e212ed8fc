// Follows a contact: its last place and the cages' present places come in; the nearest places of both now go out.
#include <algorithm>

#include "collide/contact_gap.hpp"
#include "collide/penetration.hpp"
#include "surface/triangle_distance.hpp"

namespace frond {

// Part of a's side: a node, or the stretch of an edge around the point that touched.
struct Stretch {
    std::array<Vec3, 2> ends;
    std::array<double, 2> along;  // positions along the edge, 0..1 [-]
};

static Stretch stretch_of(const CollisionBody& a, const ContactSide& side) {
    constexpr double AROUND = 0.01;  // [m]
    const Vec3& begin = a.places[side.nodes[0]];
    if (side.node_count == 1) return {{begin, begin}, {0, 0}};
    const Vec3 edge = a.places[side.nodes[1]] - begin;
    const double share = AROUND / std::max(edge.norm(), 1e-9);
    const double first = std::max(0.0, side.weights[1] - share), last = std::min(1.0, side.weights[1] + share);
    return {{begin + first * edge, begin + last * edge}, {first, last}};
}

// Returns the barycentric weights of a point of a triangle; the first corner's if it has no area.
static std::array<double, 3> weights_in(const Corners& corners, const Vec3& p) {
    const Vec3 across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double squared = across.squaredNorm();
    if (!(squared > 0)) return {1, 0, 0};
    const double second = across.dot((p - corners[0]).cross(corners[2] - corners[0])) / squared;
    const double third = across.dot((corners[1] - corners[0]).cross(p - corners[0])) / squared;
    return {1 - second - third, second, third};
}

bool follow_contact(const CollisionBody& a, const CollisionBody& b, double reach, CageContact& contact) {
    constexpr double TURNED = 0.3, TOUCHING = 1e-5;  // cosine; [m]
    const Stretch stretch = stretch_of(a, contact.a);
    const Vec3 around = Vec3::Constant(reach);
    const Vec3 lower = stretch.ends[0].cwiseMin(stretch.ends[1]) - around;
    const Vec3 upper = stretch.ends[0].cwiseMax(stretch.ends[1]) + around;
    NearestPair nearest = {Vec3::Zero(), Vec3::Zero(), reach * reach};
    int nearest_face = -1;
    for (size_t f = 0; f < b.collider->faces.size(); ++f) {
        const int piece = b.collider->tet_piece[size_t(b.collider->face_tet[f])];
        if (piece != contact.b.piece && !b.collider->are_near(piece, contact.b.piece)) continue;
        if (a.collider == b.collider && a.places == b.places && b.collider->are_near(piece, contact.a.piece)) continue;
        const Triangle& face = b.collider->faces[f];
        const Corners corners = {b.places[face[0]], b.places[face[1]], b.places[face[2]]};
        if ((corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]).array() > upper.array()).any() ||
            (corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]).array() < lower.array()).any())
            continue;
        const Vec3 across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        if (!(across.dot(contact.normal) > TURNED * across.norm())) continue;  // the far side of a blade
        const NearestPair pair = nearest_of_segment_and_triangle(stretch.ends[0], stretch.ends[1], corners);
        if (pair.squared >= nearest.squared) continue;
        nearest = pair;
        nearest_face = int(f);
    }
    if (nearest_face < 0) return false;

    const double gap = std::sqrt(nearest.squared);
    const Vec3 apart = nearest.a - nearest.b;
    const double cosine = gap > TOUCHING ? apart.dot(contact.normal) / gap : 1;
    if (std::abs(cosine) < TURNED) return false;
    const Triangle& face = b.collider->faces[size_t(nearest_face)];
    const std::array<double, 3> weights =
        weights_in({b.places[face[0]], b.places[face[1]], b.places[face[2]]}, nearest.b);
    contact.b = side_of_nodes(*b.collider, contact.b.body, face.data(), weights.data(), 3,
                              b.collider->face_tet[size_t(nearest_face)]);
    if (contact.a.node_count == 2) {
        const Vec3 edge = a.places[contact.a.nodes[1]] - a.places[contact.a.nodes[0]];
        const double along = (nearest.a - a.places[contact.a.nodes[0]]).dot(edge) / std::max(edge.squaredNorm(), 1e-18);
        contact.a.weights[1] = std::clamp(along, 0.0, 1.0);
        contact.a.weights[0] = 1 - contact.a.weights[1];
    }
    contact.point = nearest.a;
    if (gap > TOUCHING) contact.normal = apart / (cosine > 0 ? gap : -gap);
    contact.depth = cosine > 0 ? -gap : gap;
    return true;
}

}  // namespace frond
