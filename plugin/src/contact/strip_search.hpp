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

// Makes the contact of a pair that has the gap at a time of the step: it keeps the two, from where they are before the
// step, as far apart as they are thick, along the gap's normal.
PlantContact contact_of(const std::vector<StripPath>& paths, const StripPair& pair, double time, const StripGap& gap);

// Organs of two plants of an island whose strips have gone through each other: body and organ, twice.
using OrganPair = std::array<int, 4>;
OrganPair organs_of(const std::vector<StripPath>& paths, const StripPair& pair);

// What the strips of an island's plants touch.
struct StripContacts {
    std::vector<PlantContact> contacts;
    std::vector<OrganPair> crossed;  // sorted
    std::vector<Vec3> normals;       // one per pair, of its gap before the step; zero: not known
};
// `last`: contacts of the last substep, whose impulses begin the next search for them.
// `pairs`: that come near each other within the step.
StripContacts find_strip_contacts(const std::vector<StripPath>& paths, const std::vector<StripPair>& pairs,
                                  const std::vector<const PlantContact*>& last);
// How far the corners of two plants may stray from the foreseen ways, before pairs have to be found anew [m].
constexpr double STRAY = 0.003;
// Finds the pairs that come near each other on ways that stray no farther from these, and remembers both.
void remember_pairs(const std::vector<StripPath>& paths, PlantSearch& memory);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
