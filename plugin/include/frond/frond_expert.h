/* frond_expert.h - measuring plants and steering their solver. Include <frond/frond.h>, which holds the rules for
 * units, ownership, errors and threads.
 */
#ifndef FROND_EXPERT_H
#define FROND_EXPERT_H

#include "frond/frond_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- profile: where the time goes ------------------------------------------------------------------------------ */

/* Wall clock of the last substep [ms]. */
typedef struct frond_profile {
    /* All of it, then its parts in the order in which they run, and the surfaces made since. */
    double ms_step, ms_collide, ms_effects, ms_assembly, ms_solve, ms_response, ms_capsules, ms_surface;
    /* The parts of ms_collide for plants with plants: broad phase, spatial hash, tests and depths. */
    double ms_broad, ms_hash, ms_narrow;
    /* Time of each effect, by bit. Gravity, damping, friction and two-way impulses are part of what others solve: they
     * have no time of their own and are 0. Where plants are stepped by several threads the times of these add up, as do
     * those of assembly and solve. */
    double ms_of_effect[FROND_EFFECT_COUNT];
} frond_profile;

/* Reports how long the last substep took. */
FROND_API frond_result frond_world_get_profile(frond_world world, frond_profile* out);
/* Computes a number that is equal for two worlds that simulated identically: on any processor, by any compiler, with
 * Bullet in the same precision. */
FROND_API frond_result frond_world_get_state_hash(frond_world world, uint64_t* out);

/* ---- cage and chain of a model ----------------------------------------------------------------------------------- */

typedef struct frond_cage_view {
    const double* nodes; /* node_count*3, at rest [m] */
    const int32_t* tets; /* tet_count*4, positive volume */
    int node_count, tet_count;
} frond_cage_view;
typedef struct frond_chain_view {
    const double* nodes;    /* node_count*3, at rest [m] */
    const double* radii;    /* node_count [m] */
    const int32_t* parents; /* node_count; -1 at a root. A node with a parent is the end of a capsule. */
    int node_count;
} frond_chain_view;

/* Gives the cage of a model; borrowed from the model. */
FROND_API frond_result frond_model_get_cage(frond_model model, frond_cage_view* out);
/* Gives the chain of a model; borrowed from the model. */
FROND_API frond_result frond_model_get_chain(frond_model model, frond_chain_view* out);

/* ---- a plant's mechanics and state --------------------------------------------------------------------------------
 */

typedef struct frond_energy {
    double kinetic, elastic, gravity; /* [J]; gravity is zero at the height of the world's origin */
} frond_energy;

/* Switches to other mechanics, from the same shape and velocities: exactly between tets; between cage and chain as near
 * as the one can take the other's shape. Pins, and the ground under its foot, stay. */
FROND_API frond_result frond_plant_set_mechanics(frond_plant plant, frond_mechanics mechanics);
/* Switches to another integrator, from the same shape and velocities. */
FROND_API frond_result frond_plant_set_integrator(frond_plant plant, frond_integrator integrator);
/* Copies positions [m] and velocities [m/s] of the cage's nodes in the world's frame, node_count*3 each. node_count
 * must be the plant's. Either array may be null. */
FROND_API frond_result frond_plant_get_state(frond_plant plant, double* positions, double* velocities, int node_count);
/* Sets positions [m] and velocities [m/s] of the cage's nodes, as above. It moves pinned nodes too: they stay where
 * they are put. Rods and springs take a shape of the cage as near as they can; frond_snapshot.h keeps theirs to the
 * bit. */
FROND_API frond_result frond_plant_set_state(frond_plant plant, const double* positions, const double* velocities,
                                             int node_count);
/* Returns how many numbers the plastic state has; 0 as long as nothing has yielded, or for an invalid handle. */
FROND_API int frond_plant_get_plastic_count(frond_plant plant);
/* Copies the plastic state, which belongs to the shape beside the state above. It is of use only to another plant of
 * the same model and mechanics, broken at the same capsules. count must be what frond_plant_get_plastic_count returns.
 */
FROND_API frond_result frond_plant_get_plastic(frond_plant plant, double* values, int count);
/* Sets the plastic state; count must be that of the plant which the values came from; 0 makes the plant elastic again.
 * When mechanics change, tets hand their plastic state to other tets and the chain to the chain; between the two it is
 * lost. */
FROND_API frond_result frond_plant_set_plastic(frond_plant plant, const double* values, int count);
/* Computes the energies of the plant as it is now. */
FROND_API frond_result frond_plant_get_energy(frond_plant plant, frond_energy* out);
/* Computes the strain of the outermost fibre of each capsule's organ by bending and pulling [-], against the shape
 * without any load: what FROND_EFFECT_BREAKING compares with strength / young. 0 for fragments. capsule_count must be
 * the plant's; out: capsule_count. */
FROND_API frond_result frond_plant_get_strains(frond_plant plant, double* out, int capsule_count);
/* Computes the force of the air on the whole plant, pinned nodes included, at the end of the last substep, in the
 * world's frame [N]. */
FROND_API frond_result frond_plant_get_air_force(frond_plant plant, frond_vec3* out);
/* Computes the momentum of all nodes together, in the world's frame [kg m/s]. */
FROND_API frond_result frond_plant_get_momentum(frond_plant plant, frond_vec3* out);

/* ---- the chain's own loads, state and section forces ---------------------------------------------------------------
 * Chain nodes are those of frond_model_get_chain, capsules those of frond_plant_get_capsules. State and section forces
 * are of FROND_MECHANICS_ROD and FROND_MECHANICS_SPRING_CHAIN, whose nodes turn; with tets they are UNSUPPORTED. */

/* Returns the number of chain nodes; 0 for an invalid handle. */
FROND_API int frond_plant_get_chain_node_count(frond_plant plant);
/* Adds a force [N] and a moment [N m] on a chain node for the next frond_world_step (all its substeps) only, in the
 * world's frame: they keep their directions. Loads on one node add up, with those of frond_plant_add_force. With tets
 * the moment is a couple of forces on the corners of the tet that the node is in. */
FROND_API frond_result frond_plant_add_chain_load(frond_plant plant, int chain_node, frond_vec3 force,
                                                  frond_vec3 moment);
/* Adds a force per length of a capsule as it is modelled [N/m], likewise. Its ends get what makes a beam bend as under
 * the load itself: half of it each, and the moments of a beam that is clamped at both ends. */
FROND_API frond_result frond_plant_add_distributed_load(frond_plant plant, int capsule, frond_vec3 force_per_length);

/* Motion of a chain node in the world's frame. A node's rotation is that of the plant's material there from how it was
 * modelled: that of the plant's def as long as nothing is bent. */
typedef struct frond_chain_state {
    frond_vec3 position;         /* [m] */
    frond_quat rotation;         /* need not have length one when it is set */
    frond_vec3 velocity;         /* [m/s] */
    frond_vec3 angular_velocity; /* [rad/s] */
} frond_chain_state;
/* Copies the motion of all chain nodes. chain_node_count must be the plant's; out: chain_node_count. */
FROND_API frond_result frond_plant_get_chain_state(frond_plant plant, frond_chain_state* out, int chain_node_count);
/* Sets the motion of all chain nodes, as above, exactly. It moves pinned nodes too: they stay where they are put. Nodes
 * of fragments stay with these. */
FROND_API frond_result frond_plant_set_chain_state(frond_plant plant, const frond_chain_state* states,
                                                   int chain_node_count);

/* Elastic force and moment in the middle of a capsule, of what is beyond it (towards its end) on what is before it. */
typedef struct frond_section_force {
    frond_vec3 axis;     /* direction from the capsule's begin to its end, world frame, length one */
    frond_vec3 thin;     /* direction across it, where it is thinnest; `wide` is axis x thin */
    double tension;      /* force along axis: below zero it is pressed [N] */
    double shear_thin;   /* force along thin [N] */
    double shear_wide;   /* force along wide [N] */
    double twist;        /* moment about axis [N m] */
    double bending_thin; /* moment that bends the axis towards thin, about wide [N m] */
    double bending_wide; /* moment that bends the axis towards wide, about minus thin [N m] */
} frond_section_force;
/* Computes the section forces of all capsules: what statics says of the loads beyond, for a plant at rest. 0 for
 * fragments. capsule_count must be the plant's; out: capsule_count. */
FROND_API frond_result frond_plant_get_section_forces(frond_plant plant, frond_section_force* out, int capsule_count);

/* ---- supports: chain nodes on hinges, ball joints and forks -------------------------------------------------------
 */

/* Which turns of a chain node a support holds. */
typedef enum frond_held_turns {
    FROND_HELD_TURNS_NONE,        /* with its place held a ball joint */
    FROND_HELD_TURNS_ABOUT_AXIS,  /* that about an axis, such as twist about a beam's: a fork */
    FROND_HELD_TURNS_ACROSS_AXIS, /* all but that about an axis: a hinge */
    FROND_HELD_TURNS_ALL,         /* a clamp */
    FROND_HELD_TURNS_COUNT
} frond_held_turns;

/* How a chain node is held. A turn is held about an axis if the rotation vector of the node, from where it was when it
 * was supported, has no part along that axis (the twist of swing and twist); it is held across the axis if the vector
 * is along it. */
typedef struct frond_support {
    bool holds_place; /* the node stays where it is */
    frond_held_turns held_turns;
    frond_vec3 axis; /* world frame, of any length but zero; not read if no turn or every turn is held */
} frond_support;
/* Supports a chain node as it is now, place and rotation, in place of pins and the ground, which do not hold that node
 * as long as it has a support; one that holds nothing lets it go. Null takes the support away: pins and the ground then
 * hold the node where it is by then. `support` is copied. Supports are ideal: they do no work, and parts that are held
 * do not move. They go along with frond_plant_set_transform, with frond_plant_set_state and frond_plant_set_chain_state
 * to where the node is put, and are gone after frond_plant_reset and with what breaks off. The plant wakes, is stepped
 * alone, and is never in FROND_DETAIL_MODAL. UNSUPPORTED with tets, and for a plant that a nearer detail makes one of
 * tets; frond_plant_set_mechanics refuses tets as long as there are supports. A plant that stands on several roots has
 * a chain node for each, all without a parent. Where supports hold it at one of several places, a step has up to ten
 * Newton iterations. */
FROND_API frond_result frond_plant_set_support(frond_plant plant, int chain_node, const frond_support* support);
/* Computes the force [N] and the moment about the node [N m] of a support on its node, in the world's frame, as
 * frond_plant_get_root_force does, which includes them. Loads on the node itself, such as a half of the distributed
 * load beside it, go past the plant into the support and are not part of it. Either may be null. */
FROND_API frond_result frond_plant_get_support_force(frond_plant plant, int chain_node, frond_vec3* force,
                                                     frond_vec3* moment);

/* ---- energy ledger: what was given to plants, and what became of it -----------------------------------------------
 */

/* The energy of a world's plants, and all work done on them since accounting began, each [J]; negative: they gave it
 * away. A step's work is a force's value at its end times the displacement of what it acts on, as implicit Euler counts
 * it; that of grabs what their springs lose; that of pins by the mean elastic force; that of bodies their impulses
 * times their own mean velocities, so that what lies still gives none. `error` bounds what that leaves open. Plants in
 * FROND_DETAIL_MODAL do not count: their energy goes with `calls`. Contacts among plants are part of `dissipated`,
 * which no step should lower by more than `error` rises. */
typedef struct frond_energy_ledger {
    /* Of all plants together; elastic and gravity over those of each plant as modelled, where it stands, gravity only
     * of plants on which it acts. */
    frond_energy now;
    double begin;     /* sum of the three when accounting began */
    double forces;    /* work of frond_plant_add_force */
    double grabs;     /* of the springs of grabs */
    double air;       /* of wind, and of the air's resistance, which takes energy */
    double pins;      /* of pinned nodes that the host moved */
    double bodies;    /* of bodies of the Bullet world in contact */
    double bonds;     /* of bodies to which plants are bonded, and of bonds that come together again */
    double fragments; /* went off with what broke off */
    /* Changes by calls between steps: plants made, destroyed or put elsewhere, states that were set or restored, other
     * mechanics, effects or gravity. */
    double calls;
    /* begin + all the above - now: damping, friction, plastic flow, and the errors of the solution. */
    double dissipated;
    /* Estimated error of all work together: half the change of drag and damping in a step, times displacement, and of
     * elastic forces on pins how far they are halfway from their mean. */
    double error;
} frond_energy_ledger;

/* Gives a world's energy ledger. Accounting begins with the first call and makes steps take longer from then on, to the
 * same bits; without a call it costs nothing. */
FROND_API frond_result frond_world_get_energy_ledger(frond_world world, frond_energy_ledger* out);

/* ---- advice: which settings for which accuracy -------------------------------------------------------------- */

typedef struct frond_advice {
    frond_plant_def plant; /* the default one with mechanics, integrator and tuning.mass set */
    double cage_size;      /* for a frond_model_def [m]; 0: the cage does not matter */
    double capsule_height; /* for a frond_model_def [m]; 0: the chain does not matter */
    double time_step;      /* at most; for frond_world_step or frond_world_def.max_substep [s] */
    double error;          /* of the tip: rms over two periods of the first mode, over its peak [-] */
    double cpu;            /* expected CPU seconds per simulated second, alone in its world, on an AMD EPYC */
} frond_advice;

/* Recommends settings for a model, always as rods. Either error or cpu is above zero: with `error`, 0..1, the cheapest
 * settings that are as accurate; with `cpu` the most accurate of those tried that cost no more. UNSUPPORTED, with a
 * text that names what there is, if no settings do. The error is that of the chain's tip, the node farthest from its
 * root along the chain, which a small horizontal force held aside where it gives way most, once the force ceases: held
 * at its roots, without damping, contacts and wind, at the chain's shape as modelled, under weight if it stands so and
 * else without. It is computed for this model, from the modes that the force excites and what the integrator makes of
 * them in such steps, and holds within a fifth. The first mode is the one that the tip shows most of, with those of
 * nearly its frequency. A model of stems is to be built anew with the capsule_height that comes back; its error is
 * against capsules of a 320th of the way to the tip. The chain of a mesh, of tets or of a URDF file is another plant
 * with each capsule_height, since it is measured anew, or has its own: what comes back is the height that it has, the
 * model need not be built anew, and the error is against the same capsules with FROND_MASS_CONSISTENT in exact steps.
 * CPU is by measured steps of rods. Takes as long as making the rods of such a model a dozen times: some tenths of a
 * second for a few stems. */
FROND_API frond_result frond_recommend(frond_model model, double error, double cpu, frond_advice* out);

#ifdef __cplusplus
}
#endif
#endif /* FROND_EXPERT_H */
