// In: contacts, and plants whose step is solved but not yet accepted. Out: impulses on plants and bodies.
//
// A plant's compliance is the inverse of its own implicit system, so that resting, pushing and stacking need no
// penalties: a stem bears within the step what it can bear. Bodies have already moved when plants step, so an impulse
// changes their next motion; both sides of a contact advance from the places at which it was found.
#include "contact/respond_to_contacts.hpp"

#include <algorithm>

#include "contact/bound_gain.hpp"
#include "contact/coupled_rows.hpp"
#include "contact/keep_apart.hpp"
#include "contact/part_plants.hpp"
#include "contact/strip_search.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

bool pushes_back(const World& world, const PlantBody& body) {
    return world.effects & body.plant->input.effects & FROND_EFFECT_TWO_WAY && body.plant->step.is_sound;
}

namespace {

// Adds contacts to the steps of all plants, also of those that nothing pushes: their solution without contacts then
// stands.
void end_steps(const ContactIsland& island) {
    for (PlantBody* body : island.plants) add_contacts(*body->plant, body->level.pending);
}

// Rows of an island and their impulses.
struct Given {
    std::vector<ContactRow> rows;
    std::vector<Vec3> impulses;
};

// Computes how fast bodies go on once they are pushed, and their work on plants: impulses times mean velocities, to
// which a bond adds that by which it comes back together.
void go_on(const World& world, Given& given) {
    for (size_t i = 0; i < given.rows.size(); i++) {
        ContactRow& at = given.rows[i];
        if (!at.work) continue;
        Vec3 after = at.contact_body.velocity;
        for (size_t k = 0; k < given.rows.size(); k++)
            if (are_one_body(at, given.rows[k]))
                after -= compliance_between(at.contact_body, given.rows[k].contact_body) * given.impulses[k];
        if (at.pushed_on) *at.pushed_on = after;
        const bool is_slowed = pushes_back(world, *at.plants[0]);
        const Vec3 mean = is_slowed ? Vec3(0.5 * (at.contact_body.velocity + after)) : at.contact_body.velocity;
        *at.work = given.impulses[i].dot(mean + at.touch.wanted);
    }
}

// Applies the rows' impulses to the plants.
void give_to_plants(const ContactIsland& island, Given& given) {
    auto& [rows, impulses] = given;
    for (size_t i = 0; i < rows.size(); i++) {
        *rows[i].impulse = impulses[i];
        if (impulses[i].isZero(0)) continue;
        for (size_t k = 0; k < 2; k++) {
            if (!rows[i].plants[k]) continue;
            Plant& plant = *rows[i].plants[k]->plant;
            add_impulse(plant, rows[i].touches[k], k == 0 ? impulses[i] : Vec3(-impulses[i]), push_of(plant).impulse);
        }
    }
    end_steps(island);
}

// Applies the rows' impulses to the bodies. Returns the rigid ones among them.
std::vector<btRigidBody*> give_to_bodies(const World& world, Given& given) {
    auto& [rows, impulses] = given;
    std::vector<btRigidBody*> pushed;
    std::vector<BodyPush> all;
    for (size_t i = 0; i < impulses.size(); i++) {
        if (rows[i].plants[1] || impulses[i].isZero(0) || !pushes_back(world, *rows[i].plants[0])) continue;
        all.push_back({&rows[i].contact_body, -impulses[i]});
        if (rows[i].contact_body.rigid) pushed.push_back(rows[i].contact_body.rigid);
    }
    take_impulses(all);
    return pushed;
}

// Takes the impulses back that bodies gave to plants whose step is rewound: neither moves by them.
void take_back_from_rewound(const World& world, Given& given) {
    bool any = false;
    for (size_t i = 0; i < given.rows.size(); i++) {
        ContactRow& row = given.rows[i];
        if (row.plants[1] || row.plants[0]->plant->step.is_sound || given.impulses[i].isZero(0)) continue;
        given.impulses[i].setZero();
        row.impulse->setZero();
        any = true;
    }
    if (any) go_on(world, given);
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

// Has contacts ask for no more than that nothing comes nearer if the rest would give energy: steps are shortened
// instead. Returns whether it did.
bool stop_asking(const ContactIsland& island, const CoupledRows& coupled, const std::vector<Vec3>& impulses, double h) {
    const auto asks = [](const PlantContact* contact) { return contact->lacking > 0; };
    const auto parts = [](const Contact* contact) {
        return contact->may_part && contact->gap < 0 && !contact->other->isKinematicObject();
    };
    if (std::none_of(island.with_plants.begin(), island.with_plants.end(), asks) &&
        std::none_of(island.with_bodies.begin(), island.with_bodies.end(), parts))
        return false;
    double most = 0;
    for (const PlantBody* body : island.plants) most += parting_work(*body->plant, h);
    if (gain_by(impulses, coupled) <= most) return false;
    for (PlantContact* contact : island.with_plants) {
        contact->lacking = 0;
        contact->may_ask = false;
    }
    for (Contact* contact : island.with_bodies)
        if (parts(contact)) contact->may_part = false;
    return true;
}

// Finds the impulses of an island and applies them to its plants.
Given respond_in(const World& world, const ResponseRow& response, const ContactIsland& island, double h,
                 std::vector<TouchedPlant>& touched) {
    Given given;
    auto& [rows, impulses] = given;
    take_inertias(island);
    for (bool again = true; again;) {
        rows = make_rows(world, island, h);
        if (all_wait(rows, h)) {
            end_steps(island);
            rows.clear();
            return given;
        }
        const CoupledRows coupled(std::move(rows), island.plants.size(), touched);
        rows = coupled.rows();
        ResponseSettings settings = world.response_settings;
        settings.h = h;
        impulses.clear();
        for (const ContactRow& row : rows) impulses.push_back(*row.impulse);
        response.find(coupled.touches(), coupled.table(), settings, impulses);
        again = stop_asking(island, coupled, impulses, h);
    }
    go_on(world, given);
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
    constexpr double MOST_COUPLINGS = 2e6;  // of an island's contacts, summed over responses, which take that long
    double couplings = 0;
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
        size_t most_rows = 0;
        for (const Given& of : given) most_rows = std::max(most_rows, of.rows.size());
        couplings += double(most_rows) * double(most_rows);
        // Rows point into the contacts that were answered, so the search for missed ones adds to copies.
        std::vector<Contact> contacts = std::move(world.contacts);
        std::vector<PlantContact> plant_contacts = std::move(world.plant_contacts);
        world.contacts = contacts;
        world.plant_contacts = plant_contacts;
        const Missed missed = find_missed_contacts(world, h);
        if (!missed.is_asked || round == MOST || couplings > MOST_COUPLINGS) {
            world.contacts = std::move(contacts);
            world.plant_contacts = std::move(plant_contacts);
            if (missed.any) held = hold_back_what_passes(world, h);
            break;
        }
        take_back(waiting);
    }
    for (Given& of : given) {
        if (bound_gain(of.rows, h, of.impulses)) go_on(world, of);
        take_back_from_rewound(world, of);
    }
    tell_what_is_behind(world, h);
    part_plants(world, h, waiting.touched);
    for (Given& of : given)
        for (btRigidBody* body : give_to_bodies(world, of)) give_gravity(world.gravity_ahead, *body, h);
    for (const HeldBody& body : held) put_back(world, body, h);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
