// In: a world. Out: a snapshot of it.
#include <algorithm>

#include "plant/settings.hpp"
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

SavedTouches take_touches(const World& world, const std::vector<Contact>& with_bodies,
                          const std::vector<PlantContact>& with_plants) {
    SavedTouches touches;
    for (const Contact& c : with_bodies) {
        const int other = place_of(world, c.other);
        if (other >= 0) touches.with_bodies.push_back({c.plant->index, other, c});
    }
    for (const PlantContact& c : with_plants)
        if (is_by_the_same(c)) touches.with_plants.push_back({{c.plants[0]->index, c.plants[1]->index}, c});
    return touches;
}

// Adds the end of the last step to the history of a batched plant, which has it in its motion only.
void add_end(Motion& motion) {
    History& history = motion.history;
    if (!history.valid || history.x_end.size() > 0) return;
    history.x_end = motion.x;
    history.v_end = motion.v;
}

SavedPlant take_plant(const World& world, const PlantBody& body) {
    const Plant& plant = *body.plant;
    SavedPlant saved = {};
    saved.kind = kind_of(plant);
    saved.which = plant.which;
    saved.input = plant.input;
    saved.state = plant.state;
    add_end(saved.state.motion);
    saved.lead = plant.view.lead;
    if (plant.state.blend) saved.blend.push_back(*plant.state.blend);
    if (plant.state.modal) saved.modal.push_back(*plant.state.modal);
    saved.has_own_elements = plant.state.own_elements != nullptr;
    saved.plastic = plastic_of(plant);
    saved.supports = supports_of(plant);
    if (plant.input.forces) saved.forces = *plant.input.forces;
    for (const Grab& grab : plant.input.grabs) saved.grab_targets.push_back(grab.target);
    for (const Fragment& f : plant.state.fragments) saved.fragments.push_back({f.node, f});
    if (!plant.state.fragments.empty()) saved.parted_at = plant.state.parting->start;

    saved.new_for = body.new_for;
    saved.asleep = body.rest.asleep;
    saved.still = body.rest.still;
    saved.places = body.rest.places;
    saved.air = body.rest.air.cast<double>();
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
            body.getWorldTransform(),
            body.getInterpolationWorldTransform(),
            body.getLinearVelocity(),
            body.getAngularVelocity(),
            body.getInterpolationLinearVelocity(),
            body.getInterpolationAngularVelocity(),
            body.getTotalForce(),
            body.getTotalTorque(),
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
    add(model.cage.nodes.data(), model.cage.nodes.size() * sizeof(Vec3));
    add(model.cage.tets.data(), model.cage.tets.size() * sizeof(Tet));
    for (const ChainNode& node : model.chain.nodes) add(node.position.data(), sizeof(Vec3));
    const double mass = model.mass();
    add(&mass, sizeof mass);
    add(plant.position.data(), sizeof(Vec3));
    add(plant.rotation.coeffs().data(), 4 * sizeof(double));
    add(&plant.nodes->order, sizeof(int));
    const frond_plant_def def = def_of(plant);
    each_setting(def, plant.input, [&](const auto& setting, const auto&) { add(&setting, sizeof setting); });
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
        snapshot.bonds.push_back({bond.vertex, place_of(world, bond.body), bond.impulse, bond.length, bond.foreseen});
    for (const GravityAhead::Held& held : world.gravity_ahead.bodies) {
        const int body = place_of(world, held.body);
        if (body >= 0) snapshot.ahead.push_back({body, held.force});
    }
    for (const btCollisionObject* other : world.others_before)
        if (const int place = place_of(world, other); place >= 0) snapshot.others_before.push_back(place);
    std::sort(snapshot.others_before.begin(), snapshot.others_before.end());  // they were by address
    snapshot.touches = take_touches(world, world.contacts, world.plant_contacts);
    return snapshot;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
