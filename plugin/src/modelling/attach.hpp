// Attach: ties the parts of a model to each other, once its surface, chain and cage are complete.
#pragma once

#include "model/model.hpp"

namespace frond {

// Finds the cage nodes of the tets that hold the foot of the chain's roots: a drooping leaf that touches the ground
// stays free.
std::vector<uint8_t> find_root_nodes(const Model& model);
// Fills capsules, organ_parents, chain_view and chain_embedding of a model whose surface, chain and cage are complete.
void bind_chain(Model& model);
// Fills capsules, organ_parents and chain_view.
void list_chain(Model& model);

}  // namespace frond
