// In: contacts, and plants whose step is solved but not yet accepted. Out: impulses on plants and bodies.
//
// A plant's compliance is the inverse of its own implicit system, so that resting, pushing and stacking need no
// penalties: a stem bears within the step what it can bear. Bodies have already moved when plants step, so an impulse
// changes their next motion; both sides of a contact advance from the places at which it was found.
#include "contact/respond_to_contacts.hpp"

#include <algorithm>

#include "contact/bodies_go_on.hpp"
#include "contact/bound_gain.hpp"
#include "contact/coupled_rows.hpp"
#include "contact/foresee.hpp"
#include "contact/keep_apart.hpp"
#include "contact/part_plants.hpp"
#include "contact/push_plants.hpp"
#include "contact/stop_asking.hpp"
#include "contact/strip_search.hpp"
#include "core/elementary.hpp"
#include "plant/plant_step.hpp"
#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

bool pushes_back(const World& world, const PlantBody& body) {
    return world.effects & body.plant->input.effects & FROND_EFFECT_TWO_WAY && body.plant->step.is_sound;
}

namespace {

// How an island was answered: its rows and their impulses.
struct Given {
    std::vector<ContactRow> rows;
    std::vector<Vec3> impulses;
    std::vector<PlantBody*> plants;
    size_t contacts = 0;   // number of contacts and bonds
    double couplings = 0;  // between rows, summed over all responses of the step
};

size_t contacts_of(const ContactIsland& island) {
    return island.with_bodies.size() + island.with_plants.size() + island.bonds.size();
}

// Applies the rows' impulses to the bodies. Returns the rigid ones among them.
std::vector<btRigidBody*> give_to_bodies(const World& world, Given& given) {
    const std::vector<ContactRow>& rows = given.rows;
    const std::vector<Vec3>& impulses = given.impulses;
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
void take_back_from_rewound(Given& given) {
    bool any = false;
    for (size_t i = 0; i < given.rows.size(); i++) {
        ContactRow& row = given.rows[i];
        if (row.plants[1] || row.plants[0]->plant->step.is_sound || given.impulses[i].isZero(0)) continue;
        given.impulses[i].setZero();
        row.impulse->setZero();
        any = true;
    }
    if (any) go_on(given.rows, given.impulses);
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

// Finds the impulses of an island and applies them to its plants.
Given respond_in(const World& world, const ResponseRow& response, const ContactIsland& island, double h,
                 Waiting& waiting) {
    Given given;
    std::vector<ContactRow>& rows = given.rows;
    std::vector<Vec3>& impulses = given.impulses;
    take_inertias(island);
    for (bool again = true; again;) {
        rows = make_rows(world, island, h);
        if (all_wait(rows, h)) {
            rows.clear();
            impulses.clear();
            push_plants(island, rows, impulses, waiting);
            return given;
        }
        const CoupledRows coupled(std::move(rows), island.plants.size(), waiting.touched);
        rows = coupled.rows();
        ResponseSettings settings = world.response_settings;
        settings.h = h;
        impulses.clear();
        for (const ContactRow& row : rows) impulses.push_back(*row.impulse);
        response.find(coupled.touches(), coupled.table(), settings, impulses);
        again = stop_asking(island, coupled, impulses, h);
        if (again) continue;
        push_plants(island, rows, impulses, waiting);
        for (size_t i = 0; i < rows.size(); i++)
            if (rows[i].contact_body.link && !impulses[i].isZero(0))
                rows[i].parts = coupled.parts_with_gives(i, impulses);
    }
    go_on(rows, impulses);
    for (size_t i = 0; i < rows.size(); i++) *rows[i].impulse = impulses[i];
    return given;
}

// Couplings of an island after which it gets no more responses in a step, which take as long as there are couplings;
// fewer where plants can let a body through.
constexpr double MOST_COUPLINGS = 5e5, MOST_WITH_LED = 1e5;

// The responses of a step, island by island.
struct Responses {
    std::vector<Given> given;
    // By the plants' numbers; `passed`: something goes through one as it is now, or nearly.
    Answers answers;
    std::vector<uint8_t> asked, passed;
    explicit Responses(size_t plants) : answers(plants, Answer::fresh), asked(plants, 0), passed(plants, 0) {}
    // Returns which of the answers is each plant's; -1: none.
    std::vector<int> given_of() const {
        std::vector<int> of(answers.size(), -1);
        for (size_t i = 0; i < given.size(); i++)
            for (const PlantBody* body : given[i].plants) of[size_t(body->number)] = int(i);
        return of;
    }
};

// Returns what the last response gave an island, if that still is the answer; null where contacts came, went or ask for
// more.
Given* standing_answer(Responses& all, const std::vector<int>& given_of, const ContactIsland& island) {
    const int before = given_of[size_t(island.plants[0]->number)];
    if (before < 0) return nullptr;
    Given& given = all.given[size_t(before)];
    const auto differs = [&](const PlantBody* body) {
        return given_of[size_t(body->number)] != before || all.asked[size_t(body->number)];
    };
    if (std::any_of(island.plants.begin(), island.plants.end(), differs)) return nullptr;
    return given.plants.size() == island.plants.size() && given.contacts == contacts_of(island) ? &given : nullptr;
}

// Answers the islands that have no standing answer.
void respond_again(World& world, const ResponseRow& response, double h, Waiting& waiting, Responses& all) {
    const std::vector<ContactIsland> islands = find_contact_islands(world);
    const std::vector<int> given_of = all.given_of();
    std::vector<Given> given(islands.size());
    std::vector<size_t> open;  // islands
    std::vector<uint8_t> stands(all.answers.size(), 0);
    for (size_t i = 0; i < islands.size(); i++) {
        if (Given* standing = standing_answer(all, given_of, islands[i])) {
            given[i] = std::move(*standing);
            point_at(islands[i], given[i].rows);
            for (const PlantBody* body : given[i].plants) stands[size_t(body->number)] = 1;
            continue;
        }
        open.push_back(i);
        for (const PlantBody* body : islands[i].plants)
            if (const int of = given_of[size_t(body->number)]; of >= 0)
                given[i].couplings = std::max(given[i].couplings, all.given[size_t(of)].couplings);
    }
    for (PlantBody* body : waiting.bodies) {
        const size_t number = size_t(body->number);
        if (given_of[number] >= 0 && !stands[number]) take_back(waiting, *body);
    }
    run_jobs(world, open.size(), [&](size_t k) {
        const ContactIsland& island = islands[open[k]];
        Given& to = given[open[k]];
        const double couplings = to.couplings;
        to = respond_in(world, response, island, h, waiting);
        to.plants = island.plants;
        to.contacts = contacts_of(island);
        to.couplings = couplings + squared(double(to.rows.size()));
    });
    for (const size_t i : open) {
        const std::vector<Contact*>& contacts = islands[i].with_bodies;
        const bool any_goes_on = std::any_of(contacts.begin(), contacts.end(), [](Contact* c) { return goes_on(*c); });
        const bool is_last = given[i].couplings > (any_goes_on ? MOST_WITH_LED : MOST_COUPLINGS);
        for (PlantBody* body : given[i].plants) {
            if (is_last) note_trouble(world, *body, FROND_TROUBLE_CROWDED);
            all.answers[size_t(body->number)] = is_last ? Answer::last : Answer::fresh;
        }
    }
    all.given = std::move(given);
}

// Looks for what the contacts missed. Returns whether islands are to be answered again.
bool ask_again(World& world, double h, Responses& all) {
    const Missed missed = find_missed_contacts(world, h, all.answers);
    for (size_t i = 0; i < all.answers.size(); i++) {
        all.asked[i] = 0;
        if (all.answers[i] == Answer::fresh) all.passed[i] = 0;
        if (all.answers[i] == Answer::last) all.passed[i] = 1;
    }
    for (const PlantBody* body : missed.passed) all.passed[size_t(body->number)] = 1;
    for (const PlantBody* body : missed.asked) all.asked[size_t(body->number)] = 1;
    for (Answer& answer : all.answers)
        if (answer == Answer::fresh) answer = Answer::kept;
    return !missed.asked.empty();
}

}  // namespace

void respond_to_contacts(World& world, double h) {
    // Responses in a step: they are linear, so that some may go through others in spite of them.
    constexpr int MOST = 5;
    const ResponseRow& response = response_row(world.response);
    if (!response.find) return;
    Waiting waiting = find_waiting(world);
    Responses all(world.taking_part.size());
    for (int round = 1;; round++) {
        respond_again(world, response, h, waiting, all);
        // Rows point into the contacts that were answered, so the search for missed ones adds to copies.
        std::vector<Contact> contacts = std::move(world.contacts);
        std::vector<PlantContact> plant_contacts = std::move(world.plant_contacts);
        world.contacts = contacts;
        world.plant_contacts = plant_contacts;
        if (ask_again(world, h, all) && round < MOST) continue;
        world.contacts = std::move(contacts);
        world.plant_contacts = std::move(plant_contacts);
        break;
    }
    std::vector<HeldBody> held;
    if (std::any_of(all.passed.begin(), all.passed.end(), [](uint8_t passed) { return passed != 0; }))
        held = hold_back_what_passes(world, h);
    for (Given& of : all.given) {
        if (bound_gain(world, of.rows, h, of.impulses)) go_on(of.rows, of.impulses);
        take_back_from_rewound(of);
        if (world.ledger) count_work_of_bodies(world, of.rows, of.impulses);
    }
    tell_what_is_behind(world, h, all.answers);
    for (const Given& of : all.given) foresee(world, of.rows, h);
    part_plants(world, h, waiting.touched);
    for (Given& of : all.given)
        for (btRigidBody* body : give_to_bodies(world, of)) give_gravity(world.gravity_ahead, *body, h);
    for (const HeldBody& body : held) put_back(world, body, h);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
