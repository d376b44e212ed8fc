// In: the steps that plants took, and bodies as they go on once contacts have pushed them. Out: contacts of what bodies
// went through in spite of those that were known, or, if nothing helps, shorter steps.
#include "contact/keep_apart.hpp"

#include <algorithm>
#include <cmath>

#include "contact/contact_body.hpp"
#include "contact/find_contacts.hpp"
#include "contact/piece.hpp"
#include "contact/strip_search.hpp"
#include "core/union_find.hpp"
#include "plant/plant_step.hpp"
#include "world/convert.hpp"
#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Returns how a body goes on in the step of h [s], with its gravity, once contacts and bonds have pushed it.
ObjectMotion pushed_motion(const World& world, const SweptBody& swept, double h) {
    ObjectMotion motion = swept.motion;
    if (!is_free(*swept.object)) return motion;
    const btRigidBody* rigid = btRigidBody::upcast(swept.object);
    const Vec3 centre = from_bullet(rigid->getCenterOfMassPosition());
    motion.way += h * h * from_bullet(rigid->getGravity());
    const auto push = [&](const PlantBody& by, const Vec3& impulse, const Vec3& at) {
        if (!pushes_back(world, by)) return;
        motion.way += h * double(rigid->getInvMass()) * impulse;
        motion.turn +=
            h * from_bullet(rigid->getInvInertiaTensorWorld() * to_bullet((at - centre).cross(impulse).eval()));
    };
    for (const Contact& contact : world.contacts)
        if (contact.other == rigid) push(*contact.plant, -contact.impulse, contact.on_other);
    for (const Bond& bond : world.bonds)
        if (bond.body == rigid) push(*bond.plant, -bond.impulse, place_on_body(bond));
    return motion;
}

// Calls `take` for each hit of a body, as it goes on, with the plants that it may hit and whose steps may still change.
void find_hits_in_step(const World& world, const SweptBody& swept, double h,
                       const std::function<bool(const PlantBody&)>& may_hit,
                       const std::function<void(PlantBody&, const Hit&)>& take) {
    // Links would need the motion of the whole robot.
    if (!btRigidBody::upcast(swept.object)) return;
    const ObjectMotion motion = pushed_motion(world, swept, h);
    for (PlantBody* body : swept.plants)
        if (awaits_contacts(*body) && may_hit(*body))
            find_hits(*body, motion_in_step(*body), *swept.object, motion, [&](const Hit& hit) { take(*body, hit); });
}

bool any_plant(const PlantBody&) {
    return true;
}

// Returns how deep the pieces of a hit are in each other where they first touch [m].
double depth_before(const Hit& hit) {
    return std::max(0.0, -hit.impact.normal.dot(hit.impact.on_a - hit.impact.on_b));
}

// Returns how deep they may be at the end: until a stem's axis is reached. What is deeper already comes no deeper [m].
double most_depth(const PlantBody& body, const Hit& hit) {
    return std::max(radius_of(body, hit.capsule), depth_before(hit));
}

// Groups of what goes on by one share: plants by their numbers, then swept bodies.
struct Groups {
    UnionFind sets;
    std::vector<std::pair<int, double>> shares;  // of members [-]
    void hold(int member, double share) { shares.push_back({member, share}); }
    // Returns each group's share, by its first member.
    std::vector<double> least() {
        std::vector<double> least(sets.parent.size(), 1);
        for (const auto& [member, share] : shares) {
            double& of = least[size_t(sets.find(member))];
            of = std::min(of, share);
        }
        return least;
    }
};

// Joins plants that are held back together, or they would go through each other on ways that none of them went.
void group_plants(World& world, Groups& groups) {
    for (size_t i = 0; i < world.plant_island_count; i++) {
        PlantSearch& memory = *world.plant_searches[i];
        int first = -1;
        for (const PlantBody* body : memory.island) {
            if (!awaits_contacts(*body)) continue;  // it goes where it goes
            if (first < 0) first = body->number;
            groups.sets.join(first, body->number);
        }
        const double share = first < 0 ? 1 : way_until_crossing(memory);
        if (share < 1) groups.hold(first, share);
    }
}

// Joins bodies with the plants that they push or go through, if these push them. What stands still holds plants back.
void group_bodies(World& world, double h, Groups& groups) {
    for (size_t i = 0; i < world.swept.size(); i++) {
        const SweptBody& swept = world.swept[i];
        const int member = int(world.taking_part.size() + i);
        const bool is_pushed = is_free(*swept.object);
        const bool stands_still = !is_pushed && swept.motion.way.isZero(0) && swept.motion.turn.isZero(0);
        for (const Contact& contact : world.contacts)
            if (is_pushed && contact.other == swept.object && pushes_back(world, *contact.plant) &&
                !is_heavy(*swept.object, borne_at(*contact.plant, contact.capsule)))
                groups.sets.join(contact.plant->number, member);
        find_hits_in_step(world, swept, h, any_plant, [&](PlantBody& body, const Hit& hit) {
            const double after = depth_after(hit), most = most_depth(body, hit), before = depth_before(hit);
            const bool goes_along =
                is_pushed && pushes_back(world, body) && !is_heavy(*swept.object, borne_at(body, hit.capsule));
            if (!goes_along && !stands_still) {
                if (after > radius_of(body, hit.capsule)) note_trouble(world, body, FROND_TROUBLE_PASSED);
                return;
            }
            if (after <= most) return;
            if (goes_along) groups.sets.join(body.number, member);
            const double share = hit.impact.time + (1 - hit.impact.time) * (most - before) / (after - before);
            groups.hold(goes_along ? member : body.number, share);
        });
    }
}

// Has plants go a share of their way, halved while that strains them. Returns the share.
double go_share(const std::vector<PlantBody*>& plants, double share, double h) {
    constexpr double LEAST = 0.01;  // [-]
    const auto may_go = [&](const PlantBody* body) { return may_go_part_of_way(*body->plant, share, h); };
    while (share > LEAST && !std::all_of(plants.begin(), plants.end(), may_go)) share /= 2;
    if (share <= LEAST) share = 0;
    for (PlantBody* body : plants) {
        go_part_of_way(*body->plant, share);
        body->plant->trouble |= FROND_TROUBLE_HELD_BACK;
    }
    return share;
}

// Returns whether a body that lies on a stem comes to the round end of the next segment, which is inside the stem: it
// would catch there.
bool slides_over_joint(const World& world, const PlantBody& body, const SweptBody& swept, const Hit& hit) {
    constexpr double LIES = 0.001;  // gap [m]
    if (!slides(*swept.object) || !is_in_joint(body, hit.capsule, hit.impact.on_a)) return false;
    return std::any_of(world.contacts.begin(), world.contacts.end(), [&](const Contact& contact) {
        return contact.plant == &body && contact.other == swept.object && contact.gap < LIES &&
               are_joined(*body.plant, contact.capsule, hit.capsule);
    });
}

}  // namespace

void add_passed_contacts(World& world, double h, const Answers& answers, Missed& missed) {
    std::vector<const PlantBody*> added;
    std::vector<Contact> contacts = world.contacts;
    for (const SweptBody& swept : world.swept) {
        const bool goes_otherwise =
            std::any_of(world.contacts.begin(), world.contacts.end(), [&](const Contact& contact) {
                return contact.other == swept.object && stands(*contact.plant, answers, Answer::fresh);
            });
        const auto may_hit = [&](const PlantBody& body) {
            return stands(body, answers, Answer::fresh) || (goes_otherwise && stands(body, answers, Answer::kept));
        };
        find_hits_in_step(world, swept, h, may_hit, [&](PlantBody& body, const Hit& hit) {
            const double after = depth_after(hit), deeper = after - depth_before(hit);
            if (deeper <= least_miss(body, hit.capsule)) return;
            if (slides_over_joint(world, body, swept, hit)) return;
            if (after > most_depth(body, hit)) missed.passed.push_back(&body);
            if (add_hit(world, body, swept, hit, contacts)) added.push_back(&body);
        });
    }
    if (added.empty()) return;
    drop_what_draws_out(contacts);
    if (contacts.size() > world.contacts.size()) {
        missed.passed.insert(missed.passed.end(), added.begin(), added.end());
        missed.asked.insert(missed.asked.end(), added.begin(), added.end());
    }
    world.contacts = std::move(contacts);
}

void add_plants_in_bodies(const World& world, double h, std::vector<PlantBody*>& plants) {
    for (const SweptBody& swept : world.swept)
        find_hits_in_step(world, swept, h, any_plant, [&](PlantBody& body, const Hit& hit) {
            if (depth_after(hit) > most_depth(body, hit)) plants.push_back(&body);
        });
}

std::vector<HeldBody> hold_back_what_passes(World& world, double h) {
    const size_t plant_count = world.taking_part.size();
    Groups groups = {UnionFind(plant_count + world.swept.size()), {}};
    group_plants(world, groups);
    group_bodies(world, h, groups);
    std::vector<double> shares = groups.least();
    std::vector<std::vector<PlantBody*>> plants(shares.size());
    for (PlantBody* body : world.taking_part)
        if (awaits_contacts(*body)) plants[size_t(groups.sets.find(body->number))].push_back(body);
    for (size_t i = 0; i < shares.size(); i++)
        if (shares[i] < 1) shares[i] = go_share(plants[i], shares[i], h);
    std::vector<HeldBody> held;
    for (size_t i = 0; i < world.swept.size(); i++) {
        const double share = shares[size_t(groups.sets.find(int(plant_count + i)))];
        if (share < 1) held.push_back({btRigidBody::upcast(world.swept[i].object), share});
    }
    return held;
}

void put_back(World& world, const HeldBody& held, double h) {
    btRigidBody& rigid = *held.rigid;
    const Vec3 velocity = from_bullet(rigid.getLinearVelocity()), turning = from_bullet(rigid.getAngularVelocity());
    const Vec3 back = -(1 - held.share) * h * velocity;
    rigid.proceedToTransform(moved(rigid.getWorldTransform(), back, -(1 - held.share) * h * turning, 1));
    world.bullet->updateSingleAabb(&rigid);
    // What rises by that is paid from its speed.
    const double square = velocity.squaredNorm(), left = square + 2 * from_bullet(rigid.getGravity()).dot(back);
    if (left < square) rigid.setLinearVelocity(to_bullet(std::sqrt(std::max(0.0, left / square)) * velocity));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
