// In: a snapshot that fits a world. Out: the world in the snapshot's state.
#include <algorithm>

#include "plant/pins.hpp"
#include "world/link_loads.hpp"
#include "world/snapshot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

btVector3 vector_of(const std::array<btScalar, 3>& v) {
    return btVector3(v[0], v[1], v[2]);
}

btTransform frame_of(const std::array<btScalar, 12>& n) {
    return btTransform(btMatrix3x3(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]),
                       btVector3(n[9], n[10], n[11]));
}

btCollisionObject* object_at(const World& world, int place) {
    return world.bullet->getCollisionObjectArray()[place];
}

void put_touches(const World& world, const SavedTouches& saved, std::vector<Contact>& with_bodies,
                 std::vector<PlantContact>& with_plants) {
    with_bodies.clear();
    with_plants.clear();
    for (const SavedContact& s : saved.with_bodies) {
        Contact contact = {};
        contact.plant = world.bodies[size_t(s.plant)].get();
        contact.capsule = s.capsule;
        contact.along = s.along;
        contact.across = s.across;
        contact.other = object_at(world, s.other);
        contact.on_plant = s.on_plant;
        contact.on_other = s.on_other;
        contact.normal = s.normal;
        contact.gap = s.gap;
        contact.friction = s.friction;
        contact.impulse = s.impulse;
        contact.foreseen = s.foreseen;
        with_bodies.push_back(contact);
    }
    for (const SavedPlantContact& s : saved.with_plants) {
        with_plants.push_back(s.contact);
        for (size_t k = 0; k < 2; k++) {
            PlantBody& body = *world.bodies[size_t(s.plants[k])];
            with_plants.back().plants[k] = &body;
            take_collider(body);  // for its present mechanics; it may have none yet
        }
    }
}

void put_modal(const SavedModal& saved, Plant& plant) {
    begin_modal(plant);
    ModalMotion& modal = *plant.state.modal;
    modal.place = saved.place;
    modal.speed = saved.speed;
    modal.rest = saved.rest;
    modal.damping = saved.damping;
    modal.since = saved.since;
    modal.comes_to_rest = saved.comes_to_rest;
    modal.fresh = saved.fresh;
    modal.blend_out = saved.blend_out;
    modal.stale = false;  // the chain was posed when it was saved
}

void put_plant(SavedPlant& saved, PlantBody& body) {
    Plant& plant = *body.plant;
    end_modal(plant);
    give_supports(plant, {});
    set_mechanics(plant, saved.which);
    if (!saved.modal.empty()) put_modal(saved.modal.front(), plant);
    plant.input.pinned = std::move(saved.pinned);
    plant.input.pin_target = std::move(saved.pin_target);
    plant.input.anchor = std::move(saved.anchor);
    give_supports(plant, std::move(saved.supports));
    apply_pins(plant);  // makes the pins' springs; the rest is in the motion
    plant.state.motion = std::move(saved.motion);
    plant.state.trend = std::move(saved.trend);
    plant.state.blend_out = std::move(saved.blend_out);
    plant.view.lead = saved.lead;
    plant.state.stepped_by = 0;
    if (saved.has_own_elements || plant.state.own_elements) set_plastic(plant, saved.plastic);
    const size_t fibres = plant.fibres ? plant.fibres->list.size() : 0;
    plant.state.fibre_give = saved.fibre_give.size() == fibres ? std::move(saved.fibre_give) : std::vector<double>();
    plant.input.pins_changed = saved.pins_changed;
    plant.input.pins_are_own = saved.pins_are_own;
    plant.state.fibre_force = std::move(saved.fibre_force);
    plant.input.has_user_force = saved.has_user_force;
    plant.input.forces = nullptr;
    if (saved.has_user_force) forces_of(plant) = {std::move(saved.user_force), std::move(saved.chain_load)};
    plant.state.is_touched = saved.is_touched;
    plant.state.is_entangled = saved.is_entangled;
    plant.state.substeps = saved.substeps;
    plant.state.recovers_for = saved.recovers_for;
    size_t i = 0;
    for (Grab& grab : plant.input.grabs) grab.target = saved.grab_targets[i++];
    for (size_t k = 0; k < saved.fragments.size(); k++) {
        const SavedFragment& from = saved.fragments[k];
        Fragment& fragment = plant.state.fragments[k];
        fragment.turn = from.turn;
        fragment.shift = from.shift;
        fragment.centre = from.centre;
        fragment.velocity = from.velocity;
        fragment.angular_velocity = from.angular_velocity;
    }
    body.new_for = saved.new_for;
    const double ms = body.level.ms, ms_capsules = body.level.ms_capsules;  // measured on this machine
    body.level = saved.level;
    body.level.ms = ms;
    body.level.ms_capsules = ms_capsules;
    body.grown_in = saved.grown_in.empty() ? nullptr : std::make_unique<GrownIn>();
    for (const SavedGrownIn& grown_in : saved.grown_in) {
        const btCollisionObject* other = object_at(*body.world, grown_in.other);
        const btBroadphaseProxy* proxy = other->getBroadphaseHandle();
        (*body.grown_in)[{grown_in.capsule, other, proxy ? proxy->m_uniqueId : 0}] = grown_in.depth;
    }
    moved(plant);
    move_capsules(body);
    body.world->bullet->updateSingleAabb(&body);
}

// Restores a plant's state of rest or sleep; the plant is awake.
void put_rest(World& world, SavedPlant& saved, PlantBody& body) {
    Rest& rest = body.rest;
    if (saved.asleep) {
        put_touches(world, saved.asleep_with, world.contacts, world.plant_contacts);
        fall_asleep(world, body);
    }
    rest.still = saved.still;
    rest.places = std::move(saved.places);
    rest.air = saved.air;
}

void put_rigid(const SavedRigid& saved, Rigid& rigid) {
    btRigidBody& body = *rigid.body;
    const btTransform frame = frame_of(saved.frame);
    body.setLinearVelocity(vector_of(saved.velocity));
    body.setAngularVelocity(vector_of(saved.angular_velocity));
    body.setCenterOfMassTransform(frame);
    body.setInterpolationWorldTransform(frame_of(saved.frame_before));
    body.setInterpolationLinearVelocity(vector_of(saved.velocity_before));
    body.setInterpolationAngularVelocity(vector_of(saved.angular_velocity_before));
    body.clearForces();
    body.applyCentralForce(vector_of(saved.force));
    body.applyTorque(vector_of(saved.torque));
    body.forceActivationState(saved.activation);
    body.setDeactivationTime(saved.still);
    rigid.has_left = saved.has_left;
}

}  // namespace

void put_snapshot(World& world, Snapshot snapshot) {
    world.gravity_ahead = {};  // no gravity is left to be cancelled
    for (size_t i = 0; i < snapshot.plants.size(); i++)
        if (snapshot.plants[i].fragments.empty() && !world.bodies[i]->plant->state.fragments.empty())
            reset_plant(*world.bodies[i]);
    for (const auto& body : world.bodies) wake(*body);
    world.time = snapshot.time;
    if (world.wind) world.wind->travelled = snapshot.travelled;
    world.turn = size_t(snapshot.turn);
    world.substep = snapshot.substep;
    world.gravity_before = snapshot.gravity_before;
    world.effects_before = snapshot.effects_before;
    for (size_t i = 0; i < snapshot.rigids.size(); i++) put_rigid(snapshot.rigids[i], *world.rigids[i]);
    for (size_t i = 0; i < snapshot.plants.size(); i++) put_plant(snapshot.plants[i], *world.bodies[i]);
    for (size_t i = 0; i < snapshot.plants.size(); i++) put_rest(world, snapshot.plants[i], *world.bodies[i]);
    const auto sleeps = [](const PlantBody* body) { return body->rest.asleep; };
    world.awake.erase(std::remove_if(world.awake.begin(), world.awake.end(), sleeps), world.awake.end());
    size_t i = 0;
    for (Bond& bond : world.bonds) {
        bond.impulse = snapshot.bonds[i].impulse;
        bond.foreseen = snapshot.bonds[i].foreseen;
        bond.length = snapshot.bonds[i++].length;
    }
    for (const SavedAhead& ahead : snapshot.ahead)
        world.gravity_ahead.bodies.push_back(
            {btRigidBody::upcast(object_at(world, ahead.body)), vector_of(ahead.force)});
    world.gravity_ahead.is_held = snapshot.is_held;
    world.others_before.clear();
    for (const int other : snapshot.others_before) world.others_before.push_back(object_at(world, other));
    std::sort(world.others_before.begin(), world.others_before.end(), std::less<>());
    put_touches(world, snapshot.touches, world.contacts, world.plant_contacts);
    lend_link_loads(world);
    find_contacts_anew(world);
    world.events.list.clear();
    world.events.touching.clear();
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
