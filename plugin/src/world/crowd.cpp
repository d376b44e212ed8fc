// In: a world's contacts. Out: which of them its plants keep.
#include "world/crowd.hpp"

#include <algorithm>
#include <numeric>

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

Crowd::Crowd(const World& world) : count(world.taking_part.size(), 0) {
    for (const Contact& contact : world.contacts) count[size_t(contact.plant->number)]++;
    for (const PlantContact& contact : world.plant_contacts) {
        count[size_t(contact.plants[0]->number)]++;
        if (contact.plants[1] != contact.plants[0]) count[size_t(contact.plants[1]->number)]++;
    }
}

bool Crowd::has_room(const PlantBody& body) const {
    constexpr int MOST = 100;  // contacts of a plant
    return count[size_t(body.number)] < MOST;
}

bool Crowd::admits(const PlantBody& a, const PlantBody& b) {
    if (!has_room(a) || !has_room(b)) return false;
    count[size_t(a.number)]++;
    if (&a != &b) count[size_t(b.number)]++;
    return true;
}

namespace {

double depth_of(const Contact& contact) {
    return -contact.gap;
}
double depth_of(const PlantContact& contact) {
    return contact.depth;
}

// Drops the contacts for which there is no room once the deeper ones are in. Returns whether there were any.
template <class Of>
bool drop_shallow(Crowd& crowd, std::vector<Of>& contacts) {
    std::vector<size_t> order(contacts.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return depth_of(contacts[a]) > depth_of(contacts[b]); });
    std::vector<uint8_t> is_admitted(contacts.size());
    for (const size_t i : order) is_admitted[i] = crowd.admits(contacts[i]);
    size_t kept = 0;
    for (size_t i = 0; i < contacts.size(); i++)
        if (is_admitted[i]) contacts[kept++] = contacts[i];
    const bool any = kept < contacts.size();
    contacts.erase(contacts.begin() + std::ptrdiff_t(kept), contacts.end());
    return any;
}

}  // namespace

void keep_deepest(World& world) {
    Crowd crowd(world);
    std::fill(crowd.count.begin(), crowd.count.end(), 0);
    const bool any_of_bodies = drop_shallow(crowd, world.contacts);
    if (drop_shallow(crowd, world.plant_contacts) || any_of_bodies) world.report.trouble |= FROND_TROUBLE_CROWDED;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
