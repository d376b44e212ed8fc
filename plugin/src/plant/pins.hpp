// Pins: cage nodes that the host holds where it puts them.
#pragma once

#include "plant/plant.hpp"

namespace frond {

// Hold a cage node where it is, release it, or move its target (model frame).
bool is_pinned(const Plant& plant, int node);
void pin_node(Plant& plant, int node);
void unpin_node(Plant& plant, int node);
void move_pin(Plant& plant, int node, const Vec3& target);
// Transfers the pins to the nodes of the mechanics.
void apply_pins(Plant& plant);
// Moves pins to where their cage nodes are rigid with the chain node that is to hold them from now on.
void put_pins_at_node(Plant& plant, int chain_node);
// Moves pinned cage nodes that a chain holds by one of its nodes to where they are rigid with that.
void place_pinned_as_held(const Plant& plant, VecX& places);
// Lets the springs of pins that were put far away pull only part of that way in the coming step. Returns whether there
// are such.
bool lead_pin_springs(Plant& plant);
// Returns whether the held nodes of a chain are at their targets.
bool is_where_held(const Motion& motion);
// Returns whether held nodes are on their way from x to their targets, or have moved before: v is not zero. A foot that
// starts or stops tears at a plant, however short the way.
bool is_carried(const Motion& motion, const VecX& x, const VecX& v);
// Returns how far the farthest of the pinned nodes is from where it is to be [m]; the second only if pins were changed
// since the last step, else 0.
double miss_of_pins(const Plant& plant);
double way_of_pins(const Plant& plant);
constexpr double PINS_STAND = 1e-4;  // way of pins over the plant's size up to which they count as still [-]

}  // namespace frond
