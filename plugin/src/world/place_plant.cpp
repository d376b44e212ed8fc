// In: a plant of a world. Out: the same elsewhere, or as newly made.
#include <algorithm>

#include "core/assert.hpp"
#include "core/lists.hpp"
#include "world/convert.hpp"
#include "world/fragments.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Removes a plant from its place: wakes what leaned on it, and drops its contacts.
void leave_place(World& world, PlantBody& body) {
    wake(body);
    wake_neighbours(world, body);
    for (const Contact& contact : world.contacts)
        if (contact.plant == &body) contact.other->activate();
    const auto is_its = [&](const Contact& contact) { return contact.plant == &body; };
    remove_where(world.contacts, is_its);
    const auto has_it = [&](const PlantContact& contact) {
        return contact.plants[0] == &body || contact.plants[1] == &body;
    };
    remove_where(world.plant_contacts, has_it);
    body.grown_in = nullptr;
    body.new_for = 1;
}

}  // namespace

void place_plant(PlantBody& body, const Vec3& position, const Quat& rotation) {
    FROND_ASSERT(position.allFinite() && std::abs(rotation.norm() - 1) < 1e-6);
    World& world = *body.world;
    Plant& plant = *body.plant;
    leave_place(world, body);
    end_sway(body);
    const Quat turn = rotation * plant.rotation.conjugate();
    const btTransform by(to_bullet(turn), to_bullet(position - turn * plant.position));
    for (Rigid* fragment : body.fragment_bodies) {
        btRigidBody& rigid = *fragment->body;
        rigid.setLinearVelocity(by.getBasis() * rigid.getLinearVelocity());
        rigid.setAngularVelocity(by.getBasis() * rigid.getAngularVelocity());
        rigid.setCenterOfMassTransform(by * rigid.getWorldTransform());
        rigid.activate(true);
        world.bullet->updateSingleAabb(&rigid);
    }
    carry_fragments(body);
    plant.position = position;
    plant.rotation = rotation;
    plant.view.surface_stale = true;
    if (plant.view.previous) plant.view.previous->positions.clear();
    body.setWorldTransform(btTransform(to_bullet(rotation), to_bullet(position)));
    body.setInterpolationWorldTransform(body.getWorldTransform());
    enter_anew(body);
}

frond_plant_def def_of(const PlantBody& body) {
    frond_plant_def def = def_of(*body.plant);
    def.mechanics = body.level.own;
    def.starts_asleep = body.starts_asleep;
    const btBroadphaseProxy* proxy = body.getBroadphaseHandle();
    def.group = body.is_hidden || !proxy ? body.filter_group : proxy->m_collisionFilterGroup;
    def.mask = body.is_hidden || !proxy ? body.filter_mask : proxy->m_collisionFilterMask;
    return def;
}

void reset_plant(PlantBody& body) {
    World& world = *body.world;
    std::unique_ptr<Plant> made = create_plant(body.plant->model, def_of(body));
    leave_place(world, body);
    remove_fragments(world, body);
    made->position = body.plant->position;
    made->rotation = body.plant->rotation;
    made->input.grabs.splice(made->input.grabs.end(), body.plant->input.grabs);
    if (body.plant->view.previous) made->view.previous = std::make_unique<PreviousSurface>();
    body.plant = std::move(made);
    body.level = {};
    body.level.own = body.plant->which;
    body.rest = {};
    share_shape(body);
    if (body.starts_asleep) {
        body.new_for = 2;
        world.awake.erase(std::remove(world.awake.begin(), world.awake.end(), &body), world.awake.end());
        fall_asleep(world, body);
        if (world.ledger) look_at(body);  // it counts what a sleeper's reset gave
    } else {
        take_own_shape(body);
        enter_anew(body);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
