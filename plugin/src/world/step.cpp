// A substep of all plants of a world, inside Bullet's own.
#include <algorithm>
#include <cmath>

#include "core/timer.hpp"
#include "world/convert.hpp"
#include "world/fragments.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

constexpr double ENTANGLED = 0.0007;  // depth of plants in each other that touching alone does not make [m]

Vec3 gravity_of(const World& world) {
    return from_bullet(world.bullet->getGravity());
}

// Adds what a plant did in this substep to the world's report.
static void add_to_report(const Plant& plant, frond_report& report) {
    report.trouble |= plant.trouble;
    report.solver_iterations += plant.report.iterations;
    report.residual = std::max(report.residual, plant.report.residual);
    report.ms_effects += plant.ms_effects;
    report.ms_assembly += plant.report.ms_assembly;
    report.ms_solve += plant.report.ms_solve;
}

void World::updateAction(btCollisionWorld* collision_world, btScalar h) {
    if (!(h > 0)) return;
    const Timer step_timer;
    is_stepping = true;
    end_hold(gravity_ahead, *collision_world);
    report = {};
    Surroundings surroundings;
    surroundings.gravity = gravity_of(*this);
    surroundings.effects = effects;
    if (wind) pass_time(*wind, double(h));
    surroundings.wind = wind.get();
    surroundings.time = time + double(h);
    const auto any_wants = [&](frond_effects effect, bool awake) {
        return std::any_of(bodies.begin(), bodies.end(), [&](const std::unique_ptr<PlantBody>& body) {
            return body->plant->effects & effects & effect && !(awake && body->rest.asleep);
        });
    };
    for (const std::unique_ptr<PlantBody>& body : bodies) {
        if (body->fragment_bodies.empty()) continue;
        carry_fragments(*body);
        if (body->plant->effects & effects & FROND_USER_FORCE) pull_fragments(*body, double(h));
    }
    contacts.clear();
    for (size_t i = 0; i < bodies.size(); i++) bodies[i]->number = int(i);
    const Timer find_timer;
    wake_by_world(*this);
    if (any_wants(FROND_RIGID_CONTACT, false)) contacts = find_contacts(*this, double(h));
    if (any_wants(FROND_PLANT_CONTACT | FROND_SELF_CONTACT, true))
        plant_contacts = find_plant_contacts(*this, double(h));
    else
        plant_contacts.clear();
    wake_touched(*this, double(h));
    std::vector<PlantBody*> awake;
    for (const std::unique_ptr<PlantBody>& body : bodies)
        if (!body->rest.asleep) awake.push_back(body.get());
    report.ms_collide = find_timer.ms();
    for (PlantBody* body : awake) body->plant->is_touched = body->plant->is_entangled = false;
    for (const Contact& contact : contacts) contact.plant->plant->is_touched = true;
    for (const PlantContact& contact : plant_contacts)
        for (PlantBody* body : contact.plants) {
            body->plant->is_touched = true;
            body->plant->is_entangled |= contact.depth > ENTANGLED;
        }
    for (const Bond& bond : bonds) bond.plant->plant->is_touched = true;
    for (PlantBody* body : awake) solve_plant(*body->plant, surroundings, double(h));
    const Timer response_timer;
    let_go_of_gone(*this);
    if (!contacts.empty() || !plant_contacts.empty() || !bonds.empty()) respond_to_contacts(*this, double(h));
    report.ms_response = response_timer.ms();
    report.contact_count = int(contacts.size());
    report.plant_contact_count = int(plant_contacts.size());
    report.awake_count = int(awake.size());
    for (PlantBody* body : awake) {
        accept_step(*body->plant, surroundings, double(h));
        add_to_report(*body->plant, report);
        if (body->plant->effects & effects & FROND_BREAKING) report.broken_count += break_overloaded(*this, *body);

        const Timer capsule_timer;
        move_capsules(*body);
        collision_world->updateSingleAabb(body);
        report.ms_capsules += capsule_timer.ms();
        if (sleep_distance > 0) watch(*this, *body, double(h));
        if (!own) clear_user_force(*body->plant);
    }
    if (sleep_distance > 0) put_to_sleep(*this);
    time += double(h);
    report.ms_step = step_timer.ms();
    is_stepping = false;
}

void World::debugDraw(btIDebugDraw*) {}

void advance(World& world, double dt) {
    const int substeps = int(std::ceil(dt / world.max_substep - 1e-9));
    for (int i = 0; i < substeps; i++) world.bullet->stepSimulation(btScalar(dt / substeps), 0);
    for (const std::unique_ptr<PlantBody>& body : world.bodies) clear_user_force(*body->plant);
}

// FNV-1a over the bits of all nodes, of what is lasting and of what came off.
uint64_t state_hash(const World& world) {
    uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](const auto& values) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (size_t i = 0; i < size_t(values.size()) * sizeof(double); i++) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    };
    for (const std::unique_ptr<PlantBody>& body : world.bodies) {
        add(body->plant->motion.x);
        add(body->plant->motion.v);
        add(lasting_of(*body->plant));
        for (size_t k = 0; k < body->fragment_bodies.size(); k++) {
            const Fragment& fragment = body->plant->fragments[k];
            const btRigidBody& rigid = *body->fragment_bodies[k]->body;
            add(fragment.turn);
            add(fragment.shift);
            add(from_bullet(rigid.getLinearVelocity()));
            add(from_bullet(rigid.getAngularVelocity()));
        }
    }
    return hash;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
