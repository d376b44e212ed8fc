// Setups: their names and differences.
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
    if (a.tuning.newton_iterations != b.tuning.newton_iterations)
        add("at most " + number(a.tuning.newton_iterations) + " solves a stage");
    if (a.tuning.newton_tolerance != b.tuning.newton_tolerance)
        add("Newton tolerance " + number(a.tuning.newton_tolerance));
    if (a.tuning.max_substeps != b.tuning.max_substeps) add("at most " + number(a.tuning.max_substeps) + " substeps");
    if (a.tuning.substep_tolerance != b.tuning.substep_tolerance)
        add("substep tolerance " + number(a.tuning.substep_tolerance));
    if (a.tuning.linear_solver != b.tuning.linear_solver) add(frond_linear_solver_name(a.tuning.linear_solver));
    if (a.tuning.linear_tolerance != b.tuning.linear_tolerance)
        add("linear tolerance " + number(a.tuning.linear_tolerance));
    if (a.tuning.mass != b.tuning.mass) add(std::string(frond_mass_name(a.tuning.mass)) + " mass");
    return text.empty() ? "baseline" : text;
}

std::string key_of(const Setup& setup) {
    std::ostringstream out;
    const frond_plant_def& p = setup.plant;
    out.precision(17);
    out << int(setup.body) << ' ' << setup.resolution << ' ' << setup.dt << ' ' << p.mechanics << ' ' << p.element_order
        << ' ' << p.integrator << ' ' << p.tuning.linear_solver << ' ' << p.tuning.mass << ' '
        << p.tuning.newton_iterations << ' ' << p.tuning.newton_tolerance << ' ' << p.tuning.max_substeps << ' '
        << p.tuning.substep_tolerance << ' ' << p.tuning.linear_iterations << ' ' << p.tuning.linear_tolerance << ' '
        << p.mass_damping << ' ' << p.stiffness_damping << ' ' << p.material_damping << ' ' << p.tuning.spectral_radius
        << ' ' << p.root_height << ' ' << p.effects;
    return out.str();
}

}  // namespace frond::study
