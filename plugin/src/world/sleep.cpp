// In: plants of a world after each substep, and their contacts. Out: which of them sleep.
//
// Speeds do not distinguish rest from the turning point of a slow vibration, so positions decide: a plant is at rest
// when no point of it has moved farther than a set distance for half a period of its first mode. The remaining
// vibration is then within that distance, and so is the change by sleep. As in Bullet's islands, plants sleep with
// those they touch.
#include "world/sleep.hpp"

#include <algorithm>
#include <cmath>

#include "core/assert.hpp"
#include "core/lists.hpp"
#include "core/union_find.hpp"
#include "plant/seen.hpp"
#include "world/convert.hpp"
#include "world/show.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Wakes sleeping plants if the air at their middle has changed; checks a share of them in each substep.
void wake_blown(World& world) {
    constexpr size_t TURNS = 8;    // substeps in which each plant is checked once,
    constexpr size_t MOST = 128;   // if not more than this many have to be checked in one
    constexpr double GUST = 0.05;  // change of the air's velocity that wakes a plant [m/s]
    std::vector<PlantBody*> asked;
    std::vector<frond_vec3> points, air;
    const size_t count = world.bodies.size(), here = std::min((count + TURNS - 1) / TURNS, MOST);
    for (size_t i = 0; i < here; i++) {
        PlantBody& body = *world.bodies[world.turn++ % count];
        const frond_effects effects = world.effects & body.plant->input.effects;
        if (!body.rest.asleep || !(effects & FROND_EFFECT_WIND) || is_still(world, body)) continue;
        asked.push_back(&body);
        points.push_back(middle_of(body));
    }
    if (asked.empty()) return;
    wind_velocities(*world.wind, up_of(gravity_of(world)), world.time, points, air);
    for (size_t i = 0; i < asked.size(); i++)
        if ((Vec3(air[i].x, air[i].y, air[i].z) - asked[i]->rest.air.cast<double>()).norm() > GUST) wake(*asked[i]);
}

// Returns whether all numbers agree within `distance`. Begins at the end, where points move most.
bool are_within(const VecX& a, const VecX& b, double distance) {
    constexpr Eigen::Index MANY = 24;  // numbers compared at once
    if (a.size() != b.size()) return false;
    for (Eigen::Index end = a.size(); end > 0; end -= MANY) {
        const Eigen::Index begin = std::max(end - MANY, Eigen::Index(0));
        if (!((a - b).segment(begin, end - begin).lpNorm<Eigen::Infinity>() <= distance)) return false;
    }
    return true;
}

}  // namespace

void fall_asleep(World& world, PlantBody& body) {
    Plant& plant = *body.plant;
    FROND_ASSERT(!body.rest.asleep);
    pose(plant);
    plant.state.motion.v.setZero();
    plant.state.motion.history.valid = false;
    plant.step.is_watched = false;
    auto contacts = std::make_shared<LastContacts>();
    for (const Contact& contact : world.contacts)
        if (contact.plant == &body) contacts->with_bodies.push_back(contact);
    for (const PlantContact& contact : world.plant_contacts)
        if (contact.plants[0] == &body || contact.plants[1] == &body) contacts->with_plants.push_back(contact);
    if (!contacts->with_bodies.empty() || !contacts->with_plants.empty()) body.rest.contacts = std::move(contacts);
    // Nobody would see that a body which it lets through has left, and that comes back.
    if (body.grown_in)
        body.grown_in->erase(body.grown_in->begin(), body.grown_in->lower_bound({WHOLE_PLANT + 1, nullptr, 0}));
    body.rest.asleep = true;
    body.rest.still = 0;
    body.rest.air.setZero();
    VecX().swap(body.rest.places);
    body.forceActivationState(ISLAND_SLEEPING);
    compress(plant, world.sleep_distance, false);
    if (!body.rest.contacts) {
        if (plant.state.is_compressed && plant.state.away.empty()) share_shape(body);
        hide(body);
    }
    if (!world.wind) return;
    std::vector<frond_vec3> air;
    wind_velocities(*world.wind, up_of(gravity_of(world)), world.time, {middle_of(body)}, air);
    body.rest.air = Vec3(air[0].x, air[0].y, air[0].z).cast<float>();
}

void compress_looked_at(World& world) {
    // What something came near in the last substep is likely to be looked at in the next one too.
    const auto is_done = [&](PlantBody* body) {
        const bool is_open = body->is_looked_at && body->rest.asleep;
        if (is_open && body->met_in == world.substep) return false;
        if (is_open) compress(*body->plant, world.sleep_distance, true);
        body->is_looked_at = false;
        return true;
    };
    remove_where(world.looked_at, is_done);
}

PlantBody& look_at(PlantBody& body) {
    Plant& plant = *body.plant;
    pose(plant);
    if (!plant.state.is_compressed) return body;
    decompress(plant);
    if (!body.is_looked_at) body.world->looked_at.push_back(&body);
    body.is_looked_at = true;
    return body;
}

frond_vec3 middle_of(const PlantBody& body) {
    btVector3 lower, upper;
    static_cast<const btCompoundShape*>(body.getCollisionShape())
        ->btCompoundShape::getAabb(body.getWorldTransform(), lower, upper);
    const Vec3 middle = 0.5 * (from_bullet(lower) + from_bullet(upper));
    return {middle.x(), middle.y(), middle.z()};
}

void wake(PlantBody& body) {
    body.rest.still = 0;
    if (!body.rest.asleep) return;
    body.rest.asleep = false;
    body.forceActivationState(DISABLE_DEACTIVATION);
    decompress(*body.plant);
    take_own_shape(body);
    show_again(body);
    body.world->awake.push_back(&body);
    body.level.pending = 0;
    end_sway(body);
    add_event(*body.world, FROND_EVENT_WOKE, body);
    // Plants that touch it wake too.
    const std::shared_ptr<const LastContacts> contacts = std::move(body.rest.contacts);
    if (!contacts) return;
    for (const PlantContact& contact : contacts->with_plants)
        for (PlantBody* other : contact.plants) wake(*other);
}

void wake_neighbours(World& world, const btCollisionObject& leaving) {
    const btBroadphaseProxy* proxy = leaving.getBroadphaseHandle();
    if (!proxy) return;
    for (PlantBody* body : plants_in(world, proxy->m_aabbMin, proxy->m_aabbMax)) wake(*body);
}

bool is_moving(btCollisionObject& object) {
    if (object.isStaticObject() || !object.isActive()) return false;
    if (!object.isKinematicObject()) return true;
    const btRigidBody* rigid = btRigidBody::upcast(&object);
    return !rigid || !rigid->getLinearVelocity().isZero() || !rigid->getAngularVelocity().isZero();
}

void wake_by_world(World& world) {
    const Vec3 gravity = gravity_of(world);
    if (gravity != world.gravity_before || world.effects != world.effects_before)
        for (const auto& body : world.bodies) wake(*body);
    world.gravity_before = gravity;
    world.effects_before = world.effects;
    for (const Bond& bond : world.bonds)
        if (bond.plant->rest.asleep && (!bond.body || is_moving(*bond.body))) wake(*bond.plant);
    if (world.wind) wake_blown(world);
}

void watch(const World& world, PlantBody& body, double h) {
    const Plant& plant = *body.plant;
    Rest& rest = body.rest;
    VecX modal(2);
    if (plant.state.modal) modal = Eigen::Map<const Eigen::Vector2d>(modal_reach(plant).data());
    const VecX& x = plant.state.modal ? modal : plant.state.motion.x;
    const bool blends_out = blends(plant) || (plant.state.modal && !is_over(plant.state.modal->blend_out));
    const bool stirs = plant.input.has_user_force || plant.trouble & FROND_TROUBLE_REWOUND ||
                       plant.state.recovers_for > 0 || !plant.state.fragments.empty() || blends_out;
    if (!stirs && are_within(x, rest.places, world.sleep_distance)) {
        rest.still += h;
        return;
    }
    rest.still = 0;
    // The reference places are not updated in each substep.
    constexpr double EVERY = 0.1, APART = 0.3;  // interval [s]; its offset between consecutive plants [-]
    const auto turn = [&](double time) { return std::floor(time / EVERY + APART * body.index); };
    if (rest.places.size() != x.size() || turn(world.time) != turn(world.time - h)) rest.places = x;
}

void put_to_sleep(World& world) {
    const size_t count = world.taking_part.size();
    UnionFind touching(count);
    std::vector<uint8_t> stirs(count, 0), island_stirs(count, 0);
    for (size_t i = 0; i < count; i++) {
        const PlantBody& body = *world.taking_part[i];
        stirs[i] = !body.rest.asleep && body.rest.still < rest_time(*body.plant);
    }
    for (const Contact& contact : world.contacts)
        if (is_moving(*contact.other)) stirs[size_t(contact.plant->number)] = 1;
    for (const Bond& bond : world.bonds)
        if (bond.body && bond.plant->number >= 0 && is_moving(*bond.body)) stirs[size_t(bond.plant->number)] = 1;
    for (const PlantContact& contact : world.plant_contacts)
        touching.join(contact.plants[0]->number, contact.plants[1]->number);
    for (size_t i = 0; i < count; i++)
        if (stirs[i]) island_stirs[size_t(touching.find(int(i)))] = 1;
    for (size_t i = 0; i < count; i++)
        if (!world.taking_part[i]->rest.asleep && !island_stirs[size_t(touching.find(int(i)))]) {
            fall_asleep(world, *world.taking_part[i]);
            add_event(world, FROND_EVENT_FELL_ASLEEP, *world.taking_part[i]);
        }
    const auto sleeps = [](const PlantBody* body) { return body->rest.asleep; };
    remove_where(world.awake, sleeps);
    hide_sleepers_again(world);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
