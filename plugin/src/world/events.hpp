// Events: what happened to plants since the host last took the events.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <deque>
#include <vector>

#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct World;
struct PlantBody;

struct Events {
    // A plant and what touches it. A body may be gone: only its address is compared.
    struct Touching {
        const PlantBody* plant;
        const btCollisionObject* other;
        const PlantBody* other_plant;  // null: a body
        bool operator<(const Touching& b) const {
            return plant != b.plant ? std::less<>()(plant, b.plant) : std::less<>()(other, b.other);
        }
    };
    bool are_kept = false;  // the host has requested them
    std::deque<frond_event_info> list;
    std::vector<Touching> touching;  // pairs in the last substep, sorted; pairs of sleepers stay
};

void add_event(World& world, frond_event event, const PlantBody& body, int capsule = -1);
// Adds the events of touches that began in the last substep.
void note_touching(World& world);
// Removes the events and touches of a plant that leaves the world.
void forget_events(World& world, const PlantBody& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
