// Build: the stages from a file to a model, in their order.
#pragma once

#include <memory>

#include "io/import.hpp"
#include "model/model.hpp"

namespace frond {

std::shared_ptr<const Model> build_from_file(const std::string& path, const frond_model_def& def);
std::shared_ptr<const Model> build_from_surface(Surface surface, const frond_model_def& def);
std::shared_ptr<const Model> build_from_stems(const frond_stem* stems, int stem_count, const frond_model_def& def,
                                               const frond_stem_section* sections = nullptr);
std::shared_ptr<const Model> build_from_tets(TetMesh mesh, const frond_model_def& def);

}  // namespace frond
