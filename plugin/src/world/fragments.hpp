// Fragments of plants, as rigid bodies of the Bullet world.
#pragma once

#include "plant/plant.hpp"
#include "world/rigid.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Breaks off a capsule, given by the chain node at its end, with all beyond it, and makes a rigid body of them.
void break_off(World& world, PlantBody& body, int chain_node);
// Breaks off a capsule that is strained beyond its strength, one per substep. Returns how many came off.
int break_overloaded(World& world, PlantBody& body);
// Returns whether a capsule has come off with a fragment.
inline bool has_come_off(const Plant& plant, int capsule) {
    return !plant.state.fragments.empty() &&
           fragment_of_chain_node(plant, size_t(plant.model->capsules[size_t(capsule)][1]));
}
// Moves the plant's fragments to where their bodies are.
void carry_fragments(PlantBody& body);
// Applies the user's grabs on fragments.
void pull_fragments(PlantBody& body, double h);
// Returns whether a capsule and a body do not collide: the capsule came off, or the body did and has not yet left the
// plant.
bool is_apart(const PlantBody& body, int capsule, const btCollisionObject& other);
// Removes the bodies of a plant's fragments, from `first` on.
void remove_fragments(World& world, PlantBody& body, size_t first = 0);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
