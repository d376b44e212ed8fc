/* frond_types.h - version, results, handles, choices and plain values of Frond's C API. Include <frond/frond.h>, which
 * holds the rules for units, ownership, errors and threads.
 */
#ifndef FROND_TYPES_H
#define FROND_TYPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef FROND_API
#if defined(_WIN32) && defined(FROND_BUILDS)
#define FROND_API __declspec(dllexport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define FROND_API __attribute__((visibility("default")))
#else
#define FROND_API
#endif
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* ---- version ------------------------------------------------------------------------------------------- */

/* The only place that states the version; CMake reads it here. While the major version is 0, a new minor version may
 * change API and ABI, and the library's SOVERSION is 0.MINOR; from version 1 on a new major version may, and it is
 * MAJOR. A new patch version changes neither. */
#define FROND_VERSION_MAJOR 0
#define FROND_VERSION_MINOR 2
#define FROND_VERSION_PATCH 0
/* All three in one number, to be compared: 0x000200 is 0.2.0. */
#define FROND_VERSION (FROND_VERSION_MAJOR << 16 | FROND_VERSION_MINOR << 8 | FROND_VERSION_PATCH)

/* The same as text, "0.2.0". */
#define FROND_VERSION_STRING                \
    FROND_VERSION_TEXT(FROND_VERSION_MAJOR) \
    "." FROND_VERSION_TEXT(FROND_VERSION_MINOR) "." FROND_VERSION_TEXT(FROND_VERSION_PATCH)
#define FROND_VERSION_TEXT(number) FROND_VERSION_TEXT_OF(number)
#define FROND_VERSION_TEXT_OF(number) #number

/* Returns the library's version as text, "0.2.0"; borrowed, lives as long as the program. */
FROND_API const char* frond_version_string(void);

/* ---- results ------------------------------------------------------------------------------------------- */

/* One list gives the codes, frond_result_name() and the table in the manual. */
#define FROND_RESULTS(X)                                                                                \
    X(OK, "ok")                                                                                         \
    X(BAD_ARGUMENT, "an argument is null, not finite or out of range")                                  \
    X(BAD_HANDLE, "the handle is null, destroyed or of another kind")                                   \
    X(BAD_DEF, "the def was not made by its frond_default_*_def function, or by another version's one") \
    X(FILE_NOT_FOUND, "the file does not exist or cannot be read")                                      \
    X(FILE_FORMAT, "the file is damaged or in a format this build does not read")                       \
    X(BAD_GEOMETRY, "the geometry cannot be made into a body")                                          \
    X(UNSUPPORTED, "these options do not go together")                                                  \
    X(OUT_OF_MEMORY, "out of memory")                                                                   \
    X(INTERNAL, "a bug in frond, please report it")

#define FROND_RESULT_ENUM(code, text) FROND_RESULT_##code,
typedef enum frond_result {
    FROND_RESULTS(FROND_RESULT_ENUM) FROND_RESULT_COUNT,
    FROND_OK = FROND_RESULT_OK /* for short */
} frond_result;
#undef FROND_RESULT_ENUM

/* Returns a result's text in the table above, "ok"; "unknown result" when it is out of range. */
FROND_API const char* frond_result_name(frond_result result);
/* Returns the text of this thread's last failed call: what was wrong and what to do. Never null; "" if none failed yet.
 * Borrowed until the next failing call on this thread. */
FROND_API const char* frond_last_error(void);
/* Takes a warning; `message` is borrowed for the call. */
typedef void frond_log_fn(const char* message, void* user);
/* Sets where warnings go, from all threads. Null silences them. Default: stderr. */
FROND_API void frond_set_log(frond_log_fn* log, void* user);

/* ---- values and handles -------------------------------------------------------------------------------- */

typedef struct frond_vec3 {
    double x, y, z;
} frond_vec3;
typedef struct frond_quat {
    double x, y, z, w;
} frond_quat;
typedef struct frond_range {
    double lower, upper;
} frond_range;

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

/* Fills a def with its defaults. The frond_default_*_def functions call it with the def's kind and the version of the
 * header that the program was compiled with. A def of another version gets a cookie by which every function refuses it,
 * and nothing else is written: its layout may be another one. Null is ignored. */
FROND_API void frond_fill_def(void* def, uint32_t cookie);
#define FROND_DEF_COOKIE(kind) ((uint32_t)(kind) << 24 | (uint32_t)FROND_VERSION)

/* ---- choices ------------------------------------------------------------------------------------------- */

/* The effects that a scene pays for. An effect runs only if its bit is set on the world AND on the plant. */
#define FROND_EFFECTS(X)                                                                                            \
    X(GRAVITY, 0, "gravity")                                                                                        \
    X(DAMPING, 1, "damping")             /* mass_, stiffness_ and material_damping of the plant's def */            \
    X(USER_FORCE, 2, "user_force")       /* frond_plant_add_force and grabs */                                      \
    X(SURFACE, 3, "surface")             /* deform the render mesh */                                               \
    X(NORMALS, 4, "normals")             /* and its normals; needs FROND_EFFECT_SURFACE */                          \
    X(RIGID_CONTACT, 5, "rigid_contact") /* bodies of the Bullet world push the plant */                            \
    X(FRICTION, 6, "friction")           /* and rub on it; likewise plants on plants */                             \
    X(TWO_WAY, 7, "two_way")             /* and feel the same impulses; needs FROND_EFFECT_RIGID_CONTACT */         \
    X(PLASTICITY, 8, "plasticity")       /* deformation beyond an organ's yield_strain stays, and creeps */         \
    X(PLANT_CONTACT, 9, "plant_contact") /* plants push each other by their cages, where both have this bit. Plants \
                                          * that overlap when they are made come apart, slowly. */                  \
    X(SELF_CONTACT, 10, "self_contact")  /* parts of a plant push each other, except those that meet as modelled */ \
    X(BREAKING, 11, "breaking")          /* an organ that is bent or pulled beyond its strength breaks there: all   \
                                          * beyond comes off as a rigid body, and is still drawn with the plant */  \
    X(WIND, 12, "wind")                  /* the air's own motion pushes the plant, where the world has air:         \
                                          * frond_world_set_wind */                                                 \
    X(AIR_DRAG, 13, "air_drag")          /* the plant's own motion through the air is resisted */                   \
    X(FIBRES, 14, "fibres")              /* organs in a cage that is fatter than they are stretch by no more than   \
                                          * 3 % and what their tissue gives; the cage alone stretches like rubber.  \
                                          * Costs nothing while nothing is stretched. Chain mechanics need none,    \
                                          * FROND_MECHANICS_TET_LINEAR has none. */
typedef uint32_t frond_effects;
#define FROND_EFFECT_ENUM(code, bit, text) FROND_EFFECT_##code = 1 << bit,
#define FROND_EFFECT_ONE(code, bit, text) +1
enum {
    FROND_EFFECTS(FROND_EFFECT_ENUM) FROND_EFFECT_COUNT = 0 FROND_EFFECTS(FROND_EFFECT_ONE),
    FROND_EFFECT_ALL = (1 << FROND_EFFECT_COUNT) - 1,
    /* a plant's default; a world allows all */
    FROND_EFFECT_DEFAULT = FROND_EFFECT_ALL & ~(FROND_EFFECT_SELF_CONTACT | FROND_EFFECT_BREAKING)
};
#undef FROND_EFFECT_ENUM
#undef FROND_EFFECT_ONE

/* The mechanical model that moves a plant. Every model has a chain and a cage: with the tets the cage moves and the
 * chain follows, with the last two the chain moves and the cage follows. */
#define FROND_MECHANICS(X)                                                                                         \
    X(TET_LINEAR, "tet_linear")             /* the paper's equation (1): right for small deflections only */       \
    X(TET_COROTATIONAL, "tet_corotational") /* linear in each tet's own rotated frame: bends far */                \
    X(TET_NEOHOOKEAN, "tet_neohookean")     /* a rubber-like solid: right for large strains too */                 \
    X(ROD, "rod")                           /* beams with the organs' true sections: quickest, right for stems */  \
    X(SPRING_CHAIN, "spring_chain")         /* the paper's capsules joined by springs, driven by r and h; with the \
                                             * radii of the shape a plant sways as with rods, with others by r^4 */
#define FROND_MECHANICS_ENUM(code, text) FROND_MECHANICS_##code,
typedef enum frond_mechanics { FROND_MECHANICS(FROND_MECHANICS_ENUM) FROND_MECHANICS_COUNT } frond_mechanics;
#undef FROND_MECHANICS_ENUM

/* The formula that takes a step in time. */
#define FROND_INTEGRATORS(X)                                                                                        \
    X(IMPLICIT_EULER, "implicit_euler")       /* the paper's: one solve, damps vibration away within seconds */     \
    X(BDF2, "bdf2")                           /* one solve, uses one step before: keeps vibration, best per cost */ \
    X(SDIRK2, "sdirk2")                       /* two solves */                                                      \
    X(TR_BDF2, "tr_bdf2")                     /* two solves */                                                      \
    X(GENERALIZED_ALPHA, "generalized_alpha") /* iterated to convergence; spectral_radius sets damping */           \
    X(SYMPLECTIC_EULER, "symplectic_euler")   /* explicit: no solve, unstable but for tiny steps */
#define FROND_INTEGRATOR_ENUM(code, text) FROND_INTEGRATOR_##code,
typedef enum frond_integrator { FROND_INTEGRATORS(FROND_INTEGRATOR_ENUM) FROND_INTEGRATOR_COUNT } frond_integrator;
#undef FROND_INTEGRATOR_ENUM

/* How contacts push. */
#define FROND_RESPONSES(X)                                                                             \
    X(IMPULSE, "impulse") /* impulses that satisfy all contacts at once, with friction: exact */       \
    X(PENALTY, "penalty") /* a spring at each contact, stable however stiff: cheap, yields a little */ \
    X(NONE, "none")       /* contacts are reported but nothing pushes */
#define FROND_RESPONSE_ENUM(code, text) FROND_RESPONSE_##code,
typedef enum frond_response { FROND_RESPONSES(FROND_RESPONSE_ENUM) FROND_RESPONSE_COUNT } frond_response;
#undef FROND_RESPONSE_ENUM

/* How much of a plant is simulated, from most to least: see frond_world_set_detail. */
#define FROND_DETAILS(X)                                                                                   \
    X(FULL, "full")   /* the plant's own mechanics */                                                      \
    X(ROD, "rod")     /* rods, where the plant's own are tets */                                           \
    X(MODAL, "modal") /* the plant's two first natural modes, driven by the wind; a touch makes it rods */ \
    X(STILL, "still") /* comes to rest as modelled and stays there, asleep, whatever touches it or blows at it */
#define FROND_DETAIL_ENUM(code, text) FROND_DETAIL_##code,
typedef enum frond_detail { FROND_DETAILS(FROND_DETAIL_ENUM) FROND_DETAIL_COUNT } frond_detail;
#undef FROND_DETAIL_ENUM

/* The kinds of events of a plant: see frond_world_take_events. */
#define FROND_EVENTS(X)                                                                                           \
    X(BROKE, "broke")             /* a capsule broke, and a fragment came off */                                  \
    X(TOUCHED, "touched")         /* a body or another plant began to push it; of two plants each has an event */ \
    X(FELL_ASLEEP, "fell_asleep") /* it came to rest, and is not stepped any more */                              \
    X(WOKE, "woke")               /* it is stepped again */
#define FROND_EVENT_ENUM(code, text) FROND_EVENT_##code,
typedef enum frond_event { FROND_EVENTS(FROND_EVENT_ENUM) FROND_EVENT_COUNT } frond_event;
#undef FROND_EVENT_ENUM

/* The shape that a file shows. */
typedef enum frond_rest {
    FROND_REST_STANDS_AS_MODELLED, /* the plant as it stands under 9.81 m/s^2 along the model's -y; Frond finds the
                                    * shape without gravity */
    FROND_REST_WITHOUT_GRAVITY,    /* the plant as it would be without gravity, so that it droops */
    FROND_REST_COUNT
} frond_rest;

/* Shapes of rigid bodies, and what the three numbers of frond_rigid_def.size are [m]. All stand along their own y
 * axis. */
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

/* How the mean wind and its gusts grow with height: see frond_wind_def. */
typedef enum frond_wind_profile {
    FROND_WIND_PROFILE_UNIFORM,
    FROND_WIND_PROFILE_LOG,   /* ln(z / roughness) / ln(reference_height / roughness), 0 below the roughness */
    FROND_WIND_PROFILE_POWER, /* (z / reference_height)^exponent */
    FROND_WIND_PROFILE_COUNT
} frond_wind_profile;

/* The shape by which a plant touches other plants and itself. */
#define FROND_COLLISIONS(X)                                                            \
    X(ORGANS, "organs") /* its organs: blades as strips, the rest as thick as it is */ \
    X(CAGE, "cage")     /* the tets of its cage, as in the paper: some centimetres fatter, and dearer by far */
#define FROND_COLLISION_ENUM(code, text) FROND_COLLISION_##code,
typedef enum frond_collision { FROND_COLLISIONS(FROND_COLLISION_ENUM) FROND_COLLISION_COUNT } frond_collision;
#undef FROND_COLLISION_ENUM

/* Returns the short lower-case name of an effect's bit, "wind"; "?" of any other number. */
FROND_API const char* frond_effect_name(frond_effects effect);
/* Returns the short lower-case name of a mechanical model, "rod"; "?" when it is out of range. */
FROND_API const char* frond_mechanics_name(frond_mechanics mechanics);
/* Returns the short lower-case name of an integrator, "bdf2"; "?" when it is out of range. */
FROND_API const char* frond_integrator_name(frond_integrator integrator);
/* Returns the short lower-case name of a contact response, "impulse"; "?" when it is out of range. */
FROND_API const char* frond_response_name(frond_response response);
/* Returns the short lower-case name of a detail, "modal"; "?" when it is out of range. */
FROND_API const char* frond_detail_name(frond_detail detail);
/* Returns the short lower-case name of a shape by which plants touch, "organs"; "?" when it is out of range. */
FROND_API const char* frond_collision_name(frond_collision collision);
/* Returns the short lower-case name of an event, "woke"; "?" when it is out of range. */
FROND_API const char* frond_event_name(frond_event event);
/* Returns the short lower-case name of a rigid body's shape, "sphere"; "?" when it is out of range. */
FROND_API const char* frond_shape_name(frond_shape shape);

/* ---- tuning: for comparisons and experts; the defaults are right for plants ---------------------------------------
 */

/* How a linear system is solved. */
#define FROND_LINEAR_SOLVERS(X)                                                                                     \
    X(BLOCK, "block")                       /* Frond's own LDLT by dense fronts: exact and, for plants, quickest */ \
    X(DIRECT, "direct")                     /* sparse LDLT by Eigen: as exact; here for comparison */               \
    X(PCG_JACOBI, "pcg_jacobi")             /* the paper's conjugate gradients, preconditioned by the diagonal */   \
    X(PCG_BLOCK_JACOBI, "pcg_block_jacobi") /* by the 3x3 blocks of the diagonal */                                 \
    X(PCG_INCOMPLETE_CHOLESKY, "pcg_incomplete_cholesky") /* by factors without fill: fewest iterations */
#define FROND_LINEAR_SOLVER_ENUM(code, text) FROND_LINEAR_SOLVER_##code,
typedef enum frond_linear_solver {
    FROND_LINEAR_SOLVERS(FROND_LINEAR_SOLVER_ENUM) FROND_LINEAR_SOLVER_COUNT
} frond_linear_solver;
#undef FROND_LINEAR_SOLVER_ENUM
/* How mass is given to nodes: each its own, or shared with its neighbours as the elements' shape functions say. For
 * rods, "consistent" is the mean of both, whose frequencies are right to 0.5 % with ten segments (lumped: 2.5 % in the
 * third). */
#define FROND_MASSES(X) X(LUMPED, "lumped") X(CONSISTENT, "consistent")
#define FROND_MASS_ENUM(code, text) FROND_MASS_##code,
typedef enum frond_mass { FROND_MASSES(FROND_MASS_ENUM) FROND_MASS_COUNT } frond_mass;
#undef FROND_MASS_ENUM
/* How overlaps of cages are found. All layouts find the same ones. */
#define FROND_HASH_LAYOUTS(X)                                                                         \
    X(GRID, "grid")               /* a grid, only of those cells in which two plants are: quickest */ \
    X(PAPER, "paper")             /* the paper's table of n buckets over cells of size l */           \
    X(BRUTE_FORCE, "brute_force") /* everything with everything, to compare with */
#define FROND_HASH_LAYOUT_ENUM(code, text) FROND_HASH_LAYOUT_##code,
typedef enum frond_hash_layout { FROND_HASH_LAYOUTS(FROND_HASH_LAYOUT_ENUM) FROND_HASH_LAYOUT_COUNT } frond_hash_layout;
#undef FROND_HASH_LAYOUT_ENUM

/* A plant's solver; part of frond_plant_def. */
typedef struct frond_tuning {
    frond_linear_solver linear_solver; /* default FROND_LINEAR_SOLVER_BLOCK */
    int linear_iterations;             /* largest number, of an iterative linear solver, default 10000 */
    double linear_tolerance;           /* relative residual of an iterative linear solver [-], default 1e-6 */
    frond_mass mass;                   /* default FROND_MASS_LUMPED */
    int newton_iterations;             /* solves per step at most, 1 .. 100, default 1 */
    double newton_tolerance; /* stop when the residual force is below this share of the first one [-], default 1e-6 */
    double spectral_radius;  /* FROND_INTEGRATOR_GENERALIZED_ALPHA's at infinite frequency, 0 .. 1 [-], default 0.8: 1
                              * damps nothing, 0 most */
    /* A step is taken in 1, 2, 4 .. max_substeps (1 .. 64, default 1: always one, at no cost) equal parts, as few as
     * keep the error that the step adds to the position of any node below substep_tolerance (1e-9 .. 1, default 1e-4)
     * times the plant's size [-]. The error is estimated from how far nodes end from where their velocities and the
     * last change of these predicted; a step in which it is too large is taken again. While bodies touch it, a plant
     * takes whole steps. */
    int max_substeps;
    double substep_tolerance;
} frond_tuning;

/* A world's search for contacts, and its contact solver; part of frond_world_def. */
typedef struct frond_contact_tuning {
    frond_hash_layout hash_layout; /* default FROND_HASH_LAYOUT_GRID */
    int hash_table_size;       /* n of FROND_HASH_LAYOUT_PAPER, 0 .. 1e8; 0 (default): twice the number of entries */
    double hash_cell_size;     /* l [m], 0 .. 1e3; 0 (default) takes one and a half mean edges of the cages that touch,
                                * and never less than an eighth of one */
    int response_iterations;   /* rounds over all contacts at most, 1 .. 100000, default 200; fewer, but at least 10,
                                * where rounds times the square of the contacts that move each other exceed 5e7 */
    double response_tolerance; /* stop when no impulse changes by more than this share of the largest [-], 0 .. 1,
                                * default 1e-6 */
    double penalty_stiffness;  /* stiffness of FROND_RESPONSE_PENALTY per contact [N/m], 1e-6 .. 1e12, default 1000 */
} frond_contact_tuning;

/* Returns the short lower-case name of a linear solver, "block"; "?" when it is out of range. */
FROND_API const char* frond_linear_solver_name(frond_linear_solver solver);
/* Returns the short lower-case name of a mass matrix, "lumped"; "?" when it is out of range. */
FROND_API const char* frond_mass_name(frond_mass mass);
/* Returns the short lower-case name of a hash layout, "grid"; "?" when it is out of range. */
FROND_API const char* frond_hash_layout_name(frond_hash_layout layout);

#ifdef __cplusplus
}
#endif
#endif /* FROND_TYPES_H */
