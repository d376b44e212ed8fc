// One step of a plant in two halves, between which contacts may change the solution: loads and solve; then accept, with
// plastic strain, or rewind, and the chain.
#pragma once

#include "plant/plant.hpp"

namespace frond {

// Surroundings that the world gives to every plant of a step.
struct Surroundings {
    Vec3 gravity = Vec3::Zero();               // world frame [m/s^2]
    frond_effects effects = FROND_EFFECT_ALL;  // mask
    const Wind* wind = nullptr;                // null: there is no air
    double time = 0;                           // at the end of the step [s]
};

// The first half.
void solve_plant(Plant& plant, const Surroundings& surroundings, double h);
// Ends the first half: decides whether the solution can be the next state.
void finish_solving(Plant& plant);
// Does the middle of the first half: advances plant.motion by h under plant.loads.
SolveReport solve_in_substeps(Plant& plant, double h);
// Return gravity in the model's frame [m/s^2] and the settings of the running step.
Vec3 gravity_in(const Plant& plant, const Surroundings& surroundings, frond_effects effects);
SolveSettings settings_for(const Plant& plant, frond_effects effects);
// Gathers the forces on nodes, gravity and springs of the running step, in the model's frame.
void gather_loads(Plant& plant, const Surroundings& surroundings, frond_effects effects);
// Sets the drags of the running step's loads.
void gather_air(Plant& plant, const Surroundings& surroundings, frond_effects effects, double h);
// How far a node goes in a step that its speed before need not foretell [m].
constexpr double WHIPS = 0.01;
// Returns whether a solved plant went that far among bodies that it was not swept against.
bool whips_among_bodies(const Plant& plant);
// Solves the step again from its start, where one solve gave the plant energy that nothing can have given.
void solve_again(Plant& plant, double h);
// The same where a fibre became taut in it.
void stop_by_fibres(Plant& plant, double h);

// The middle: what contacts push and part.
// Returns the push of a step's contacts, which are known from then on.
ContactPush& push_of(Plant& plant);
// Returns whether contacts push the plant in its step.
inline bool is_pushed(const Plant& plant) {
    return plant.step.push && plant.step.push->impulse.size() > 0;
}
// Adds the push of contacts, if there is any, to the solved step of a plant in contact: only then does its energy show
// whether the step went wrong.
void add_contacts(Plant& plant, double h);
// Returns the work that parting it from what it overlaps may do on it in a step of h [s]: it lifts a plant, or another
// mass [kg], slowly [J].
double parting_work(const Plant& plant, double h);
double parting_work(double mass, double h);
// Moves it by impulses on its nodes [N s], without velocity, as far as that does little work on it. Returns the way of
// the nodes [m]; empty: none.
VecX correct_position(Plant& plant, const VecX& impulses, double h);
// The solved step without contacts, to which contacts may be added anew.
struct FreeStep {
    VecX x, v, retract_from;
    bool is_shaken = false, has_history = false, is_sound = true, is_off_course = false;
    SolveReport report;
    uint32_t trouble = 0;
};
FreeStep free_step(const Plant& plant);
void take_back(Plant& plant, const FreeStep& step);
// Goes only a share of the solved step's way, more slowly. A straight way of nodes strains a plant that turns far:
// the first returns whether it would gain no energy that nothing gave it.
bool may_go_part_of_way(Plant& plant, double share, double h);
void go_part_of_way(Plant& plant, double share);

// The second half.
void accept_step(Plant& plant, const Surroundings& surroundings, double h);
// Replaces the second half if the step was broken off: puts the plant back to where it was before the first one.
void drop_step(Plant& plant);
// Does both halves.
void step_plant(Plant& plant, const Surroundings& surroundings, double h);
// Called before and after a step.
void take_workspace(Plant& plant);
void return_workspace(Plant& plant);

}  // namespace frond
