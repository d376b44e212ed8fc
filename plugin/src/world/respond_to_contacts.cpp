// In: contacts, and plants whose step is solved but not yet accepted. Out: impulses on plants and bodies.
//
// A plant answers with the inverse of its own implicit system, so that resting, pushing and stacking need no penalties:
// what a stem can bear within the step it bears. Bodies have moved already when plants step, so an impulse changes how
// they move next; both sides of a contact are advanced from the places at which it was found.
#include <algorithm>
#include <map>

#include "plant/touch.hpp"
#include "solve/impulses.hpp"
#include "world/pusher.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// How fast two that overlap must part, and how fast two that do not may still approach [m/s].
double least_speed(double gap, double h) {
    constexpr double SLOP = 0.0005, SHARE = 0.2, FASTEST = 1;  // [m], of the overlap a step, [m/s]
    if (gap >= 0) return -gap / h;
    return std::min(SHARE * std::max(0.0, -gap - SLOP) / h, FASTEST);
}

// Both sides of the contacts that have an answer.
struct Sides {
    std::vector<Contact*> contacts;
    std::vector<PlantTouch> plants;
    std::vector<Pusher> pushers;
};

Sides make_sides(std::vector<Contact>& contacts, double h) {
    Sides sides;
    for (Contact& contact : contacts) {
        Plant& plant = *contact.plant->plant;
        PlantTouch touch;
        if (!make_touch(plant, capsule_grip(plant, contact.capsule, contact.along), touch)) continue;
        wake(*contact.other, contact.normal, touch.velocity);
        sides.contacts.push_back(&contact);
        sides.plants.push_back(std::move(touch));
        sides.pushers.push_back(make_pusher(*contact.other, contact.on_other, h));
    }
    return sides;
}

std::vector<std::vector<Coupling>> couple(const Sides& sides) {
    const size_t count = sides.contacts.size();
    std::vector<std::vector<Coupling>> coupling(count);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++) {
            Mat3 block = answer_between(sides.pushers[i], sides.pushers[j]);
            if (sides.contacts[i]->plant == sides.contacts[j]->plant)
                block += answer_at(*sides.contacts[i]->plant->plant, sides.plants[i].grip, sides.plants[j]);
            if (!block.isZero(0)) coupling[i].push_back({int(j), block});
        }
    return coupling;
}

}  // namespace

void respond_to_contacts(World& world, std::vector<Contact>& contacts, double h) {
    Sides sides = make_sides(contacts, h);
    std::vector<Touch> touches;
    for (size_t i = 0; i < sides.contacts.size(); i++) {
        const Contact& contact = *sides.contacts[i];
        const bool rubs = world.effects & contact.plant->plant->effects & FROND_FRICTION;
        touches.push_back({contact.normal, sides.plants[i].velocity - sides.pushers[i].velocity,
                           least_speed(contact.gap, h), rubs ? contact.friction : 0});
    }
    std::vector<Vec3> impulses;
    find_impulses(touches, couple(sides), {}, impulses);
    for (size_t i = 0; i < impulses.size(); i++) {
        if (impulses[i].isZero(0)) continue;
        sides.contacts[i]->impulse = impulses[i];
        take_impulse(*sides.contacts[i]->plant->plant, sides.plants[i], impulses[i]);
    }
    for (const std::unique_ptr<PlantBody>& body : world.bodies) add_contacts(*body->plant, h);
    // A plant that cannot bear it is put back, and then pushes nothing.
    for (size_t i = 0; i < impulses.size(); i++) {
        const Plant& plant = *sides.contacts[i]->plant->plant;
        const bool pushes_back = world.effects & plant.effects & FROND_TWO_WAY;
        if (!pushes_back || !plant.is_sound || impulses[i].isZero(0)) continue;
        take_impulse(sides.pushers[i], -impulses[i]);
        if (sides.pushers[i].rigid) give_gravity(world.gravity_ahead, *sides.pushers[i].rigid, h);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
