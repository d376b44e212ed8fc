// Making and ending a world; plants enter and leave it.
#include "world/world.hpp"

#include <algorithm>
#include <mutex>
#include <set>

#include "core/error.hpp"
#include "world/fragments.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Bullet worlds that have plants, so that none is attached twice.
static std::mutex attached_mutex;
static std::set<btDynamicsWorld*>& attached_worlds() {
    static std::set<btDynamicsWorld*> worlds;
    return worlds;
}

World::World(std::unique_ptr<OwnBullet> given, btDynamicsWorld* bullet, const frond_world_def& def)
    : own(std::move(given)), bullet(bullet), effects(def.effects), max_substep(def.max_substep),
      hash({def.hash_layout, def.hash_table_size, def.hash_cell_size}), response(def.response),
      sleep_distance(def.sleep_distance) {
    response_settings.limits = {def.response_iterations, def.response_tolerance};
    response_settings.stiffness = def.penalty_stiffness;
    soft_info.m_broadphase = bullet->getBroadphase();
    soft_info.m_dispatcher = bullet->getDispatcher();
    bullet->addAction(this);
}

World::~World() {
    while (!bodies.empty()) remove_plant(*this, bodies.back().get());
    while (!rigids.empty()) remove_rigid(*this, rigids.back().get());
    bullet->removeAction(this);
    std::lock_guard<std::mutex> lock(attached_mutex);
    attached_worlds().erase(bullet);
}

std::unique_ptr<World> make_world(btDynamicsWorld* bullet, const frond_world_def& def) {
    std::unique_ptr<OwnBullet> own;
    if (!bullet) {
        own = std::make_unique<OwnBullet>();
        bullet = &own->world;
        own->configuration.setPlaneConvexMultipointIterations();  // or a box would sink into a plane on one corner
        bullet->setGravity(btVector3(btScalar(def.gravity.x), btScalar(def.gravity.y), btScalar(def.gravity.z)));
    }
    {
        std::lock_guard<std::mutex> lock(attached_mutex);
        if (!attached_worlds().insert(bullet).second)
            fail(FROND_BAD_ARGUMENT, "this Bullet world is attached already; use the frond_world of the first attach");
    }
    return std::make_unique<World>(std::move(own), bullet, def);
}

PlantBody* add_plant(World& world, std::unique_ptr<Plant> plant) {
    world.bodies.push_back(std::make_unique<PlantBody>(&world.soft_info, &world, std::move(plant)));
    PlantBody* body = world.bodies.back().get();
    // The default filter of a kinematic object would meet nothing that is static.
    world.bullet->addCollisionObject(body, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    return body;
}

void remove_plant(World& world, PlantBody* body) {
    remove_fragments(world, *body);
    wake(*body);
    wake_neighbours(world, *body);
    world.bullet->removeCollisionObject(body);
    world.contacts.clear();
    world.plant_contacts.clear();
    world.bonds.remove_if([&](const Bond& bond) { return bond.plant == body; });
    const auto is_body = [&](const std::unique_ptr<PlantBody>& other) { return other.get() == body; };
    world.bodies.erase(std::find_if(world.bodies.begin(), world.bodies.end(), is_body));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
