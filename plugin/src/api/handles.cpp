#include "api/handles.hpp"

#include "core/error.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Never destroyed, so that handles may still be released while the program ends.
template <class S>
static S& slots() {
    static S* instance = new S;
    return *instance;
}
WorldSlots& world_slots() {
    return slots<WorldSlots>();
}
ModelSlots& model_slots() {
    return slots<ModelSlots>();
}
PlantSlots& plant_slots() {
    return slots<PlantSlots>();
}
GrabSlots& grab_slots() {
    return slots<GrabSlots>();
}
RigidSlots& rigid_slots() {
    return slots<RigidSlots>();
}
BondSlots& bond_slots() {
    return slots<BondSlots>();
}

// Throws for an invalid handle, with one text for all kinds.
static void require(bool found, uint64_t id, const char* noun) {
    if (found) return;
    if (id == 0)
        fail(FROND_RESULT_BAD_HANDLE, "the %s handle is null; use the one that its create or load call gave", noun);
    fail(FROND_RESULT_BAD_HANDLE,
         "the %s handle is stale or of another kind; the %s was destroyed, or its world was, or the "
         "host deleted it; make it anew",
         noun, noun);
}

World& get(frond_world world) {
    const std::shared_ptr<World> found = world_slots().find(world.id);
    require(bool(found), world.id, "world");
    return *found;
}
const std::shared_ptr<const Model> get(frond_model model) {
    std::shared_ptr<const Model> found = model_slots().find(model.id);
    require(bool(found), model.id, "model");
    return found;
}
PlantBody& get(frond_plant plant) {
    PlantBody* found = plant_slots().find(plant.id);
    require(found, plant.id, "plant");
    return *found;
}
GrabEntry get(frond_grab grab) {
    const GrabEntry found = grab_slots().find(grab.id);
    require(found.grab, grab.id, "grab");
    return found;
}

Rigid& get(frond_rigid rigid) {
    Rigid* found = rigid_slots().find(rigid.id);
    require(found, rigid.id, "rigid");
    return *found;
}

Bond& get(frond_bond bond) {
    Bond* found = bond_slots().find(bond.id);
    require(found, bond.id, "bond");
    return *found;
}

void show(PlantBody& body) {
    move_capsules(body);
    body.world->bullet->updateSingleAabb(&body);
}

Plant& awaken(PlantBody& body) {
    wake(body);
    end_sway(body);
    disturb(body);
    return *body.plant;
}

void forget(PlantBody& body) {
    for (const Bond& bond : body.world->bonds)
        if (bond.plant == &body) bond_slots().erase(bond.handle);
    for (const Grab& grab : body.plant->input.grabs) grab_slots().erase(grab.handle);
    for (const Rigid* fragment : body.fragment_bodies) rigid_slots().erase(fragment->handle.id);
    plant_slots().erase(body.handle.id);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
