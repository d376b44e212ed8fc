// In: contacts of the last substep, and those found in this one. Out: both together.
#include "contact/remember_contacts.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "collide/contact_gap.hpp"
#include "contact/find_plant_contacts.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

constexpr double DRIFTED = 0.02;  // distance from its last place beyond which a contact is another one [m]
constexpr double APART = 0.01;    // distance between both sides beyond which a contact ends [m]

// A contact's first plant, second plant, and nodes of the point on the first.
using Key = std::tuple<int, int, std::array<int, 4>>;
Key key_of(const PlantContact& contact) {
    return {contact.plants[0]->number, contact.plants[1]->number, contact.sides[0].nodes};
}

// Moves a contact on by the displacements of its points.
PlantContact moved_on(const PlantContact& before) {
    PlantContact contact = before;
    take_attachments(contact);
    contact.depth -= (contact.between - before.between).dot(contact.normal);
    return contact;
}

// Moves a contact to where the two are nearest now. False if they are apart, or lie on other sides of each other.
bool follow(const PlacedIsland& island, PlantContact& contact) {
    constexpr double IN = 0.005;           // [m]
    if (contact.depth > IN) return false;  // exit of a deep overlap that is gone
    const auto body_of = [&](const PlantBody* body) -> const CollisionBody& {
        return island
            .bodies[size_t(std::find(island.plants.begin(), island.plants.end(), body) - island.plants.begin())];
    };
    CageContact now = {CONTACT_NODE_IN_TET, contact.sides[0], contact.sides[1],
                       contact.point,       contact.normal,   contact.depth};
    if (!follow_contact(body_of(contact.plants[0]), body_of(contact.plants[1]), APART, now) || now.depth > IN)
        return false;
    contact.sides = {now.a, now.b};
    contact.point = now.point;
    contact.normal = now.normal;
    contact.depth = now.depth;
    take_attachments(contact);
    return true;
}

bool move_on(const PlacedIsland&, PlantContact& contact) {
    constexpr double IN = 0.001;  // [m]
    constexpr int LONG = 12;      // [substeps]
    const Vec3 between = contact.between;
    contact = moved_on(contact);
    const Vec3 moved = contact.between - between;
    // What a response lacked is of its own step.
    contact.lacking = contact.lacking_place = 0;
    contact.may_ask = true;
    // The search found no overlap, so depth begins at zero or below; if it grows too far unseen, the contact ends.
    if (contact.missed++ == 0) contact.depth = std::min(contact.depth, 0.0);
    if (contact.missed > LONG || contact.depth > IN || contact.depth < -APART) return false;
    return (moved - moved.dot(contact.normal) * contact.normal).norm() <= DRIFTED;
}

// How contacts of two plants are kept.
struct Memory {
    bool (*go_on)(const PlacedIsland&, PlantContact&);  // updates a contact that was not found; false: it ends
    double alike;  // least cosine between the exits of one contact: a tip may have several
    bool doubts;   // contacts that become deeper are checked
};
constexpr Memory OF_CAGES = {follow, 0.8, false}, OF_SHEATHS = {move_on, -1, true};

// A penalty spring pushes by depth, which begins anew where a contact is followed to another place, so such contacts
// are remembered instead.
const Memory& memory_of(const World& world, const PlantContact& contact) {
    const bool is_followed = !contact.by_sheath[0] && !contact.by_sheath[1] && world.response != FROND_RESPONSE_PENALTY;
    return is_followed ? OF_CAGES : OF_SHEATHS;
}

bool are_one_pair(const PlantContact& a, const PlantContact& b) {
    return a.plants == b.plants || (a.plants[0] == b.plants[1] && a.plants[1] == b.plants[0]);
}

// Limits depths to those of the last substep plus the motion since then: where the search finds more, it has chosen
// another exit direction, as where a leaf slides off another one's tip. Then the last substep's stays, if there is one.
void doubt_what_is_deeper(const World& world, const std::vector<const PlantContact*>& last,
                          std::vector<PlantContact>& contacts) {
    constexpr double NEAR = 0.1, CALM = 0.005, SLACK = 0.002;  // [m]
    std::multimap<Key, const PlantContact*> known;
    for (const PlantContact* before : last) known.emplace(key_of(*before), before);
    for (PlantContact& contact : contacts) {
        if (!memory_of(world, contact).doubts || contact.depth <= SLACK) continue;
        bool is_new = true;
        double deepest = 0;
        for (const PlantContact* before : last) {
            if (!are_one_pair(*before, contact)) continue;
            is_new = false;
            if ((before->point - contact.point).norm() < NEAR) deepest = std::max(deepest, before->depth);
        }
        if (is_new || deepest > CALM) continue;
        const auto [first, end] = known.equal_range(key_of(contact));
        const PlantContact* nearest = nullptr;
        for (auto k = first; k != end; ++k)
            if ((k->second->point - contact.point).norm() < DRIFTED && (!nearest || k->second->depth > nearest->depth))
                nearest = k->second;
        if (nearest) {
            const PlantContact now = moved_on(*nearest);
            if (contact.depth <= now.depth + SLACK) continue;
            deepest = std::max(now.depth, 0.0);
            if (now.depth > 0) contact.normal = now.normal;
        }
        contact.depth = std::min(contact.depth, deepest + SLACK);
    }
}

// Keeps contacts that pushed and were not found again; those found again take over their impulses.
void keep_what_pushes(const PlacedIsland& island, const std::vector<const PlantContact*>& last,
                      std::vector<PlantContact>& contacts) {
    std::multimap<Key, size_t> found;
    for (size_t i = 0; i < contacts.size(); i++) found.emplace(key_of(contacts[i]), i);
    // An edge may touch at several places: a contact found at another place is another one.
    const auto find_again = [&](const PlantContact& before) -> PlantContact* {
        PlantContact* nearest = nullptr;
        double least = DRIFTED;
        const auto [first, end] = found.equal_range(key_of(before));
        for (auto k = first; k != end; ++k) {
            PlantContact& contact = contacts[k->second];
            const double away = (contact.point - before.point).norm();
            if (away >= least || contact.normal.dot(before.normal) < memory_of(island.world, before).alike) continue;
            least = away;
            nearest = &contact;
        }
        return nearest;
    };
    for (const PlantContact* before : last) {
        const bool pushed = before->depth > 0 || !before->impulse.isZero(0);
        if (!pushed || !may_touch(island.world, *before)) continue;
        if (PlantContact* again = find_again(*before)) {
            again->impulse += before->impulse;
            continue;
        }
        PlantContact contact = *before;
        if (memory_of(island.world, contact).go_on(island, contact)) contacts.push_back(contact);
    }
}

}  // namespace

void remember_contacts(const PlacedIsland& island, const std::vector<const PlantContact*>& last,
                       std::vector<PlantContact>& contacts) {
    doubt_what_is_deeper(island.world, last, contacts);
    keep_what_pushes(island, last, contacts);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
