// In: the steps that plants took with the impulses of their contacts. Out: corrections of their positions.
//
// What a correction would carry through something else is not stopped by impulses, which would do whatever work that
// takes: contacts there take part in the correction, and what still goes through is moved less.
#include "contact/part_plants.hpp"

#include <algorithm>

#include "contact/coupled_rows.hpp"
#include "contact/keep_apart.hpp"
#include "plant/plant_step.hpp"
#include "solve/position_correction.hpp"
#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// What a plant was moved by.
struct Correction {
    VecX from, way;  // of its nodes [m]; empty: none
    double share = 1;
};
using Corrections = std::vector<Correction>;  // by the plants' numbers

// Goes another share of a correction's way, back to the last bit. Returns whether that is any other.
bool go_share(Plant& plant, Correction& correction, double share) {
    if (correction.way.size() == 0 || correction.share == share) return false;
    plant.state.motion.x = correction.from + share * correction.way;
    correction.share = share;
    return true;
}

// Corrects the positions of an island's plants.
void part(const World& world, const ContactIsland& island, double h, std::vector<TouchedPlant>& touched,
          Corrections& corrections) {
    const CoupledRows coupled(make_correction_rows(world, island, h), island.plants.size(), touched);
    const std::vector<ContactRow>& rows = coupled.rows();
    const std::vector<Vec3> impulses =
        correct_positions(coupled.touches(), coupled.table(), world.response_settings.limits);
    std::vector<VecX> sums(island.plants.size());  // of the impulses on each plant's nodes
    for (size_t i = 0; i < impulses.size(); i++)
        for (size_t k = 0; k < 2; k++) {
            const PlantBody* body = rows[i].plants[k];
            if (!body || impulses[i].isZero(0)) continue;
            add_impulse(*body->plant, rows[i].touches[k], k == 0 ? impulses[i] : Vec3(-impulses[i]),
                        sums[size_t(body->place)]);
        }
    for (const PlantBody* body : island.plants) {
        const VecX& sum = sums[size_t(body->place)];
        Correction& correction = corrections[size_t(body->number)] = {};
        if (sum.size() == 0) continue;
        correction.from = body->plant->state.motion.x;
        correction.way = correct_position(*body->plant, sum, h);
    }
}

}  // namespace

// Moves plants apart, by corrections that it returns.
static Corrections part_all(World& world, double h, std::vector<TouchedPlant>& touched) {
    constexpr int MOST = 3;         // corrections, each with the contacts that the last one missed
    constexpr double LEAST = 0.25;  // share of a correction below which it is none [-]
    const auto overlap = [](const PlantContact& contact) { return contact.depth > 0; };
    if (std::none_of(world.plant_contacts.begin(), world.plant_contacts.end(), overlap)) return {};
    Corrections corrections(world.taking_part.size());
    const auto take_back = [&] {
        for (PlantBody* body : world.taking_part) go_share(*body->plant, corrections[size_t(body->number)], 0);
    };
    bool by_plants = true;
    for (int round = 1;; round++) {
        const std::vector<ContactIsland> islands = find_contact_islands(world);
        run_jobs(world, islands.size(), [&](size_t i) { part(world, islands[i], h, touched, corrections); });
        const auto has_moved = [](const Correction& correction) { return correction.way.size() > 0; };
        if (std::none_of(corrections.begin(), corrections.end(), has_moved)) return {};
        const Missed missed = add_missed_contacts(world, &PlantContact::lacking_place, nullptr);
        by_plants = !missed.passed.empty();
        if (!by_plants && world.swept.empty()) return corrections;
        if (missed.asked.empty() || round == MOST) break;
        take_back();
    }
    for (bool again = true; again;) {
        again = false;
        const std::vector<PlantBody*> crossing = find_crossing_plants(world, h, by_plants);
        by_plants = true;
        for (PlantBody* body : crossing) {
            Correction& correction = corrections[size_t(body->number)];
            again |= go_share(*body->plant, correction, correction.share > LEAST ? correction.share / 2 : 0);
        }
    }
    return corrections;
}

void part_plants(World& world, double h, std::vector<TouchedPlant>& touched) {
    const Corrections corrections = part_all(world, h, touched);
    for (size_t i = 0; i < corrections.size(); i++)
        if (corrections[i].way.size() > 0 && corrections[i].share > 0)
            note_of_plant(world, *world.taking_part[i], FROND_TROUBLE_PARTED);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
