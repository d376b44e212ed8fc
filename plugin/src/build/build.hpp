// Build: the stages from a file to a model, in their order.
#pragma once

#include <memory>

#include "model/import.hpp"
#include "model/model.hpp"

namespace frond {

std::shared_ptr<const Model> build_from_file(const std::string& path, const frond_model_def& def);
std::shared_ptr<const Model> build_from_surface(Surface surface, const frond_model_def& def);
std::shared_ptr<const Model> build_from_stems(const frond_stem* stems, int stem_count, const frond_model_def& def);
std::shared_ptr<const Model> build_from_tets(TetMesh mesh, const frond_model_def& def);

// Makes organs stiffer that could not carry the plant in the shape in which it was modelled: sets organ_stiffer.
// Returns the one that needed most.
struct WeakOrgan {
    std::string name;   // empty: there is none
    double factor = 1;  // how much stiffer it was made [-]
};
WeakOrgan strengthen(Model& model);

// Set tet_young and tet_poisson of a model whose organs, cage and root stand: as the materials are, for tets that the
// caller brought; or so that a cage of Frond's own, in elements of an order, bends as its organs do.
void take_materials(Model& model);
void calibrate(Model& model, int order);

// Finds the shape without gravity from which weight bends the cage to the shape that was modelled, for the default
// mechanics; where the cage would topple, after making organs stiffer in it, which returns the weakest.
WeakOrgan find_rest_shape(Model& model, int order);
// For other mechanics, and with order 2 the moduli too, when a plant first asks for it; safe from any thread.
void ensure_rest_shape(const Model& model, frond_mechanics which, int order);

}  // namespace frond
