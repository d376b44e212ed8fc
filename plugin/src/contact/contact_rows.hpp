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
    size_t number = 0;                  // among its island's contacts with bodies, with plants, or bonds
    Contact* contact = nullptr;         // null unless it is one with a body
    Vec3* impulse;                      // the contact's own
    double* work = nullptr;             // likewise; null where no body is on the other side
    Foreseen* foreseen = nullptr;       // likewise
    std::vector<Foreseen::Part> parts;  // of a link's impulse, without their work
};

// Returns whether a body that impulses move is on the other side.
inline bool is_movable(const ContactRow& row) {
    return !row.plants[1] && (row.contact_body.rigid || row.contact_body.link);
}

// Returns the work of a row's impulse along the velocity at which it asks both sides to part [J].
double asked_work(const ContactRow& row, const Vec3& impulse);
// Returns the parts of an impulse, without their work: along a row's normal and by friction, or of a bond.
std::vector<Foreseen::Part> parts_of(const ContactRow& row, const Vec3& impulse);
// Makes the rows of an island for a step of h [s]; wakes sleeping bodies that plants push.
std::vector<ContactRow> make_rows(const World& world, const ContactIsland& island, double h);
// Makes the rows of an island for a correction of positions: of plants, and of bodies, which only bound it; none if no
// plants have to part.
std::vector<ContactRow> make_correction_rows(const World& world, const ContactIsland& island, double h);
// Returns the velocity along the normal with which a link may go on towards a plant in the next step of h [s], from a
// gap [m] and while the plant goes on with that velocity, so that the response will not have to slow it down [m/s].
double way_on_of_link(double gap, double plant, double h);
// Likewise for a bond. `wanted`: what it asked for in this step, to close its gap; `now`: the plant's velocity in it.
Vec3 way_on_of_link(const Vec3& wanted, const Vec3& now, const Vec3& plant);
// Points an island's rows at its contacts where these are now, of the same number and in the same order.
void point_at(const ContactIsland& island, std::vector<ContactRow>& rows);
// Returns whether no row would push anything: all are apart and come no nearer in the step than they may. Then no
// compliances are needed.
bool all_wait(const std::vector<ContactRow>& rows, double h);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
