// Rows: contacts and bonds as equations of the response.
#pragma once

#include "contact/contact_body.hpp"
#include "contact/contact_island.hpp"
#include "plant/touch.hpp"
#include "solve/impulses.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// A contact with the data of both sides.
struct ContactRow {
    std::array<PlantBody*, 2> plants = {};  // the second is null where a body is on the other side
    std::array<PlantTouch, 2> touches;
    std::array<size_t, 2> places = {};  // their indices among the touches of that plant
    ContactBody contact_body;           // the other side, if that is no plant
    Touch touch;
    size_t number = 0;          // among its island's contacts with bodies, with plants, or bonds
    Vec3* impulse;              // the contact's own
    Vec3* pushed_on = nullptr;  // likewise; null where nothing asks for it
    double* work = nullptr;     // likewise; null where no body is on the other side
};

// Makes the rows of an island for a step of h [s]; wakes sleeping bodies that plants push.
std::vector<ContactRow> make_rows(const World& world, const ContactIsland& island, double h);
// Makes the rows of an island for a correction of positions: of plants, and of bodies, which only bound it; none if no
// plants have to part.
std::vector<ContactRow> make_correction_rows(const World& world, const ContactIsland& island, double h);
// Points an island's rows at its contacts where these are now, of the same number and in the same order.
void point_at(const ContactIsland& island, std::vector<ContactRow>& rows);
// Returns whether no row would push anything: all are apart and come no nearer in the step than they may. Then no
// compliances are needed.
bool all_wait(const std::vector<ContactRow>& rows, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
