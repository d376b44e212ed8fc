// Sweeps: how far bodies and pieces of plants move in a step, and which of them meet.
#pragma once

#include <functional>

#include "contact/shape_impact.hpp"
#include "world/swept_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Returns the motion in h [s] from where the object is, at its present velocity; none for static and sleeping ones.
ObjectMotion motion_of(const btCollisionObject& object, double h);
// Returns the same motion, ending where the object is.
ObjectMotion backwards(ObjectMotion motion);

// Returns the displacement in a step from which on something is swept: less is seen where it ends. What lies on leaves
// moves by less, and comes to rest better by Bullet's own contacts [m].
double far_for(const btCollisionObject& object);

// Displacements of a plant's chain nodes in a step, world frame [m].
struct PlantMotion {
    std::vector<Vec3> ways;
    double farthest = 0;
    bool is_past = false;  // they lead to where the plant is, not on from there
};
// Returns them as they are if nothing touches the plant.
PlantMotion motion_of(const PlantBody& body, double h);
// Returns them as the step that is solved but not yet accepted has them; none where there is no such step.
PlantMotion motion_in_step(const PlantBody& body);
// Returns the motion of a plant's capsule or plate.
MovingShape moving_piece(const PlantBody& body, const PlantMotion& motion, int child, int capsule);

struct Box {
    btVector3 lower, upper;
    void widen(double by);
    void add(const Box& other);
};
// Returns the box of a shape over all its motion.
Box box_of(const btCollisionShape& shape, const ObjectMotion& motion);

// Calls `take` for the convex parts of a shape, triangles of meshes among them, that may come into a box.
void for_each_convex(const btCollisionShape& shape, const ObjectMotion& motion, const Box& box,
                     const std::function<void(const MovingShape&)>& take);
// Calls `take` for the children of a plant whose boxes overlap one in the world's frame, but for covered ones.
void for_each_child(PlantBody& body, const Box& box, const std::function<void(int child, int capsule)>& take);

// A piece of a plant that a body's shape touches first at impact.time.
struct Hit {
    int capsule;
    const MovingShape& piece;
    const MovingShape& shape;
    ShapeImpact impact;
};
// Calls `take` for all impacts of an object with a plant that goes on as it moves.
void find_hits(PlantBody& body, const PlantMotion& of_plant, const btCollisionObject& object,
               const ObjectMotion& of_object, const std::function<void(const Hit&)>& take);
// Does the same, and for pieces that are not met like that, but would be if they stayed where they are: the plant may
// be held back.
void find_foreseen_hits(PlantBody& body, const PlantMotion& of_plant, const btCollisionObject& object,
                        const ObjectMotion& of_object, const std::function<void(const Hit&)>& take);
// Returns how deep a hit's points are in each other at the end of the step [m].
double depth_after(const Hit& hit);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
