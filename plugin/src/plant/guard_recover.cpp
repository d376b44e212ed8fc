// In: a plant after a step. Out: whether no admissible load can reach its state, how long it recovers from that, and a
// restart from the modelled shape if it cannot.
//
// Put there by a host, or driven there by loads that no tissue bears, the plant holds thousands of times the energy of
// any vibration. Released, it would fly about for long; so while it recovers it is damped enough to stop a sway without
// overshoot, by the integrator that damps most, and gains no plastic strain.
#include <algorithm>
#include <cmath>

#include "plant/guard.hpp"
#include "plant/plant.hpp"

namespace frond {

namespace {

constexpr double TORN = 0.5;    // uniform strain that no plant has ever had [-]
constexpr double FOLDED = 0.1;  // uniform strain that no plant keeps by itself [-]

// Returns whether the elastic energy exceeds that of the whole plant stretched by `strain` along its longest side, at
// constant volume.
bool holds_more_than(const Plant& plant, const VecX& x, double strain) {
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const double own = row.energy(elements_of(plant), x);
    if (own < lifting_energy(plant)) return false;  // weight can bend it this far
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

// Returns whether the step needed a search, and the search gave up.
bool is_lost(const Plant& plant) {
    return plant.trouble & FROND_TROUBLE_RETRIED && !plant.report.converged;
}

}  // namespace

void damp_recovering(const Plant& plant, SolveSettings& settings) {
    if (plant.state.recovers_for <= 0) return;
    settings.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    settings.mass_damping += 2 * PI / rest_time(plant);
}

void watch_recovery(Plant& plant, double h) {
    constexpr float SWAYS = 1.5;  // duration of a recovery, in periods of the slowest mode [-]
    const float sway = float(2 * rest_time(plant));
    bool ends = false;
    if (plant.state.recovers_for > 0) {
        plant.trouble |= FROND_TROUBLE_RETRIED;
        plant.state.recovers_for = std::max(0.0f, plant.state.recovers_for - float(h));
        const double way_left = double(plant.state.recovers_for) * plant.state.motion.v.lpNorm<Eigen::Infinity>();
        ends = way_left <= OFF_COURSE * double(plant.size) && !plant.step.is_pressed;
    } else if ((plant.step.is_off_course || is_lost(plant)) && holds_more_than(plant, plant.step.x_good, TORN)) {
        plant.state.recovers_for = SWAYS * sway;
    }
    // A plant that is still heavily strained or finds no solution, and will not get far any more, or rests with tets
    // inside out, would stay so for ever.
    const bool is_folded =
        ends && (is_lost(plant) || is_inside_out(plant) || holds_more_than(plant, plant.state.motion.x, FOLDED));
    if (!(is_folded || is_caught_inside_out(plant, h)) || !start_from_modelled(plant)) return;
    plant.trouble |= FROND_TROUBLE_REWOUND;
    plant.state.recovers_for = sway;
}

}  // namespace frond
