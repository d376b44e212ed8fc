// Bond: a point of a plant held to a body of the host's, a fruit in a gripper, a pot that is carried.
#pragma once

#include "plant/touch.hpp"
#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;

struct Bond {
    PlantBody* plant;
    int vertex;                   // of the plant's surface
    btCollisionObject* body;      // null once it has left the world: nothing holds any more
    Vec3 on_body;                 // where it is held, in the body's frame [m]
    Vec3 impulse = Vec3::Zero();  // on the plant, of the last substep [N s]
    double length = 1;            // of that substep [s]
    uint64_t handle = 0;          // of the C API
};

// Holds the surface's vertex nearest to a point of the world to where the body is there now.
Bond& add_bond(World& world, PlantBody& plant, const Vec3& point, btCollisionObject& body);
Vec3 held_place(const Bond& bond);  // on the plant, world frame [m]
Vec3 place_on_body(const Bond& bond);
// Bonds to bodies that have left the world hold nothing from now on.
void let_go_of_gone(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
