// In: the motions of several plants, one a lane. Out: their motions after a step of bdf2 with one solve, or of implicit
// Euler where bdf2 starts anew: for each the operations of step_bdf2() and solve_stage(), in the same order.
#include "batch/batch_step.hpp"

#include <algorithm>

#include "batch/form_system.hpp"
#include "solve/integrator.hpp"
#include "solve/workspace.hpp"

namespace frond {

namespace {

// Sets the base of a bdf2 step from the history, and the predicted positions.
struct LookBack {
    Batch& a;
    const std::vector<uint8_t>& pinned;
    double h, h_before;
    Bdf2 method;
    template <class S>
    FROND_INLINE void run() const {
        for (int i = 0; i < a.system->elements->node_count; ++i) {
            const int at = 3 * i;
            const Lanes3<S> x = load3<S>(a.x.data(), at);
            Lanes3<S> v = pinned[size_t(i)] ? Lanes3<S>{} : load3<S>(a.v.data(), at);
            const Lanes3<S> x_prev = load3<S>(a.x_prev.data(), at), v_prev = load3<S>(a.v_prev.data(), at);
            const Lanes3<S> x_from = x + constant<S>(h) * v, x_base = x + constant<S>(method.back) * (x - x_prev),
                            v_base = v + constant<S>(method.back) * (v - v_prev);
            if (a.held[size_t(i)]) v = constant<S>(1 / method.step) * (x_from - x_base);
            begin(at, v, x_from, x_base, v_base);
        }
    }
    template <class S>
    FROND_INLINE void begin(int at, const Lanes3<S>& v, const Lanes3<S>& x_from, const Lanes3<S>& x_base,
                            const Lanes3<S>& v_base) const {
        const Lanes3<S> end = x_base + constant<S>(method.step) * v;
        store3(v, a.v_start.data(), at);
        store3(x_from, a.x_from.data(), at);
        store3(x_base, a.x_base.data(), at);
        store3(v_base, a.v_base.data(), at);
        store3(end - x_from, a.way.data(), at);
    }
};

// The same for implicit Euler, without history.
struct BeginAnew {
    LookBack step;
    bool is_ahead;  // forces are taken where velocities lead
    template <class S>
    FROND_INLINE void run() const {
        const Batch& a = step.a;
        for (int i = 0; i < a.system->elements->node_count; ++i) {
            const Lanes3<S> x = load3<S>(a.x.data(), 3 * i),
                            v = step.pinned[size_t(i)] ? Lanes3<S>{} : load3<S>(a.v.data(), 3 * i);
            step.begin(3 * i, v, is_ahead ? x + constant<S>(step.h) * v : x, x, v);
        }
    }
};

// Where the solve leads.
struct Move {
    Batch& a;
    double step;
    template <class S>
    FROND_INLINE void run() const {
        for (int i = 0; i < a.system->elements->node_count; ++i) {
            const Lanes3<S> v = load3<S>(a.v_start.data(), 3 * i) + load3<S>(a.dv.data(), 3 * i);
            store3(v, a.v_end.data(), 3 * i);
            store3(load3<S>(a.x_base.data(), 3 * i) + constant<S>(step) * v, a.x_end.data(), 3 * i);
        }
    }
};

// As retract() in newton.cpp.
struct TakeRetracted {
    Batch& a;
    double step;
    template <class S>
    FROND_INLINE void run() const {
        for (int i = 0; i < a.system->elements->node_count; ++i) {
            const Lanes3<S> by = load3<S>(a.retracted.data(), 3 * i) - load3<S>(a.x_end.data(), 3 * i);
            const Lanes3<S> v = load3<S>(a.v_end.data(), 3 * i) + constant<S>(1 / step) * by;
            store3(v, a.v_end.data(), 3 * i);
            store3(load3<S>(a.x_base.data(), 3 * i) + constant<S>(step) * v, a.x_end.data(), 3 * i);
        }
    }
};

// Puts pinned nodes where they are held; lanes with a number that is not finite are lost.
struct Finish {
    Batch& a;
    const std::vector<uint8_t>& pinned;
    bool turns;  // every other node is a rotation
    unsigned& lost;
    template <class S>
    FROND_INLINE void run() const {
        S sound = constant<S>(1), within = sound;
        for (int i = 0; i < a.system->elements->node_count; ++i) {
            if (pinned[size_t(i)]) {
                store3(load3<S>(a.x.data(), 3 * i), a.x_end.data(), 3 * i);
                store3(load3<S>(a.v_start.data(), 3 * i), a.v_end.data(), 3 * i);
            }
            const Lanes3<S> x = load3<S>(a.x_end.data(), 3 * i), v = load3<S>(a.v_end.data(), 3 * i);
            const S far = dot(x, x);
            sound = select(far + dot(v, v) <= 1e300, sound, S{});
            if (turns && i % 2) within = select(far <= PI * PI * NEARLY, within, S{});
        }
        lost |= bits_of(sound == 0.0);
        a.wound = bits_of(within == 0.0);
    }
};

}  // namespace

bool may_be_batched(const System& system, const SolveSettings& settings, double h) {
    return system.row->batch && system.masses.lumped && settings.integrator == FROND_INTEGRATOR_BDF2 &&
           settings.linear_solver == FROND_LINEAR_SOLVER_BLOCK && settings.newton_iterations == 1 &&
           !settings.careful && !is_long_stage(system, h) && settings_are_sound(settings);
}

VecX linearized_end(const Batch& a, int lane) {
    VecX base, v;
    take_lane(a.x_base, a.lanes, lane, base);
    take_lane(a.v_start, a.lanes, lane, v);
    return base + a.reach * v;
}

int lanes_for(int count) {
    return count > 4 ? most_lanes() : std::min(most_lanes(), 4);
}

void make_room(Batch& a, std::shared_ptr<const System> system, int lanes) {
    if (a.system == system && a.lanes == lanes) return;
    a.lanes = lanes;
    a.system = std::move(system);
    const BlockPattern& pattern = a.system->elements->pattern;
    const size_t n = 3 * size_t(lanes) * size_t(pattern.node_count);
    for (NumbersInLines* numbers : {&a.x, &a.v, &a.x_prev, &a.v_prev, &a.x_end, &a.v_end, &a.v_start, &a.x_from,
                                    &a.x_base, &a.v_base, &a.way, &a.elastic, &a.rhs, &a.dv})
        make_room(*numbers, n);
    make_room(a.gravity, 3 * size_t(lanes));
    const size_t nodes = size_t(pattern.node_count),
                 drags = a.system->row->moves_chain ? nodes / 2 : a.system->chain.size();
    make_room(a.drag_force, 3 * drags * size_t(lanes));
    make_room(a.drag_damping, 6 * drags * size_t(lanes));
    a.A.pattern = &pattern;
    a.factor.plan = &a.system->plan;
    make_room(a.A.values, 9 * size_t(lanes) * pattern.row.size());
}

unsigned step_batch(Batch& a, const SolveSettings& settings, const std::vector<uint8_t>& pinned, double h,
                    double h_before) {
    const System& system = *a.system;
    const Elements& elements = *system.elements;
    const bool looks_back = h_before > 0;
    const Bdf2 method = looks_back ? bdf2_after(h_before, h) : Bdf2{0, h};
    a.reach = method.step;
    a.held = system.loose;
    for (size_t i = 0; i < pinned.size(); ++i) a.held[i] |= pinned[i];
    const LookBack look_back = {a, pinned, h, h_before, method};
    const bool is_ahead = looks_back || takes_forces_ahead(system, settings);
    if (looks_back)
        run_in_lanes(a.lanes, look_back);
    else
        run_in_lanes(a.lanes, BeginAnew{look_back, is_ahead});
    unsigned lost = is_ahead ? system.row->batch->not_calm(elements, a.x, a.x_from, 1) : 0;

    const bool turns = system.row->batch->rotary_inertia != nullptr;
    if (turns) system.row->batch->rotary_inertia(elements, a.x, a.inertia);
    const double damping = damping_of(system, settings, a.element_damping);
    const StageBase base = looks_back ? StageBase{a.x.data(), a.x_prev.data(), method.back} : StageBase{};
    system.row->batch->set_ahead(
        elements, a.x_from,
        {a.way.data(), a.v_start.data(), method.step, a.element_damping.empty() ? damping : 0, a.element_damping, base},
        a.elastic, a.A, a.filled, a.seen, a.inverted.data());
    const double mass = 1 + method.step * settings.mass_damping;
    if (turns)
        run_in_lanes(a.lanes, FormPairs{a, method.step, mass});
    else
        run_in_lanes(a.lanes, FormPlaces{a, method.step, mass});

    lost |= factorize_lanes(a.factor, a.A);
    a.dv = a.rhs;
    solve(a.factor, a.dv.data());
    relative_residuals(a.A, a.rhs, a.dv, a.way, a.residual.data());
    run_in_lanes(a.lanes, Move{a, method.step});
    if (system.row->batch->retract) {
        a.may_yield = system.row->batch->retract(elements, a.x_from, a.x_end, a.held, a.seen, a.retracted);
        run_in_lanes(a.lanes, TakeRetracted{a, method.step});
    }
    run_in_lanes(a.lanes, Finish{a, pinned, turns, lost});
    return lost;
}

bool can_be_taken_apart(const System& system) {
    return !system.plan.tree && !system.row->batch->retract;
}

void take_apart(const Batch& a, Workspace* const* workspaces) {
    std::array<FrontFactor*, MOST_LANES> factors;
    for (size_t lane = 0; lane < size_t(a.lanes); ++lane) {
        Workspace* workspace = workspaces[lane];
        factors[lane] = workspace ? &workspace->linear.block.fronts : nullptr;
        if (!workspace) continue;
        workspace->linear.has_factor = true;
        workspace->held = a.held;
        workspace->reach = a.reach;
        workspace->retract_from.resize(0);
    }
    take_apart(a.factor.fronts, factors.data());
}

}  // namespace frond
