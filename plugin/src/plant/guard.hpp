// Guard: detects steps that no plant can have taken, and recovers from them. A healthy step only pays for the check of
// how far its nodes went.
#pragma once

#include "core/types.hpp"

namespace frond {

struct Plant;
struct SolveSettings;

// Returns the largest displacement of a node in the running step [m]; infinite if it is not a number.
double farthest_way(const Plant& plant);
// Returns whether something ended a step of h [s] far from where it was heading when the step began: a position by more
// than 0.02 of the plant's size, the rotation of a chain node by more than 0.35 rad. Steps longer than 1/60 s always
// count as off course.
bool ends_off_course(const Plant& plant, double h);
constexpr double OFF_COURSE = 0.02, TURNED_OFF_COURSE = 0.35;  // over the plant's size [-], [rad]
// Longest step that is trusted [s]: the error of one solve, relative to the motion, grows as the square of the step,
// and small displacements strain stiff parts much.
constexpr double TRUSTED = 1.001 / 60;
// Returns whether a node was displaced by much more than the plant's size and than it may have to come back.
bool has_run_away(const Plant& plant);
constexpr double FARTHEST_WAY = 4;  // displacement over the plant's size that is not questioned [-]
// Returns whether the plant is stretched to many times its size.
bool is_far_out(const Plant& plant);
// Returns the potential of the running step's forces and springs, also of pins [J].
double potential_of_pulls(const Plant& plant, const VecX& x);
// Returns the potential energy [J]: elastic, of weight and of those.
double potential_energy(const Plant& plant, const VecX& x);
// Returns the work of weight along a displacement of all nodes [J].
double work_of_weight(const Plant& plant, const VecX& way);
// Returns the energy that lifts the plant by its own size [J].
double lifting_energy(const Plant& plant);

// Returns whether what turns is inflated by the integrator's forces at the start of the step, in a cage: rods are
// retracted. Implicit Euler takes the steps of what is touched; what nothing holds may spin by a third of a radian in a
// step and stay on its course.
bool may_inflate(const Plant& plant);
// Sets is_off_course after a solve over h [s] from x_good and v_good, and returns whether the plant may go there: it
// did not run away, nor gain energy that the loads and contacts cannot have given. What stayed on its course is not
// asked for its energy, unless pins or contacts push it, it starts anew, as with forces of the host, tets were inside
// out, a cage was to leave the trust bound, the step has stages, of which one need not damp what another strained, it
// may inflate the plant, or its substeps were too long: in the last of them a node may become much faster and hardly go
// anywhere.
bool keeps_course(Plant& plant, double h);
// Returns whether the plant gained no more energy in a step of h [s] than loads and contacts can have given, but for a
// hundredth of what it had and of what lifts it by its size.
bool gains_no_energy(Plant& plant, double h);
// Returns whether no node ran away, and none left its course with energy that nothing can have given. A pressed plant
// springs far in a solve without contacts, and its energy is meaningless there.
bool is_plausible(Plant& plant, double h);

// Translates a plant with its pins, between solves, if they were put farther away than `least` times its size.
bool jump_with_pins(Plant& plant, double least);
constexpr double JUMP = 1;  // distance of the pins from which no step follows them, over the plant's size [-]
constexpr double STUCK_BEHIND = 1e-3;  // the same where a step failed that began at rest [-]

// Strengthens the damping of a step while the plant recovers.
void damp_recovering(const Plant& plant, SolveSettings& settings);
// Begins, continues and ends the recovery from states that no admissible load can reach, after a step of h [s].
void watch_recovery(Plant& plant, double h);

// Returns whether tets are inside out; false if the mechanics move the chain.
bool is_inside_out(const Plant& plant);
// Returns whether, after a step, the plant rests with tets inside out.
bool is_caught_inside_out(const Plant& plant, double h);
// Puts the plant into its modelled shape, at rest, if that has less potential energy; false if not.
bool start_from_modelled(Plant& plant);
// Moves the plant towards its modelled shape, as little as leaves it an elastic energy and a work against its weight of
// `most` together [J]; drops its plastic strain if even the modelled shape has more.
void approach_modelled(Plant& plant, double most);

}  // namespace frond
