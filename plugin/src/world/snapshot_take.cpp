// In: a world. Out: a snapshot of it.
#include <algorithm>

#include "world/snapshot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Returns a body's index among Bullet's objects; -1 if it has gone.
int place_of(const World& world, const btCollisionObject* object) {
    const btCollisionObjectArray& objects = world.bullet->getCollisionObjectArray();
    for (int i = 0; i < objects.size(); i++)
        if (objects[i] == object) return i;
    return -1;
}

std::array<btScalar, 3> numbers_of(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}

std::array<btScalar, 12> numbers_of(const btTransform& frame) {
    std::array<btScalar, 12> numbers;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) numbers[size_t(3 * row + column)] = frame.getBasis()[row][column];
    for (int i = 0; i < 3; i++) numbers[size_t(9 + i)] = frame.getOrigin()[i];
    return numbers;
}

SavedTouches take_touches(const World& world, const std::vector<Contact>& with_bodies,
                          const std::vector<PlantContact>& with_plants) {
    SavedTouches touches;
    for (const Contact& c : with_bodies) {
        const int other = place_of(world, c.other);
        if (other < 0) continue;
        touches.with_bodies.push_back({c.plant->index, c.capsule, other, c.along, c.across, c.gap, c.friction,
                                       c.on_plant, c.on_other, c.normal, c.impulse, c.foreseen});
    }
    for (const PlantContact& c : with_plants)
        if (is_by_the_same(c)) touches.with_plants.push_back({{c.plants[0]->index, c.plants[1]->index}, c});
    return touches;
}

void take_modal(const ModalMotion& modal, SavedPlant& saved) {
    saved.modal.push_back({modal.place, modal.speed, modal.rest, modal.damping, modal.since, modal.comes_to_rest,
                           modal.fresh, modal.blend_out});
}

// Adds the end of the last step to the history of a batched plant, which has it in its motion only.
Motion with_end(Motion motion) {
    History& history = motion.history;
    if (!history.valid || history.x_end.size() > 0) return motion;
    history.x_end = motion.x;
    history.v_end = motion.v;
    return motion;
}

SavedPlant take_plant(const World& world, const PlantBody& body) {
    const Plant& plant = *body.plant;
    SavedPlant saved = {};
    saved.kind = kind_of(plant);
    saved.which = plant.which;
    saved.motion = with_end(plant.state.motion);
    saved.trend = plant.state.trend;
    saved.blend_out = plant.state.blend_out;
    saved.lead = plant.view.lead;
    if (plant.state.modal) take_modal(*plant.state.modal, saved);
    saved.has_own_elements = plant.state.own_elements != nullptr;
    saved.plastic = plastic_of(plant);
    saved.fibre_give = plant.state.fibre_give;
    saved.fibre_force = plant.state.fibre_force;
    saved.pinned = plant.input.pinned;
    saved.pin_target = plant.input.pin_target;
    saved.anchor = plant.input.anchor;
    saved.supports = supports_of(plant);
    saved.pins_changed = plant.input.pins_changed;
    saved.pins_are_own = plant.input.pins_are_own;
    saved.has_user_force = plant.input.has_user_force;
    if (plant.input.forces) {
        saved.user_force = plant.input.forces->on_nodes;
        saved.chain_load = plant.input.forces->on_chain;
    }
    saved.is_touched = plant.state.is_touched;
    saved.is_entangled = plant.state.is_entangled;
    saved.substeps = plant.state.substeps;
    saved.recovers_for = plant.state.recovers_for;
    for (const Grab& grab : plant.input.grabs) saved.grab_targets.push_back(grab.target);
    for (const Fragment& f : plant.state.fragments)
        saved.fragments.push_back({f.node, f.turn, f.shift, f.centre, f.velocity, f.angular_velocity});

    saved.new_for = body.new_for;
    saved.asleep = body.rest.asleep;
    saved.still = body.rest.still;
    saved.places = body.rest.places;
    saved.air = body.rest.air;
    saved.level = body.level;
    if (body.rest.contacts)
        saved.asleep_with = take_touches(world, body.rest.contacts->with_bodies, body.rest.contacts->with_plants);
    if (!body.grown_in) return saved;
    for (const auto& [key, depth] : *body.grown_in) {
        const auto& [capsule, object, number] = key;
        const int other = place_of(world, object);
        if (other >= 0 && object->getBroadphaseHandle() && object->getBroadphaseHandle()->m_uniqueId == number)
            saved.grown_in.push_back({capsule, other, depth});
    }
    // The map is ordered by addresses, which differ from run to run.
    std::sort(saved.grown_in.begin(), saved.grown_in.end(), [](const SavedGrownIn& a, const SavedGrownIn& b) {
        return std::make_pair(a.capsule, a.other) < std::make_pair(b.capsule, b.other);
    });
    return saved;
}

SavedRigid take_rigid(const Rigid& rigid) {
    const btRigidBody& body = *rigid.body;
    return {rigid.is_plane,
            rigid.grown_on != nullptr,
            numbers_of(body.getWorldTransform()),
            numbers_of(body.getInterpolationWorldTransform()),
            numbers_of(body.getLinearVelocity()),
            numbers_of(body.getAngularVelocity()),
            numbers_of(body.getInterpolationLinearVelocity()),
            numbers_of(body.getInterpolationAngularVelocity()),
            numbers_of(body.getTotalForce()),
            numbers_of(body.getTotalTorque()),
            body.getActivationState(),
            body.getDeactivationTime(),
            rigid.has_left};
}

}  // namespace

uint64_t kind_of(const Plant& plant) {
    uint64_t hash = 0;
    const auto add = [&](const void* bytes, size_t size) {
        hash = hash * 31 + checksum_of(static_cast<const uint8_t*>(bytes), size);
    };
    const Model& model = *plant.model;
    const SolveSettings& s = plant.input.settings;
    add(model.cage.nodes.data(), model.cage.nodes.size() * sizeof(Vec3));
    add(model.cage.tets.data(), model.cage.tets.size() * sizeof(Tet));
    for (const ChainNode& node : model.chain.nodes) add(node.position.data(), sizeof(Vec3));
    const double mass = model.mass();
    add(&mass, sizeof mass);
    add(plant.position.data(), sizeof(Vec3));
    add(plant.rotation.coeffs().data(), 4 * sizeof(double));
    const int choices[] = {int(s.integrator),   int(s.linear_solver), int(plant.input.mass),   plant.nodes->order,
                           s.newton_iterations, s.max_iterations,     plant.input.max_substeps};
    add(choices, sizeof choices);
    const double numbers[] = {s.newton_tolerance,           s.tolerance,       s.mass_damping,
                              s.stiffness_damping,          s.spectral_radius, plant.input.material_damping,
                              plant.input.substep_tolerance};
    add(numbers, sizeof numbers);
    return hash;
}

Snapshot take_snapshot(World& world) {
    Snapshot snapshot = {};
    snapshot.time = world.time;
    snapshot.travelled = world.wind ? world.wind->travelled : 0;
    snapshot.turn = world.turn;
    snapshot.substep = world.substep;
    snapshot.gravity_before = world.gravity_before;
    snapshot.effects_before = world.effects_before;
    snapshot.is_held = world.gravity_ahead.is_held;
    for (const auto& body : world.bodies) snapshot.plants.push_back(take_plant(world, look_at(*body)));
    compress_looked_at(world);
    for (const auto& rigid : world.rigids) snapshot.rigids.push_back(take_rigid(*rigid));
    for (const Bond& bond : world.bonds)
        snapshot.bonds.push_back({bond.vertex, bond.impulse, bond.length, bond.foreseen});
    for (const GravityAhead::Held& held : world.gravity_ahead.bodies) {
        const int body = place_of(world, held.body);
        if (body >= 0) snapshot.ahead.push_back({body, numbers_of(held.force)});
    }
    for (const btCollisionObject* other : world.others_before)
        if (const int place = place_of(world, other); place >= 0) snapshot.others_before.push_back(place);
    std::sort(snapshot.others_before.begin(), snapshot.others_before.end());  // they were by address
    snapshot.touches = take_touches(world, world.contacts, world.plant_contacts);
    return snapshot;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
