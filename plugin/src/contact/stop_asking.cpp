// In: the impulses of an island. Out: its contacts, which ask for less where these give more energy than parting may.
#include "contact/stop_asking.hpp"

#include <algorithm>
#include <array>

#include "contact/contact_body.hpp"
#include "contact/keep_apart.hpp"
#include "plant/plant_step.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Returns the energy that plants and bodies gain by impulses, without the work of kinematic bodies [J]. It is none
// where nothing parts faster than it came.
double gain_by(const std::vector<Vec3>& impulses, const CoupledRows& coupled) {
    const std::vector<ContactRow>& rows = coupled.rows();
    const CouplingTable table = coupled.table();
    std::vector<Vec3> changes(rows.size(), Vec3::Zero());  // of the velocities
    for (size_t i = 0; i < rows.size(); i++)
        if (!impulses[i].isZero(0))
            for (const Coupling& by : table.row(int(i)))
                changes[size_t(by.other)] += by.block.transpose() * impulses[i];
    double gain = 0;
    for (size_t i = 0; i < rows.size(); i++)
        if (rows[i].plants[1] || !rows[i].contact_body.object->isKinematicObject())
            gain += impulses[i].dot(rows[i].touch.velocity + 0.5 * changes[i]);
    return gain;
}

bool asks(const PlantContact* contact) {
    return contact->lacking > 0;
}
// A body that is led does what work its way takes.
bool asks(const Contact* contact) {
    return contact->shortfall.lacking > 0 && !is_carried_on(*contact);
}
// A kinematic body that moves does what work its way takes; one at rest parts as a static one does. Hosts move ghost
// objects too, and Bullet knows no speed of these.
bool parts(const Contact* contact) {
    const bool may_move =
        contact->other->isKinematicObject() &&
        !(btRigidBody::upcast(contact->other) && velocity_at(*contact->other, contact->on_other).isZero(0));
    return contact->part_share > 0 && contact->gap < 0 && !may_move;
}

// Returns the work of contacts by parting from bodies, on plants and free bodies: what is held and overlaps something
// that cannot move gets it whatever it takes [J]. Ghost objects are moved by their hosts.
double work_of_parting(const ContactIsland& island, const std::vector<Vec3>& impulses, const CoupledRows& coupled) {
    const std::vector<ContactRow>& rows = coupled.rows();
    double work = 0;
    for (size_t i = 0; i < rows.size(); i++) {
        const ContactRow& row = rows[i];
        if (row.plants[1] || row.touch.is_bond) continue;
        if (!btRigidBody::upcast(row.contact_body.object) && !row.contact_body.link) continue;
        if (parts(island.with_bodies[row.number])) work += asked_work(row, impulses[i]);
    }
    return work;
}

// Returns the work that parting may do on the plants of an island, and then on its free bodies too [J].
std::array<double, 2> most_parting(const ContactIsland& island, double h) {
    double of_plants = 0, of_bodies = 0;
    for (const PlantBody* body : island.plants) of_plants += parting_work(*body->plant, h);
    std::vector<const btRigidBody*> bodies;
    for (const Contact* contact : island.with_bodies)
        if (is_free(*contact->other)) bodies.push_back(btRigidBody::upcast(contact->other));
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (const btRigidBody* body : bodies) of_bodies += parting_work(1 / double(body->getInvMass()), h);
    return {of_plants, of_plants + of_bodies};
}

}  // namespace

bool stop_asking(const ContactIsland& island, const CoupledRows& coupled, const std::vector<Vec3>& impulses, double h) {
    constexpr double SAFE = 0.7, LEAST = 0.01;  // of the speed that the work allows; share of it that is none [-]
    if (std::none_of(island.with_plants.begin(), island.with_plants.end(), [](auto* of) { return asks(of); }) &&
        std::none_of(island.with_bodies.begin(), island.with_bodies.end(),
                     [](auto* of) { return asks(of) || parts(of); }))
        return false;
    const auto [of_plants, of_all] = most_parting(island, h);
    const double work = work_of_parting(island, impulses, coupled);
    const bool gives = gain_by(impulses, coupled) > of_plants;
    if (!gives && work <= of_all) return false;
    // What parts goes on as slowly as the work allows, or what motors press against a plant would sink in.
    const double slower = gives ? 0 : SAFE * of_all / work;
    for (PlantContact* contact : island.with_plants) {
        contact->lacking = 0;
        contact->may_ask = false;
    }
    for (Contact* contact : island.with_bodies) {
        if (parts(contact))
            contact->part_share = contact->part_share * slower > LEAST ? contact->part_share * slower : 0;
        if (!asks(contact)) continue;
        contact->shortfall.lacking = 0;
        contact->shortfall.may_ask = false;
    }
    return true;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
