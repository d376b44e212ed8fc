// Supports: chain nodes that the host holds otherwise than pins and the ground do.
#pragma once

#include <vector>

#include "solve/solve.hpp"

namespace frond {

struct Plant;

// Places and turns are of the model's frame.
struct Support {
    int chain_node;
    bool holds_place;
    frond_held_turns held_turns;
    Vec3 axis;   // of length one; only turns that are held in part have one
    Vec3 place;  // where it holds the node [m]
    Vec3 turn;   // rotation vector of the node as it was when it was supported
};

// Those of a plant, and what follows from them.
struct Supports {
    std::vector<Support> list;
    std::vector<Guide> guides;
};

const std::vector<Support>& supports_of(const Plant& plant);
const std::vector<Guide>& guides_of(const Plant& plant);
// Replaces all supports by others, from the next apply_pins() on.
void give_supports(Plant& plant, std::vector<Support> supports);
// Returns the support of a chain node; null if it has none.
const Support* support_of(const Plant& plant, int chain_node);
// Supports a chain node as it is now, in place of what else would hold it; or leaves it to pins and the ground, from
// where it is now. `axis` is in the model's frame.
void set_support(Plant& plant, int chain_node, bool holds_place, frond_held_turns held_turns, const Vec3& axis);
void remove_support(Plant& plant, int chain_node);
// Holds the supported nodes of a motion of the chain.
void hold_supported(const std::vector<Support>& supports, Motion& motion);
// Returns whether supports hold the plant at one of several places. What a solve gave is then no step that keeps each
// segment's strain: rebuilt from one held node on, it misses the other, and the last segment takes all of that.
bool hold_several_places(const Plant& plant);
// Returns whether one solve a step is too few for how supports hold the plant: at several places, or in forks, whose
// axes turn with what they hold, so that by implicit Euler, with the forces of the step's start, it gains energy.
bool need_several_solves(const Plant& plant);
// Lets supports hold their nodes where these have been put.
void carry_supports(Plant& plant);
// Drops the supports of what has come off.
void drop_lost_supports(Plant& plant);

}  // namespace frond
