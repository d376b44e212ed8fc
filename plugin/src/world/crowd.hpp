// How many contacts a plant may have: each is coupled with all others of its plants, so that cost grows with the square
// of their number.
#pragma once

#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Contacts that each plant has, and whether there is room for more.
struct Crowd {
    std::vector<int> count;  // by the plants' numbers
    explicit Crowd(const World& world);
    bool has_room(const PlantBody& body) const;
    // Count a contact; false, and nothing is counted, if a plant of it has as many as it may have.
    bool admits(const PlantBody& a, const PlantBody& b);
    bool admits(const Contact& contact) { return admits(*contact.plant, *contact.plant); }
    bool admits(const PlantContact& contact) { return admits(*contact.plants[0], *contact.plants[1]); }
};

// Keeps each plant's deepest contacts, first those with bodies, which nothing else stops. Reports
// FROND_TROUBLE_CROWDED where it drops some.
void keep_deepest(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
