// In: a plant after a step. Out: whether it has a shape to which nothing can have bent it, for how long it recovers
// from that, and a way out where it cannot.
//
// Put there by a host, or driven there by what no tissue bears, it holds thousands of times the energy of any sway. Set
// free, that would keep it flying about for long, so while it recovers it is damped as much as stops a sway without
// swinging back, by the integrator that damps most, and keeps no set.
#include <algorithm>
#include <cmath>

#include "plant/guard.hpp"
#include "plant/plant.hpp"

namespace frond {

namespace {

constexpr double TORN = 0.5;    // all of it strained by that has no plant been [-]
constexpr double FOLDED = 0.1;  // and so far none stays that nothing holds [-]

// More elastic energy than if all of it were drawn out so far along its longest side, and as much narrower as keeps its
// volume.
bool holds_more_than(const Plant& plant, const VecX& x, double strain) {
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const double own = row.energy(elements_of(plant), x);
    if (own < lifting_energy(plant)) return false;  // so far weight bends it
    const VecX& modelled = elements_of(*plant.system).modelled;
    const int next = plant.follow ? 2 : 1;
    Vec3 low = point(modelled, 0), high = low;
    for (int i = 0; i < modelled.size() / 3; i += next) {
        low = low.cwiseMin(point(modelled, i));
        high = high.cwiseMax(point(modelled, i));
    }
    int longest = 0;
    (high - low).maxCoeff(&longest);
    Vec3 stretch = Vec3::Constant(1 / std::sqrt(1 + strain));
    stretch[longest] = 1 + strain;
    VecX drawn_out = modelled;
    for (int i = 0; i < modelled.size() / 3; i += next) point(drawn_out, i) = stretch.cwiseProduct(point(modelled, i));
    return own > row.energy(elements_of(*plant.system), drawn_out);
}

// The step was searched for, and the search gave up.
bool is_lost(const Plant& plant) {
    return plant.trouble & FROND_TROUBLE_RETRIED && !plant.report.converged;
}

// Where the plant hardly moves, though nothing pulls or presses it.
bool found_no_way(const Plant& plant, double h) {
    const bool is_pulled = plant.has_user_force || plant.loads.springs.size() > plant.pin_springs.size();
    return is_lost(plant) && !is_pulled && !plant.is_pressed && hardly_moves(plant, h);
}

}  // namespace

void damp_recovering(const Plant& plant, SolveSettings& settings) {
    if (plant.recovers_for <= 0) return;
    settings.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    settings.mass_damping += 2 * M_PI / plant.rest_time;
}

void watch_recovery(Plant& plant, double h) {
    constexpr float SWAYS = 1.5;    // of the slowest, that it takes
    constexpr float CAUGHT = 0.25;  // for so much of one, a plant that nothing pulls
    const float sway = float(2 * plant.rest_time);
    bool ends = false;
    if (plant.recovers_for > 0) {
        plant.trouble |= FROND_TROUBLE_RETRIED;
        plant.recovers_for = std::max(0.0f, plant.recovers_for - float(h));
        ends = plant.recovers_for == 0 && !plant.is_pressed;
    } else if ((plant.is_off_course || is_lost(plant)) && holds_more_than(plant, plant.x_good, TORN)) {
        plant.recovers_for = SWAYS * sway;
    } else {
        plant.recovers_for = found_no_way(plant, h) ? plant.recovers_for - float(h) : 0;
    }
    // What lies folded or finds no way by now, or rests with tets inside out, would for ever.
    const bool is_folded =
        ends && (is_lost(plant) || is_inside_out(plant) || holds_more_than(plant, plant.motion.x, FOLDED));
    const bool is_caught = -plant.recovers_for > CAUGHT * sway || is_caught_inside_out(plant, h);
    if (!(is_folded || is_caught) || !start_from_modelled(plant)) return;
    plant.trouble |= FROND_TROUBLE_REWOUND;
    plant.recovers_for = sway;
}

}  // namespace frond
