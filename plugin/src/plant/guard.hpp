// Guard: what is noticed of a step that no plant can have taken, and what is done about it. A healthy step pays for the
// looks at how far its nodes went, nothing else.
#pragma once

#include "core/types.hpp"

namespace frond {

struct Plant;
struct SolveSettings;

// Farthest way of a place in the running step [m]; infinite where it is no number.
double farthest_way(const Plant& plant);
// Whether something ended a step of h [s] far from where it was heading when the step began: a place by more than 0.02
// of the plant's size, the rotation of a chain's node by more than 0.35 rad; steps longer than 1/60 s are never trusted
// that far.
bool ends_off_course(const Plant& plant, double h);
constexpr double OFF_COURSE = 0.02, TURNED_OFF_COURSE = 0.35;  // over the plant's size [-], [rad]
// What is stiff is strained much by little: the error of one solve grows over what moves as the square of the step [s].
constexpr double TRUSTED = 1.001 / 60;
// Whether a place went much farther than the plant is long, and than it has to come back.
bool has_run_away(const Plant& plant);
constexpr double FARTHEST_WAY = 4;  // over the plant's size, that is not asked about [-]
// Stretched to many times its size.
bool is_far_out(const Plant& plant);
// Of a chain's node, whose rotation vector turns back by 2 pi where it has turned by more than pi [rad].
Vec3 turn_of(const VecX& x, const VecX& from, int node);

// Elastic and that of weight, forces and springs, those of pins too, which do not change within a step [J].
double potential_energy(const Plant& plant, const VecX& x);
// What lifts it by its own size [J].
double lifting_energy(const Plant& plant);

struct EnergyLook {
    // It has more than it had and than forces, springs and pins that move can have given.
    bool comes_from_nowhere = false;
    // It had less than lifts it by its size when the step began, or when it ended hardly more than it was given.
    bool is_small = false;
};
// After a solve over h [s] from x_good and v_good; contacts did `work` [J]. Not told, both false, in the air, which may
// give any.
EnergyLook look_at_energy(const Plant& plant, double h, double work = 0);

// Between solves: a plant whose pins are put farther away than so much of its size goes along with them, as it is.
bool jump_with_pins(Plant& plant, double least);
constexpr double JUMP = 1;             // so far no step follows them
constexpr double STUCK_BEHIND = 1e-3;  // nor, where a step failed that began at rest, so far

// In a step: stronger damping, while the plant recovers.
void damp_recovering(const Plant& plant, SolveSettings& settings);
// After a step of h [s]: begins, keeps up and ends recovery from shapes to which nothing can have bent the plant.
void watch_recovery(Plant& plant, double h);

// After a step: whether no place went farther than any sway does where it turns.
bool hardly_moves(const Plant& plant, double h);
// Whether tets are; never where a chain moves.
bool is_inside_out(const Plant& plant);
// After a step: whether the plant rests with tets inside out.
bool is_caught_inside_out(const Plant& plant, double h);
// Puts it into its modelled shape, at rest, if that has less potential energy; false if not.
bool start_from_modelled(Plant& plant);

}  // namespace frond
