// Setups: their names, and in what they differ.
#include <cmath>
#include <cstring>
#include <sstream>

#include "study/study.hpp"

namespace frond::study {

bool moves_chain(frond_mechanics mechanics) {
    return std::strncmp(frond_mechanics_name(mechanics), "tet_", 4) != 0;
}

static std::string number(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

std::string time_step_text(double dt) {
    const double rate = 1 / dt;
    if (std::abs(rate - std::round(rate)) < 1e-6 * rate && rate > 1.5) return "1/" + number(std::round(rate)) + " s";
    return number(dt) + " s";
}

std::string resolution_text(const Setup& setup) {
    const std::string count = number(setup.resolution);
    if (setup.body == Body::MESH) return count + (setup.resolution == 1 ? " cell" : " cells") + " across";
    return count + (moves_chain(setup.plant.mechanics) ? " capsules" : " cells") + " along";
}

static const char* body_name(Body body) {
    return body == Body::MESH ? "own mesh" : body == Body::STEM ? "stem" : "plant";
}

std::string difference(const Setup& setup, const Setup& baseline) {
    const frond_plant_def &a = setup.plant, &b = baseline.plant;
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (a.mechanics != b.mechanics) add(frond_mechanics_name(a.mechanics));
    if (a.element_order != b.element_order) add(a.element_order == 2 ? "T10" : "T4");
    if (setup.body != baseline.body) add(body_name(setup.body));
    if (setup.body != baseline.body || setup.resolution != baseline.resolution) add(resolution_text(setup));
    if (setup.dt != baseline.dt) add(time_step_text(setup.dt));
    if (a.integrator != b.integrator) add(frond_integrator_name(a.integrator));
    if (a.newton_iterations != b.newton_iterations) add("at most " + number(a.newton_iterations) + " solves a stage");
    if (a.newton_tolerance != b.newton_tolerance) add("Newton tolerance " + number(a.newton_tolerance));
    if (a.max_substeps != b.max_substeps) add("at most " + number(a.max_substeps) + " substeps");
    if (a.substep_tolerance != b.substep_tolerance) add("substep tolerance " + number(a.substep_tolerance));
    if (a.linear_solver != b.linear_solver) add(frond_linear_solver_name(a.linear_solver));
    if (a.tolerance != b.tolerance) add("linear tolerance " + number(a.tolerance));
    if (a.mass != b.mass) add(std::string(frond_mass_name(a.mass)) + " mass");
    return text.empty() ? "baseline" : text;
}

std::string key_of(const Setup& setup) {
    std::ostringstream out;
    const frond_plant_def& p = setup.plant;
    out.precision(17);
    out << int(setup.body) << ' ' << setup.resolution << ' ' << setup.dt << ' ' << p.mechanics << ' ' << p.element_order
        << ' ' << p.integrator << ' ' << p.linear_solver << ' ' << p.mass << ' ' << p.newton_iterations << ' '
        << p.newton_tolerance << ' ' << p.max_substeps << ' ' << p.substep_tolerance << ' ' << p.max_iterations << ' '
        << p.tolerance << ' ' << p.mass_damping << ' ' << p.stiffness_damping << ' ' << p.material_damping << ' '
        << p.spectral_radius << ' ' << p.root_height << ' ' << p.effects;
    return out.str();
}

}  // namespace frond::study
