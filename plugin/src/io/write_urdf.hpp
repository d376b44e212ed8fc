// Writes a model's chain as URDF.
#pragma once

#include <string>

#include "model/model.hpp"

namespace frond {

// See frond_model_write_urdf().
std::string urdf_of(const Model& model, const std::string& name);

}  // namespace frond
