// In: a plant's motion at the start of a step, and its loads. Out: all forces on it, damping included.
#include "core/timer.hpp"
#include "solve/drags.hpp"
#include "solve/integrator.hpp"
#include "solve/springs.hpp"

namespace frond {

void force_at_start(Workspace& w, const StepInput& input, SolveReport& report) {
    Timer timer;
    const System& system = *w.system;
    const Mechanics& body = *system.row;
    const VecX& x = input.motion.x;
    const double b = w.damping_scale;
    w.force = w.external;
    add_spring_force(input.loads.springs, x, w.force);
    for_each_fibre(input.loads, [&](const Fibre& fibre) { add_fibre_force(fibre, x, w.force); });
    add_drag_force(input.loads.drags, x, w.v_start, w.force);

    // D = a M + b K, or with each element's own b; K is the positive stiffness, as in a stage.
    if (!w.element_damping.empty()) {
        w.A.set_zero();
        w.damping.set_zero();
        report.inverted =
            body.add_force_stiffness_and_damping(*w.elements, x, w.element_damping, w.force, w.A, w.damping);
        w.damping.multiply(w.v_start, w.product);
        w.force -= w.product;
    } else if (b > 0) {
        w.A.set_zero();
        report.inverted = body.add_force_and_stiffness(*w.elements, x, Tangent::positive, w.force, w.A);
        w.A.multiply(w.v_start, w.product);
        w.force -= b * w.product;
    } else {
        report.inverted = body.add_force(*w.elements, x, w.force);
    }
    multiply_mass(system, w.inertia, w.v_start, w.momentum);
    w.force -= input.settings.mass_damping * w.momentum;
    report.ms_assembly += timer.lap();
}

}  // namespace frond
