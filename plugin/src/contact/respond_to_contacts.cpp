// In: contacts, and plants whose step is solved but not yet accepted. Out: impulses on plants and bodies.
//
// A plant's compliance is the inverse of its own implicit system, so that resting, pushing and stacking need no
// penalties: a stem bears within the step what it can bear. Bodies have already moved when plants step, so an impulse
// changes their next motion; both sides of a contact advance from the places at which it was found.
#include "contact/respond_to_contacts.hpp"

#include <algorithm>
#include <numeric>

#include "contact/contact_rows.hpp"
#include "contact/keep_apart.hpp"
#include "contact/strip_search.hpp"
#include "contact/touched_plant.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

bool pushes_back(const World& world, const PlantBody& body) {
    return world.effects & body.plant->input.effects & FROND_EFFECT_TWO_WAY && body.plant->step.is_sound;
}

namespace {

using Row = ContactRow;

// Finds where rows touch their plants; drops those of plants that have no compliance.
void find_touches(std::vector<TouchedPlant>& touched, std::vector<Row>& rows) {
    const auto has_none = [&](Row& row) {
        for (size_t k = 0; k < 2; k++) {
            if (!row.plants[k]) continue;
            TouchedPlant& at = touched[size_t(row.plants[k]->number)];
            const int place = find_touch(at, *row.plants[k]->plant, row.touches[k].attachment);
            if (place < 0) return true;
            row.places[k] = size_t(place);
        }
        return false;
    };
    rows.erase(std::remove_if(rows.begin(), rows.end(), has_none), rows.end());
}

// Sides of rows that are one plant's: as a row's first plant, or with the opposite sign as its second.
struct Sides {
    std::vector<int> rows;
    std::vector<double> signs;
    std::vector<size_t> places;  // among the plant's touches
};

std::vector<Sides> sort_by_plant(size_t plant_count, const std::vector<Row>& rows) {
    std::vector<Sides> sides(plant_count);
    for (size_t i = 0; i < rows.size(); i++)
        for (size_t k = 0; k < 2; k++) {
            if (!rows[i].plants[k]) continue;
            Sides& of = sides[size_t(rows[i].plants[k]->place)];
            of.rows.push_back(int(i));
            of.signs.push_back(k == 0 ? 1 : -1);
            of.places.push_back(rows[i].places[k]);
        }
    return sides;
}

bool are_one_body(const Row& a, const Row& b) {
    if (a.plants[1] || b.plants[1]) return false;
    if (a.contact_body.link && b.contact_body.link)
        return a.contact_body.link->m_multiBody == b.contact_body.link->m_multiBody;
    return a.contact_body.rigid && a.contact_body.rigid == b.contact_body.rigid;
}

// Couplings of rows, computed on request.
struct Coupler {
    const std::vector<Row>& rows;
    std::vector<TouchedPlant>& touched;
    std::vector<Sides> plants;
    std::vector<std::vector<Coupling>> known;
};

// Adds the couplings of a row to the other rows of its plants.
void couple_by_plants(Coupler& coupler, int by, std::vector<Coupling>& row) {
    const Row& at = coupler.rows[size_t(by)];
    for (size_t k = 0; k < 2; k++) {
        if (!at.plants[k]) continue;
        const Sides& sides = coupler.plants[size_t(at.plants[k]->place)];
        const std::vector<Mat3>& compliances =
            compliances_to(coupler.touched[size_t(at.plants[k]->number)], at.places[k]);
        const double sign = k == 0 ? 1 : -1;
        for (size_t i = 0; i < sides.rows.size(); i++) {
            const Mat3& compliance = compliances[sides.places[i]];
            if (!compliance.isZero(0)) row.push_back({sides.rows[i], sign * sides.signs[i] * compliance.transpose()});
        }
    }
}

const std::vector<Coupling>& couple(Coupler& coupler, int by) {
    std::vector<Coupling>& row = coupler.known[size_t(by)];
    if (!row.empty()) return row;
    couple_by_plants(coupler, by, row);
    const Row& at = coupler.rows[size_t(by)];
    for (size_t i = 0; i < coupler.rows.size(); i++)
        if (are_one_body(at, coupler.rows[i]))
            row.push_back({int(i), compliance_between(at.contact_body, coupler.rows[i].contact_body)});
    if (row.empty()) row.push_back({by, Mat3::Zero()});
    return row;
}

// Adds contacts to the steps of all plants, also of those that nothing pushes: their solution without contacts then
// stands.
void end_steps(const ContactIsland& island) {
    for (PlantBody* body : island.plants) add_contacts(*body->plant, body->level.pending);
}

// Rows of an island and their impulses.
struct Given {
    std::vector<Row> rows;
    Pushes pushes;
};

// Computes how fast bodies go on once they are pushed.
void go_on(Given& given) {
    for (Row& at : given.rows) {
        if (!at.pushed_on) continue;
        *at.pushed_on = at.contact_body.velocity;
        for (size_t i = 0; i < given.rows.size(); i++)
            if (are_one_body(at, given.rows[i]))
                *at.pushed_on -=
                    compliance_between(at.contact_body, given.rows[i].contact_body) * given.pushes.impulses[i];
    }
}

// Applies the rows' impulses to the plants.
void give_to_plants(const ContactIsland& island, Given& given) {
    auto& [rows, pushes] = given;
    const auto to_plants = [&](const Row& row, const Vec3& impulse, auto take) {
        if (impulse.isZero(0)) return;
        take(*row.plants[0]->plant, row.touches[0], impulse);
        if (row.plants[1]) take(*row.plants[1]->plant, row.touches[1], -impulse);
    };
    for (size_t i = 0; i < rows.size(); i++) {
        *rows[i].impulse = pushes.impulses[i];
        to_plants(rows[i], pushes.impulses[i],
                  [](Plant& p, const PlantTouch& touch, const Vec3& impulse) { take_impulse(p, touch, impulse); });
        if (!pushes.corrections.empty()) to_plants(rows[i], pushes.corrections[i], take_correction);
    }
    end_steps(island);
}

// Applies the rows' impulses to the bodies. Returns the rigid ones among them.
std::vector<btRigidBody*> give_to_bodies(const World& world, Given& given) {
    auto& [rows, pushes] = given;
    std::vector<btRigidBody*> pushed;
    std::vector<BodyPush> all;
    for (size_t i = 0; i < pushes.impulses.size(); i++) {
        if (rows[i].plants[1] || pushes.impulses[i].isZero(0) || !pushes_back(world, *rows[i].plants[0])) continue;
        all.push_back({&rows[i].contact_body, -pushes.impulses[i]});
        if (rows[i].contact_body.rigid) pushed.push_back(rows[i].contact_body.rigid);
    }
    take_impulses(all);
    return pushed;
}

// Brings the inertias of multi-bodies up to date.
void take_inertias(const ContactIsland& island) {
    std::vector<btMultiBody*> bodies;
    const auto add = [&](btCollisionObject* object) {
        const btMultiBodyLinkCollider* link = object ? btMultiBodyLinkCollider::upcast(object) : nullptr;
        if (link && link->m_multiBody) bodies.push_back(link->m_multiBody);
    };
    for (const Contact* contact : island.with_bodies) add(contact->other);
    for (const Bond* bond : island.bonds) add(bond->body);
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (btMultiBody* body : bodies) take_present_inertia(*body);
}

// Shortens impulses by which movable bodies would gain more energy than the plants have, as long as nothing drives
// them.
void limit_gain(const ContactIsland& island, Given& given) {
    std::vector<BodyPush> on_bodies;
    for (size_t i = 0; i < given.rows.size(); i++) {
        const ContactBody& body = given.rows[i].contact_body;
        if (given.rows[i].plants[1] || given.pushes.impulses[i].isZero(0)) continue;
        if (body.rigid || body.link) on_bodies.push_back({&body, -given.pushes.impulses[i]});
    }
    if (on_bodies.empty()) return;
    const double share = share_within(on_bodies, [&] {
        double stored = 0;
        for (const PlantBody* body : island.plants) stored += stored_at_start(*body->plant);
        for (const Contact* contact : island.with_bodies)
            if (contact->other->isKinematicObject()) stored = INFINITY;
        return stored;
    });
    if (share == 1) return;
    for (size_t i = 0; i < given.rows.size(); i++)
        if (!given.rows[i].plants[1] && (given.rows[i].contact_body.rigid || given.rows[i].contact_body.link))
            given.pushes.impulses[i] *= share;
}

// Finds the impulses of an island and applies them to its plants.
Given respond_in(const World& world, const ResponseRow& response, const ContactIsland& island, double h,
                 std::vector<TouchedPlant>& touched) {
    Given given;
    auto& [rows, pushes] = given;
    take_inertias(island);
    rows = make_rows(world, island, h);
    if (all_wait(rows, h)) {
        end_steps(island);
        rows.clear();
        return given;
    }
    find_touches(touched, rows);
    std::vector<Touch> touches;
    for (const Row& row : rows) touches.push_back(row.touch);
    ResponseSettings settings = world.response_settings;
    settings.h = h;
    for (const Row& row : rows) pushes.impulses.push_back(*row.impulse);
    Coupler coupler = {rows, touched, sort_by_plant(island.plants.size(), rows),
                       std::vector<std::vector<Coupling>>(rows.size())};
    CouplingTable table;
    table.row = [&](int row) -> const std::vector<Coupling>& { return couple(coupler, row); };
    table.islands.emplace_back(rows.size());
    std::iota(table.islands[0].begin(), table.islands[0].end(), 0);
    response.find(touches, table, settings, pushes);
    limit_gain(island, given);
    go_on(given);
    give_to_plants(island, given);
    return given;
}

}  // namespace

// Plants whose step may still change, and their steps without contacts.
struct Waiting {
    std::vector<PlantBody*> bodies;
    std::vector<FreeStep> steps;
    std::vector<TouchedPlant> touched;  // by the plants' numbers
};

static Waiting find_waiting(const World& world) {
    Waiting waiting;
    waiting.touched.resize(world.taking_part.size());
    for (PlantBody* body : world.awake)
        if (waits(*body->plant) && body->level.is_due && !body->plant->state.modal) {
            waiting.bodies.push_back(body);
            waiting.steps.push_back(free_step(*body->plant));
        }
    return waiting;
}

// Takes the response back. What was solved again in its workspace has another factor, as it would foretell the next
// push.
static void take_back(Waiting& waiting) {
    for (size_t i = 0; i < waiting.bodies.size(); i++) {
        Plant& plant = *waiting.bodies[i]->plant;
        if (!plant.follow && plant.trouble & FROND_TROUBLE_RETRIED)
            waiting.touched[size_t(waiting.bodies[i]->number)] = {};
        take_back(plant, waiting.steps[i]);
    }
}

void respond_to_contacts(World& world, double h) {
    // Responses in a step: they are linear, so that some may go through others in spite of them.
    constexpr int MOST = 5;
    const ResponseRow& response = response_row(world.response);
    if (!response.find) return;
    Waiting waiting = find_waiting(world);
    std::vector<Given> given;
    std::vector<HeldBody> held;
    for (int round = 1;; round++) {
        const std::vector<ContactIsland> islands = find_contact_islands(world);
        given.clear();
        given.resize(islands.size());
        run_jobs(world, islands.size(),
                 [&](size_t i) { given[i] = respond_in(world, response, islands[i], h, waiting.touched); });
        const Missed missed = find_missed_contacts(world, h);
        if (!missed.any) break;
        if (!missed.is_asked || round == MOST) {
            held = hold_back_what_passes(world, h);
            break;
        }
        take_back(waiting);
    }
    tell_what_is_behind(world, h);
    for (Given& of : given)
        for (btRigidBody* body : give_to_bodies(world, of)) give_gravity(world.gravity_ahead, *body, h);
    for (const HeldBody& body : held) put_back(world, body, h);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
