// In: impulses, and plants whose step is solved. Out: the plants' steps with these, and impulses that both sides take.
#include "contact/push_plants.hpp"

#include <algorithm>

#include "plant/plant_step.hpp"
#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

Waiting find_waiting(const World& world) {
    Waiting waiting;
    waiting.touched.resize(world.taking_part.size());
    waiting.of.resize(world.taking_part.size());
    for (PlantBody* body : world.awake)
        if (waits(*body->plant) && body->level.is_due && !body->plant->state.modal) {
            waiting.of[size_t(body->number)] = waiting.bodies.size();
            waiting.bodies.push_back(body);
            waiting.steps.push_back(free_step(*body->plant));
        }
    return waiting;
}

void take_back(Waiting& waiting, PlantBody& body) {
    if (!body.plant->follow && body.plant->trouble & FROND_TROUBLE_RETRIED) waiting.touched[size_t(body.number)] = {};
    take_back(*body.plant, waiting.steps[waiting.of[size_t(body.number)]]);
}

namespace {

// Returns whether a row's other side is a rigid body that never moves, which can give no energy.
bool stands_still(const ContactRow& row) {
    return !row.plants[1] && !row.touch.is_bond && btRigidBody::upcast(row.contact_body.object) &&
           row.contact_body.object->isStaticObject();
}

// Gathers the rows' impulses on the plants that `on` names by their places in the island.
void gather_pushes(const std::vector<ContactRow>& rows, const std::vector<Vec3>& impulses,
                   const std::vector<uint8_t>& on) {
    for (size_t i = 0; i < rows.size(); i++) {
        const ContactRow& row = rows[i];
        const Vec3& impulse = impulses[i];
        for (size_t k = 0; k < 2; k++) {
            if (impulse.isZero(0) || !row.plants[k] || !on[size_t(row.plants[k]->place)]) continue;
            Plant& plant = *row.plants[k]->plant;
            add_impulse(plant, row.touches[k], k == 0 ? impulse : Vec3(-impulse), push_of(plant).impulse);
            if (stands_still(row)) push_of(plant).asked_work += asked_work(row, impulse);
        }
    }
}

// Shortens impulses to what both of their sides take, as a plant that turns away from what pushes it takes a share of
// its push alone: no energy comes from between two plants. Plants that are pushed less may turn away in their turn; in
// the end nothing pushes them.
void level_pushes(const ContactIsland& island, const std::vector<ContactRow>& rows, std::vector<Vec3>& impulses,
                  Waiting& waiting) {
    constexpr int MOST = 4;  // rounds of shares
    const auto share_of = [](const PlantBody* body) {
        return body && is_pushed(*body->plant) ? body->plant->step.push->share : 1;
    };
    for (int round = 0;; round++) {
        std::vector<uint8_t> again(island.plants.size(), 0);
        bool any = false;
        for (size_t i = 0; i < rows.size(); i++) {
            const auto& plants = rows[i].plants;
            double share = std::min(share_of(plants[0]), share_of(plants[1]));
            if (share == 1 || impulses[i].isZero(0)) continue;
            any = true;
            if (round >= MOST) share = 0;
            for (const PlantBody* body : plants)
                if (body && share_of(body) > share) again[size_t(body->place)] = 1;
            impulses[i] *= share;
        }
        if (!any) return;
        for (PlantBody* body : island.plants) {
            if (again[size_t(body->place)]) {
                take_back(waiting, *body);
                body->plant->step.takes = 1;
            } else if (share_of(body) < 1) {
                body->plant->step.push->impulse *= body->plant->step.push->share;
                body->plant->step.push->share = 1;
            }
        }
        gather_pushes(rows, impulses, again);
        for (PlantBody* body : island.plants)
            if (again[size_t(body->place)]) add_contacts(*body->plant, body->level.pending);
    }
}

}  // namespace

void push_plants(const ContactIsland& island, const std::vector<ContactRow>& rows, std::vector<Vec3>& impulses,
                 Waiting& waiting) {
    gather_pushes(rows, impulses, std::vector<uint8_t>(island.plants.size(), 1));
    for (PlantBody* body : island.plants) add_contacts(*body->plant, body->level.pending);
    level_pushes(island, rows, impulses, waiting);
    if (!rows.empty()) return;
    // A step that was not looked at before may have been solved again.
    for (const PlantBody* body : island.plants) {
        FreeStep& free = waiting.steps[waiting.of[size_t(body->number)]];
        if (body->plant->trouble & ~free.trouble & FROND_TROUBLE_RETRIED) free = free_step(*body->plant);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
