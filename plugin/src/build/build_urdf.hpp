// Build of a plant from a URDF file, and the stages that it shares with other builds.
#pragma once

#include <memory>

#include "model/import.hpp"
#include "model/model.hpp"
#include "model/urdf.hpp"

namespace frond {

// Links of cylinders and capsules alone become stems of just that radius; with other shapes a surface is made of all,
// and what holds it is measured on that, pieces of links being joined at the links' joints.
std::shared_ptr<const Model> build_from_urdf(const std::string& path, const frond_model_def& def);

ImportOptions import_options(const frond_model_def& def);
// How place_surface() moved a surface that was made as it stands.
StemPlacement placement_of(const Surface& before, const Surface& after);
// The model has its surface and organs already.
void find_chain(Model& model, const frond_model_def& def);
// Cage, weight and moduli, of one whose chain stands too.
void build_body(Model& model, const frond_model_def& def);

}  // namespace frond
