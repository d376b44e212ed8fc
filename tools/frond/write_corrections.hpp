// Corrections that change nothing: what was found in a plant file, in the form in which a person can correct it.
#pragma once

#include <string>

#include "scenes/scene.hpp"

namespace frond::tools {

// Writes MESH.frond.json beside MESH.obj ...; returns its path. Throws a SceneError if it is there already.
std::string write_corrections(frond_model model, const std::string& file);

}  // namespace frond::tools
