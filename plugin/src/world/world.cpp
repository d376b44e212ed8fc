// Makes and ends worlds, adds plants to them and removes them.
#include "world/world.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "world/convert.hpp"
#include "world/detection.hpp"
#include "world/fragments.hpp"
#include "world/link_loads.hpp"
#include "world/own_bullet.hpp"
#include "world/rigid.hpp"
#include "world/robot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Bullet worlds that have plants, so that none is attached twice.
static std::mutex attached_mutex;
static std::set<btDynamicsWorld*>& attached_worlds() {
    static std::set<btDynamicsWorld*> worlds;
    return worlds;
}

World::World(std::unique_ptr<OwnBullet> given, btDynamicsWorld* bullet, const frond_world_def& def)
    : own(std::move(given)),
      bullet(bullet),
      effects(def.effects),
      max_substep(def.max_substep),
      hash({def.tuning.hash_layout, def.tuning.hash_table_size, def.tuning.hash_cell_size}),
      response(def.response),
      parallel_for(def.parallel_for),
      parallel_user(def.parallel_user),
      sleep_distance(def.sleep_distance) {
    response_settings.limits = {def.tuning.response_iterations, def.tuning.response_tolerance};
    response_settings.stiffness = def.tuning.penalty_stiffness;
    soft_info.m_broadphase = bullet->getBroadphase();
    soft_info.m_dispatcher = bullet->getDispatcher();
    end_detection(*bullet);
    bullet->addAction(this);
    gravity_before = gravity_of(*this);
    effects_before = effects;
}

World::~World() {
    is_ending = true;
    if (is_gone) {
        for (const auto& body : bodies) body->is_taken_back = true;
    } else {
        while (!bodies.empty()) remove_plant(*this, bodies.back().get());
        while (!robots.empty()) remove_robot(*this, robots.back().get());
        while (!rigids.empty()) remove_rigid(*this, rigids.back().get());
        remove_link_loads(*this);
        bullet->removeAction(this);
    }
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
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "this Bullet world is attached already; use the frond_world of the first attach, or call "
                 "frond::forget for it if its Bullet world was deleted");
    }
    return std::make_unique<World>(std::move(own), bullet, def);
}

PlantBody* add_plant(World& world, std::unique_ptr<Plant> plant, int group, int mask, bool asleep) {
    world.bodies.push_back(std::make_unique<PlantBody>(&world.soft_info, &world, std::move(plant)));
    PlantBody* body = world.bodies.back().get();
    body->index = int(world.bodies.size()) - 1;
    body->starts_asleep = asleep;
    world.bullet->addCollisionObject(body, group, mask);
    if (asleep) {
        body->new_for = 2;
        fall_asleep(world, *body);
    } else {
        world.awake.push_back(body);
        take_own_shape(*body);
    }
    return body;
}

// Takes a plant out of the lists of a world. Returns its object, which they owned.
static std::unique_ptr<PlantBody> take_out(World& world, PlantBody* body) {
    world.contacts.clear();
    world.plant_contacts.clear();
    forget_events(world, *body);
    world.bonds.remove_if([&](const Bond& bond) { return bond.plant == body; });
    for (std::vector<PlantBody*>* list : {&world.awake, &world.taking_part, &world.looked_at})
        list->erase(std::remove(list->begin(), list->end(), body), list->end());
    std::replace(world.plants_at.begin(), world.plants_at.end(), static_cast<const btCollisionObject*>(body),
                 static_cast<const btCollisionObject*>(nullptr));
    const size_t index = size_t(body->index);
    std::unique_ptr<PlantBody> taken = std::move(world.bodies[index]);
    world.bodies.erase(world.bodies.begin() + body->index);
    for (size_t i = index; i < world.bodies.size(); i++) world.bodies[i]->index = int(i);
    return taken;
}

void remove_plant(World& world, PlantBody* body) {
    remove_fragments(world, *body);
    if (!world.is_ending) {
        wake(*body);
        wake_neighbours(world, *body);
    }
    show_again(*body);
    world.bullet->removeCollisionObject(body);
    take_out(world, body)->is_taken_back = true;
}

// Sleepers forget that they touched it, and wake in the next substep.
void host_deleted(PlantBody& body) {
    World& world = *body.world;
    if (world.release.plant) world.release.plant(body);
    for (Rigid* fragment : body.fragment_bodies) fragment->grown_on = nullptr;
    for (const auto& other : world.bodies) {
        if (other.get() == &body || !other->rest.contacts) continue;
        auto contacts = std::make_shared<LastContacts>(*other->rest.contacts);
        std::vector<PlantContact>& plants = contacts->with_plants;
        remove_where(plants, [&](const PlantContact& c) { return c.plants[0] == &body || c.plants[1] == &body; });
        other->rest.contacts = std::move(contacts);
    }
    world.effects_before = ~world.effects;
    static_cast<void>(take_out(world, &body).release());  // the host deletes it
}

bool is_held(const World& world) {
    const auto is_in = [](const btCollisionObject* object) { return object && object->getBroadphaseHandle(); };
    bool held = false;
    for (const auto& body : world.bodies) held |= is_in(body.get());
    for (const auto& rigid : world.rigids) held |= is_in(rigid->body.get());
    for (const auto& robot : world.robots)
        for (const RobotLink& link : robot->links) held |= is_in(link.collider.get());
    return held;
}

Vec3 gravity_of(const World& world) {
    return from_bullet(world.bullet->getGravity());
}

int number_of(World& world, PlantBody& body) {
    if (body.number >= 0) return body.number;
    body.number = int(world.taking_part.size());
    world.taking_part.push_back(&body);
    return body.number;
}

// Returns into how many substeps a step is divided: as many as its length takes, and more where a kinematic body goes
// far past a plant. The response to contacts is linear within a substep: a stem that a car of 20 m/s met in one of 1/60
// s was drawn out to 3.1 times its length, in four parts of that to 1.4 (`DrivenOver` in the tests).
static int substeps_for(World& world, double dt, const Leader& leader) {
    constexpr double FAR = 0.05;  // about the length of a segment [m]
    constexpr double MOST = 4;    // parts of a substep
    const double by_length = std::ceil(dt / world.max_substep - 1e-9);
    if (by_length < 1) return 0;
    return int(by_length * std::clamp(std::ceil(leader.way_past_plants(world) / (by_length * FAR)), 1.0, MOST));
}

void advance(World& world, double dt) {
    const Leader leader(world);
    const int substeps = substeps_for(world, dt, leader);
    if (substeps > 0) limit_motors(world, dt / substeps);
    uint32_t trouble = 0;
    for (int i = 1; i <= substeps; i++) {
        leader.lead(double(i) / substeps);
        world.bullet->stepSimulation(btScalar(dt / substeps), 0);
        trouble |= world.report.trouble;
    }
    if (substeps > 0) world.report.trouble = trouble;
    for (PlantBody* body : world.awake) clear_user_force(*body->plant);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
