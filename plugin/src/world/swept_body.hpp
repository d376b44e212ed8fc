// SweptBody: a body that moves so fast past plants, or past which they move so fast, that Bullet may see nothing of it.
#pragma once

#include "world/sweep.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;
struct Contact;

struct SweptBody {
    btCollisionObject* object;
    ObjectMotion motion;             // in the step, as it began without contacts
    std::vector<PlantBody*> plants;  // that it may meet, by index
};

// Adds the contact of a hit, unless one like it is known. Returns whether it did; a kinematic body's replaces those
// that push the other way.
bool add_hit(World& world, PlantBody& body, const SweptBody& swept, const Hit& hit, std::vector<Contact>& contacts);

// Whether something went through another thing in spite of all contacts, and whether the next response is asked for
// more.
struct Missed {
    bool any = false, is_asked = false;
};
// Looks at the ways that waiting plants went with the contacts that are known, and that bodies will go once these have
// pushed them. Where a body goes through a plant, it adds a contact.
void add_passed_contacts(World& world, double h, Missed& missed);

// A free body that goes only a share of its way.
struct HeldBody {
    btRigidBody* rigid;
    double share;  // of its way in the step [-]
};
// Has plants that still go through each other, or free bodies that go through plants, go only as far along the step as
// none does, with all that they touch. Returns the bodies, whose motion is known once they are pushed. Reports plants
// through which kinematic bodies go, which nothing holds back.
std::vector<HeldBody> hold_back_what_passes(World& world, double h);
// Puts a free body back by what it may not go of its way in a step of h [s], at most as fast as it had the energy for.
void put_back(World& world, const HeldBody& held, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
