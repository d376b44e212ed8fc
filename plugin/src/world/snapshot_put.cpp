// In: a snapshot that fits a world. Out: the world in the snapshot's state.
#include <algorithm>

#include "core/lists.hpp"
#include "plant/fragment.hpp"
#include "plant/pins.hpp"
#include "world/fragments.hpp"
#include "world/link_loads.hpp"
#include "world/snapshot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

btCollisionObject* object_at(const World& world, int place) {
    return world.bullet->getCollisionObjectArray()[place];
}

void put_touches(const World& world, const SavedTouches& saved, std::vector<Contact>& with_bodies,
                 std::vector<PlantContact>& with_plants) {
    with_bodies.clear();
    with_plants.clear();
    for (const SavedContact& s : saved.with_bodies) {
        with_bodies.push_back(s.contact);
        with_bodies.back().plant = world.bodies[size_t(s.plant)].get();
        with_bodies.back().other = object_at(world, s.other);
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

void put_modal(const ModalState& saved, Plant& plant) {
    begin_modal(plant);
    static_cast<ModalState&>(*plant.state.modal) = saved;
    plant.state.modal->stale = false;  // the chain was posed when it was saved
}

void put_plant(SavedPlant& saved, PlantBody& body) {
    Plant& plant = *body.plant;
    end_modal(plant);
    give_supports(plant, {});
    set_mechanics(plant, saved.which);
    if (!saved.modal.empty()) put_modal(saved.modal.front(), plant);
    static_cast<Pins&>(plant.input) = saved.input;
    give_supports(plant, std::move(saved.supports));
    apply_pins(plant);  // makes the pins' springs; the rest is in the motion
    static_cast<SavedInput&>(plant.input) = std::move(saved.input);
    static_cast<SavedState&>(plant.state) = std::move(saved.state);
    const size_t fibres = plant.fibres ? plant.fibres->list.size() : 0;
    if (plant.state.fibre_give.size() != fibres) plant.state.fibre_give.clear();
    plant.view.lead = saved.lead;
    plant.state.blend = saved.blend.empty() ? nullptr : std::make_unique<Blend>(std::move(saved.blend.front()));
    plant.state.stepped_by = 0;
    if (saved.has_own_elements || plant.state.own_elements) set_plastic(plant, saved.plastic);
    plant.input.forces = nullptr;
    if (plant.input.has_user_force) forces_of(plant) = std::move(saved.forces);
    size_t i = 0;
    for (Grab& grab : plant.input.grabs) grab.target = saved.grab_targets[i++];
    if (!saved.fragments.empty()) plant.state.parting->start = std::move(saved.parted_at);
    for (size_t k = 0; k < saved.fragments.size(); k++)
        static_cast<FragmentMotion&>(plant.state.fragments[k]) = saved.fragments[k].motion;
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
    rest.air = saved.air.cast<float>();
}

void put_rigid(const SavedRigid& saved, Rigid& rigid) {
    btRigidBody& body = *rigid.body;
    body.setLinearVelocity(saved.velocity);
    body.setAngularVelocity(saved.angular_velocity);
    body.setCenterOfMassTransform(saved.frame);
    body.setInterpolationWorldTransform(saved.frame_before);
    body.setInterpolationLinearVelocity(saved.velocity_before);
    body.setInterpolationAngularVelocity(saved.angular_velocity_before);
    body.clearForces();
    body.applyCentralForce(saved.force);
    body.applyTorque(saved.torque);
    body.forceActivationState(saved.activation);
    body.setDeactivationTime(saved.still);
    rigid.has_left = saved.has_left;
}

}  // namespace

void put_snapshot(World& world, Snapshot snapshot) {
    world.gravity_ahead = {};  // no gravity is left to be cancelled
    for (const auto& body : world.bodies) {
        wake(*body);
        body->troubled_in = UINT32_MAX;
        const size_t fragments = snapshot.plants[size_t(body->index)].fragments.size();
        if (fragments >= body->plant->state.fragments.size()) continue;
        remove_fragments(world, *body, fragments);
        rejoin(*body->plant, fragments);
    }
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
    remove_where(world.awake, sleeps);
    size_t i = 0;
    for (Bond& bond : world.bonds) {
        const SavedBond& saved = snapshot.bonds[i++];
        bond.body = saved.body >= 0 ? object_at(world, saved.body) : nullptr;  // it may have let go since
        bond.impulse = saved.impulse;
        bond.foreseen = saved.foreseen;
        bond.length = saved.length;
    }
    for (const SavedAhead& ahead : snapshot.ahead)
        world.gravity_ahead.bodies.push_back({btRigidBody::upcast(object_at(world, ahead.body)), ahead.force});
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
