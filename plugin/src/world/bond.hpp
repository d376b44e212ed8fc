// Bond: a point of a plant held to a body of the Bullet world: a fruit in a gripper, a pot that is carried.
#pragma once

#include "plant/touch.hpp"
#include "world/foreseen.hpp"
#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;

struct Bond {
    PlantBody* plant;
    int vertex;                   // vertex of the plant's surface
    btCollisionObject* body;      // null once it has left the world: the bond then holds nothing
    Vec3 on_body;                 // held place, in the body's frame [m]
    Vec3 impulse = Vec3::Zero();  // impulse on the plant in the last substep [N s]
    double work = 0;              // of the body on the plant in that substep [J]
    double length = 1;            // length of that substep [s]
    Foreseen foreseen;            // for the next one, if the body is a link
    uint64_t handle = 0;          // handle in the C API
};

// Bonds the surface vertex nearest to `point`, in the world's frame, to the place of the body where the vertex is now.
Bond& add_bond(World& world, PlantBody& plant, const Vec3& point, btCollisionObject& body);
Vec3 held_place(const Bond& bond);  // held point of the plant, world frame [m]
Vec3 place_on_body(const Bond& bond);
// Ends the hold of bonds whose body has left the world or whose vertex has come off with a fragment.
void let_go_of_gone(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
