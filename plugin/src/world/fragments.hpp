// Parts of plants that came off, as rigid bodies of the Bullet world.
#pragma once

#include "world/rigid.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Takes off what is beyond a capsule, by the chain node at its end, and makes a rigid body of it.
void break_off(World& world, PlantBody& body, int chain_node);
// The same where a capsule is strained beyond its strength, one a substep. Returns how many came off.
int break_overloaded(World& world, PlantBody& body);
// The plant's fragments are where their bodies are.
void carry_fragments(PlantBody& body);
// The user's springs on what came off.
void pull_fragments(PlantBody& body, double h);
// Tells whether a capsule and a body do not push each other: one is a fragment of the plant that came off.
bool is_apart(const PlantBody& body, int capsule, const btCollisionObject& other);
// Their bodies end.
void remove_fragments(World& world, PlantBody& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
