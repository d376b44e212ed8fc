// In: velocities at the end of an implicit stage. Out: residual, potential and matrix of its equations.
#include "solve/stage_equations.hpp"

#include <cmath>

#include "solve/drags.hpp"
#include "solve/guides.hpp"
#include "solve/springs.hpp"

namespace frond {

void set_positions(const StageEquations& e, const VecX& v) {
    e.w.x = e.stage.x_base + e.stage.step * v;
}

// Computes the residual without the terms of K: step * f + impulse - M (v - v_base) - step * a M v.
static void start_residual(const StageEquations& e, const VecX& v, VecX& rhs) {
    const double step = e.stage.step;
    rhs = e.w.external + e.w.elastic;
    add_spring_force(e.input.loads.springs, e.w.x, rhs);
    for_each_fibre(e.input.loads, [&](const Fibre& fibre) { add_fibre_force(fibre, e.w.x, rhs); });
    add_drag_force(e.input.loads.drags, e.w.x, v, rhs);
    rhs *= step;
    if (e.stage.impulse) rhs += *e.stage.impulse;
    e.w.dv = e.stage.v_base - (1 + step * e.input.settings.mass_damping) * v;
    multiply_mass(e.system, e.w.inertia, e.w.dv, e.w.momentum);
    rhs += e.w.momentum;
}

double free_norm(const StageEquations& e, const VecX& rhs) {
    double sum = 0;
    for (int i = 0; i < e.system.elements->node_count; ++i)
        if (!e.w.held[size_t(i)] && guide_of(e.w, i) < 0) sum += point(rhs, i).squaredNorm();
    for (size_t g = 0; g < e.w.guides.size(); ++g) {
        const Vec3 of_node = point(rhs, e.w.guides[g].node);
        sum += (of_node - e.w.held_parts[g] * of_node).squaredNorm();
    }
    return std::sqrt(sum);
}

void follow_guides(const StageEquations& e, VecX& v) {
    for (const Guide& guide : e.w.guides) {
        const Vec3 end = point(e.stage.x_base, guide.node) + e.stage.step * point(v, guide.node);
        point(v, guide.node) += 1 / e.stage.step * (guided(guide, end) - end);
    }
}

const VecX& linearized_from(const StageEquations& e) {
    const VecX& start = e.input.motion.x;
    return &e.stage.x_from == &start || is_calm(e.system, start, e.stage.x_from) ? e.stage.x_from : start;
}

void form_damping(StageEquations& e) {
    e.at_once = false;
    if (!e.apart && !(e.rayleigh > 0)) return;
    e.keep_damping = true;
    Workspace& w = e.w;
    const VecX* at = &linearized_from(e);
    if (&e.stage.x_base == &e.input.motion.x) {
        w.x_middle = e.stage.x_base + 0.5 * e.stage.step * w.v;
        if (is_calm(e.system, e.stage.x_base, w.x_middle)) at = &w.x_middle;
    }
    w.damping.set_pattern(e.system.elements->pattern);
    w.damping.set_zero();
    if (!e.apart) {
        e.body.add_stiffness(*w.elements, *at, Tangent::positive, 1, w.damping);
        return;
    }
    w.elastic.setZero(at->size());
    w.A.set_zero();
    e.body.add_force_stiffness_and_damping(*w.elements, *at, w.element_damping, w.elastic, w.A, w.damping);
}

void linearize_at_start(StageEquations& e) {
    Workspace& w = e.w;
    const VecX& from = linearized_from(e);
    e.report.leaves_bound |= &from != &e.stage.x_from;
    w.elastic.setZero(from.size());
    w.A.set_zero();
    set_positions(e, w.v);
    w.dv = w.x - from;
    const bool is_rigid_way = e.stage.undamped && &from == &e.stage.x_from;
    if (is_rigid_way) w.v_damped = w.v - *e.stage.undamped;
    const VecX& damped = is_rigid_way ? w.v_damped : w.v;
    if (e.at_once) {
        e.report.inverted = e.body.add_ahead(
            *w.elements, from,
            {w.dv.data(), damped.data(), e.stage.step, e.apart ? 0 : e.rayleigh, w.element_damping, e.stage.base},
            w.elastic, w.A);
        return start_residual(e, w.v, w.rhs);
    }
    if (e.apart && !e.keep_damping) {
        w.damping.set_zero();
        e.report.inverted =
            e.body.add_force_stiffness_and_damping(*w.elements, from, w.element_damping, w.elastic, w.A, w.damping);
    } else {
        const Tangent tangent = e.exact ? Tangent::exact : Tangent::positive;
        e.report.inverted = e.body.add_force_and_stiffness(*w.elements, from, tangent, w.elastic, w.A);
    }
    const bool is_multiple = !e.apart && !e.keep_damping;  // the damping is a multiple of this stiffness
    if (is_multiple) w.dv += e.rayleigh * damped;
    w.A.multiply(w.dv, w.product);
    start_residual(e, w.v, w.rhs);
    w.rhs -= e.stage.step * w.product;
    if (is_multiple) return;
    w.damping.multiply(damped, w.product);
    w.rhs -= e.stage.step * e.rayleigh * w.product;
}

double residual_at(StageEquations& e, const VecX& v, VecX& rhs) {
    Workspace& w = e.w;
    e.report.work++;
    set_positions(e, v);
    w.elastic.setZero(v.size());
    e.report.inverted = e.body.add_force(*w.elements, w.x, w.elastic);
    start_residual(e, v, rhs);
    if (e.keep_damping) {
        w.damping.multiply(v, w.product);
        rhs -= e.stage.step * e.rayleigh * w.product;
    }
    look_at_guides(w, w.x);
    return free_norm(e, rhs);
}

double potential_at(const StageEquations& e, const VecX& v) {
    Workspace& w = e.w;
    const double step = e.stage.step, a = e.input.settings.mass_damping;
    e.report.work++;
    set_positions(e, v);
    double potential =
        e.body.energy(*w.elements, w.x) + spring_energy(e.input.loads.springs, w.x) - step * w.external.dot(v);
    for_each_fibre(e.input.loads, [&](const Fibre& fibre) { potential += fibre_energy(fibre, w.x); });
    w.dv = v - e.stage.v_base;
    multiply_mass(e.system, w.inertia, w.dv, w.momentum);
    potential += 0.5 * w.dv.dot(w.momentum);
    multiply_mass(e.system, w.inertia, v, w.momentum);
    potential += 0.5 * step * a * v.dot(w.momentum);
    potential += step * drag_potential(e.input.loads.drags, w.x, v);
    if (e.stage.impulse) potential -= e.stage.impulse->dot(v);
    if (e.keep_damping) {
        w.damping.multiply(v, w.product);
        potential += 0.5 * step * e.rayleigh * v.dot(w.product);
    }
    return potential;
}

static void add_mass(const Masses& masses, double scale, BlockMatrix& A) {
    const auto add = [&](int slot) { A.block(slot).diagonal().array() += scale * masses.slot[size_t(slot)]; };
    const BlockPattern& pattern = *A.pattern;
    if (masses.lumped)
        for (int i = 0; i < pattern.node_count; ++i) add(pattern.start[size_t(i)]);
    else
        for (int k = 0; k < pattern.block_count(); ++k) add(k);
}

void add_inertia(Workspace& w, double scale) {
    for (size_t i = 0; i < w.inertia.size(); ++i)
        if (!w.held[2 * i + 1]) w.A.block(w.A.pattern->start[2 * i + 1]) += scale * w.inertia[i];
}

void form_matrix(StageEquations& e, bool first, Tangent tangent) {
    BlockMatrix& A = e.w.A;
    const double step = e.stage.step, mass = 1 + step * e.input.settings.mass_damping;
    const bool alike = first && !e.apart && !e.keep_damping;
    const double scale = step * step + (alike ? step * e.rayleigh : 0);
    if (!e.at_once)
        for (double& value : A.values) value *= scale;
    if (!e.at_once && !alike && (e.apart || e.keep_damping))
        for (size_t k = 0; k < A.values.size(); ++k) A.values[k] += step * e.rayleigh * e.w.damping.values[k];
    add_mass(e.system.masses, mass, A);
    add_inertia(e.w, mass);
    add_spring_stiffness(e.input.loads.springs, e.w.x, tangent, step * step, A);
    for_each_fibre(e.input.loads, [&](const Fibre& fibre) { add_fibre_stiffness(fibre, e.w.x, step * step, A); });
    add_drag_damping(e.input.loads.drags, e.w.x, step, A);
}

void hold(StageEquations& e) {
    Workspace& w = e.w;
    const BlockPattern& pattern = *w.A.pattern;
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)];
            if (!w.held[size_t(i)] && !w.held[size_t(j)]) continue;
            auto block = w.A.block(k);
            block.setZero();
            if (i == j) block.setIdentity();
        }
    for (int i = 0; i < pattern.node_count; ++i)
        if (w.held[size_t(i)]) point(w.rhs, i).setZero();
    look_at_guides(w, w.x);
    hold_parts(w);
    keep_free_parts(w, w.rhs);
}

}  // namespace frond
