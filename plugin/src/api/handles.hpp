// Handles: the objects that the C API's handles stand for.
#pragma once

#include "core/slots.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct GrabEntry {
    PlantBody* body = nullptr;
    Grab* grab = nullptr;
};

using WorldSlots = Slots<std::shared_ptr<World>, 1>;
using ModelSlots = Slots<std::shared_ptr<const Model>, 2>;
using PlantSlots = Slots<PlantBody*, 3>;
using GrabSlots = Slots<GrabEntry, 4>;
using RigidSlots = Slots<Rigid*, 5>;
using BondSlots = Slots<Bond*, 6>;
WorldSlots& world_slots();
ModelSlots& model_slots();
PlantSlots& plant_slots();
GrabSlots& grab_slots();
RigidSlots& rigid_slots();
BondSlots& bond_slots();

// Returns the object that a handle stands for; BAD_HANDLE if there is none.
World& get(frond_world world);
const std::shared_ptr<const Model> get(frond_model model);
PlantBody& get(frond_plant plant);
GrabEntry get(frond_grab grab);
Rigid& get(frond_rigid rigid);
Bond& get(frond_bond bond);

// Wakes a plant that is about to be changed, after all arguments were checked: it is stepped in full again.
Plant& awaken(PlantBody& body);
// Updates capsules and box after the nodes were moved.
void show(PlantBody& body);

// Releases the handles of a plant, its grabs, bonds and fragments; the plant itself belongs to the world.
void forget(PlantBody& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
