// A model's rods in capsules of other lengths, to tell what its own lengths cost in accuracy.
#pragma once

#include <memory>

#include "model/model.hpp"

namespace frond {

// Returns whether the chain is the same plant in capsules of any length: it is made of stems. That of a surface is
// measured anew for each length, and another plant each time.
bool can_be_cut_anew(const Model& model);

// Makes the chain, its sections, masses and stiffer organs as building the model with this capsule_height [m] would;
// the cage is left as it is, without the chain in it. Needs can_be_cut_anew(). Throws as building does.
std::shared_ptr<const Model> with_capsules(const Model& model, double height);

// Cuts each capsule into equal parts that are the same beam: sizes go on linearly as its section's taper says, the mass
// that rods share between its ends is spread along it, and what else the nodes carry stays with them. Returns a model
// that has no more than rods need; nodes of the model keep their order, and the last one of a capsule's parts is its
// end.
std::shared_ptr<const Model> with_cut_capsules(const Model& model, int parts);

}  // namespace frond
