// In: two convex shapes and their motions in a step. Out: when and where they first touch.
//
// While the gap is g along a normal, and the shapes approach along it at no more than v, they stay apart for g / v. A
// turning shape approaches by no more than its rate of turning times the distance of its farthest point.
#include "contact/shape_impact.hpp"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "collide/advance.hpp"
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

std::optional<ShapeImpact> first_impact(const MovingShape& a, const MovingShape& b) {
    constexpr double TOUCH = 2e-4;  // gap at which shapes count as touching; Bullet's is known no better [m]
    constexpr int MOST_STEPS = 64;  // shapes that slide past each other for so long count as touching
    const double turning = a.turn.norm() * reach_of(a.shape) + b.turn.norm() * reach_of(b.shape);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    btGjkPairDetector detector(&a.shape, &b.shape, &simplex, &depth);
    struct ShapeGap {
        double distance;  // [m]
        Vec3 normal, on_b;
        double approach;  // upper bound of the speed along the normal [m a step]
    };
    const auto gap_at = [&](double time) -> ShapeGap {
        btGjkPairDetector::ClosestPointInput input;
        input.m_transformA = a.at(time);
        input.m_transformB = b.at(time);
        btPointCollector nearest;
        detector.getClosestPoints(input, nearest, nullptr);
        if (!nearest.m_hasResult) return {INFINITY, Vec3::Zero(), Vec3::Zero(), 0};
        const Vec3 normal = from_bullet(nearest.m_normalOnBInWorld);
        return {double(nearest.m_distance), normal, from_bullet(nearest.m_pointInWorld),
                normal.dot(b.way - a.way) + turning};
    };
    const auto until = [](double time, const ShapeGap& gap) {
        return gap.approach > 0 ? time + gap.distance / gap.approach : INFINITY;
    };
    std::optional<ShapeImpact> impact;
    advance(TOUCH, MOST_STEPS, gap_at, until, [&](double time, const ShapeGap& gap) {
        // What touches and parts does not meet.
        if (gap.approach > 0) impact = ShapeImpact{time, gap.normal, gap.on_b + gap.distance * gap.normal, gap.on_b};
    });
    return impact;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
