// In: the steps that plants took with the contacts that were known before. Out: contacts of what went through others in
// spite of them, and how far none does. The ways of corners count as straight.
#include "contact/keep_apart.hpp"

#include <algorithm>

#include "collide/strip_cull.hpp"
#include "contact/contact_body.hpp"
#include "contact/let_through.hpp"
#include "contact/piece.hpp"
#include "contact/strip_search.hpp"
#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// How near cores may come, over how thick they are together, and over how near they were [-].
constexpr double NEAREST = 0.25, OF_BEFORE = 0.5;

// The ways that an island's plants went; empty if none of them is watched.
std::vector<StripPath> paths_of(PlantSearch& memory) {
    std::vector<StripPath> paths;
    const auto is_watched = [](const PlantBody* body) { return body->plant->step.is_watched && has_step(*body); };
    if (std::none_of(memory.island.begin(), memory.island.end(), is_watched)) return paths;
    for (size_t i = 0; i < memory.island.size(); i++) {
        PlantBody& body = *memory.island[i];
        take_collider(body);
        auto& [before, after] = memory.corners[i];
        const bool steps = has_step(body);
        const VecX &from = steps ? body.plant->step.x_good : body.plant->state.motion.x, &placed = memory.placed[i];
        if (placed.size() != from.size() || placed != from) {
            place_corners(body, from, before);
            memory.placed[i] = from;
        }
        if (steps)
            place_corners(body, body.plant->state.motion.x, after);
        else
            after = before;
        const bool with_itself = body.world->effects & body.plant->input.effects & FROND_EFFECT_SELF_CONTACT;
        paths.push_back({&body, before.data(), after.data(), with_itself});
    }
    return paths;
}

// Returns whether plants went so far off the foreseen ways that other pairs may meet.
bool have_strayed(const PlantSearch& memory, const std::vector<StripPath>& paths) {
    for (size_t i = 0; i < paths.size(); i++) {
        const auto& [before, after] = memory.corners[i];
        const std::vector<Vec3>& foreseen = memory.foreseen[i];
        if (foreseen.size() != after.size()) return true;
        for (size_t k = 0; k < after.size(); k++)
            if (!((after[k] - foreseen[k]).squaredNorm() < STRAY * STRAY)) return true;
    }
    return false;
}

struct Miss {
    StripPair pair;
    StripImpact impact;
    double thick;  // [m]
};

// From which nearness of their cores on, over their thickness, pairs are in each other, and may come out on either side
// [-]: what impulses move, and what is moved to part the plants.
constexpr double CROSSED = 1e-6, DEEP = NEAREST;

// Finds pairs that come too near each other, nearer than `share` of what they may; if there are answers, only of those
// that the last response moved, with others that may still move.
std::vector<Miss> misses_of(PlantSearch& memory, const std::vector<StripPath>& paths, double share, double crossed,
                            const Answers* answers) {
    std::vector<Miss> misses;
    if (have_strayed(memory, paths)) {
        remember_pairs(paths, memory);
        memory.normals.assign(memory.pairs.size(), Vec3::Zero());
    }
    for (size_t i = 0; i < memory.pairs.size(); i++) {
        const StripPair& pair = memory.pairs[i];
        const StripPath &a = paths[size_t(pair.a)], &b = paths[size_t(pair.b)];
        if (!awaits_contacts(*a.body) || !awaits_contacts(*b.body)) continue;  // a response changes both
        const auto either_stands = [&](Answer as) {
            return stands(*a.body, *answers, as) || stands(*b.body, *answers, as);
        };
        if (answers && (!either_stands(Answer::fresh) || either_stands(Answer::last))) continue;
        const StripCore core_a = a.core_before(pair.strip_a), core_b = b.core_before(pair.strip_b);
        const StripCore a_after = a.core_after(pair.strip_a), b_after = b.core_after(pair.strip_b);
        const double thick = a.strip(pair.strip_a).radius + b.strip(pair.strip_b).radius;
        const double near = NEAREST * thick;
        const Vec3& line = memory.normals[i];
        if ((!line.isZero(0) && stay_apart_along(line, core_a.at, a_after.at, core_b.at, b_after.at, near)) ||
            stay_apart(core_a, a_after, core_b, b_after, near) || pass_by(core_a, a_after, core_b, b_after, near))
            continue;
        const StripGap before = gap_between(core_a, core_b);
        if (before.distance < crossed * thick) continue;
        const double nearest = share * std::min(near, OF_BEFORE * before.distance);
        const auto impact = first_impact(core_a, a_after, core_b, b_after, nearest, before);
        if (!impact) continue;
        if (std::binary_search(memory.crossed.begin(), memory.crossed.end(), organs_of(paths, pair))) continue;
        misses.push_back({pair, *impact, thick});
    }
    return misses;
}

// Calls `take` for each miss of the world's plants; of an island's only for the first ones in the step if they are more
// than `most`.
void for_each_miss(World& world, double crossed, size_t most, const Answers* answers,
                   const std::function<void(const std::vector<StripPath>& paths, const Miss& miss)>& take) {
    const auto is_fresh = [&](const PlantBody* body) { return !answers || stands(*body, *answers, Answer::fresh); };
    for (size_t i = 0; i < world.plant_island_count; i++) {
        PlantSearch& memory = *world.plant_searches[i];
        if (std::none_of(memory.island.begin(), memory.island.end(), is_fresh)) continue;
        const std::vector<StripPath> paths = paths_of(memory);
        if (paths.empty()) continue;
        std::vector<Miss> misses = misses_of(memory, paths, 1, crossed, answers);
        if (misses.size() > most) {
            for (PlantBody* body : memory.island) note_trouble(world, *body, FROND_TROUBLE_CROWDED);
            std::stable_sort(misses.begin(), misses.end(),
                             [](const Miss& a, const Miss& b) { return a.impact.time < b.impact.time; });
            misses.erase(misses.begin() + std::ptrdiff_t(most), misses.end());
        }
        for (const Miss& miss : misses) take(paths, miss);
    }
}

bool is_between(const PlantContact& known, const PlantContact& contact) {
    return known.by_strips && known.plants == contact.plants && known.sides[0].nodes == contact.sides[0].nodes &&
           known.sides[1].nodes == contact.sides[1].nodes;
}

// Adds a contact, or has the known one of the same strips that points the same way ask for what is lacking.
// Returns whether the next response may differ by that.
bool add_missed(const std::vector<StripPath>& paths, const Miss& miss, double PlantContact::*lacking,
                std::vector<PlantContact>& contacts) {
    constexpr double ALIKE = 0.9;  // cosine
    PlantContact contact = contact_of(paths, miss.pair, miss.impact.time, miss.impact.gap);
    for (PlantContact& known : contacts) {
        if (!is_between(known, contact) || known.normal.dot(contact.normal) < ALIKE) continue;
        const StripPath &a = paths[size_t(miss.pair.a)], &b = paths[size_t(miss.pair.b)];
        const double apart = known.normal.dot(point_on(a.core_after(miss.pair.strip_a).at, known.sides[0].weights) -
                                              point_on(b.core_after(miss.pair.strip_b).at, known.sides[1].weights));
        if (lacking == &PlantContact::lacking && !known.may_ask) return false;
        known.*lacking += std::max(0.0, miss.thick - apart);
        return true;
    }
    contacts.push_back(contact);
    return true;
}

// Returns by how much a plant is still in the way of a body, once both are pushed, at the end of the step [m].
double behind(const Contact& contact, double h) {
    const Plant& plant = *contact.plant->plant;
    const Attachment at = attachment_of(contact);
    const Vec3 way = attachment_place(at, plant.state.motion.x) - attachment_place(at, plant.step.x_good);
    return contact.normal.dot(h * contact.pushed_on - plant.rotation * way) - contact.gap;
}

// Has a contact ask for more where the plant's response, which is linear, leaves it in the way of a body, as long as
// that helps: what the plant cannot do, a free body does. Beyond what a led body parts in a step, what overlaps already
// parts slowly, but comes no deeper. Links would turn what is asked beyond a linear response into spin.
bool ask_for_more(Contact& contact, double h) {
    if (!btRigidBody::upcast(contact.other) || !has_step(*contact.plant)) return false;
    const double parts = is_carried_on(contact) ? h * fastest_from_led(contact) : 0;
    const double now = behind(contact, h) + std::min(contact.gap + parts, 0.0);
    if (now < least_miss(*contact.plant, contact.capsule)) return false;
    return contact.shortfall.ask_for(now);
}

}  // namespace

bool is_carried_on(const Contact& contact) {
    return contact.other->isKinematicObject() && !velocity_at(*contact.other, contact.on_other).isZero(0);
}

bool is_heavy(const btCollisionObject& object, double borne) {
    return is_free(object) && 1 > MOST_LOAD * borne * double(btRigidBody::upcast(&object)->getInvMass());
}

bool goes_on(const Contact& contact) {
    return is_carried_on(contact) || is_heavy(*contact.other, contact.plant->plant->model->mass());
}

double fastest_from_led(const Contact& contact) {
    constexpr double SLOWEST = 1;  // [m/s]
    return SLOWEST + std::max(0.0, velocity_at(*contact.other, contact.on_other).dot(contact.normal));
}

double least_miss(const PlantBody& body, int capsule) {
    constexpr double NO_MATTER = 0.001, SHARE = 0.3;  // [m], over the radius [-]
    return std::max(NO_MATTER, SHARE * radius_of(body, capsule));
}

Missed find_missed_contacts(World& world, double h, const Answers& answers) {
    Missed missed;
    for (Contact& contact : world.contacts)
        if (stands(*contact.plant, answers, Answer::fresh) && ask_for_more(contact, h))
            missed.asked.push_back(contact.plant);
    missed.passed = missed.asked;
    add_passed_contacts(world, h, answers, missed);
    const Missed of_plants = add_missed_contacts(world, &PlantContact::lacking, &answers);
    missed.passed.insert(missed.passed.end(), of_plants.passed.begin(), of_plants.passed.end());
    missed.asked.insert(missed.asked.end(), of_plants.asked.begin(), of_plants.asked.end());
    return missed;
}

Missed add_missed_contacts(World& world, double PlantContact::*lacking, const Answers* answers) {
    // Contacts that a response adds: those that meet later may then not do so.
    constexpr size_t MOST = 300;
    Missed missed;
    for_each_miss(world, lacking == &PlantContact::lacking ? CROSSED : DEEP, MOST, answers,
                  [&](const std::vector<StripPath>& paths, const Miss& miss) {
                      const bool is_asked = add_missed(paths, miss, lacking, world.plant_contacts);
                      for (const int of : {miss.pair.a, miss.pair.b}) {
                          const PlantBody* body = paths[size_t(of)].body;
                          missed.passed.push_back(body);
                          if (is_asked) missed.asked.push_back(body);
                      }
                  });
    return missed;
}

void tell_what_is_behind(World& world, double h, const Answers& answers) {
    // Beyond a stem's axis, a thin body is on its other side.
    for (const Contact& contact : world.contacts)
        if (goes_on(contact) && has_step(*contact.plant) &&
            behind(contact, h) > radius_of(*contact.plant, contact.capsule)) {
            note_trouble(world, *contact.plant, FROND_TROUBLE_PASSED);
            if (stands(*contact.plant, answers, Answer::last)) let_through(*contact.plant, *contact.other);
        }
}

std::vector<PlantBody*> find_crossing_plants(World& world, double h, bool by_plants) {
    std::vector<PlantBody*> plants;
    add_plants_in_bodies(world, h, plants);
    if (!by_plants) return plants;
    for_each_miss(world, DEEP, SIZE_MAX, nullptr, [&](const std::vector<StripPath>& paths, const Miss& miss) {
        for (const int of : {miss.pair.a, miss.pair.b}) plants.push_back(paths[size_t(of)].body);
    });
    return plants;
}

double way_until_crossing(PlantSearch& memory) {
    constexpr double WITHIN = 0.4, SAFE = 0.95;  // over what is allowed before; over the time to there [-]
    const std::vector<StripPath> paths = paths_of(memory);
    double share = 1;
    if (paths.empty()) return share;
    for (const Miss& miss : misses_of(memory, paths, WITHIN, CROSSED, nullptr))
        share = std::min(share, SAFE * miss.impact.time);
    return share;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
