// Calibration: moduli and rest shape by which a plant stands as modelled and bends as its organs do.
#pragma once

#include "model/model.hpp"

namespace frond {

// Makes organs stiffer that could not carry the plant in its modelled shape: sets organ_stiffer. Returns the one that
// needed most.
struct WeakOrgan {
    std::string name;   // empty: none
    std::string kind;   // "blade" ...
    double factor = 1;  // factor by which it was made stiffer [-]
};
WeakOrgan strengthen(Model& model);

// Set tet_young and tet_poisson of a model that has organs, cage and root: from the materials, for tets that the caller
// brought; or so that a cage of Frond's own, in elements of an order, bends as its organs do.
void take_materials(Model& model);
void calibrate(Model& model, int order);

// Finds the shape without gravity from which weight bends the cage to the modelled shape, for the default mechanics. If
// the cage would topple, makes organs stiffer in it first. Returns the weakest.
WeakOrgan find_rest_shape(Model& model, int order);
// Does the same for other mechanics, and with order 2 for the moduli too, when a plant first needs it; safe from any
// thread.
void ensure_rest_shape(const Model& model, frond_mechanics which, int order);

}  // namespace frond
