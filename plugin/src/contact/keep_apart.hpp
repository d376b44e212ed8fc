// What the response known so far leaves undone: contacts that ask for more, and plants that are held back.
#pragma once

#include "contact/sweep.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// How a plant stands between two responses of a step.
enum class Answer : uint8_t {
    fresh,  // the last response answered its island
    kept,   // an earlier one did; what other islands do now may come at it
    last    // its island gets no more responses
};
using Answers = std::vector<Answer>;  // by the plants' numbers
inline bool stands(const PlantBody& body, const Answers& answers, Answer as) {
    return answers[size_t(body.number)] == as;
}

// Plants that something went through in spite of all contacts, or nearly, and those of whose islands the next response
// is asked for more; some twice.
struct Missed {
    std::vector<const PlantBody*> passed, asked;
};
// Returns how deep a body goes into a segment before that counts as missed [m].
double least_miss(const PlantBody& body, int capsule);
// Returns whether a kinematic body moves there. What rests in a plant parts from it slowly, as any other body.
bool is_carried_on(const Contact& contact);
// Most that a body pushes an organ with, over what carries and bends all that the organ bears: as much as bends a stem
// over at 0.17 of its height, by one over the square of that [-].
constexpr double MOST_LOAD = 34;
// Returns whether a free body weighs more than what bears a mass [kg] is pushed with: nothing that it does stops it.
bool is_heavy(const btCollisionObject& object, double borne);
// Returns whether a body goes on whatever the plant does: it is led there, or heavy for the plant as a whole.
bool goes_on(const Contact& contact);
// Returns how fast a plant parts at most from a led body that overlaps it: by how far it came at the plant in this
// step, and by what is left of earlier ones [m/s].
double fastest_from_led(const Contact& contact);
// Looks at the ways that watched plants went with the contacts that are known. Where strips, or bodies, went through
// them, or nearly, it adds contacts or has those that are known ask for more.
Missed find_missed_contacts(World& world, double h, const Answers& answers);
// Does so where plants went through plants, or nearly. `lacking`: of what the contacts ask for more. Null: all plants
// are looked at.
Missed add_missed_contacts(World& world, double PlantContact::*lacking, const Answers* answers);
// Reports plants that a body that goes on has come past, whatever was asked of their contacts. Those whose island gets
// no more responses let it through.
void tell_what_is_behind(World& world, double h, const Answers& answers);
// Returns the plants that go through bodies that move fast, or, if asked, through each other, on their ways in the
// step; some twice.
std::vector<PlantBody*> find_crossing_plants(World& world, double h, bool by_plants);
// Adds those that go through a body.
void add_plants_in_bodies(const World& world, double h, std::vector<PlantBody*>& plants);
// Returns the share of the step's way that an island's plants may go until strips would go through each other.
double way_until_crossing(PlantSearch& memory);

// Adds the contact of a hit, unless one like it is known. Returns whether it did; a kinematic body's replaces those
// that push the other way.
bool add_hit(World& world, PlantBody& body, const SweptBody& swept, const Hit& hit, std::vector<Contact>& contacts);

// Looks at the ways that waiting plants went with the contacts that are known, and that bodies will go once these have
// pushed them. Where a body goes through a plant, it adds a contact.
void add_passed_contacts(World& world, double h, const Answers& answers, Missed& missed);

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
