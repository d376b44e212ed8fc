// Settings of a plant, as its def names them and as it keeps them.
#pragma once

namespace frond {

// Visits the settings of a plant's def together with where the plant keeps them.
template <class Def, class Input, class Visit>
void each_setting(Def& def, Input& input, Visit&& visit) {
    auto& solve = input.settings;
    visit(def.integrator, solve.integrator);
    visit(def.mass_damping, solve.mass_damping);
    visit(def.stiffness_damping, solve.stiffness_damping);
    visit(def.material_damping, input.material_damping);
    visit(def.tuning.linear_solver, solve.linear_solver);
    visit(def.tuning.linear_iterations, solve.max_iterations);
    visit(def.tuning.linear_tolerance, solve.tolerance);
    visit(def.tuning.mass, input.mass);
    visit(def.tuning.newton_iterations, solve.newton_iterations);
    visit(def.tuning.newton_tolerance, solve.newton_tolerance);
    visit(def.tuning.spectral_radius, solve.spectral_radius);
    visit(def.tuning.max_substeps, input.max_substeps);
    visit(def.tuning.substep_tolerance, input.substep_tolerance);
}

}  // namespace frond
