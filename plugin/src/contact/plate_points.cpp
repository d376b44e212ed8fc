// In: a plate, and a convex body near it. Out: the points at which they touch if they do: the outline of the body's
// side that faces the plate, clipped by the plate (Sutherland, Hodgman 1974, "Reentrant polygon clipping").
#include <cmath>

#include "contact/plate.hpp"
#include "core/elementary.hpp"
#include "world/convert.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Points from the middle of the plate: x is wide, y along, z thin [m].
using Outline = std::vector<Vec3>;

// Clips an outline along an axis: keeps the part below `most`, or with sign -1 the part above -most.
Outline clip(const Outline& outline, int axis, double sign, double most) {
    Outline inside;
    for (size_t i = 0; i < outline.size(); i++) {
        const Vec3 &from = outline[i], &to = outline[(i + 1) % outline.size()];
        const double before = most - sign * from[axis], after = most - sign * to[axis];
        if (before >= 0) inside.push_back(from);
        if ((before > 0 && after < 0) || (before < 0 && after > 0))
            inside.push_back(from + before / (before - after) * (to - from));
    }
    return inside;
}

// Drops points that are close to another one.
void drop_doubles(Outline& outline) {
    constexpr double BESIDE = 0.001;  // [m]
    Outline kept;
    for (const Vec3& p : outline) {
        bool is_new = true;
        for (const Vec3& other : kept) is_new = is_new && (p - other).norm() > BESIDE;
        if (is_new) kept.push_back(p);
    }
    outline = kept;
}

}  // namespace

std::vector<Vec3> points_over_plate(const PlantBody& body, int capsule, const btCollisionObject& other,
                                    const Vec3& towards) {
    constexpr double FACING = 0.7;  // cosine
    // Slopes of the body's side against the plate: of a face on it, then of edges that slope over its rim [-].
    constexpr double TILTS[] = {0.05, 0.2, 0.6};
    constexpr double NEAR = 0.005;  // height above the plate up to which points of slopes are used [m]
    constexpr int DIRECTIONS = 8;   // around the plate, in which slopes are looked for
    const Plant& plant = *body.plant;
    const Flat& flat = body.hull->flats[size_t(capsule)];
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    Mat3 piece;
    if (!other.getCollisionShape()->isConvex() || !piece_frame(plant, end, flat.wide, flat.spread, piece)) return {};
    Mat3 frame;
    frame << plant.rotation * piece.col(2), plant.rotation * piece.col(0), plant.rotation * piece.col(1);
    const Vec3 a = plant.to_world(plant.view.chain_positions[size_t(begin)]);
    const Vec3 b = plant.to_world(plant.view.chain_positions[size_t(end)]), middle = 0.5 * (a + b);
    const double facing = towards.dot(frame.col(2));
    if (std::abs(facing) < FACING) return {};

    const auto& shape = static_cast<const btConvexShape&>(*other.getCollisionShape());
    const btTransform& place = other.getWorldTransform();
    const double half_width = flat.half_width - flat.half_thickness, half_length = 0.5 * (b - a).norm();
    Outline points;
    for (const double tilt : TILTS) {
        // The body's outermost points in directions around the plate's normal.
        Outline outline;
        for (int k = 0; k < DIRECTIONS; k++) {
            const double turn = 2 * PI * k / DIRECTIONS;
            const Vec3 aside = tilt * (frond::cos(turn) * frame.col(0) + frond::sin(turn) * frame.col(1));
            const btVector3 way = to_bullet(Vec3(std::copysign(1.0, facing) * frame.col(2) + aside));
            const btVector3 point = place * shape.localGetSupportingVertex(way * place.getBasis());
            outline.push_back(frame.transpose() * (from_bullet(point) - middle));
        }
        for (const double sign : {-1.0, 1.0}) {
            outline = clip(outline, 0, sign, half_width);
            outline = clip(outline, 1, sign, half_length);
        }
        for (const Vec3& p : outline)
            if (tilt == TILTS[0] || std::abs(p.z()) < flat.half_thickness + NEAR) points.push_back(p);
    }
    drop_doubles(points);
    for (Vec3& p : points) p = middle + frame * p;
    return points;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
