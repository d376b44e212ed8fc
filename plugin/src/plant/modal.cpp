// In: a chain that moves, then the air. Out: the chain, moving by its first two modes.
//
// Each mode is an oscillator displaced by the air's push, solved exactly over the time for which the push is taken as
// constant; so it can be updated rarely and drawn at any time. The modes' rotations turn the segments of the chain,
// which keep their lengths however far it bends. The part of the chain's shape that the modes cannot represent blends
// out as turns and strains of segments, too: as displacements it would draw them out.
#include "plant/modal.hpp"

#include <cmath>

#include "core/assert.hpp"
#include "core/elementary.hpp"
#include "mechanics/rotation.hpp"
#include "plant/plant_step.hpp"
#include "plant/seen.hpp"

namespace frond {

namespace {

struct State {
    double place, speed;
};

// Solves x'' + c x' + k (x - rest) = 0 for the state after t.
State after(const State& start, double rest, double c, double k, double t) {
    FROND_ASSERT(k >= 0 && c >= 0 && t >= 0);
    const double a = 0.5 * c, d = k - a * a, x = start.place - rest;
    double cosine, sine_over;  // cos(sqrt(d) t), and sin(sqrt(d) t) over sqrt(d)
    double fall = frond::exp(-a * t);
    if (d > 1e-9 * k) {
        const double omega = std::sqrt(d);
        cosine = frond::cos(omega * t);
        sine_over = frond::sin(omega * t) / omega;
    } else if (d < -1e-9 * k) {
        const double omega = std::sqrt(-d);
        // With strong damping cosh overflows and the decay underflows, so both are taken together.
        const double slow = frond::exp(-k / (omega + a) * t), quick = frond::exp(-(omega + a) * t);
        cosine = 0.5 * (slow + quick);
        sine_over = 0.5 * (slow - quick) / omega;
        fall = 1;
    } else {
        cosine = 1;
        sine_over = t;
    }
    return {rest + fall * (x * (cosine + a * sine_over) + start.speed * sine_over),
            fall * (start.speed * (cosine - a * sine_over) - k * x * sine_over)};
}

State state_of(const ModalMotion& modal, size_t k) {
    return after({modal.place[k], modal.speed[k]}, modal.rest[k], modal.damping[k], modal.modes->modes[k].square,
                 modal.since);
}

// Calls `act` for each segment of a chain with such rotations: its nodes, the rotation midway between theirs, and its
// modelled chord.
template <class Act>
void for_each_segment(const Plant& plant, const VecX& x, const Act& act) {
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    const VecX& modelled = elements_of(*plant.system).modelled;
    for (int i = 0; i < int(nodes.size()); i++) {
        const int parent = nodes[size_t(i)].parent;
        if (parent < 0) continue;
        const Vec3 turn = 0.5 * (point(x, 2 * parent + 1) + point(x, 2 * i + 1));
        act(2 * parent, 2 * i, rotation_of<double>(turn), Vec3(point(modelled, 2 * i) - point(modelled, 2 * parent)));
    }
}

// A chain in its own terms: rotations of its nodes, places of roots, and of any other node by how much its segment's
// chord differs from the modelled one, in the frame midway between its ends' rotations. A sum of such terms bends a
// chain, and a sum of places stretches it.
VecX terms_of(const Plant& plant, const VecX& x) {
    VecX terms = x;
    for_each_segment(plant, x, [&](int begin, int end, const Mat3& turned, const Vec3& chord) {
        point(terms, end) = turned.transpose() * (point(x, end) - point(x, begin)) - chord;
    });
    return terms;
}

// Returns the positions and rotations of the chain with such terms.
VecX chain_of(const Plant& plant, const VecX& terms) {
    VecX x = terms;
    for_each_segment(plant, terms, [&](int begin, int end, const Mat3& turned, const Vec3& chord) {
        point(x, end) = point(x, begin) + turned * (chord + point(terms, end));
    });
    return x;
}

// Returns the terms of the chain as modelled.
VecX modelled_terms(const Plant& plant) {
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    VecX terms = elements_of(*plant.system).modelled;
    for (int i = 0; i < int(nodes.size()); i++)
        if (nodes[size_t(i)].parent >= 0) point(terms, 2 * i).setZero();
    return terms;
}

// Returns how `of` changes where x moves by v.
template <class Of>
VecX rate_of(const Plant& plant, const Of& of, const VecX& x, const VecX& v) {
    return (of(plant, x + SHORT * v) - of(plant, x - SHORT * v)) / (2 * SHORT);
}

// Adds what the modes turn, times the factors given.
void add_turns(const Plant& plant, const std::array<double, 2>& factors, VecX& terms) {
    for (size_t k = 0; k < 2; k++) {
        const VecX& shape = plant.state.modal->modes->modes[k].shape;
        if (shape.size() == 0) continue;
        for (int i = 1; i < terms.size() / 3; i += 2) point(terms, i) += factors[k] * point(shape, i);
    }
}

// Updates the air's push on the modes, which then stays constant until the next update.
void ask_air(Plant& plant, const Surroundings& surroundings) {
    ModalMotion& modal = *plant.state.modal;
    const frond_effects effects = plant.input.effects & surroundings.effects;
    Vec3 wind = Vec3::Zero();
    if (surroundings.wind && effects & FROND_EFFECT_WIND && !modal.comes_to_rest) {
        const Vec3 p = plant.to_world(modal.modes->middle);
        modal.at.assign(1, {p.x(), p.y(), p.z()});
        if (!wind_velocities(*surroundings.wind, up_of(surroundings.gravity), surroundings.time, modal.at, modal.air))
            plant.trouble |= FROND_TROUBLE_BAD_WIND;
        wind = plant.rotation.conjugate() * Vec3(modal.air[0].x, modal.air[0].y, modal.air[0].z);
    }
    const double speed = wind.norm(), density = surroundings.wind ? surroundings.wind->def.density : 0;
    const bool damps = effects & FROND_EFFECT_DAMPING;
    for (size_t k = 0; k < 2; k++) {
        const NaturalMode& mode = modal.modes->modes[k];
        if (mode.shape.size() == 0) continue;
        const SolveSettings& s = plant.input.settings;
        double push = 0;
        modal.damping[k] =
            damps ? s.mass_damping + s.stiffness_damping * mode.stiffness + s.full_damping * mode.ratio : 0;
        for (size_t a = 0; a < 3 && speed > 0; a++) {
            const double share = wind[Eigen::Index(a)] * wind[Eigen::Index(a)] / (speed * speed);
            push += density * speed * share * mode.push[a].dot(wind);
            if (effects & FROND_EFFECT_AIR_DRAG) modal.damping[k] += density * speed * share * mode.resist[a];
        }
        constexpr double EBB = 0.85;  // factor per update on a deflection that the air no longer holds [-]
        modal.rest[k] = modal.comes_to_rest ? EBB * modal.rest[k] : push / mode.square;
        if (modal.comes_to_rest) modal.damping[k] = std::max(modal.damping[k], std::sqrt(mode.square));
    }
}

}  // namespace

void begin_modal(Plant& plant) {
    if (plant.state.modal) return;
    plant.state.modal = std::make_unique<ModalMotion>();
    ModalMotion& modal = *plant.state.modal;
    modal.modes = modal_basis_of(plant);
    const VecX& mass = node_mass_of(*plant.system);
    const VecX& modelled = elements_of(*plant.system).modelled;
    for (size_t k = 0; k < 2; k++) {
        const VecX& shape = modal.modes->modes[k].shape;
        if (shape.size() == 0) continue;
        for (int i = 0; i < mass.size(); i += 2) {
            modal.place[k] += mass[i] * point(shape, i).dot(point(plant.state.motion.x, i) - point(modelled, i));
            modal.speed[k] += mass[i] * point(shape, i).dot(point(plant.state.motion.v, i));
        }
        modal.rest[k] = modal.place[k];
    }
    VecX turned = modelled_terms(plant), turning = VecX::Zero(modelled.size());
    add_turns(plant, modal.place, turned);
    add_turns(plant, modal.speed, turning);
    VecX rates = rate_of(plant, terms_of, plant.state.motion.x, plant.state.motion.v) - turning;
    // Strains of rods are small, but as rates, which errors of velocities are enough for, they would become large.
    for (int i = 0; i < rates.size() / 3; i += 2) point(rates, i).setZero();
    begin_blend_out(modal.blend_out, terms_of(plant, plant.state.motion.x) - turned, rates);
    plant.state.motion.history.valid = false;
    plant.report = {};
    plant.report.ok = true;
    plant.step.loads->drags.clear();
    plant.state.blown.setZero();
    plant.state.stepped_by = 0;
}

bool sways_on_its_roots(const Plant& plant) {
    return plant.input.stands_on_roots && !plant.input.pins_are_own && plant.state.fragments.empty() &&
           !plant.input.supports && plant.input.grabs.empty() && !plant.input.has_user_force;
}

void keep_only_modes(Plant& plant) {
    begin_modal(plant);
    plant.state.modal->blend_out = {};
    end_modal(plant);
}

void pose(Plant& plant) {
    if (!plant.state.modal || !plant.state.modal->stale) return;
    ModalMotion& modal = *plant.state.modal;
    std::array<double, 2> at, speed;
    for (size_t k = 0; k < 2; k++) {
        const State now = state_of(modal, k);
        at[k] = now.place;
        speed[k] = now.speed;
    }
    VecX terms = modelled_terms(plant), rates = VecX::Zero(terms.size());
    add_turns(plant, at, terms);
    add_turns(plant, speed, rates);
    add_offset(modal.blend_out, terms);
    add_rate(modal.blend_out, rates);
    plant.state.motion.x = chain_of(plant, terms);
    plant.state.motion.v = rate_of(plant, chain_of, terms, rates);
    modal.stale = false;
    moved(plant);
}

void end_modal(Plant& plant) {
    if (!plant.state.modal) return;
    pose(plant);
    plant.state.modal = nullptr;
}

void step_modal(Plant& plant, const Surroundings& surroundings, double h, bool ask) {
    ModalMotion& modal = *plant.state.modal;
    plant.trouble = 0;
    modal.since += h;
    modal.stale = plant.view.cage_stale = plant.view.surface_stale = true;
    pass_time(modal.blend_out, h);
    pass_blend_time(plant, h);
    if (!ask && !modal.fresh) return;
    modal.fresh = false;
    for (size_t k = 0; k < 2; k++) {
        const State now = state_of(modal, k);
        modal.place[k] = now.place;
        modal.speed[k] = now.speed;
    }
    modal.since = 0;
    ask_air(plant, surroundings);
}

std::array<double, 2> modal_reach(const Plant& plant) {
    std::array<double, 2> modal;
    for (size_t k = 0; k < 2; k++)
        modal[k] = state_of(*plant.state.modal, k).place * plant.state.modal->modes->modes[k].reach;
    return modal;
}

}  // namespace frond
