// First touch of two convex shapes of Bullet that move through a step.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <cmath>
#include <optional>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// A shape's frame at the start of the step, and how far it goes from there: its origin along a straight line, about
// which it turns at constant speed.
struct MovingShape {
    const btConvexShape& shape;
    btTransform from;
    Vec3 way = Vec3::Zero();   // displacement of the origin [m]
    Vec3 turn = Vec3::Zero();  // rotation vector [rad]

    btTransform at(double time) const;
};

struct ShapeImpact {
    double time;      // share of the step, 0..1 [-]; 0 where they touch or overlap from the start
    Vec3 normal;      // from b to a, length one
    Vec3 on_a, on_b;  // the points that touch, in the world frame at that time [m]
};

// Finds the first touch; nothing where the shapes do not meet. None is missed: time is approached from below by
// conservative advancement (Mirtich 1996, "Impulse-based Dynamic Simulation of Rigid Body Systems"; Bullet's own
// btContinuousConvexCollision gives up after a number of iterations).
std::optional<ShapeImpact> first_impact(const MovingShape& a, const MovingShape& b);

// Nearest points of two shapes, or those at which they part on the shortest way, by Bullet's GJK and EPA.
struct ShapeGap {
    double distance = INFINITY;                                            // below zero where they overlap [m]
    Vec3 normal = Vec3::Zero(), on_a = Vec3::Zero(), on_b = Vec3::Zero();  // from b to a; zero if there are none
};
ShapeGap gap_between(const btConvexShape& a, const btTransform& at_a, const btConvexShape& b, const btTransform& at_b);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
