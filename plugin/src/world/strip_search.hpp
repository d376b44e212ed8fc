// Strips of plants: where their corners are, which come near each other within a step, and the contacts that follow.
#pragma once

#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Computes the places of the corners of a plant's strips for a state of its mechanics, world frame [m].
void place_corners(const PlantBody& body, const VecX& x, std::vector<Vec3>& out);

// A plant's strips on their way through a step.
struct StripPath {
    PlantBody* body;
    const Vec3 *before, *after;  // places of its corners, world frame [m]
    bool with_itself;
    StripCore core_before(int strip) const;
    StripCore core_after(int strip) const;
    const Strip& strip(int number) const { return body->touched().strips[size_t(number)]; }
};

// Strips of two plants, or of one.
struct StripPair {
    int a, strip_a, b, strip_b;
};
// Finds the pairs that come nearer than `margin` [m] within the step, by their boxes; those near each other as modelled,
// as at a joint, are left out.
std::vector<StripPair> find_strip_pairs(const std::vector<StripPath>& paths, double margin);

// Makes the contact of a pair that has the gap at a time of the step: it keeps the two, from where they are before the
// step, as far apart as they are thick, along the gap's normal.
PlantContact contact_of(const std::vector<StripPath>& paths, const StripPair& pair, double time, const StripGap& gap);

// Organs of two plants of an island whose strips have gone through each other: body and organ, twice.
using OrganPair = std::array<int, 4>;
OrganPair organs_of(const std::vector<StripPath>& paths, const StripPair& pair);

// What the strips of an island's plants touch; crossed: sorted.
struct StripContacts {
    std::vector<PlantContact> contacts;
    std::vector<OrganPair> crossed;
};
// `last`: contacts of the last substep, whose impulses begin the next search for them.
StripContacts find_strip_contacts(const std::vector<StripPath>& paths, const std::vector<const PlantContact*>& last);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
