// Builds a plant from a URDF file; declares stages shared with other builds.
#pragma once

#include <memory>

#include "core/timer.hpp"
#include "io/import.hpp"
#include "io/urdf.hpp"
#include "model/model.hpp"

namespace frond {

// Links of cylinders and capsules alone become stems of exactly their radius. With other shapes a surface is made of
// all links, and chain and sections are measured on it, with the links' parts joined at their joints.
std::shared_ptr<const Model> build_from_urdf(const std::string& path, const frond_model_def& def);

ImportOptions import_options(const frond_model_def& def);
// Returns how place_surface() moved a surface.
StemPlacement placement_of(const Surface& before, const Surface& after);
// Finds chain and sections of a model that has its surface and organs.
void find_chain(Model& model, const frond_model_def& def, const std::vector<int>& rooted = {});
// Makes cage, masses and moduli of a model that has its chain too.
void build_body(Model& model, const frond_model_def& def);
// Notes how long it took since the build began, and refuses a model of which no plant can be made.
std::shared_ptr<const Model> finished(std::shared_ptr<Model> model, const Timer& total);

}  // namespace frond
