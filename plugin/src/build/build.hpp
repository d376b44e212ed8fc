// Build: the stages from a file to a model, in their order.
#pragma once

#include <memory>

#include "model/import.hpp"
#include "model/model.hpp"

namespace frond {

std::shared_ptr<const Model> build_from_file(const std::string& path, const frond_model_def& def);
std::shared_ptr<const Model> build_from_surface(Surface surface, const frond_model_def& def);
std::shared_ptr<const Model> build_from_tets(TetMesh mesh, const frond_model_def& def);

// Sets tet_density, tet_young and tet_poisson of a model whose chain, organs and cage stand.
void calibrate(Model& model);

}  // namespace frond
