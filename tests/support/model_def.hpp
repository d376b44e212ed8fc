// Defs for builds and plants that bypass the checks of the C API: metres, y up, default cages; one solve per step, no
// damping but the materials', which must be requested.
#pragma once

#include <cmath>

#include "modelling/build.hpp"

namespace frond::test {

inline frond_model_def model_def() {
    frond_model_def def = {};
    def.cage_smoothness = CageOptions().smoothness;
    def.allow_stiffening = INFINITY;
    def.scale = 1;
    def.up = {0, 1, 0};
    return def;
}

inline frond_plant_def plant_def(frond_mechanics which, int order = 1) {
    frond_plant_def def = {};
    def.rotation = {0, 0, 0, 1};
    def.mechanics = which;
    def.element_order = order;
    def.integrator = FROND_INTEGRATOR_BDF2;
    def.tuning.newton_iterations = 1;
    def.tuning.newton_tolerance = 1e-8;
    def.tuning.linear_iterations = 1000;
    def.tuning.linear_tolerance = 1e-6;
    def.tuning.spectral_radius = 0.8;
    def.effects = FROND_EFFECT_ALL;
    return def;
}

}  // namespace frond::test
