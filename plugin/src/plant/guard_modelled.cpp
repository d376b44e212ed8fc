// In: a plant that is caught in a shape from which no step leads back: at rest with tets inside out, strained from all
// sides, or stretched so far that every step fails. Out: its modelled shape, where it is held, if that has less
// potential energy. The visible difference blends out within a second. The same for a plant that has been handed over
// to other mechanics with more energy than it had: a shape between the two.
#include <cmath>

#include "mechanics/rotation.hpp"
#include "plant/guard.hpp"
#include "plant/seen.hpp"

namespace frond {

namespace {

// Finds the placement of the modelled shape as it is held now, or as it lies if nothing holds it. False if that is
// undetermined.
bool find_frame(const Plant& plant, Mat3& rotation, Vec3& shift) {
    const Motion& motion = plant.state.motion;
    const VecX& modelled = elements_of(*plant.system).modelled;
    const int next = plant.follow ? 2 : 1;
    std::vector<Vec3> from, to, held_from, held_to;
    for (int i = 0; i < motion.x.size() / 3; i += next) {
        const bool is_held = motion.pinned[size_t(i)];
        (is_held ? held_from : from).push_back(point(modelled, i));
        (is_held ? held_to : to).push_back(point(motion.x, i));
        if (!is_held || !plant.follow) continue;
        // One held node of a chain determines it.
        rotation = rotation_of<double>(point(motion.x, i + 1));
        shift = point(motion.x, i) - rotation * point(modelled, i);
        return true;
    }
    return fit_rigid(held_from, held_to, Vec3::Zero(), rotation, shift) ||
           fit_rigid(from, to, Vec3::Zero(), rotation, shift);
}

// What is held stays where it is, and what broke off with its fragment.
VecX modelled_in(const Plant& plant, const Mat3& rotation, const Vec3& shift) {
    const VecX& modelled = elements_of(*plant.system).modelled;
    const Vec3 turn = rotation_vector<double>(rotation);
    const int per_node = plant.follow ? 2 : 1;
    VecX x = plant.state.motion.x;
    for (int i = 0; i < x.size() / 3; i++) {
        const size_t node = size_t(i / per_node);
        const bool is_gone = plant.follow ? fragment_of_chain_node(plant, node) : fragment_of_node(plant, node);
        if (plant.state.motion.pinned[size_t(i)] || is_gone) continue;
        point(x, i) = plant.follow && i % 2 == 1 ? turn : Vec3(rotation * point(modelled, i) + shift);
    }
    return x;
}

// Drops plastic strain that would bend the modelled shape by more than its weight can: it arose where no plant can be.
// Changes nothing and returns false if the modelled shape would not have less energy than the present one.
bool drop_wild_sets_for_less_energy(Plant& plant, const VecX& x) {
    const double caught = potential_energy(plant, plant.state.motion.x), with_sets = potential_energy(plant, x);
    if (!plant.state.own_elements) return with_sets < caught;
    const std::vector<double> sets = plastic_of(plant);
    set_plastic(plant, {});
    const double without = potential_energy(plant, x);
    const bool are_wild = !(with_sets - without < lifting_energy(plant)),
               has_less = (are_wild ? without : with_sets) < caught;
    if (!are_wild || !has_less) set_plastic(plant, sets);
    return has_less;
}

}  // namespace

// A tet of order 2 may be right at its integration points and inverted at its corners.
bool is_inside_out(const Plant& plant) {
    if (plant.follow) return false;
    if (plant.report.inverted > 0) return true;
    if (plant.nodes->order == 1) return false;
    const VecX& x = plant.state.motion.x;
    for (const Tet& tet : plant.model->cage.tets) {
        const Vec3 a = point(x, tet[0]);
        if (!((point(x, tet[1]) - a).dot((point(x, tet[2]) - a).cross(point(x, tet[3]) - a)) > 0)) return true;
    }
    return false;
}

void approach_modelled(Plant& plant, double most) {
    constexpr int HALVINGS = 8;  // the share of the way is found to a 256th
    Mat3 rotation;
    Vec3 shift;
    if (!find_frame(plant, rotation, shift)) return;
    const VecX from = plant.state.motion.x, to = modelled_in(plant, rotation, shift);
    const VecX way = (plant.follow ? wound_as(from, to) : to) - from;
    const auto stored_at = [&](double share) {
        plant.state.motion.x = from + share * way;
        return stored_energy(plant).potential;
    };
    const auto has_little_at = [&](double share) { return stored_at(share) <= most; };
    const double stored = stored_at(0);
    if (!has_little_at(1)) {
        const std::vector<double> sets = plastic_of(plant);
        set_plastic(plant, {});
        // Linear tets hold energy where they are turned, and any where pins strain them, even as modelled.
        if (!(stored_at(1) < stored)) {
            set_plastic(plant, sets);
            plant.state.motion.x = from;
            return;
        }
    }
    double enough = 1;
    for (double step = 0.5; step > std::ldexp(1, -HALVINGS); step /= 2)
        if (has_little_at(enough - step)) enough -= step;
    plant.state.motion.x = enough < 1 ? VecX(from + enough * way) : to;
}

bool start_from_modelled(Plant& plant) {
    if (!plant.state.fragments.empty()) return false;
    Mat3 rotation;
    Vec3 shift;
    Motion& motion = plant.state.motion;
    if (!find_frame(plant, rotation, shift)) return false;
    const VecX x = modelled_in(plant, rotation, shift);
    if (!drop_wild_sets_for_less_energy(plant, x)) return false;
    plant.view.cage_stale = true;  // a host may have read the places from which the step began
    Seen seen = seen_of(plant);
    seen.velocities.setZero();
    seen.chain_moving = seen.chain;
    motion.x = x;
    motion.v.setZero();
    motion.history.valid = false;
    end_blend(plant);
    // Bodies touch the visible shape: a blend-out would have them bend the plant from where it no longer is.
    if (!plant.state.is_touched) blend_from(plant, seen);
    return true;
}

// Returns whether, after a step, all nodes are slower than a vibrating plant's at its turning points.
static bool hardly_moves(const Plant& plant, double h) {
    constexpr double SLOW = 0.002;  // plant sizes per second, slower than any vibration at its turning points
    const double slow = SLOW * double(plant.size);
    return plant.step.v_good.lpNorm<Eigen::Infinity>() < slow && farthest_way(plant) < slow * h;
}

bool is_caught_inside_out(const Plant& plant, double h) {
    if (plant.follow || plant.step.is_pressed || (plant.report.inverted == 0 && plant.nodes->order == 1)) return false;
    return hardly_moves(plant, h) && is_inside_out(plant);
}

}  // namespace frond
