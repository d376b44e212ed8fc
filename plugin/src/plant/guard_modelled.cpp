// In: a plant that is caught in a shape from which no step leads back: at rest with tets inside out, strained from all
// sides; or so far drawn out that every step fails. Out: its modelled shape, where it is held, if that has less
// potential energy than the one it is caught in. What is seen of it fades over within a second.
#include "mechanics/rotation.hpp"
#include "plant/guard.hpp"
#include "plant/plant.hpp"

namespace frond {

namespace {

// Where the modelled shape is as it is held now, or as it lies if nothing holds it. False where that is not to be told.
bool find_frame(const Plant& plant, Mat3& rotation, Vec3& shift) {
    const Motion& motion = plant.motion;
    const VecX& modelled = elements_of(*plant.system).modelled;
    const int next = plant.follow ? 2 : 1;
    std::vector<Vec3> from, to, held_from, held_to;
    for (int i = 0; i < motion.x.size() / 3; i += next) {
        const bool is_held = motion.pinned[size_t(i)];
        (is_held ? held_from : from).push_back(point(modelled, i));
        (is_held ? held_to : to).push_back(point(motion.x, i));
        if (!is_held || !plant.follow) continue;
        // One node of a chain tells how it is turned.
        rotation = rotation_of<double>(point(motion.x, i + 1));
        shift = point(motion.x, i) - rotation * point(modelled, i);
        return true;
    }
    return fit_rigid(held_from, held_to, Vec3::Zero(), rotation, shift) ||
           fit_rigid(from, to, Vec3::Zero(), rotation, shift);
}

VecX modelled_in(const Plant& plant, const Mat3& rotation, const Vec3& shift) {
    const VecX& modelled = elements_of(*plant.system).modelled;
    const Vec3 turn = rotation_vector<double>(rotation);
    VecX x = plant.motion.x;
    for (int i = 0; i < x.size() / 3; i++) {
        if (plant.motion.pinned[size_t(i)]) continue;
        point(x, i) = plant.follow && i % 2 == 1 ? turn : Vec3(rotation * point(modelled, i) + shift);
    }
    return x;
}

// Without the sets that would bend it there by more than its weight can: it got them where no plant can be. Nothing is
// changed if that is no less than what it holds now.
bool drop_wild_sets_for_less_energy(Plant& plant, const VecX& x) {
    const double caught = potential_energy(plant, plant.motion.x), with_sets = potential_energy(plant, x);
    if (!plant.own_elements) return with_sets < caught;
    const std::vector<double> sets = plastic_of(plant);
    set_plastic(plant, {});
    const double without = potential_energy(plant, x);
    const bool are_wild = !(with_sets - without < lifting_energy(plant)),
               has_less = (are_wild ? without : with_sets) < caught;
    if (!are_wild || !has_less) set_plastic(plant, sets);
    return has_less;
}

}  // namespace

// Points of integration may be right in a tet of order 2 whose corners are not.
bool is_inside_out(const Plant& plant) {
    if (plant.follow) return false;
    if (plant.report.inverted > 0) return true;
    if (plant.nodes->order == 1) return false;
    const VecX& x = plant.motion.x;
    for (const Tet& tet : plant.model->cage.tets) {
        const Vec3 a = point(x, tet[0]);
        if (!((point(x, tet[1]) - a).dot((point(x, tet[2]) - a).cross(point(x, tet[3]) - a)) > 0)) return true;
    }
    return false;
}

bool start_from_modelled(Plant& plant) {
    if (!plant.fragments.empty()) return false;
    Mat3 rotation;
    Vec3 shift;
    Motion& motion = plant.motion;
    if (!find_frame(plant, rotation, shift)) return false;
    const VecX x = modelled_in(plant, rotation, shift);
    if (!drop_wild_sets_for_less_energy(plant, x)) return false;
    const VecX places = cage_places(plant);
    motion.x = x;
    motion.v.setZero();
    motion.history.valid = false;
    plant.cage_stale = true;
    plant.blend_out = {};
    // Bodies push what is seen of it: while that fades it would be bent from where it no longer is.
    if (!plant.is_touched) begin_blend_out(plant.blend_out, places - cage_places(plant), VecX::Zero(places.size()));
    return true;
}

bool hardly_moves(const Plant& plant, double h) {
    constexpr double SLOW = 0.002;  // in sizes of the plant a second; no sway turns as slowly as that
    const double slow = SLOW * double(plant.size);
    return plant.v_good.lpNorm<Eigen::Infinity>() < slow && farthest_way(plant) < slow * h;
}

bool is_caught_inside_out(const Plant& plant, double h) {
    if (plant.follow || plant.is_pressed || (plant.report.inverted == 0 && plant.nodes->order == 1)) return false;
    return hardly_moves(plant, h) && is_inside_out(plant);
}

}  // namespace frond
