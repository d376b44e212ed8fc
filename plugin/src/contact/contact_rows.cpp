// In: contacts and bonds. Out: their rows.
#include "contact/contact_rows.hpp"

#include <algorithm>

#include "contact/keep_apart.hpp"
#include "core/assert.hpp"
#include "plant/plant_step.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

void point_at(Contact& contact, ContactRow& row) {
    row.contact = &contact;
    row.foreseen = &contact.foreseen;
    row.impulse = &contact.impulse;
    row.work = &contact.work;
}
void point_at(PlantContact& contact, ContactRow& row) {
    row.impulse = &contact.impulse;
}
void point_at(Bond& bond, ContactRow& row) {
    row.foreseen = &bond.foreseen;
    row.impulse = &bond.impulse;
    row.work = &bond.work;
}

// Returns how fast overlapping sides must part: by a share of the overlap beyond the slop per step, up to `fastest`
// [m/s].
double parting_speed(double depth, double slop, double h, double share, double fastest) {
    return std::min(share * std::max(0.0, depth - slop) / h, fastest);
}

// Overlaps with bodies are removed by velocities, as these have already moved: by so slow ones that nobody sees bodies
// bounce that are deep in a stem after a fall, but faster from a kinematic body that is led.
constexpr double SLOP = 0.0005, SHARE = 0.2, FASTEST = 0.1;  // [m], [-], [m/s]

// Returns how fast sides that meet within the step must part by restitution; 0 below a speed at which nothing bounces.
double rebound_speed(const Contact& contact, const Touch& touch, double h) {
    constexpr double SLOWEST = 0.5;  // [m/s]
    const double approach = -touch.velocity.dot(contact.normal);
    const bool meets = approach > SLOWEST && h * approach > contact.gap;
    return meets ? contact.restitution * approach : 0;
}

bool rubs(const World& world, const PlantBody& body) {
    return world.effects & body.plant->input.effects & FROND_EFFECT_FRICTION;
}

double mass_of(const PlantBody* body) {
    return node_mass_of(*body->plant->system).sum();
}

// Returns the largest push of a contact [N s]. A plant gives way to none where it is held, and what plants do not move
// has any force: a walker over a corn plant's foot drew its cage out 8.5 times. So a contact with such a body gets what
// brings all that the organ bears to the speed at which the two part, and a multiple of what carries that and bends it
// by the plant's size; what presses harder goes through. Links push by any force, since Bullet's solver foretells their
// pushes: bounded ones gave them 123 J (`MultiBody.GainsNoEnergyFromPlants`).
double most_push(const Contact& contact, const Touch& touch, double h) {
    const double borne = borne_at(*contact.plant, contact.capsule);
    const bool is_pushed = is_free(*contact.other) || btMultiBodyLinkCollider::upcast(contact.other);
    if (is_pushed && !is_heavy(*contact.other, borne)) return Touch::ANY_PUSH;
    const Plant& plant = *contact.plant->plant;
    const double faster = std::max(0.0, touch.bias_velocity - touch.velocity.dot(contact.normal));
    const double bending = squared(2 * PI * plant.sway) * double(plant.size);  // [m/s^2]
    return borne * (faster + MOST_LOAD * (GRAVITY + bending) * h);
}

// Adds the row of a contact with a body.
void add_row(const World& world, Contact& contact, double h, std::vector<ContactRow>& rows) {
    Plant& plant = *contact.plant->plant;
    ContactRow row;
    row.plants[0] = contact.plant;
    if (!make_touch(plant, attachment_of(contact), row.touches[0])) return;
    row.contact_body = make_contact_body(*contact.other, contact.on_other, h);
    FROND_ASSERT(std::abs(contact.normal.squaredNorm() - 1) < 1e-3);
    row.touch.normal = contact.normal;
    row.touch.velocity = row.touches[0].velocity - row.contact_body.velocity;
    // What a kinematic body has moved against in this step is to get out of its way at once.
    row.touch.bias_velocity = contact.gap >= 0 ? -contact.gap / h
                              : is_carried_on(contact)
                                  ? parting_speed(-contact.gap, SLOP, h, 1, fastest_from_led(contact))
                                  : parting_speed(-contact.gap, SLOP, h, SHARE, FASTEST);
    if (row.touch.bias_velocity > 0) row.touch.bias_velocity *= contact.part_share;
    if (const double rebound = rebound_speed(contact, row.touch, h); rebound > 0)
        row.touch.bias_velocity = std::max(row.touch.bias_velocity, rebound);
    row.touch.most_push = most_push(contact, row.touch, h);
    row.touch.bias_velocity += contact.shortfall.lacking / h;
    row.touch.friction = rubs(world, *contact.plant) ? contact.friction : 0;
    row.touch.depth = -contact.gap;
    point_at(contact, row);
    contact.work = 0;
    contact.pushed_on = row.contact_body.velocity;
    rows.push_back(std::move(row));
}

// Wakes bodies that plants push. Call it before rows are made, so that all rows of a body see it in the same state.
void wake_pushed(const std::vector<Contact*>& contacts) {
    PlantTouch touch;
    for (const Contact* contact : contacts)
        if (make_touch(*contact->plant->plant, attachment_of(*contact), touch))
            wake(*contact->other, contact->normal, touch.velocity);
}

// Moves an attachment from the rim to the axis where a push at the rim would turn it in the step by more than a linear
// compliance can predict. Returns whether it did.
bool drop_levers(double way, Attachment& attachment) {
    constexpr double TURN = 0.15;  // [rad]
    const double lever = (attachment.arm[0] + attachment.arm[1]).norm();
    if (lever == 0 || way < TURN * lever) return false;
    attachment.arm[0].setZero();
    attachment.arm[1].setZero();
    return true;
}

constexpr double PLANT_SLOP = 0.0002;  // overlap that plants keep [m]

// Adds the row of a contact of plants. They part by position correction: cages may overlap by half a leaf when they are
// made, and velocities would make them fly.
void add_row(const World& world, PlantContact& contact, double h, std::vector<ContactRow>& rows) {
    constexpr double SHARE = 0.4, FASTEST = 0.1, FASTEST_CAGES = 0.5;  // [-], [m/s]
    // Limit of a position correction, over the lighter plant's weight [-]. Without it, feet that cannot part would use
    // up all work that position correction may do, and nothing else would part.
    constexpr double STRONG = 0.4;
    ContactRow row;
    row.plants = contact.plants;
    for (size_t k = 0; k < 2; k++)
        if (!make_touch(*contact.plants[k]->plant, contact.attachments[k], row.touches[k])) return;
    row.touch.normal = contact.normal;
    row.touch.velocity = row.touches[0].velocity - row.touches[1].velocity;
    const double room = std::max(0.0, PLANT_SLOP - contact.depth) / h;
    row.touch.bias_velocity = -room + contact.lacking / h;
    const double way = h * (row.touch.bias_velocity - row.touch.velocity.dot(contact.normal));
    for (size_t k = 0; k < 2; k++)
        if (drop_levers(way, contact.attachments[k]) &&
            !make_touch(*contact.plants[k]->plant, contact.attachments[k], row.touches[k]))
            return;
    row.touch.velocity = row.touches[0].velocity - row.touches[1].velocity;
    // Penalty springs leave nearly all of the parting to position correction.
    if (world.response != FROND_RESPONSE_PENALTY)
        row.touch.most_correction =
            h * STRONG * GRAVITY * std::min(mass_of(contact.plants[0]), mass_of(contact.plants[1]));
    row.touch.least_correction =
        room > 0 ? -room
                 : parting_speed(contact.depth, PLANT_SLOP, h, SHARE, contact.by_strips ? FASTEST : FASTEST_CAGES);
    row.touch.least_correction += contact.lacking_place / h;
    row.touch.friction = rubs(world, *contact.plants[0]) && rubs(world, *contact.plants[1]) ? contact.friction : 0;
    row.touch.depth = contact.depth;
    point_at(contact, row);
    rows.push_back(std::move(row));
}

// Adds the row of a contact with a body for a correction of positions, which brings the plant no deeper into the body.
void add_correction_row(const Contact& contact, double h, std::vector<ContactRow>& rows) {
    ContactRow row;
    row.plants[0] = contact.plant;
    if (!make_touch(*contact.plant->plant, attachment_of(contact), row.touches[0])) return;
    row.touch.normal = contact.normal;
    const double nearer = contact.normal.dot(contact.pushed_on - row.touches[0].velocity);
    row.touch.least_correction = std::min(0.0, nearer - contact.gap / h);
    rows.push_back(std::move(row));
}

constexpr double BOND_SHARE = 0.5;  // of its gap that a bond closes in a step [-]

void add_row(Bond& bond, double h, std::vector<ContactRow>& rows) {
    constexpr double FASTEST = 10;  // [m/s]
    bond.foreseen = {};
    if (bond.plant->rest.asleep) return;
    bond.impulse.setZero();
    bond.work = 0;
    bond.length = h;
    if (!bond.body) return;
    Plant& plant = *bond.plant->plant;
    ContactRow row;
    row.plants[0] = bond.plant;
    const Attachment attachment = pulled_at_vertex(plant, bond.vertex);
    if (!make_touch(plant, attachment, row.touches[0])) return;
    if (!bond.body->isStaticOrKinematicObject()) bond.body->activate();
    const Vec3 place = place_on_body(bond);
    row.contact_body = make_contact_body(*bond.body, place, h);
    row.touch.is_bond = true;
    row.touch.normal = Vec3::UnitY();
    row.touch.velocity = row.touches[0].velocity - row.contact_body.velocity;
    row.touch.wanted = BOND_SHARE / h * (place - plant.to_world(attachment_place(attachment, plant.step.x_good)));
    if (row.touch.wanted.norm() > FASTEST) row.touch.wanted *= FASTEST / row.touch.wanted.norm();
    row.touch.bias_velocity = row.touch.friction = 0;
    point_at(bond, row);
    rows.push_back(std::move(row));
}

}  // namespace

std::vector<ContactRow> make_rows(const World& world, const ContactIsland& island, double h) {
    std::vector<ContactRow> rows;
    wake_pushed(island.with_bodies);
    const auto add = [&](const auto& list, const auto& add_one) {
        for (size_t i = 0; i < list.size(); i++) {
            const size_t before = rows.size();
            add_one(*list[i]);
            if (rows.size() > before) rows.back().number = i;
        }
    };
    add(island.with_bodies, [&](Contact& contact) { add_row(world, contact, h, rows); });
    add(island.with_plants, [&](PlantContact& contact) { add_row(world, contact, h, rows); });
    add(island.bonds, [&](Bond& bond) { add_row(bond, h, rows); });
    return rows;
}

double asked_work(const ContactRow& row, const Vec3& impulse) {
    return std::max(0.0, row.touch.bias_velocity) * impulse.dot(row.touch.normal);
}

std::vector<Foreseen::Part> parts_of(const ContactRow& row, const Vec3& impulse) {
    std::vector<Foreseen::Part> parts;
    const auto add = [&](Foreseen::Kind kind, const Vec3& of) {
        if (!of.isZero(0)) parts.push_back({kind, of, 0, {}});
    };
    const auto add_axes = [&](Foreseen::Kind first, const Vec3& of) {
        for (int axis = 0; axis < 3; axis++) add(Foreseen::Kind(int(first) + axis), Vec3(of[axis] * Vec3::Unit(axis)));
    };
    if (row.touch.is_bond) {
        add_axes(Foreseen::Kind::bond_x, impulse);
    } else {
        const Vec3 along = row.touch.normal.dot(impulse) * row.touch.normal;
        add(Foreseen::Kind::normal, along);
        add_axes(Foreseen::Kind::friction_x, impulse - along);
    }
    return parts;
}

double way_on_of_link(double gap, double plant, double h) {
    const double room = gap / h, slack = SLOP / h;
    // Half of what is free, as the response leaves the link room for its way in the step after.
    if (plant <= room) return 0.5 * (plant + room);
    if (plant <= room + slack) return plant;
    return std::max((plant + SHARE * (room + slack)) / (1 + SHARE), plant - FASTEST);
}

Vec3 way_on_of_link(const Vec3& wanted, const Vec3& now, const Vec3& plant) {
    // The gap that is left, over the step, and which grows by the link's own way.
    const Vec3 gap = wanted / BOND_SHARE - now;
    return (plant - BOND_SHARE * gap) / (1 + BOND_SHARE);
}

void point_at(const ContactIsland& island, std::vector<ContactRow>& rows) {
    for (ContactRow& row : rows) {
        if (row.plants[1])
            point_at(*island.with_plants[row.number], row);
        else if (row.touch.is_bond)
            point_at(*island.bonds[row.number], row);
        else
            point_at(*island.with_bodies[row.number], row);
    }
}

std::vector<ContactRow> make_correction_rows(const World& world, const ContactIsland& island, double h) {
    std::vector<ContactRow> rows;
    const auto has_to_part = [](const PlantContact* contact) { return contact->depth > PLANT_SLOP; };
    if (std::none_of(island.with_plants.begin(), island.with_plants.end(), has_to_part)) return rows;
    for (PlantContact* contact : island.with_plants) add_row(world, *contact, h, rows);
    for (Contact* contact : island.with_bodies) add_correction_row(*contact, h, rows);
    return rows;
}

bool all_wait(const std::vector<ContactRow>& rows, double h) {
    const auto waits = [&](const ContactRow& row) {
        const Touch& touch = row.touch;
        return !touch.is_bond && row.impulse->isZero(0) && touch.depth <= 0 && touch.least_correction <= 0 &&
               touch.velocity.dot(touch.normal) >= std::max(touch.bias_velocity, touch.depth / h);
    };
    return std::all_of(rows.begin(), rows.end(), waits);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
