// What an island's impulses do to its plants, whose steps are solved but not yet accepted.
#pragma once

#include "contact/contact_rows.hpp"
#include "contact/touched_plant.hpp"
#include "plant/plant_step.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Plants whose step may still change, and their steps without contacts.
struct Waiting {
    std::vector<PlantBody*> bodies;
    std::vector<FreeStep> steps;
    std::vector<size_t> of;             // which of these a plant is, by the plants' numbers
    std::vector<TouchedPlant> touched;  // likewise
};
Waiting find_waiting(const World& world);
// Takes the response of a plant back. Where it was solved again, its matrix was factored at another place, and the
// compliances found with the one before are dropped.
void take_back(Waiting& waiting, PlantBody& body);

// Adds the rows' impulses to the steps of an island's plants, also of those that nothing pushes, and shortens them to
// what both of their sides take. Without rows, the steps without contacts are from then on those that come out.
void push_plants(const ContactIsland& island, const std::vector<ContactRow>& rows, std::vector<Vec3>& impulses,
                 Waiting& waiting);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
