/* frond.h - plants that bend, for worlds simulated by the Bullet physics engine. Compiles as C99 and as C++.
 *
 * This header is the manual. A plant is made in three steps: a *model* (shape and material, read-only, shared), a
 * *world* (a Bullet world; Frond makes one, or frond_bullet.hpp attaches to yours), and a *plant* (one instance that
 * moves).
 *
 * Units      SI everywhere: metre, kilogram, second, radian, newton, pascal.
 * Numbers    double in the simulation, float in what goes to a GPU. Right-handed. A model's own up axis is +y after
 *            import; in the world gravity alone decides what is down.
 * Defaults   Make every def with its frond_default_*_def(), then change fields.
 * Ownership  Each *_create, *_load or *_from_* has one *_destroy. Defs, arrays and strings passed in are copied.
 *            Pointers inside a *_view are borrowed: those of a model live as long as the model, those of a plant die at
 *            the next step or destroy.
 * Errors     Zero (FROND_OK) is success. On failure the call changed nothing, out parameters are zeroed, and
 *            frond_last_error() says what was wrong and what to do. Wrong input never aborts the program.
 * Threads    One world, one thread at a time. Different worlds may be used from different threads. Models are
 *            read-only and may be shared by all of them. Within a step a world may use threads that the host lends it:
 *            frond_world_def.parallel_for.
 */
#ifndef FROND_H
#define FROND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef FROND_API
#if defined(__GNUC__)
#define FROND_API __attribute__((visibility("default")))
#else
#define FROND_API
#endif
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* ---- results ------------------------------------------------------------------------------------------- */

/* One list gives the codes, frond_result_name() and the table in the manual. */
#define FROND_RESULTS(X)                                                          \
    X(OK, "ok")                                                                   \
    X(BAD_ARGUMENT, "an argument is null, not finite or out of range")            \
    X(BAD_HANDLE, "the handle is null, destroyed or of another kind")             \
    X(BAD_DEF, "the def was not made by its frond_default_*_def function")        \
    X(FILE_NOT_FOUND, "the file does not exist or cannot be read")                \
    X(FILE_FORMAT, "the file is damaged or in a format this build does not read") \
    X(BAD_GEOMETRY, "the geometry cannot be made into a body")                    \
    X(UNSUPPORTED, "these options do not go together")                            \
    X(OUT_OF_MEMORY, "out of memory")                                             \
    X(INTERNAL, "a bug in frond, please report it")

#define FROND_RESULT_ENUM(code, text) FROND_RESULT_##code,
typedef enum frond_result {
    FROND_RESULTS(FROND_RESULT_ENUM) FROND_RESULT_COUNT,
    FROND_OK = FROND_RESULT_OK
} frond_result;
#undef FROND_RESULT_ENUM

FROND_API const char* frond_version_string(void);
/* "ok", "an argument is null ...": the text of the table above. "unknown result" when out of range. */
FROND_API const char* frond_result_name(frond_result result);
/* Text of this thread's last failed call: what was wrong and what to do. Never null; "" if none failed yet.
 * Borrowed until the next failing call on this thread. */
FROND_API const char* frond_last_error(void);
typedef void frond_log_fn(const char* message, void* user);
/* Where warnings go. Null silences them. Default: stderr. */
FROND_API void frond_set_log(frond_log_fn* log, void* user);

/* ---- values and handles -------------------------------------------------------------------------------- */

typedef struct frond_vec3 {
    double x, y, z;
} frond_vec3;
typedef struct frond_quat {
    double x, y, z, w;
} frond_quat;

/* Handles are values. All-zero is null. A destroyed object's handle is recognised, never dereferenced. */
typedef struct frond_world {
    uint64_t id;
} frond_world;
typedef struct frond_model {
    uint64_t id;
} frond_model;
typedef struct frond_plant {
    uint64_t id;
} frond_plant;
typedef struct frond_grab {
    uint64_t id;
} frond_grab;
typedef struct frond_rigid {
    uint64_t id;
} frond_rigid;
typedef struct frond_bond {
    uint64_t id;
} frond_bond;

/* ---- choices ------------------------------------------------------------------------------------------- */

/* What a scene pays for. An effect runs only if its bit is set on the world AND on the plant. */
#define FROND_EFFECTS(X)                                                                                            \
    X(GRAVITY, 0, "gravity")                                                                                        \
    X(DAMPING, 1, "damping")             /* mass_, stiffness_ and material_damping of the plant's def */            \
    X(USER_FORCE, 2, "user_force")       /* frond_plant_add_force and grabs */                                      \
    X(SURFACE, 3, "surface")             /* deform the render mesh */                                               \
    X(NORMALS, 4, "normals")             /* and its normals; needs FROND_EFFECT_SURFACE */                          \
    X(RIGID_CONTACT, 5, "rigid_contact") /* bodies of the Bullet world push the plant */                            \
    X(FRICTION, 6, "friction")           /* and rub on it; likewise plants on plants */                             \
    X(TWO_WAY, 7, "two_way")             /* and feel the same impulses; needs FROND_EFFECT_RIGID_CONTACT */         \
    X(PLASTICITY, 8, "plasticity")       /* what is bent beyond its yield_strain keeps a set, and creeps */         \
    X(PLANT_CONTACT, 9, "plant_contact") /* plants push each other by their cages, where both have this bit. Those  \
                                          * that stand in each other when they are made come apart, slowly. */      \
    X(SELF_CONTACT, 10, "self_contact")  /* and parts of a plant do, but for those that meet as modelled */         \
    X(BREAKING, 11, "breaking")          /* what is bent or pulled beyond its strength breaks there: all beyond     \
                                          * comes off as a rigid body, and goes on being drawn with the plant. */   \
    X(WIND, 12, "wind")                  /* the air's own motion pushes the plant, where the world has air:         \
                                          * frond_world_set_wind */                                                 \
    X(AIR_DRAG, 13, "air_drag")          /* and the plant's own motion through the air is resisted */               \
    X(FIBRES, 14, "fibres")              /* organs in a cage that is fatter than they are are not drawn out by more \
                                          * than 3 % and what their tissue gives; their cage alone gives as rubber  \
                                          * does. Costs nothing while nothing is drawn out. Chains need none,       \
                                          * FROND_MECHANICS_TET_LINEAR has none. */
typedef uint32_t frond_effects;
#define FROND_EFFECT_ENUM(code, bit, text) FROND_EFFECT_##code = 1 << bit,
#define FROND_EFFECT_ONE(code, bit, text) +1
enum {
    FROND_EFFECTS(FROND_EFFECT_ENUM) FROND_EFFECT_COUNT = 0 FROND_EFFECTS(FROND_EFFECT_ONE),
    FROND_EFFECT_ALL = (1 << FROND_EFFECT_COUNT) - 1,
    /* of a plant; a world allows all */
    FROND_EFFECT_DEFAULT = FROND_EFFECT_ALL & ~(FROND_EFFECT_SELF_CONTACT | FROND_EFFECT_BREAKING)
};
#undef FROND_EFFECT_ENUM
#undef FROND_EFFECT_ONE
/* The name of one bit, "wind"; "?" of any other number. */
FROND_API const char* frond_effect_name(frond_effects effect);

/* What moves by itself. Every model has a chain and a cage: with the tets the cage moves and the chain follows, with
 * the last two the chain moves and the cage follows. */
#define FROND_MECHANICS(X)                                                                                         \
    X(TET_LINEAR, "tet_linear")             /* the paper's equation (1): right for small deflections only */       \
    X(TET_COROTATIONAL, "tet_corotational") /* linear in each tet's own rotated frame: bends far */                \
    X(TET_NEOHOOKEAN, "tet_neohookean")     /* a rubber-like solid: right for large strains too */                 \
    X(ROD, "rod")                           /* beams with the organs' true sections: quickest, right for stems */  \
    X(SPRING_CHAIN, "spring_chain")         /* the paper's capsules joined by springs, driven by r and h; with the \
                                             * radii of the shape a plant sways as with rods, with others by r^4 */
/* How a step in time is taken. */
#define FROND_INTEGRATORS(X)                                                                                  \
    X(IMPLICIT_EULER, "implicit_euler")       /* the paper's: one solve, damps sway away within seconds */    \
    X(BDF2, "bdf2")                           /* one solve, looks one step back: keeps sway, best per cost */ \
    X(SDIRK2, "sdirk2")                       /* two solves */                                                \
    X(TR_BDF2, "tr_bdf2")                     /* two solves */                                                \
    X(GENERALIZED_ALPHA, "generalized_alpha") /* iterated to convergence; spectral_radius sets damping */     \
    X(SYMPLECTIC_EULER, "symplectic_euler")   /* explicit: no solve, unstable but for tiny steps */
/* How a linear system is solved. */
#define FROND_LINEAR_SOLVERS(X)                                                                                     \
    X(BLOCK, "block")                       /* Frond's own LDLT by dense fronts: exact and, for plants, quickest */ \
    X(DIRECT, "direct")                     /* sparse LDLT by Eigen: as exact; here for comparison */               \
    X(PCG_JACOBI, "pcg_jacobi")             /* the paper's conjugate gradients, preconditioned by the diagonal */   \
    X(PCG_BLOCK_JACOBI, "pcg_block_jacobi") /* by the 3x3 blocks of the diagonal */                                 \
    X(PCG_INCOMPLETE_CHOLESKY, "pcg_incomplete_cholesky") /* by factors without fill: fewest iterations */
/* How mass is given to nodes: each its own, or shared with its neighbours as the elements' shape functions say. Of
 * rods, "consistent" is the mean of both, whose frequencies are right to 0.5 % with ten pieces (lumped: 2.5 % in the
 * third). */
#define FROND_MASSES(X) X(LUMPED, "lumped") X(CONSISTENT, "consistent")

/* How it is found out where cages are in each other. All of them find the same. */
#define FROND_HASH_LAYOUTS(X)                                                                         \
    X(GRID, "grid")               /* a grid of cells, only those in which two plants are: quickest */ \
    X(PAPER, "paper")             /* the paper's table of n buckets over cells of size l */           \
    X(BRUTE_FORCE, "brute_force") /* everything with everything, to compare with */
/* What contacts do. */
#define FROND_RESPONSES(X)                                                                             \
    X(IMPULSE, "impulse") /* impulses that fit together, with friction, as bodies answer: exact */     \
    X(PENALTY, "penalty") /* a spring at each contact, stable however stiff: cheap, yields a little */ \
    X(NONE, "none")       /* contacts are told but nothing pushes */

/* How much of a plant is simulated, from most to least: see frond_world_set_detail. */
#define FROND_DETAILS(X)                                                                           \
    X(FULL, "full")   /* the plant's own mechanics */                                              \
    X(ROD, "rod")     /* rods, where the plant's own are tets */                                   \
    X(MODAL, "modal") /* the plant's two first sways, driven by the wind; a touch makes it rods */ \
    X(STILL, "still") /* comes to rest as modelled and stays there, asleep, whatever touches or blows at it */

#define FROND_DETAIL_ENUM(code, text) FROND_DETAIL_##code,
typedef enum frond_detail { FROND_DETAILS(FROND_DETAIL_ENUM) FROND_DETAIL_COUNT } frond_detail;
#undef FROND_DETAIL_ENUM
#define FROND_MECHANICS_ENUM(code, text) FROND_MECHANICS_##code,
typedef enum frond_mechanics { FROND_MECHANICS(FROND_MECHANICS_ENUM) FROND_MECHANICS_COUNT } frond_mechanics;
#undef FROND_MECHANICS_ENUM
#define FROND_INTEGRATOR_ENUM(code, text) FROND_INTEGRATOR_##code,
typedef enum frond_integrator { FROND_INTEGRATORS(FROND_INTEGRATOR_ENUM) FROND_INTEGRATOR_COUNT } frond_integrator;
#undef FROND_INTEGRATOR_ENUM
#define FROND_LINEAR_SOLVER_ENUM(code, text) FROND_LINEAR_SOLVER_##code,
typedef enum frond_linear_solver {
    FROND_LINEAR_SOLVERS(FROND_LINEAR_SOLVER_ENUM) FROND_LINEAR_SOLVER_COUNT
} frond_linear_solver;
#undef FROND_LINEAR_SOLVER_ENUM
#define FROND_MASS_ENUM(code, text) FROND_MASS_##code,
typedef enum frond_mass { FROND_MASSES(FROND_MASS_ENUM) FROND_MASS_COUNT } frond_mass;
#undef FROND_MASS_ENUM
#define FROND_HASH_LAYOUT_ENUM(code, text) FROND_HASH_LAYOUT_##code,
typedef enum frond_hash_layout { FROND_HASH_LAYOUTS(FROND_HASH_LAYOUT_ENUM) FROND_HASH_LAYOUT_COUNT } frond_hash_layout;
#undef FROND_HASH_LAYOUT_ENUM
#define FROND_RESPONSE_ENUM(code, text) FROND_RESPONSE_##code,
typedef enum frond_response { FROND_RESPONSES(FROND_RESPONSE_ENUM) FROND_RESPONSE_COUNT } frond_response;
#undef FROND_RESPONSE_ENUM
/* Which shape the file shows: the plant as it stands under 9.81 m/s^2 along the model's -y, for which Frond finds the
 * shape without gravity, or as it would be without gravity, so that it droops. */
typedef enum frond_rest { FROND_REST_STANDS_AS_MODELLED, FROND_REST_WITHOUT_GRAVITY, FROND_REST_COUNT } frond_rest;

/* Short lower-case names, for reports. "?" when out of range. */
FROND_API const char* frond_mechanics_name(frond_mechanics mechanics);
FROND_API const char* frond_integrator_name(frond_integrator integrator);
FROND_API const char* frond_linear_solver_name(frond_linear_solver solver);
FROND_API const char* frond_mass_name(frond_mass mass);
FROND_API const char* frond_hash_layout_name(frond_hash_layout layout);
FROND_API const char* frond_response_name(frond_response response);
FROND_API const char* frond_detail_name(frond_detail detail);

/* ---- world --------------------------------------------------------------------------------------------- */

/* A host's own threads: runs job(data, i) for each i in 0 .. count-1, in any order, on any threads, the caller's among
 * them, and returns when all have ended. */
typedef void frond_job_fn(void* data, int index);
typedef void frond_parallel_for_fn(int count, frond_job_fn* job, void* data, void* user);

typedef struct frond_world_def {
    frond_vec3 gravity;    /* [m/s^2], default (0, -9.81, 0) */
    frond_effects effects; /* a mask over every plant's, default FROND_EFFECT_ALL */
    double max_substep;    /* longest step that the solver takes [s], 1e-6 .. 1, default 1/60 */
    /* Plants against plants and themselves. */
    frond_hash_layout hash_layout; /* default FROND_HASH_LAYOUT_GRID */
    int hash_table_size;   /* n of FROND_HASH_LAYOUT_PAPER, 0 .. 1e8; 0 (default) takes twice the number of things in it
                            */
    double hash_cell_size; /* l [m], 0 .. 1e3; 0 (default) takes one and a half mean edges of the cages that touch, and
                            * less than an eighth of one is not taken */
    /* All contacts. */
    frond_response response;   /* default FROND_RESPONSE_IMPULSE */
    int response_iterations;   /* rounds over all contacts at most, 1 .. 100000, default 200 */
    double response_tolerance; /* stop when no impulse changes by more than this share of the largest [-], 0 .. 1,
                                * default 1e-6 */
    double penalty_stiffness;  /* of FROND_RESPONSE_PENALTY, a contact [N/m], 1e-6 .. 1e12, default 1000 */
    /* A plant falls asleep when nothing of it has gone farther than this for half a period of its slowest sway, 0.5 to
     * 3 s, and nothing that moves touches it [m], 0 .. 0.01, default 5e-5; 0: none sleeps. It then stands still and
     * costs nothing, until it is touched, pulled, bent or blown at, a pin or bond moves, or its neighbour leaves. */
    double sleep_distance;
    /* Threads for the steps of plants, each a job; results are the same bits for any number of them. Null (default):
     * Bullet's task scheduler, if the host has set one (btSetTaskScheduler), else the caller's thread alone. */
    frond_parallel_for_fn* parallel_for;
    void* parallel_user;
    uint32_t cookie; /* do not set */
} frond_world_def;

/* What the last substep did and cost. Each bit of `trouble` has a cause, an effect and a remedy. */
enum {
    /* Cause: the linear solver or Newton hit its limit. Effect: the step is less accurate.
     * Remedy: raise max_iterations or newton_iterations, or use FROND_LINEAR_SOLVER_BLOCK. */
    FROND_TROUBLE_NOT_CONVERGED = 1 << 0,
    /* Cause: a plant's state became non-finite or its system could not be solved. Effect: it was put back to its
     * last good state and brought to rest; or, where no step leads out of a shape that nothing can have bent it to,
     * into its modelled shape, where it is held. Remedy: smaller steps, weaker forces. */
    FROND_TROUBLE_REWOUND = 1 << 1,
    /* Cause: a tet turned inside out. Effect: none lasting with FROND_MECHANICS_TET_COROTATIONAL. Remedy: smaller
       steps. */
    FROND_TROUBLE_INVERTED = 1 << 2,
    /* A step ran away and was solved again by implicit Euler with a line search, which costs several times as much and
     * damps. Remedy: a shorter time step, or gentler pushes. */
    FROND_TROUBLE_RETRIED = 1 << 3,
    /* Cause: the game's wind field gave a velocity that is not finite or beyond 1000 m/s. Effect: the air stood still
     * there for the step. Remedy: have the function of frond_world_set_wind_field write every velocity. */
    FROND_TROUBLE_BAD_WIND = 1 << 7
};
typedef struct frond_report {
    uint32_t trouble;
    int plant_count, node_count, tet_count; /* in the world */
    int solver_iterations;                  /* of all plants in the last substep; a direct solve counts as one */
    double residual;                        /* largest relative residual of a linear solve in the last substep [-] */
    double time;                            /* simulated [s] */
    int awake_count;                        /* plants that the last substep moved; the others slept */
    int broken_count;                       /* fragments that came off in the last substep */
    int contact_count;                      /* points at which bodies touched plants in the last substep */
    int plant_contact_count;                /* and plants touched plants, or themselves */
    /* Wall clock of the last substep [ms]: all of it, then its parts in the order in which they run. */
    double ms_step, ms_collide, ms_effects, ms_assembly, ms_solve, ms_response, ms_capsules, ms_surface;
    /* Of ms_collide, plants with plants: whose organs may meet, the spatial hash, tests and depths. */
    double ms_broad, ms_hash, ms_narrow;
    /* Effects that something was done for in the last substep, and the time each took, by bit [ms]. Gravity, damping,
     * friction and two-way impulses are part of what others solve: they have no time of their own and are 0. Where
     * plants are stepped by several threads the times of these add up, as those of assembly and solve do. */
    frond_effects effects_run;
    double ms_of_effect[FROND_EFFECT_COUNT];
    int detail_count[FROND_DETAIL_COUNT]; /* awake plants in each detail; a plant that sleeps is in none */
} frond_report;

typedef struct frond_ray_hit {
    frond_plant plant; /* null: nothing was hit */
    int capsule;       /* which of the plant's capsules */
    int node;          /* the cage node nearest to the point */
    frond_vec3 point;  /* [m] */
    double distance;   /* from the origin [m] */
} frond_ray_hit;

FROND_API frond_world_def frond_default_world_def(void);
/* Makes a btMultiBodyDynamicsWorld of its own with nothing in it. To use one that you have, see frond_bullet.hpp. */
FROND_API frond_result frond_world_create(const frond_world_def* def, frond_world* out);
/* Destroys its plants and grabs too. Null and stale handles are ignored. */
FROND_API void frond_world_destroy(frond_world world);
FROND_API bool frond_world_is_valid(frond_world world);
/* Advances by exactly dt [s], 0..1, in equal substeps no longer than max_substep. The same calls give the same bits.
 * UNSUPPORTED for a world that was attached: its owner steps it. A step in which memory runs out, or a function of the
 * host throws, is broken off: plants that were not done with it stand where it began, and the next one goes on. */
FROND_API frond_result frond_world_step(frond_world world, double dt);
/* [m/s^2]. Of an attached world this sets the host's own gravity, of its bodies too. Plants that sleep wake. */
FROND_API frond_result frond_world_set_gravity(frond_world world, frond_vec3 gravity);
/* A mask over every plant's effects, for all of them at once. Plants that sleep wake. */
FROND_API frond_result frond_world_set_effects(frond_world world, frond_effects effects);
/* For pictures that are drawn between steps of a fixed length, so that what moves evenly looks so.
 * frond_plant_get_surface then shows plants where they were between the last two substeps: fraction 1 (default) at the
 * end of the last one, 0 at its beginning, straight between and as far beyond, up to 2.
 * FROND_INTERPOLATION_AS_MOTION_STATES: whenever it is asked, where the motion states of a Bullet world have its
 * bodies. Everything else, frond_rigid_get_state too, tells of the last one's end. */
#define FROND_INTERPOLATION_AS_MOTION_STATES (-1.0)
FROND_API frond_result frond_world_set_interpolation(frond_world world, double fraction);
FROND_API frond_result frond_world_get_report(frond_world world, frond_report* out);
/* Equal for two worlds that simulated identically with the same binary. */
FROND_API frond_result frond_world_get_state_hash(frond_world world, uint64_t* out);
/* Nearest plant along a ray, through Bullet's own ray test against the capsules. direction need not have length one;
 * max_distance [m] > 0. A miss is FROND_OK with a null out->plant. */
FROND_API frond_result frond_world_cast_ray(frond_world world, frond_vec3 origin, frond_vec3 direction,
                                            double max_distance, frond_ray_hit* out);

/* ---- wind: the air of a world --------------------------------------------------------------------------------- */

/* A world has no air, which costs nothing, until it is given some here. Each piece of the chain then feels the air that
 * passes it: stems across their axes, blades along their normals as they are turned now, both by skin friction as well.
 * Forces follow the plant's velocity implicitly, so that a light leaf in a gale is stable at any time step. Plants do
 * not shelter each other, and there is no lift but that of a slanted blade. */

/* How the mean wind and its gusts grow with height: see frond_wind_def. */
typedef enum frond_wind_profile {
    FROND_WIND_PROFILE_UNIFORM,
    FROND_WIND_PROFILE_LOG,   /* ln(z / roughness) / ln(reference_height / roughness), 0 below the roughness */
    FROND_WIND_PROFILE_POWER, /* (z / reference_height)^exponent */
    FROND_WIND_PROFILE_COUNT
} frond_wind_profile;

/* A mean wind, and gusts on it: velocities with Kaimal's spectra, f S(f) / sigma^2 = 4 n / (1 + 6 n)^(5/3) with
 * n = f L / U, and the coherence in space of IEC 61400-1, carried along by the mean wind (Taylor's hypothesis). They
 * are a function of place, time and seed and nothing else; a wind that is set anew while they blow takes them along.
 * Across the wind and upwards they have 0.8 and 0.5 times the standard deviation and a third and a twelfth of the
 * length scale that they have along it, as there. Height z [m] is against gravity, above the level of ground_height;
 * gusts grow with it as the mean does. */
typedef struct frond_wind_def {
    frond_vec3 velocity; /* mean, at reference_height [m/s], up to 200; default 0: still air */
    double turbulence;   /* standard deviation of gusts along the wind over the mean speed [-], 0..1, default 0.2 */
    double length_scale; /* of gusts along the wind, L above [m], 0.1 .. 1e4, default 20 */
    uint64_t seed;       /* of the gusts; default 1 */
    frond_wind_profile profile; /* default FROND_WIND_PROFILE_LOG */
    double reference_height;    /* [m], 0.01 .. 1e4, default 10 as weather stations have it */
    double roughness;           /* of the ground [m], 1e-6 .. half the reference height, default 0.03: open grassland */
    double exponent;            /* of FROND_WIND_PROFILE_POWER [-], 0..1, default 1/7 */
    double ground_height;       /* of the ground against gravity [m], default 0 */
    double density;             /* of the air [kg/m^3], 0.01 .. 10, default 1.2 */
    uint32_t cookie;            /* do not set */
} frond_wind_def;

/* The game's own wind, asked once a plant and substep, from one thread at a time but from any that the world was lent;
 * it is to depend on place and time alone. points: count of them, world frame [m]; time: of the substep's
 * end [s]. velocities [m/s]: what the world's frond_wind_def gives there, to be added to or replaced. */
typedef void frond_wind_field_fn(const frond_vec3* points, int count, double time, frond_vec3* velocities, void* user);

FROND_API frond_wind_def frond_default_wind_def(void);
/* Gives the world air, with a wind in it or still; a null def takes air and field away. Costs nothing where neither
 * FROND_EFFECT_WIND nor FROND_EFFECT_AIR_DRAG is on. */
FROND_API frond_result frond_world_set_wind(frond_world world, const frond_wind_def* def);
/* In a world without air it makes still air first. A null field leaves the air to the frond_wind_def again. */
FROND_API frond_result frond_world_set_wind_field(frond_world world, frond_wind_field_fn* field, void* user);
/* Velocity of the air at a point and the world's time [m/s], the game's field included; 0 in a world without air. */
FROND_API frond_result frond_world_get_wind_at(frond_world world, frond_vec3 point, frond_vec3* out);

/* ---- model: shape at rest, built once, read-only, shared by many plants ------------------------------------ */

/* One set of physical constants for every mechanics, so that they can be compared. A field from `hollow` on that is
 * zero means "does not have it", so that a material of which only the first four are set is a solid, isotropic,
 * undamped and smooth one that never yields or breaks. A field out of its range is BAD_ARGUMENT with a text that names
 * it. */
typedef struct frond_material {
    double density;   /* of the fresh tissue [kg/m^3], 1 .. 2e4 */
    double young;     /* along the organ [Pa], 1e3 .. 1e12 */
    double poisson;   /* [-], 0 .. 0.499 */
    double thickness; /* of a blade, or the wall of what is drawn as an open sheet [m], 1e-6 .. 1 */
    /* Inner over outer radius of an organ that is a tube [-], 0 (solid) .. 0.98. `young` and `density` are then the
     * wall's. Blades and flowers, which are sheets, are never hollow. */
    double hollow;
    /* EI / GJ of the section: how much more easily the organ is twisted than bent [-]; EI is the mean of the two
     * principal bending stiffnesses. 0: as an isotropic section of its shape, which for a round one is 1 + poisson;
     * else 0.01 .. 100. */
    double twist_to_bend;
    /* Share of critical damping that the plant's first sway would have if all organs were of this material [-], 0 .. 1.
     * Each organ damps what bends in itself, in proportion to stiffness: what sways n times as fast as the plant, a
     * leaf on its own, has n times the ratio. frond_plant_def.material_damping scales it. */
    double damping_ratio;
    double friction; /* Coulomb's coefficient against what it touches [-], 0 .. 100 */
    /* Strain of the outermost fibre, in bending or in pulling, beyond which a part of the deformation stays [-], 0
     * (never), else 1e-6 .. 10. Sections then yield from the rim inwards, elastic and perfectly plastic. Where a plant
     * stands with more than two thirds of it under its own weight, one and a half times that counts instead. */
    double yield_strain;
    /* Share of the elastic strain beyond yield_strain that becomes lasting, a second [1/s], 0 (none) .. 1e6. */
    double creep_rate;
    /* Tension in the outermost fibre at which the organ breaks, in bending or in pulling [Pa], 0 (never),
     * else 1 .. 1e12. */
    double strength;
    /* Drag coefficient in air of the area that the organ turns to the flow [-]; 0: by its kind, 0.01 .. 10. Blades and
     * flowers are then flat plates of the organ's aspect, fruits spheres, crowns 0.4 and everything else a long
     * cylinder, both by Reynolds number (sources: plugin/src/plant/air_pieces.cpp). The skin's friction is added. */
    double drag;
} frond_material;
/* A material for the organs of one kind or name: see frond_model_def.organs. */
typedef struct frond_organ_material {
    const char* organ; /* the organ's name, or its kind: "stem", "blade" ... */
    frond_material material;
} frond_organ_material;
/* Published values for the kinds "stem", "petiole", "blade", "midrib", "peduncle", "flower", "fruit", "branch", "root",
 * "tendril", "crown" (foliage drawn as a solid) and "support" (stakes, pots), and for "grass_stem" and "grass_blade",
 * which stems and blades get whose name or material names a grass. Sources stand in plugin/src/model/materials.cpp.
 * BAD_ARGUMENT names the kinds there are. */
FROND_API frond_result frond_material_preset(const char* kind, frond_material* out);

typedef struct frond_model_def {
    double scale;           /* metres per file unit; 0 (default) trusts the file unless the plant would be shorter than
                             * 2 cm or taller than 50 m, then takes the unit that makes sense and warns */
    frond_vec3 up;          /* of the file; (0,0,0) (default) takes what the file declares, else guesses +y or +z */
    double capsule_height;  /* h of the paper [m]; 0 chooses from the shape */
    double capsule_radius;  /* r of the paper [m]; 0 fits the shape */
    double cage_size;       /* wanted edge length of the cage's cells [m]; 0 chooses from the shape */
    double cage_offset;     /* how far the cage reaches outside the surface [m]; 0 is the default */
    double cage_smoothness; /* 0 cells as they are .. 1 (default 0.5) boundary drawn close to the surface */
    frond_rest rest; /* default FROND_REST_STANDS_AS_MODELLED; tets of the caller's are taken as without gravity */
    const frond_organ_material* organs; /* override presets, by organ name or kind; the last match wins; BAD_ARGUMENT
                                         * for one that no organ has */
    int organ_count;
    uint32_t cookie; /* do not set */
} frond_model_def;

/* One tapered straight piece. parent is an index into the same array (smaller than its own), or -1 for a root. */
typedef struct frond_stem {
    int parent;
    frond_vec3 begin, end;           /* [m] */
    double radius_begin, radius_end; /* [m] */
} frond_stem;

typedef struct frond_model_info {
    /* surface */
    int vertex_count, triangle_count; /* of the render mesh */
    int part_count, texture_count, organ_count;
    int component_count;     /* pieces of surface that do not touch by sharing vertices */
    int joint_count;         /* places where the cage joins such pieces */
    int dropped_triangles;   /* with bad indices, without area, or given twice */
    int repaired_vertices;   /* not finite, or normals that had to be made */
    double scale;            /* metres per file unit that was used */
    frond_vec3 up;           /* file axis that became +y */
    frond_vec3 lower, upper; /* bounding box [m] */
    /* cage */
    int node_count, tet_count;
    double min_dihedral, max_dihedral; /* over all tets [degree] */
    double min_volume;                 /* smallest tet [m^3] */
    double contained;         /* share of vertices that lie inside the cage [-]; the rest are bound from outside */
    double attachment_error;  /* largest distance of a bound vertex from its place at rest [m] */
    double volume;            /* of the cage [m^3] */
    double mass;              /* of the plant [kg] */
    double stiffening_factor; /* how much stiffer than its materials the plant was made so that it stands [-] */
    /* chain */
    int chain_node_count, capsule_count, root_count, fork_count;
    double chain_length; /* of all capsules [m] */
    /* cost of building [ms] */
    double ms_import, ms_cage, ms_chain, ms_total;
} frond_model_info;

/* A run of triangles of one look and one organ. */
typedef struct frond_part {
    const char* name;     /* node or group in the file */
    const char* material; /* in the file */
    const char* organ;    /* organ name that Frond gave it */
    const char* kind;     /* kind of organ: "stem", "blade" ... */
    int first_triangle, triangle_count;
    float color[4]; /* base colour, linear RGBA */
    int texture;    /* index of the base-colour texture, -1: none */
} frond_part;
/* A texture as it came: the bytes of an image file (PNG, JPEG ...), to be decoded by the renderer. */
typedef struct frond_texture_view {
    const char* name; /* path or name in the file */
    const uint8_t* bytes;
    size_t byte_count;
} frond_texture_view;
typedef struct frond_range {
    double lower, upper;
} frond_range;
/* An organ, and between what its sections lie, one a capsule of the chain. They are those of the organ as it grew, a
 * rod or a strip, not of the cage around it. A small organ can lie within another one's capsules; all from
 * capsule_count on is then 0. */
typedef struct frond_organ {
    const char* name;        /* "leaf_3"; no two organs of a model share one */
    const char* kind;        /* "stem", "blade" ... */
    frond_material material; /* the preset of its kind, or what frond_model_def.organs put in its place */
    int capsule_count;
    double length;            /* of its capsules [m] */
    double mass;              /* of its sections times their lengths [kg] */
    frond_range thickness;    /* outer size where the section is thinnest [m] */
    frond_range width;        /* and across that; of a blade as if it were laid flat [m] */
    frond_range area;         /* of tissue: a tube's is its wall's [m^2] */
    frond_range bending_thin; /* EI against bending towards the thin side [N m^2] */
    frond_range bending_wide; /* EI against bending towards the wide side [N m^2] */
    frond_range torsion;      /* GJ [N m^2] */
} frond_organ;
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

FROND_API frond_model_def frond_default_model_def(void);
/* Mesh files that assimp reads (.obj .ply .glb .gltf .fbx .dae .stl), tet meshes (.msh .vtk) and plants as links and
 * joints (.urdf). What assimp and urdfdom read is read in a process of its own with limits on time and memory, so that
 * a damaged file cannot bring down the program; tet meshes are lists of numbers, read here and checked one by one. */
FROND_API frond_result frond_model_load(const char* path, const frond_model_def* def, frond_model* out);
/* xyz: vertex_count*3. indices: triangle_count*3, each in 0..vertex_count-1. The triangles may be a soup. */
FROND_API frond_result frond_model_from_triangles(const float* xyz, int vertex_count, const int32_t* indices,
                                                  int triangle_count, const frond_model_def* def, frond_model* out);
/* A tree of tapered pieces; the surface is made too. */
FROND_API frond_result frond_model_from_stems(const frond_stem* stems, int stem_count, const frond_model_def* def,
                                              frond_model* out);
/* The caller's own tets, simulated as they are, node by node. xyz: node_count*3 [m]; tets: tet_count*4, in either
 * orientation. The surface is the tets' boundary. scale and up of the def apply, the cage fields do not. */
FROND_API frond_result frond_model_from_tets(const double* xyz, int node_count, const int32_t* tets, int tet_count,
                                             const frond_model_def* def, frond_model* out);
/* Plants made from it keep what they need. Null and stale handles are ignored. */
FROND_API void frond_model_destroy(frond_model model);
FROND_API bool frond_model_is_valid(frond_model model);
FROND_API frond_result frond_model_get_info(frond_model model, frond_model_info* out);
FROND_API frond_result frond_model_get_part(frond_model model, int part, frond_part* out);
/* organ: 0 .. frond_model_info.organ_count - 1. */
FROND_API frond_result frond_model_get_organ(frond_model model, int organ, frond_organ* out);
FROND_API frond_result frond_model_get_texture(frond_model model, int texture, frond_texture_view* out);
FROND_API frond_result frond_model_get_cage(frond_model model, frond_cage_view* out);
FROND_API frond_result frond_model_get_chain(frond_model model, frond_chain_view* out);

/* ---- plant: one instance, which moves ---------------------------------------------------------------------- */

typedef struct frond_plant_def {
    frond_vec3 position;       /* of the model's origin [m] */
    frond_quat rotation;       /* need not have length one; default identity */
    frond_mechanics mechanics; /* default FROND_MECHANICS_TET_COROTATIONAL */
    /* Of the displacements within a tet, 1 (default) or 2. Linear tets are quick and lock: one cell across and five
     * times as long as thick bends 3 % of what it should, which a cage made by Frond is calibrated for and the caller's
     * own tets are not. Quadratic tets have a node in the middle of each edge too and bend such cells within 5 %, with
     * some twenty times the work a step. Cages that Frond makes are fitted to their rods anew when a plant
     * first asks for order 2, which takes some seconds. Chain mechanics move alike with both. */
    int element_order;
    frond_integrator integrator;       /* default FROND_INTEGRATOR_BDF2 */
    frond_linear_solver linear_solver; /* default FROND_LINEAR_SOLVER_BLOCK */
    frond_mass mass;                   /* default FROND_MASS_LUMPED */
    int newton_iterations;             /* solves per step at most, 1..100, default 1 */
    double newton_tolerance; /* stop when the residual force is below this share of the first one [-], default 1e-6 */
    int max_iterations;      /* of an iterative linear solver, default 10000 */
    double tolerance;        /* of an iterative linear solver, relative residual [-], default 1e-6 */
    /* A step is taken in 1, 2, 4 .. max_substeps (1 .. 64, default 1: always one, at no cost) equal parts, as few as
     * keep the error that the step adds to the place of any node below substep_tolerance (1e-9 .. 1, default 1e-4)
     * times the plant's size [-]. The error is told from how far nodes end from where their velocities and the last
     * change of these said; a step in which it is too large is taken again. While bodies touch it, a plant takes whole
     * steps. */
    int max_substeps;
    double substep_tolerance;
    double mass_damping;      /* Rayleigh: D = mass_damping M + stiffness_damping K [1/s], default 0.1 */
    double stiffness_damping; /* [s], default 0.002 */
    double material_damping; /* how much of their materials' damping_ratio the organs have, on top of the two above [-],
                              * 0 (none) .. 100, default 1 */
    double spectral_radius;  /* of FROND_INTEGRATOR_GENERALIZED_ALPHA at infinite frequency, 0..1 [-], default 0.8: 1
                              * damps  nothing, 0 most */
    double root_height;      /* cage nodes lower than this above the plant's foot are pinned [m]; 0 (default) chooses
                              * from the shape; negative pins none. A node on an edge is where both its ends are. */
    frond_effects effects;   /* default FROND_EFFECT_DEFAULT */
    /* Begins asleep, as modelled, as if it had come to rest so: a field of thousands then costs no steps until
     * something moves them. Default false. */
    bool starts_asleep;
    /* Of Bullet's collision filter: the plant meets what has a group in its mask and has its group in the own mask,
     * plants too. Default 1 and -1 (all). */
    int group, mask;
    void* user;
    uint32_t cookie; /* do not set */
} frond_plant_def;

typedef struct frond_energy {
    double kinetic, elastic, gravity; /* [J]; gravity is zero at the height of the world's origin */
} frond_energy;

/* The render mesh in the world's frame, ready for vertex buffers. */
typedef struct frond_surface_view {
    const float* positions; /* vertex_count*3 [m] */
    const float* normals;   /* vertex_count*3, length one */
    const float* uvs;       /* vertex_count*2, or null */
    const uint8_t* colors;  /* vertex_count*4 RGBA, or null */
    const int32_t* indices; /* triangle_count*3 */
    int vertex_count, triangle_count;
} frond_surface_view;

/* The capsules as they are now in the world's frame. */
typedef struct frond_capsule {
    frond_vec3 begin, end; /* centres of the two half spheres [m] */
    double radius;         /* [m] */
} frond_capsule;

/* A point at which a body of the Bullet world, another plant or the plant itself touched a plant in the last substep,
 * or was about to. Each of two plants tells of it; what touches itself does once. Plants that sleep tell those with
 * which they fell asleep. */
typedef struct frond_contact {
    frond_vec3 point;   /* on the plant [m] */
    frond_vec3 normal;  /* from the body to the plant, length one */
    frond_vec3 impulse; /* on the plant in that substep [N s]; the body got the opposite */
    double gap;         /* before the substep, below zero they overlapped [m] */
    int capsule;        /* of the plant; where plants touch, the one that the touching part of the cage belongs to */
    const void* body;   /* the btCollisionObject; borrowed from the host */
    frond_plant other;  /* the plant that it is; null: a body */
} frond_contact;

FROND_API frond_plant_def frond_default_plant_def(void);
/* Stands in the world from its next step on, until it or the world is destroyed. Keeps what it needs of the model. */
FROND_API frond_result frond_plant_create(frond_world world, frond_model model, const frond_plant_def* def,
                                          frond_plant* out);
/* Destroys its grabs too. Null and stale handles are ignored. */
FROND_API void frond_plant_destroy(frond_plant plant);
FROND_API bool frond_plant_is_valid(frond_plant plant);
/* False for stale handles, and for plants that sleep: see frond_world_def.sleep_distance. */
FROND_API bool frond_plant_is_awake(frond_plant plant);
/* For what Frond cannot see, such as a static body that was put elsewhere. */
FROND_API frond_result frond_plant_wake(frond_plant plant);
/* Null for an invalid handle. */
FROND_API void* frond_plant_get_user(frond_plant plant);
/* Switches what acts on this plant, which wakes; what is off costs nothing from the next step on. */
FROND_API frond_result frond_plant_set_effects(frond_plant plant, frond_effects effects);
/* Goes on with other mechanics, from the same shape and velocities: exactly between tets; between cage and chain as
 * near as the one can take the other's shape. What the plant stands on and is held by stays. */
FROND_API frond_result frond_plant_set_mechanics(frond_plant plant, frond_mechanics mechanics);
/* Goes on with another integrator, from the same shape and velocities. */
FROND_API frond_result frond_plant_set_integrator(frond_plant plant, frond_integrator integrator);
/* Of the cage, whatever moves: the nodes of frond_cage_view first, as they stand there; with element_order 2 one in the
 * middle of each edge follows, ordered by the edge's lower and then its higher node. 0 for an invalid handle. */
FROND_API int frond_plant_get_node_count(frond_plant plant);
FROND_API int frond_plant_get_capsule_count(frond_plant plant);
/* node_count must be the plant's. Either array may be null. positions [m], velocities [m/s], node_count*3, in the
 * world's frame. Setting moves pinned nodes too: they stay where they are put. Rods and springs take a shape of the
 * cage as near as they can; frond_snapshot.h keeps theirs to the bit. */
FROND_API frond_result frond_plant_get_state(frond_plant plant, double* positions, double* velocities, int node_count);
FROND_API frond_result frond_plant_set_state(frond_plant plant, const double* positions, const double* velocities,
                                             int node_count);
/* The plastic state, besides the state above: how many numbers that is, 0 as long as nothing has
 * yielded or for an invalid handle, and the numbers, of use only to another plant of the same model and mechanics,
 * broken at the same capsules. count must be what the first says, for set that of the plant they came from: 0 takes all
 * sets away. Tets hand them to other tets when mechanics change and the chain to the chain; between the two they are
 * lost. */
FROND_API int frond_plant_get_plastic_count(frond_plant plant);
FROND_API frond_result frond_plant_get_plastic(frond_plant plant, double* values, int count);
FROND_API frond_result frond_plant_set_plastic(frond_plant plant, const double* values, int count);
/* Holds a cage node where it is, or lets it go. */
FROND_API frond_result frond_plant_pin(frond_plant plant, int node);
FROND_API frond_result frond_plant_unpin(frond_plant plant, int node);
/* Moves a pinned node [m] within the next step. BAD_ARGUMENT if it is not pinned. */
FROND_API frond_result frond_plant_move_pin(frond_plant plant, int node, frond_vec3 position);
/* [N], for the next frond_world_step (all its substeps) only. Forces on one node add up. */
FROND_API frond_result frond_plant_add_force(frond_plant plant, int node, frond_vec3 force);
/* Of the plant as it is now. */
FROND_API frond_result frond_plant_get_energy(frond_plant plant, frond_energy* out);
/* Made when somebody asks for it, once a step; the arrays are the plant's own until its next step. With
 * FROND_EFFECT_SURFACE off, in the plant or its world, it stays as it was, and normals do with FROND_EFFECT_NORMALS
 * off. */
FROND_API frond_result frond_plant_get_surface(frond_plant plant, frond_surface_view* out);
/* capsule_count must be the plant's; out: capsule_count. */
FROND_API frond_result frond_plant_get_capsules(frond_plant plant, frond_capsule* out, int capsule_count);
/* How much the outermost fibre of each capsule's organ is drawn out or pressed by bending and pulling [-], against the
 * shape that it has without any load: what FROND_EFFECT_BREAKING compares with strength / young. 0 of what came off.
 * capsule_count must be the plant's; out: capsule_count. */
FROND_API frond_result frond_plant_get_strains(frond_plant plant, double* out, int capsule_count);
/* Number of contacts of the last substep, none while the plant sleeps; 0 for an invalid handle. */
FROND_API int frond_plant_get_contact_count(frond_plant plant);
/* contact_count must be the plant's; out: contact_count. */
FROND_API frond_result frond_plant_get_contacts(frond_plant plant, frond_contact* out, int contact_count);
/* Of the air on the whole plant, pinned nodes included, at the end of the last substep, in the world's frame [N]. */
FROND_API frond_result frond_plant_get_air_force(frond_plant plant, frond_vec3* out);
/* Of all nodes together, in the world's frame [kg m/s]. */
FROND_API frond_result frond_plant_get_momentum(frond_plant plant, frond_vec3* out);
/* The highest point of the surface against gravity [m]. */
FROND_API frond_result frond_plant_get_tip(frond_plant plant, frond_vec3* out);

/* ---- detail: near plants in full, far ones for less ---------------------------------------------------------------
 * Call frond_world_set_viewer with the camera's place each frame: that is all. From the first call on plants are
 * simulated in the detail that their distance asks for, as frond_default_detail_def says. Places and velocities go on
 * without a jump: what another detail cannot have of a plant's shape fades within a second. A body that touches a plant
 * in DETAIL_MODAL makes it rods at once. Which detail a plant has depends on the calls and on nothing else, unless
 * there is a budget. */

/* Says how far off a plant is to count, given the distance to the viewer that counts otherwise [m] (with by_size [-]):
 * a game's own order of importance. Not finite or below zero counts as zero. */
typedef double frond_detail_fn(frond_plant plant, double distance, void* user);

typedef struct frond_detail_def {
    /* From which distance of the plant's middle from the viewer on it has less detail [m], each 0 .. 1e9, none smaller
     * than the one before. */
    double rod_from;   /* default 5 */
    double half_from;  /* rods are stepped every second substep, by twice its length; default 12 */
    double modal_from; /* default 25; sways are told every fourth substep and drawn at each */
    double still_from; /* default 150 */
    bool by_size;      /* distances count in sizes of the plant, as it looks on the screen, not metres; default false */
    double hysteresis; /* share by which a plant has to come nearer to get detail back [-], 0 .. 0.9, default 0.15 */
    /* Time that a substep of all plants may take [ms], 0 .. 1e6; 0 (default): any. Plants then lose detail, those that
     * count as farthest first, as soon as more is measured, and get it back when there is time again. Results then
     * depend on the machine's speed. */
    double budget;
    frond_detail_fn* distance; /* null (default): as it is */
    void* user;
    uint32_t cookie; /* do not set */
} frond_detail_def;

FROND_API frond_detail_def frond_default_detail_def(void);
/* Null: all plants in full again. Without a viewer, all are at distance zero. */
FROND_API frond_result frond_world_set_detail(frond_world world, const frond_detail_def* def);
/* [m]. Begins with the default def where none was set. */
FROND_API frond_result frond_world_set_viewer(frond_world world, frond_vec3 position);
/* What the plant has now; one that sleeps gets what it should have when it wakes. */
FROND_API frond_result frond_plant_get_detail(frond_plant plant, frond_detail* out);

/* ---- fragments: what broke off -----------------------------------------------------------------------------------
 * With FROND_EFFECT_BREAKING a plant breaks at the capsule whose outermost fibre is strained most, one a substep, if
 * that is more than its organ's strength / young and more than 1.5 times what it stands with. Rods tell bending and
 * pulling apart; in a cage a capsule that is pulled breaks at half its strength or more. The capsule and all that grows
 * beyond it become a rigid body with their mass and momentum. It is drawn in the plant's surface, its nodes, capsules
 * and vertices are reported where it is, grabs on it pull it, forces and pins on its nodes end; other bodies and plants
 * feel it, its own plant does not, which takes no part in FROND_EFFECT_PLANT_CONTACT and FROND_EFFECT_SELF_CONTACT any
 * more. Bonds on it let go. Triangles across the break keep their place in the list, without area. */
typedef struct frond_fragment {
    frond_rigid rigid; /* the plant's: it ends with it, and frond_rigid_destroy leaves it alone */
    int capsule;       /* at which it came off */
    double mass;       /* [kg] */
} frond_fragment;
/* In the order in which they came off; 0 for an invalid handle. */
FROND_API int frond_plant_get_fragment_count(frond_plant plant);
FROND_API frond_result frond_plant_get_fragment(frond_plant plant, int fragment, frond_fragment* out);
/* Breaks a capsule whatever its strength and the effects: a harvest, or a plant that is restored. BAD_ARGUMENT if it
 * came off already or is a root of its own. */
FROND_API frond_result frond_plant_break(frond_plant plant, int capsule);
/* Puts all fragments back: the plant is as modelled, at rest, without sets; pins on nodes that had come off stay away.
 * To restore a plant, reset it, break it at the same capsules in their order, then set its plastic state, its state
 * and the states of its fragments. A fragment keeps the bend that it comes off with. */
FROND_API frond_result frond_plant_reset(frond_plant plant);

/* ---- grab: a spring between a point of a plant and a moving point, the mouse ---------------------------------- */

/* Takes hold of the surface vertex nearest to `point` [m]. stiffness [N/m] > 0. The target starts at that vertex. */
FROND_API frond_result frond_grab_create(frond_plant plant, frond_vec3 point, double stiffness, frond_grab* out);
/* Where it pulls to [m], in the world. */
FROND_API frond_result frond_grab_move(frond_grab grab, frond_vec3 target);
/* Where it holds the plant now, where it pulls to [m], and with what force on the plant [N]. Any may be null. */
FROND_API frond_result frond_grab_get(frond_grab grab, frond_vec3* point, frond_vec3* target, frond_vec3* force);
/* Lets go. Null and stale handles are ignored. */
FROND_API void frond_grab_destroy(frond_grab grab);
FROND_API bool frond_grab_is_valid(frond_grab grab);

/* ---- rigid: bodies that plants touch, for those who have no Bullet world of their own ------------------------- */

/* What the three numbers of frond_rigid_def.size are [m]. All stand along their own y axis. */
#define FROND_SHAPES(X)                                                                     \
    X(SPHERE, "sphere")     /* radius */                                                    \
    X(BOX, "box")           /* half extents */                                              \
    X(CAPSULE, "capsule")   /* radius, half the length between the half spheres' centres */ \
    X(CYLINDER, "cylinder") /* radius, half the length */                                   \
    X(CONE, "cone")         /* radius, half the height */                                   \
    X(PLANE, "plane")       /* none: all below its origin; does not move */
#define FROND_SHAPE_ENUM(code, text) FROND_SHAPE_##code,
typedef enum frond_shape { FROND_SHAPES(FROND_SHAPE_ENUM) FROND_SHAPE_COUNT } frond_shape;
#undef FROND_SHAPE_ENUM

typedef struct frond_rigid_state {
    frond_vec3 position;         /* of the centre of mass [m] */
    frond_quat rotation;         /* need not have length one when it is set */
    frond_vec3 velocity;         /* [m/s] */
    frond_vec3 angular_velocity; /* [rad/s] */
} frond_rigid_state;

typedef struct frond_rigid_def {
    frond_shape shape;       /* default FROND_SHAPE_SPHERE */
    frond_vec3 size;         /* see FROND_SHAPES; default 0.1 each */
    double mass;             /* [kg]; default 1; 0: nothing moves it but frond_rigid_set_state */
    double friction;         /* default 0.5; Bullet multiplies it by the other body's or organ's */
    frond_rigid_state state; /* at the beginning; default at the origin, at rest */
    uint32_t cookie;         /* do not set */
} frond_rigid_def;

FROND_API const char* frond_shape_name(frond_shape shape);
FROND_API frond_rigid_def frond_default_rigid_def(void);
FROND_API frond_result frond_rigid_create(frond_world world, const frond_rigid_def* def, frond_rigid* out);
/* Null and stale handles are ignored. Its world's end is its end. */
FROND_API void frond_rigid_destroy(frond_rigid rigid);
FROND_API bool frond_rigid_is_valid(frond_rigid rigid);
FROND_API frond_result frond_rigid_get_state(frond_rigid rigid, frond_rigid_state* out);
/* A body without mass is carried there within the next step and takes plants along; one with mass is put there, with
 * these velocities. BAD_ARGUMENT for a plane. */
FROND_API frond_result frond_rigid_set_state(frond_rigid rigid, const frond_rigid_state* state);
/* As frond_contact.body names it. Null for an invalid handle. */
FROND_API const void* frond_rigid_get_body(frond_rigid rigid);

/* ---- bond: a point of a plant held to a body: a fruit in a gripper, a pot that is carried --------------------- */

/* Holds the surface vertex nearest to `point` [m] to the place of the body where it is now, turning with the body.
 * Plant and body feel equal and opposite impulses, as contacts do (FROND_EFFECT_TWO_WAY; FROND_RESPONSE_NONE lets go).
 * One bond lets the plant turn about the point; three hold it in every way: a plant in a pot has root_height -1 and
 * some bonds around its foot. A body that leaves the world holds nothing any more. Both of one world, or BAD_ARGUMENT.
 * In a Bullet world of your own, see bond() in frond_bullet.hpp. */
FROND_API frond_result frond_bond_create(frond_plant plant, frond_vec3 point, frond_rigid rigid, frond_bond* out);
/* Where on the plant it holds [m], and with what force on the plant in the last substep [N]. Either may be null. */
FROND_API frond_result frond_bond_get(frond_bond bond, frond_vec3* point, frond_vec3* force);
/* Null and stale handles are ignored. Its plant's end is its end. */
FROND_API void frond_bond_destroy(frond_bond bond);
FROND_API bool frond_bond_is_valid(frond_bond bond);

/* ---- advice: which settings for which accuracy -------------------------------------------------------------- */

typedef struct frond_advice {
    frond_plant_def plant; /* the default one with mechanics and integrator set */
    double cage_size;      /* for a frond_model_def [m]; 0: the cage does not matter */
    double capsule_height; /* for a frond_model_def [m]; 0: the chain does not matter */
    double time_step;      /* at most; for frond_world_step or frond_world_def.max_substep [s] */
    double error;          /* to expect of the tip, rms over two periods of a sway, over its peak [-] */
    double cpu;            /* to expect: CPU seconds a simulated second, on the processor of the table */
} frond_advice;

/* Settings for a model from a table of measured ones (plugin/src/api/recommend_front.inc, made by `frond study sway
 * --advice`), brought to its length, its first sway and its number of capsules or tets. Either error or cpu is above
 * zero: with `error`, 0..1, the cheapest settings that are as accurate; with `cpu` the most accurate that cost no more.
 * Build the model anew with the sizes that come back. UNSUPPORTED, with a text that names what there is, if no settings
 * do. */
FROND_API frond_result frond_recommend(frond_model model, double error, double cpu, frond_advice* out);

#ifdef __cplusplus
}
#endif
#endif /* FROND_H */
