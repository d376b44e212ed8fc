// In: two convex shapes and their motions in a step. Out: when and where they first touch.
//
// While the gap is g along a normal, and the shapes approach along it at no more than v, they stay apart for g / v. A
// turning shape approaches by no more than its rate of turning times the distance of its farthest point.
#include "world/shape_impact.hpp"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

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
    double time = 0;
    for (int step = 0;; step++) {
        btGjkPairDetector::ClosestPointInput input;
        input.m_transformA = a.at(time);
        input.m_transformB = b.at(time);
        btPointCollector nearest;
        detector.getClosestPoints(input, nearest, nullptr);
        if (!nearest.m_hasResult) return std::nullopt;
        const Vec3 normal = from_bullet(nearest.m_normalOnBInWorld), on_b = from_bullet(nearest.m_pointInWorld);
        const double gap = double(nearest.m_distance), approach = normal.dot(b.way - a.way) + turning;
        if (!(approach > 0)) return std::nullopt;
        if (gap <= TOUCH || step == MOST_STEPS) return ShapeImpact{time, normal, on_b + gap * normal, on_b};
        time += gap / approach;
        if (!(time <= 1)) return std::nullopt;
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
