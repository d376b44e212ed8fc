// SweptBody: a body that moves so fast past plants, or past which they move so fast, that Bullet may see nothing of it.
#pragma once

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Where an object begins, and how far it moves.
struct ObjectMotion {
    btTransform from;
    Vec3 way = Vec3::Zero(), turn = Vec3::Zero();  // [m], [rad]
    // Returns whether it moves by more than `far` [m], or turns by more than that [rad].
    bool is_far(double far) const { return way.norm() > far || turn.norm() > far; }
};
struct SweptBody {
    btCollisionObject* object;
    ObjectMotion motion;             // in the step, as it began without contacts
    std::vector<PlantBody*> plants;  // that it may meet, by index
};

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
