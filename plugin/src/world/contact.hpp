// Contact: a point at which a body of the Bullet world touches a segment of a plant, a capsule or a plate, or is about
// to touch it within the step.
#pragma once

#include "world/foreseen.hpp"
#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;

// By how much responses in a step fell short of what a contact asks, since plants respond less to a push than their
// linear response, and what it asks of the next one beyond that.
struct Shortfall {
    double lacking = 0;      // what is asked in all [m]
    double asked = 0;        // what was asked last [m]
    double left = INFINITY;  // by how much the last response fell short [m]
    bool may_ask = true;     // as far as no energy comes from it
    // Asks for what `now` is left [m], by as much more as the last response did less than it was asked for. Returns
    // whether that is of use.
    bool ask_for(double now);
};

struct Contact {
    PlantBody* plant;
    int capsule;
    double along;   // position along the capsule, 0..1 [-]
    double across;  // distance from a plate's axis towards its wide side [m]; 0 for capsules
    btCollisionObject* other;
    Vec3 on_plant, on_other;  // world frame [m]
    Vec3 normal;              // direction from the other body to the plant
    double gap;               // distance of the two along the normal when the step begins; below zero they overlap [m]
    Shortfall shortfall;      // of the responses found so far in this step
    double friction = 0;      // combined coefficient of both [-]
    double restitution = 0;   // likewise [-]
    Vec3 impulse = Vec3::Zero();    // impulse on the plant, once it is known [N s]
    Vec3 pushed_on = Vec3::Zero();  // velocity of the other body there, once it is pushed [m/s]
    double work = 0;                // of the body on the plant, once it is known [J]
    Foreseen foreseen;              // for the next step
    double part_share = 1;          // of its speed with which it parts from an overlap, so that no energy comes from it
    bool is_inside = false;         // the plant's point is on a segment's round end, within another one
};

// Returns the attachment of the touched point of the plant.
Attachment attachment_of(const Contact& contact);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
