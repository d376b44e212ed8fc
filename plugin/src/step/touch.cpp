#include "step/touch.hpp"

#include <LinearMath/btQuickprof.h>

#include <algorithm>

#include "contact/contact_body.hpp"
#include "contact/contact_rows.hpp"
#include "contact/find_contacts.hpp"
#include "contact/find_plant_contacts.hpp"
#include "core/lists.hpp"
#include "core/timer.hpp"
#include "plant/fibres.hpp"
#include "step/report.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

constexpr double ENTANGLED = 0.0007;  // overlap of plants beyond that of mere touch [m]

namespace {

bool any_wants(const World& world, frond_effects effect) {
    return std::any_of(world.awake.begin(), world.awake.end(),
                       [&](const PlantBody* body) { return body->plant->input.effects & world.effects & effect; });
}

// Returns whether a body touches the plant, or may within two steps of h [s] at its speed.
bool meets(const Contact& contact, double h) {
    constexpr double NEAR = 0.001;  // [m]
    const Vec3 velocity = make_contact_body(*contact.other, contact.on_other, h).velocity;
    return contact.gap < NEAR + 2 * h * velocity.norm();
}

// Wakes sleepers that contacts move, and removes the contacts of plants that sleep on.
void wake_touched(World& world, double h) {
    for (const Contact& contact : world.contacts)
        if (contact.plant->rest.asleep && is_moving(*contact.other) && meets(contact, h) &&
            !is_still(world, *contact.plant))
            wake(*contact.plant);
    for (const PlantContact& contact : world.plant_contacts) {
        const auto& [first, second] = contact.plants;
        PlantBody& sleeper = first->rest.asleep ? *first : *second;
        if (contact.depth > 0 && first->rest.asleep != second->rest.asleep && !is_still(world, sleeper)) wake(sleeper);
    }
    const auto sleeps = [](const PlantBody* body) { return body->rest.asleep; };
    const auto of_sleeper = [&](const Contact& contact) { return sleeps(contact.plant); };
    remove_where(world.contacts, of_sleeper);
    const auto with_sleeper = [&](const PlantContact& contact) {
        return std::any_of(contact.plants.begin(), contact.plants.end(), sleeps);
    };
    remove_where(world.plant_contacts, with_sleeper);
}

// Marks the plants that contacts and bonds push.
void mark_pushed(World& world) {
    for (const Contact& contact : world.contacts) {
        contact.plant->plant->state.is_touched = true;
        contact.plant->plant->step.is_pressed |= !contact.other->isStaticObject();
    }
    for (const PlantContact& contact : world.plant_contacts)
        for (PlantBody* body : contact.plants) {
            body->plant->state.is_touched = true;
            body->plant->step.is_pressed |= contact.plants[0] != contact.plants[1];
            body->plant->state.is_entangled |= contact.depth > ENTANGLED;
        }
    for (const Bond& bond : world.bonds) {
        Plant& plant = *bond.plant->plant;
        plant.state.is_touched = plant.step.is_pressed = true;
        if (bond.body && !bond.plant->rest.asleep && is_on_fibre(plant, bond.vertex))
            plant.step.bonded.push_back(bond.vertex);
    }
}

}  // namespace

void find_touches(World& world, double h) {
    BT_PROFILE("frond collide");
    const Timer find_timer;
    wake_by_world(world);
    const std::vector<Contact> last = std::move(world.contacts);
    world.contacts.clear();
    world.swept.clear();
    for (PlantBody* body : world.awake) body->plant->step.is_among_bodies = false;
    if (world.effects & FROND_EFFECT_RIGID_CONTACT &&
        (world.awake.size() < world.bodies.size() || any_wants(world, FROND_EFFECT_RIGID_CONTACT))) {
        const Timer timer;
        world.contacts = find_contacts(world, last, h);
        add_effect(world, FROND_EFFECT_RIGID_CONTACT, timer.ms());
    }
    const frond_effects among = FROND_EFFECT_PLANT_CONTACT | FROND_EFFECT_SELF_CONTACT;
    // Also where no plant wants any: what is known of the last substep's ends.
    const Timer timer;
    world.plant_contacts = find_plant_contacts(world, h);
    if (any_wants(world, among))
        add_effect(
            world,
            any_wants(world, FROND_EFFECT_PLANT_CONTACT) ? FROND_EFFECT_PLANT_CONTACT : FROND_EFFECT_SELF_CONTACT,
            timer.ms());
    wake_touched(world, h);
    world.profile.ms_collide = find_timer.ms();
}

void note_touches(World& world) {
    constexpr double NEAR = 0.02;  // [m]
    if (!world.detail) return;
    for (const Contact& contact : world.contacts)
        if (contact.gap < NEAR && is_moving(*contact.other)) disturb(*contact.plant);
}

void mark_touched(World& world) {
    const auto sways = [](const PlantBody* body) { return body->plant->state.modal != nullptr; };
    remove_where(world.contacts, [&](const Contact& contact) { return sways(contact.plant); });
    remove_where(world.plant_contacts,
                 [&](const PlantContact& c) { return sways(c.plants[0]) || sways(c.plants[1]) || !is_by_the_same(c); });
    for (PlantBody* body : world.awake) {
        body->plant->state.is_touched = body->plant->step.is_pressed = body->plant->state.is_entangled = false;
        body->plant->step.bonded.clear();
        body->level.is_due = (world.substep + uint64_t(body->index)) % uint64_t(body->level.every) == 0;
    }
    if (response_row(world.response).find) mark_pushed(world);
    for (const SweptBody& swept : world.swept)
        for (PlantBody* body : swept.plants)
            if (!body->rest.asleep) body->plant->step.is_watched = body->level.is_due = true;
    for (PlantBody* body : world.awake)
        if (body->plant->state.is_touched || body->plant->input.has_user_force) body->level.is_due = true;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
