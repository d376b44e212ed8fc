// In: two convex shapes and their motions in a step. Out: when and where they first touch.
//
// While the gap is g along a normal, and the shapes approach along it at no more than v, they stay apart for g / v. A
// turning shape approaches by no more than its rate of turning times the distance of its farthest point.
#include "contact/shape_impact.hpp"

#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <cmath>

#include "collide/advance.hpp"
#include "collide/capsule.hpp"
#include "world/convert.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

btTransform MovingShape::at(double time) const {
    return moved(from, way, turn, time);
}

static double reach_of(const btConvexShape& shape) {
    btVector3 centre;
    btScalar radius;
    shape.getBoundingSphere(centre, radius);
    return double(centre.length() + radius);
}

namespace {

struct GapFinder {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    btGjkPairDetector detector;
    GapFinder(const btConvexShape& a, const btConvexShape& b) : detector(&a, &b, &simplex, &depth) {}
    ShapeGap find(const btTransform& a, const btTransform& b) {
        btGjkPairDetector::ClosestPointInput input;
        input.m_transformA = a;
        input.m_transformB = b;
        btPointCollector nearest;
        detector.getClosestPoints(input, nearest, nullptr);
        if (!nearest.m_hasResult) return {};
        const double distance = double(nearest.m_distance);
        const Vec3 normal = from_bullet(nearest.m_normalOnBInWorld), on_b = from_bullet(nearest.m_pointInWorld);
        return {distance, normal, on_b + distance * normal, on_b};
    }
};

// Returns whether a shape is a capsule or a sphere, and which one.
bool is_capsule(const MovingShape& shape, Capsule& as) {
    btVector3 half(0, 0, 0);
    if (shape.shape.getShapeType() == SPHERE_SHAPE_PROXYTYPE) {
        as.radius = double(static_cast<const btSphereShape&>(shape.shape).getRadius());
    } else if (shape.shape.getShapeType() == CAPSULE_SHAPE_PROXYTYPE) {
        const auto& capsule = static_cast<const btCapsuleShape&>(shape.shape);
        half[capsule.getUpAxis()] = capsule.getHalfHeight();
        as.radius = double(capsule.getRadius());
    } else {
        return false;
    }
    as.begin = from_bullet(shape.from * -half);
    as.end = from_bullet(shape.from * half);
    return true;
}

// Quick: returns whether two capsules are farther apart than they can come nearer in the step.
bool are_out_of_reach(const MovingShape& a, const MovingShape& b, double turning) {
    constexpr double MARGIN = 0.001;  // [m]
    Capsule of_a, of_b;
    return is_capsule(a, of_a) && is_capsule(b, of_b) &&
           gap_between(of_a, of_b).distance > (b.way - a.way).norm() + turning + MARGIN;
}

}  // namespace

ShapeGap gap_between(const btConvexShape& a, const btTransform& at_a, const btConvexShape& b, const btTransform& at_b) {
    return GapFinder(a, b).find(at_a, at_b);
}

std::optional<ShapeImpact> first_impact(const MovingShape& a, const MovingShape& b) {
    constexpr double TOUCH = 2e-4;  // gap at which shapes count as touching; Bullet's is known no better [m]
    constexpr int MOST_STEPS = 64;  // shapes that slide past each other for so long count as touching
    const double turning = a.turn.norm() * reach_of(a.shape) + b.turn.norm() * reach_of(b.shape);
    std::optional<ShapeImpact> impact;
    if (are_out_of_reach(a, b, turning)) return impact;
    GapFinder finder(a.shape, b.shape);
    const auto gap_at = [&](double time) { return finder.find(a.at(time), b.at(time)); };
    // An upper bound of the speed along the normal [m a step].
    const auto approach = [&](const ShapeGap& gap) {
        return std::isfinite(gap.distance) ? gap.normal.dot(b.way - a.way) + turning : 0;
    };
    const auto until = [&](double time, const ShapeGap& gap) {
        return approach(gap) > 0 ? time + gap.distance / approach(gap) : INFINITY;
    };
    advance(TOUCH, MOST_STEPS, gap_at, until, [&](double time, const ShapeGap& gap) {
        // What touches and parts does not meet.
        if (approach(gap) > 0) impact = ShapeImpact{time, gap.normal, gap.on_a, gap.on_b};
    });
    return impact;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
