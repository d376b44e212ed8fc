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
    size_t number = 0;                                 // among its island's contacts with bodies, with plants, or bonds
    Contact* contact = nullptr;                        // null unless it is one with a body
    Vec3* impulse;                                     // the contact's own
    double* work = nullptr;                            // likewise; null where no body is on the other side
    std::array<std::vector<Foreseen::Give>, 2> gives;  // of a link's impulse, by its parts
};

// Returns the part of an impulse along a row's normal, and that across it.
std::array<Vec3, 2> parts_of(const ContactRow& row, const Vec3& impulse);
// Makes the rows of an island for a step of h [s]; wakes sleeping bodies that plants push.
std::vector<ContactRow> make_rows(const World& world, const ContactIsland& island, double h);
// Makes the rows of an island for a correction of positions: of plants, and of bodies, which only bound it; none if no
// plants have to part.
std::vector<ContactRow> make_correction_rows(const World& world, const ContactIsland& island, double h);
// Returns the velocity along the normal with which a link may go on towards a plant in the next step of h [s], from a
// gap [m] and while the plant goes on with that velocity, so that the response will not have to slow it down [m/s].
double way_on_of_link(double gap, double plant, double h);
// Points an island's rows at its contacts where these are now, of the same number and in the same order.
void point_at(const ContactIsland& island, std::vector<ContactRow>& rows);
// Returns whether no row would push anything: all are apart and come no nearer in the step than they may. Then no
// compliances are needed.
bool all_wait(const std::vector<ContactRow>& rows, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
