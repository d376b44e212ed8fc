// Build: the stages from a file to a model, in their order.
#pragma once

#include <memory>

#include "model/import.hpp"
#include "model/model.hpp"

namespace frond {

std::shared_ptr<const Model> build_from_file(const std::string& path, const frond_model_def& def);
std::shared_ptr<const Model> build_from_surface(Surface surface, const frond_model_def& def);
std::shared_ptr<const Model> build_from_tets(TetMesh mesh, const frond_model_def& def);

// Set tet_density, tet_young and tet_poisson of a model whose organs, cage and root stand: as the materials are, for
// tets that the caller brought; or so that a cage of Frond's own bends as its organs do (which needs the chain too).
// With `must_stand`, organs that could not carry their weight are made stiffer; the weakest of any weight is returned.
struct WeakOrgan {
    std::string name;   // empty: there is none
    double factor = 1;  // how much stiffer it was made [-]
};
void take_materials(Model& model);
WeakOrgan calibrate(Model& model, bool must_stand);
// Sets rest_positions so that the plant stands under gravity as it was modelled; where it would topple, after making
// those organs stiffer that give way: returns the weakest.
WeakOrgan find_rest_shapes(Model& model);

}  // namespace frond
