// In: contacts and bonds of a world. Out: its contact islands, in the order of their first contacts. Immovable bodies
// join no islands.
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <unordered_map>

#include "contact/contact_island.hpp"
#include "core/assert.hpp"
#include "core/union_find.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Returns the object that moves when this one is pushed: itself, or a multi-body with all its links; null if none.
const void* pushed_with(const btCollisionObject& object) {
    if (const auto* link = btMultiBodyLinkCollider::upcast(&object)) return link->m_multiBody;
    return object.isStaticOrKinematicObject() ? nullptr : &object;
}

// Members of islands: plants by their numbers, then bodies in the order in which they occur.
struct Members {
    UnionFind sets;
    size_t count;
    std::unordered_map<const void*, int> bodies;
    Members(size_t plants, size_t most) : sets(plants + most), count(plants) {}
    void join(int plant, const btCollisionObject& object) {
        const void* body = pushed_with(object);
        if (!body) return;
        const auto [found, is_new] = bodies.insert({body, int(count)});
        count += is_new;
        sets.join(plant, found->second);
    }
};

}  // namespace

std::vector<ContactIsland> find_contact_islands(World& world) {
    Members members(world.taking_part.size(), world.contacts.size() + world.bonds.size());
    for (const Contact& contact : world.contacts) members.join(contact.plant->number, *contact.other);
    for (const PlantContact& contact : world.plant_contacts)
        members.sets.join(contact.plants[0]->number, contact.plants[1]->number);
    for (const Bond& bond : world.bonds)
        if (bond.body && !bond.plant->rest.asleep) members.join(bond.plant->number, *bond.body);

    std::vector<ContactIsland> islands;
    std::vector<int> island_of(members.sets.parent.size(), -1);
    const auto island = [&](const PlantBody& body) -> ContactIsland& {
        FROND_ASSERT(body.number >= 0 && size_t(body.number) < island_of.size());
        int& number = island_of[size_t(members.sets.find(body.number))];
        if (number < 0) {
            number = int(islands.size());
            islands.emplace_back();
        }
        return islands[size_t(number)];
    };
    std::vector<uint8_t> is_in(world.taking_part.size(), 0);
    const auto add = [&](ContactIsland& to, PlantBody& body) {
        if (is_in[size_t(body.number)]) return;
        is_in[size_t(body.number)] = 1;
        body.place = int(to.plants.size());
        to.plants.push_back(&body);
    };
    for (Contact& contact : world.contacts) {
        ContactIsland& to = island(*contact.plant);
        to.with_bodies.push_back(&contact);
        add(to, *contact.plant);
    }
    for (PlantContact& contact : world.plant_contacts) {
        ContactIsland& to = island(*contact.plants[0]);
        to.with_plants.push_back(&contact);
        for (PlantBody* body : contact.plants) add(to, *body);
    }
    for (Bond& bond : world.bonds) {
        if (bond.plant->rest.asleep) continue;
        ContactIsland& to = island(*bond.plant);
        to.bonds.push_back(&bond);
        add(to, *bond.plant);
    }
    return islands;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
