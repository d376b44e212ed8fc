/* frond_core.h - worlds, models and plants: all that a game calls. Include <frond/frond.h>, which holds the rules for
 * units, ownership, errors and threads.
 */
#ifndef FROND_CORE_H
#define FROND_CORE_H

#include "frond/frond_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- world --------------------------------------------------------------------------------------------- */

/* Runs job(data, i) for each i in 0 .. count-1, in any order, on any threads, the caller's among them, and returns when
 * all have ended, by the host's own threads. */
typedef void frond_job_fn(void* data, int index);
typedef void frond_parallel_for_fn(int count, frond_job_fn* job, void* data, void* user);

typedef struct frond_world_def {
    uint32_t cookie;         /* do not set */
    frond_vec3 gravity;      /* [m/s^2], default (0, -9.81, 0) */
    frond_effects effects;   /* a mask over every plant's, default FROND_EFFECT_ALL */
    double max_substep;      /* longest step that the solver takes [s], 1e-6 .. 1, default 1/60 */
    frond_response response; /* response of all contacts, default FROND_RESPONSE_IMPULSE */
    /* A plant falls asleep when no point of it has moved farther than this for half a period of its first mode, 0.5
     * to 3 s, and nothing that moves touches it [m], 0 .. 0.01, default 5e-5; 0: none sleeps. It then stands still and
     * costs nothing, until it is touched, pulled, bent or blown at, a pin or bond moves, or its neighbour leaves. */
    double sleep_distance;
    /* Threads for the steps of plants, each a job; results are equal to the bit for any number of them. Null (default):
     * Bullet's task scheduler, if the host has set one (btSetTaskScheduler), else the caller's thread alone. */
    frond_parallel_for_fn* parallel_for;
    void* parallel_user;
    frond_contact_tuning tuning; /* for comparisons */
} frond_world_def;

/* Trouble of a substep, bits of frond_report.trouble for a world and of frond_plant_get_trouble for a plant. */
enum {
    /* Cause: the linear solver or Newton hit its limit. Effect: the step is less accurate.
     * Remedy: raise linear_iterations or newton_iterations of the plant's tuning, or use FROND_LINEAR_SOLVER_BLOCK. */
    FROND_TROUBLE_NOT_CONVERGED = 1 << 0,
    /* Cause: a plant's state became non-finite or its system could not be solved. Effect: it was put back to its
     * last good state and brought to rest; or, where no step leads out of a shape that no admissible load can reach,
     * into its modelled shape, where it is held. Remedy: smaller steps, weaker forces. */
    FROND_TROUBLE_REWOUND = 1 << 1,
    /* Cause: a tet turned inside out. Effect: none that stays with FROND_MECHANICS_TET_COROTATIONAL. Remedy: smaller
     * steps. */
    FROND_TROUBLE_INVERTED = 1 << 2,
    /* Cause: a step gained energy that nothing gave. Effect: it was solved again with a line search, which costs many
     * times as much and may damp. Remedy: a shorter time step, or gentler pushes. */
    FROND_TROUBLE_RETRIED = 1 << 3,
    /* Cause: a kinematic body moved against a plant so far in one step that it came to a stem's axis, or against where
     * it is held, or pins moved by more than the plant's size. What is led, or heavy, pushes an organ with at most 34
     * times what carries and bends all that it bears, and what brings that to the body's speed. Effect: the body may
     * pass through the stem; the plant goes along with its pins as a whole. Remedy: shorter steps. */
    FROND_TROUBLE_PASSED = 1 << 4,
    /* Cause: parts of plants, or free bodies, moved against each other or what stands still so fast, or were pressed so
     * hard, that no response kept them apart. Effect: they went only a part of the step's way, pins as well, so that
     * nothing passed. Remedy: shorter steps. */
    FROND_TROUBLE_HELD_BACK = 1 << 5,
    /* Cause: a plant had more than 100 contacts with plants, as where cages were made in each other, or so much crossed
     * within a step that no response could account for all of it. Effect: the deepest 100 contacts push, or those that
     * meet first; a body, led or heavy, that crowds plants goes through, untouched until their boxes are apart. Remedy:
     * FROND_COLLISION_ORGANS, which touches at fewer places; shorter steps; a slower or smaller body. */
    FROND_TROUBLE_CROWDED = 1 << 6,
    /* Cause: the game's wind field gave a velocity that is not finite or beyond 1000 m/s. Effect: the air stood still
     * there for the step. Remedy: have the function of frond_world_set_wind_field write every velocity. */
    FROND_TROUBLE_BAD_WIND = 1 << 7,
    /* Bits of frond_plant_get_trouble alone: nothing went wrong, but more than its loads moved the plant. */
    /* Cause: the plant overlapped itself or another plant. Effect: it was moved apart, without velocity. Remedy: plants
     * that stand farther apart. */
    FROND_TROUBLE_PARTED = 1 << 8,
    /* Cause: organs in a cage were drawn out by more than 3 %. Effect: their fibres pulled, which takes more solves.
     * Remedy: rods, which keep their length by themselves. */
    FROND_TROUBLE_TAUT = 1 << 9,
    /* Cause: the viewer's distance or a budget changed the plant's detail, or a touch did. Effect: other mechanics took
     * over its shape and motion, and what they cannot have blends out within a second. Remedy: frond_world_set_detail
     * with other distances or without a budget. */
    FROND_TROUBLE_CHANGED_DETAIL = 1 << 10
};

/* Counts of the last substep. Times are in frond_profile (frond_expert.h). */
typedef struct frond_report {
    uint32_t trouble;                       /* FROND_TROUBLE_*, of all substeps of a step; attached: of the last */
    int plant_count, node_count, tet_count; /* in the world */
    int solver_iterations;                  /* iterations of all plants; a direct solve counts as one */
    double residual;                        /* largest relative residual of a linear solve [-] */
    double time;                            /* simulated [s] */
    int awake_count;                        /* plants that moved; the others slept */
    int broken_count;                       /* fragments that came off */
    int contact_count;                      /* points at which bodies touched plants */
    int plant_contact_count;                /* points at which plants touched plants, or themselves */
    frond_effects effects_run;              /* effects that ran */
    int detail_count[FROND_DETAIL_COUNT];   /* awake plants in each detail; a plant that sleeps is in none */
} frond_report;

typedef struct frond_ray_hit {
    frond_plant plant; /* null: nothing was hit */
    int capsule;       /* the plant's capsule that was hit */
    int node;          /* the cage node nearest to the point */
    frond_vec3 point;  /* [m] */
    double distance;   /* distance from the origin [m] */
} frond_ray_hit;

/* Returns the default settings of a world. */
static inline frond_world_def frond_default_world_def(void) {
    frond_world_def def;
    frond_fill_def(&def, FROND_DEF_COOKIE('W'));
    return def;
}
/* Makes an empty btMultiBodyDynamicsWorld that Frond owns. To use one that you have, see frond_bullet.hpp. */
FROND_API frond_result frond_world_create(const frond_world_def* def, frond_world* out);
/* Destroys a world with its plants and grabs. Null and stale handles are ignored. */
FROND_API void frond_world_destroy(frond_world world);
/* Returns whether a handle is of a world that exists. */
FROND_API bool frond_world_is_valid(frond_world world);
/* Advances a world by exactly dt [s], 0..1, in equal substeps no longer than max_substep, and up to four times as many
 * where a kinematic body goes farther than 5 cm past a plant in one: it is led evenly. The same calls give the same
 * bits. UNSUPPORTED for a world that was attached: its owner steps it. A step in which memory runs out, or a function
 * of the host throws, is aborted: plants that had not completed it are put back to its start, and the next step goes on
 * from there. */
FROND_API frond_result frond_world_step(frond_world world, double dt);
/* Sets gravity [m/s^2]. In an attached world this sets the host's own gravity, for its bodies too. Plants that sleep
 * wake. */
FROND_API frond_result frond_world_set_gravity(frond_world world, frond_vec3 gravity);
/* Sets a mask over every plant's effects. Plants that sleep wake. */
FROND_API frond_result frond_world_set_effects(frond_world world, frond_effects effects);
/* Sets which moment surfaces show, for pictures that are drawn between steps of a fixed length, so that steady motion
 * looks steady. frond_plant_get_surface then shows plants where they were between the last two substeps: fraction 1
 * (default) at the end of the last one, 0 at its beginning, linear between them and beyond, up to 2.
 * FROND_INTERPOLATION_AS_MOTION_STATES: where the motion states of a Bullet world have its bodies at the time of the
 * call. Everything else, frond_rigid_get_state too, is of the last substep's end. */
#define FROND_INTERPOLATION_AS_MOTION_STATES (-1.0)
FROND_API frond_result frond_world_set_interpolation(frond_world world, double fraction);
/* Reports what the last substep did. */
FROND_API frond_result frond_world_get_report(frond_world world, frond_report* out);
/* Returns the number of plants in a world; 0 for an invalid handle. */
FROND_API int frond_world_get_plant_count(frond_world world);
/* Copies the handles of a world's plants, in the order in which they were made. plant_count must be the world's; out:
 * plant_count. */
FROND_API frond_result frond_world_get_plants(frond_world world, frond_plant* out, int plant_count);
/* Moves the origin of a world to a point of it [m], so that coordinates stay small: `origin` is subtracted from all
 * positions of plants, grabs' targets and the viewer, and of the rigid bodies and robots that Frond made; gusts go on
 * where they were, and the wind's ground_height follows. Nothing wakes, and all goes on to rounding as it would have.
 * In a Bullet world of your own, shift your own bodies before its next step. */
FROND_API frond_result frond_world_shift_origin(frond_world world, frond_vec3 origin);
/* Finds the nearest plant along a ray, through Bullet's own ray test against the capsules. direction need not have
 * length one; max_distance [m] > 0. A miss is FROND_OK with a null out->plant. */
FROND_API frond_result frond_world_cast_ray(frond_world world, frond_vec3 origin, frond_vec3 direction,
                                            double max_distance, frond_ray_hit* out);

/* ---- events: what happened to plants ------------------------------------------------------------------------- */

/* Something that happened to a plant in a substep. */
typedef struct frond_event_info {
    frond_event event;
    double time;       /* at the substep's end [s] */
    frond_plant plant; /* events of a destroyed plant are dropped */
    int capsule;       /* the one that broke or was touched; -1 for other events */
    const void* body;  /* the one that touched it, as in frond_contact.body; null for other events */
    frond_plant other; /* the plant that touched it; null: a body */
} frond_event_info;

/* Returns how many events can be taken, 0 for invalid handles. A world keeps the last 65,536 from the first call on. */
FROND_API int frond_world_get_event_count(frond_world world);
/* Takes the events out of a world's list, in the order in which they happened: of all substeps since the last call.
 * event_count must be what frond_world_get_event_count returns; out: event_count. */
FROND_API frond_result frond_world_take_events(frond_world world, frond_event_info* out, int event_count);

/* ---- wind: the air of a world --------------------------------------------------------------------------------- */

/* A world has no air, which costs nothing, until it is given some here. Each segment of the chain then feels the air
 * that passes it: stems across their axes, blades along their normals as they are turned now, both by skin friction as
 * well. Forces follow the plant's velocity implicitly, so that a light leaf in a gale is stable at any time step.
 * Plants do not shelter each other, and there is no lift but that of a slanted blade. */

/* A mean wind, and gusts on it: velocities with Kaimal's spectra, f S(f) / sigma^2 = 4 n / (1 + 6 n)^(5/3) with
 * n = f L / U, and the coherence in space of IEC 61400-1, carried along by the mean wind (Taylor's hypothesis). They
 * are a function of place, time and seed and nothing else; a wind that is set anew while they blow takes them along.
 * Across the wind and upwards they have 0.8 and 0.5 times the standard deviation and a third and a twelfth of the
 * length scale that they have along it, as there. Height z [m] is against gravity, above the level of ground_height;
 * gusts grow with it as the mean does. */
typedef struct frond_wind_def {
    uint32_t cookie;     /* do not set */
    frond_vec3 velocity; /* mean, at reference_height [m/s], up to 200; default 0: still air */
    double turbulence;   /* standard deviation of gusts along the wind over the mean speed [-], 0..1, default 0.2 */
    double length_scale; /* L above, of gusts along the wind [m], 0.1 .. 1e4, default 20 */
    uint64_t seed;       /* seed of the gusts; default 1 */
    frond_wind_profile profile; /* default FROND_WIND_PROFILE_LOG */
    double reference_height;    /* [m], 0.01 .. 1e4, default 10 as weather stations have it */
    double roughness;           /* the ground's [m], 1e-6 .. half the reference height, default 0.03: open grassland */
    double exponent;            /* exponent of FROND_WIND_PROFILE_POWER [-], 0..1, default 1/7 */
    double ground_height;       /* height of the ground against gravity [m], default 0 */
    double density;             /* density of the air [kg/m^3], 0.01 .. 10, default 1.2 */
} frond_wind_def;

/* Gives the game's own wind: called once per plant and substep, by one thread at a time but by any that the world may
 * use; it has to depend on place and time alone. points: count of them, world frame [m]; time: of the substep's
 * end [s]. velocities [m/s]: what the world's frond_wind_def gives there, to be added to or replaced. */
typedef void frond_wind_field_fn(const frond_vec3* points, int count, double time, frond_vec3* velocities, void* user);

/* Returns the default settings of a wind: still air. */
static inline frond_wind_def frond_default_wind_def(void) {
    frond_wind_def def;
    frond_fill_def(&def, FROND_DEF_COOKIE('A'));
    return def;
}
/* Gives the world air, with a wind in it or still; a null def takes air and field away. Costs nothing where neither
 * FROND_EFFECT_WIND nor FROND_EFFECT_AIR_DRAG is on. */
FROND_API frond_result frond_world_set_wind(frond_world world, const frond_wind_def* def);
/* Sets the game's own wind; in a world without air it makes still air first. A null field leaves the air to the
 * frond_wind_def again. */
FROND_API frond_result frond_world_set_wind_field(frond_world world, frond_wind_field_fn* field, void* user);
/* Computes the velocity of the air at a point and the world's time [m/s], the game's field included; 0 in a world
 * without air. */
FROND_API frond_result frond_world_get_wind_at(frond_world world, frond_vec3 point, frond_vec3* out);

/* ---- model: shape at rest, built once, read-only, shared by many plants ------------------------------------ */

/* One set of physical constants for every mechanics, so that they can be compared. A field from `hollow` on that is
 * zero means "does not have it", so that a material of which only the first four are set is a solid, isotropic,
 * undamped and smooth one that never yields or breaks. A field out of its range is BAD_ARGUMENT with a text that names
 * it. */
typedef struct frond_material {
    double density;   /* density of the fresh tissue [kg/m^3], 1 .. 2e4 */
    double young;     /* along the organ [Pa], 1e3 .. 1e12 */
    double poisson;   /* [-], 0 .. 0.499 */
    double thickness; /* thickness of a blade, or of the wall of an organ drawn as an open sheet [m], 1e-6 .. 1 */
    /* Inner over outer radius of an organ that is a tube [-], 0 (solid) .. 0.98. `young` and `density` are then the
     * wall's. Blades and flowers, which are sheets, are never hollow. */
    double hollow;
    /* EI / GJ of the section: how much more easily the organ is twisted than bent [-]; EI is the mean of the two
     * principal bending stiffnesses. 0: as an isotropic section of its shape, which for a round one is 1 + poisson;
     * else 0.01 .. 100. */
    double twist_to_bend;
    /* Share of critical damping that the plant's first mode would have if all organs were of this material [-], 0 .. 1.
     * Each organ damps its own bending, in proportion to stiffness: a mode n times as fast as the plant's, such as a
     * leaf's own, has n times the ratio. frond_plant_def.material_damping scales it. */
    double damping_ratio;
    double friction; /* Coulomb's coefficient against what it touches [-], 0 .. 100 */
    /* Strain of the outermost fibre by bending beyond which a part of the deformation stays [-], 0 (never), else
     * 1e-6 .. 10. Sections then yield from the rim inwards, elastic and perfectly plastic. Rods do not yield along
     * their axis: tissue that is pulled breaks (`strength`) before it flows; tets yield by any strain but that of
     * volume. Where its own weight strains a plant by more than two thirds of this, one and a half times that strain
     * counts instead. */
    double yield_strain;
    /* Share of the elastic strain beyond yield_strain that becomes plastic per second [1/s], 0 (none) .. 1e6. */
    double creep_rate;
    /* Tension in the outermost fibre at which the organ breaks, in bending or in pulling [Pa], 0 (never),
     * else 1 .. 1e12. */
    double strength;
    /* Drag coefficient in air of the area that the organ turns to the flow [-]; 0: by its kind, 0.01 .. 10. Blades and
     * flowers are then flat plates of the organ's aspect, fruits spheres, crowns 0.4 and everything else a long
     * cylinder, both by Reynolds number (sources: plugin/src/plant/air_pieces.cpp). The skin's friction is added. */
    double drag;
    /* Diameter of a blade's round midrib over the blade's width [-], 0 (none) .. 0.5: a leaf drawn as a bare sheet is
     * carried by a rib that the file does not show. The presets of blades have 1/20 (maize: 4 mm of 80 mm). Blades and
     * flowers bend at least as stiffly as the rib, and twist by the sum of both; it adds no mass. */
    double midrib;
    /* Speed at which a body bounces off over that at which it came, at the place that it hits [-], 0 .. 1; times the
     * body's own, as Bullet does it. It counts above 0.5 m/s, with FROND_RESPONSE_IMPULSE, and not among plants. What
     * the plant gives back by its own spring comes on top. 0 in the presets. */
    double restitution;
} frond_material;
/* A material for the organs of one kind or name: see frond_model_def.organs. */
typedef struct frond_organ_material {
    const char* organ; /* the organ's name, or its kind: "stem", "blade" ... */
    frond_material material;
} frond_organ_material;
/* Returns the material that an organ of unknown kind has, a stem's: the preset "stem". */
FROND_API frond_material frond_default_material(void);
/* Looks up published values for the kinds "stem", "petiole", "blade", "midrib", "peduncle", "flower", "fruit",
 * "branch", "root", "tendril", "crown" (foliage drawn as a solid) and "support" (stakes, pots), and for "grass_stem",
 * "grass_blade" and "cereal_stem", given to stems and blades whose name or material names a grass or a small cereal.
 * Sources stand in plugin/src/skeleton/materials.cpp. BAD_ARGUMENT names the kinds there are. */
FROND_API frond_result frond_material_preset(const char* kind, frond_material* out);

/* What a person says about an organ where Frond's guess is wrong: see frond_model_def.corrections. */
typedef struct frond_organ_correction {
    const char* organ;  /* its name as Frond finds it without corrections: see frond_model_get_organ */
    const char* kind;   /* "stem", "blade" ..., with its preset, or "grass_blade"; null: as found */
    const char* parent; /* name of the organ that it grows out of, if it is a mesh of its own; null: as found */
    bool is_root;       /* it stands in the ground; if one organ is said to, the others do not */
    bool leave_out;     /* it is no part of the plant: neither simulated nor drawn */
} frond_organ_correction;

typedef struct frond_model_def {
    uint32_t cookie;        /* do not set */
    double scale;           /* metres per file unit; 0 (default) takes the file's own unit (glTF, FBX, DAE, OBJ with a
                             * comment that names it). Other files are in metres unless the plant would be shorter than
                             * 2 cm or taller than 120 m, as a herb than 6 m: then the unit that makes sense is taken,
                             * with a warning */
    frond_vec3 up;          /* the file's; (0,0,0) (default) takes what the file declares, else guesses +y or +z */
    double capsule_height;  /* h of the paper [m]; 0 chooses from the shape */
    double capsule_radius;  /* r of the paper [m]; 0 fits the shape */
    double cage_size;       /* wanted edge length of the cage's cells [m]; 0 chooses from the shape */
    double cage_offset;     /* how far the cage reaches outside the surface [m]; 0 is the default */
    double cage_smoothness; /* 0 cells as they are .. 1 (default 0.5) boundary drawn close to the surface */
    frond_rest rest; /* default FROND_REST_STANDS_AS_MODELLED; tets of the caller's are taken as without gravity */
    const frond_organ_material* organs; /* override presets, by organ name or kind; the last match wins; BAD_ARGUMENT
                                         * for one that no organ has. A young that is not the organ's own is taken
                                         * for measured, without a margin of stiffness and without hidden ribs, a
                                         * midrib likewise without those; no other number changes more than itself */
    int organ_count;
    /* Largest factor by which organs may be made stiffer than their materials so that the plant carries itself [-], 1
     * and more, default 3. Leaves first get the midribs that a file does not show. A plant that needs more is
     * BAD_GEOMETRY, with a text that names the organ and what to set; INFINITY takes any plant, with a warning. */
    double allow_stiffening;
    /* Corrections of organs, BAD_ARGUMENT for one of an organ that is not found. For mesh files they come on top of
     * those in a file (manual/import.md); scale and up here win over those there. Not for tets and .urdf. */
    const frond_organ_correction* corrections;
    int correction_count;
    const char* corrections_file; /* null (default): MESH.frond.json beside MESH.obj ..., if it is there; "": none */
} frond_model_def;

/* One tapered straight segment. parent is an index into the same array (smaller than its own), or -1 for a root. */
typedef struct frond_stem {
    int parent;
    frond_vec3 begin, end;           /* [m] */
    double radius_begin, radius_end; /* [m] */
} frond_stem;

/* Outlines of a stem's section. */
typedef enum frond_outline {
    FROND_OUTLINE_ROUND,     /* of the stem's radii */
    FROND_OUTLINE_RECTANGLE, /* of the given width and thickness; drawn and touched as round ones are */
    FROND_OUTLINE_COUNT
} frond_outline;

/* Section of a stem, where it is not a solid disk of its organ's material. All zero: it is that. A curved stem is a row
 * of straight ones. */
typedef struct frond_stem_section {
    frond_outline outline;
    double width, thickness; /* of a rectangle at the stem's begin, thickness the smaller one [m]; they taper with the
                              * radii */
    frond_vec3 thin;         /* direction of the thickness at the begin; its part along the stem does not count, and
                              * (0, 0, 0) leaves it open */
    double twist;            /* how far the section turns about the axis from begin to end [rad], -1000 .. 1000 */
    double hollow;           /* inner over outer size [-], 0 .. 0.98; 0: as the organ's material says. Exact for round
                              * sections, and for a rectangle's bending */
    double young_begin, young_end; /* Young's modulus at both ends, linear between [Pa]; 0: the material's */
} frond_stem_section;

typedef struct frond_model_info {
    /* surface */
    int vertex_count, triangle_count; /* counts of the render mesh */
    int part_count, texture_count, organ_count;
    int component_count;     /* parts of the surface that do not touch by sharing vertices */
    int joint_count;         /* places where the cage joins such components */
    int dropped_triangles;   /* triangles with bad indices, without area, or given twice */
    int repaired_vertices;   /* vertices that were not finite, or whose normals had to be made */
    double scale;            /* metres per file unit that was used */
    frond_vec3 up;           /* file axis that became +y */
    frond_vec3 lower, upper; /* bounding box [m] */
    /* cage */
    int node_count, tet_count;
    double min_dihedral, max_dihedral; /* over all tets [degree] */
    double min_volume;                 /* smallest tet [m^3] */
    double contained;         /* share of vertices that lie inside the cage [-]; the rest are attached from outside */
    double attachment_error;  /* largest distance of an attached vertex from its place at rest [m] */
    double volume;            /* volume of the cage [m^3] */
    double mass;              /* mass of the plant [kg] */
    double stiffening_factor; /* how much stiffer than its materials the plant was made so that it stands [-] */
    /* chain */
    int chain_node_count, capsule_count, root_count, fork_count;
    double chain_length; /* length of all capsules [m] */
    /* cost of building [ms] */
    double ms_import, ms_cage, ms_chain, ms_total;
} frond_model_info;

/* A run of triangles of one appearance and one organ. */
typedef struct frond_part {
    const char* name;     /* node or group in the file */
    const char* material; /* material in the file */
    const char* organ;    /* organ name that Frond gave it */
    const char* kind;     /* kind of organ: "stem", "blade" ... */
    int first_triangle, triangle_count;
    float color[4]; /* base colour, linear RGBA */
    int texture;    /* index of the base-colour texture, -1: none */
} frond_part;
/* A texture as in the file: the bytes of an image file (PNG, JPEG ...), to be decoded by the renderer. Frond looks at
 * its alpha only, at import: what that cuts out of a leaf weighs nothing, bends nothing and catches no wind. */
typedef struct frond_texture_view {
    const char* name; /* path or name in the file */
    const uint8_t* bytes;
    size_t byte_count;
} frond_texture_view;
/* An organ, and the ranges of its sections, one per capsule of the chain. Sections are the organ's own, of a rod or a
 * strip, not those of the cage around it, and their EI and GJ those by which a tapering capsule yields. A small organ
 * can lie within another one's capsules, and a rib drawn along a blade is one beam with it, counted in the blade's
 * sections; lengths and sections are then 0. */
typedef struct frond_organ {
    const char* name;        /* "leaf_3"; no two organs of a model share one */
    const char* kind;        /* "stem", "blade" ... */
    frond_material material; /* the preset of its kind, or what frond_model_def.organs put in its place */
    int capsule_count;
    double length;            /* length of its capsules [m] */
    double mass;              /* of all that is drawn of it; all together: the plant's mass [kg] */
    frond_range thickness;    /* outer size where the section is thinnest [m] */
    frond_range width;        /* outer size across that; of a blade as if it were laid flat [m] */
    frond_range area;         /* area of tissue: a tube's is its wall's [m^2] */
    frond_range bending_thin; /* EI against bending towards the thin side [N m^2] */
    frond_range bending_wide; /* EI against bending towards the wide side [N m^2] */
    frond_range torsion;      /* GJ [N m^2] */
    const char* why;  /* what speaks for its kind: "sheet of 0.1 by 0.03 m; named blade"; "" if the caller said so */
    double certainty; /* of its kind [-]; 0: another one is as likely, 1: nothing speaks for another one */
    int parent;       /* index of the organ that it grows out of; -1: it stands on the ground, or has no capsules */
} frond_organ;

/* Returns the default settings of a model. */
static inline frond_model_def frond_default_model_def(void) {
    frond_model_def def;
    frond_fill_def(&def, FROND_DEF_COOKIE('M'));
    return def;
}
/* Loads a model from a file: mesh files that assimp reads (.obj .ply .glb .gltf .fbx .dae .stl), tet meshes (.msh
 * .vtk), plants as links and joints (.urdf), and models that frond_model_save cooked, whatever their name. Files for
 * assimp and urdfdom are read in a process of their own with limits on time and memory, so that a damaged file cannot
 * bring down the program; tet meshes are lists of numbers, read here and checked one by one. */
FROND_API frond_result frond_model_load(const char* path, const frond_model_def* def, frond_model* out);
/* Makes a model from triangles, which may be a soup. xyz: vertex_count*3. indices: triangle_count*3, each in
 * 0..vertex_count-1. */
FROND_API frond_result frond_model_from_triangles(const float* xyz, int vertex_count, const int32_t* indices,
                                                  int triangle_count, const frond_model_def* def, frond_model* out);
/* Makes a model from a tree of tapered segments, and its surface with it. */
FROND_API frond_result frond_model_from_stems(const frond_stem* stems, int stem_count, const frond_model_def* def,
                                              frond_model* out);
/* Makes a model from a tree of tapered segments with sections of their own. sections: stem_count. */
FROND_API frond_result frond_model_from_stem_sections(const frond_stem* stems, const frond_stem_section* sections,
                                                      int stem_count, const frond_model_def* def, frond_model* out);
/* Makes a model from the caller's own tets, simulated as they are, node by node. xyz: node_count*3 [m]; tets:
 * tet_count*4, in either orientation. The surface is the tets' boundary. scale and up of the def apply, the cage fields
 * do not. */
FROND_API frond_result frond_model_from_tets(const double* xyz, int node_count, const int32_t* tets, int tet_count,
                                             const frond_model_def* def, frond_model* out);
/* Saves a model, cooked: with all that was built for it, so that frond_model_load has it in milliseconds, without the
 * program that reads meshes, and its plants move to the same bits. The file is the same on every system and for Bullet
 * in either precision. It holds the rest shapes of mechanics that plants of this model had so far and of the default
 * ones; others are found when a plant first needs them. A file that is damaged, or of a Frond that keeps models
 * otherwise, is refused by FILE_FORMAT; a def whose fields are not the default ones by BAD_ARGUMENT. */
FROND_API frond_result frond_model_save(frond_model model, const char* path);
/* Returns the size of what frond_model_save_bytes writes now [bytes]; 0 for an invalid handle. */
FROND_API size_t frond_model_get_saved_size(frond_model model);
/* Does the same as frond_model_save, in memory. size must be what frond_model_get_saved_size returns. */
FROND_API frond_result frond_model_save_bytes(frond_model model, void* bytes, size_t size);
/* Loads a model from the bytes of a file that frond_model_save wrote. */
FROND_API frond_result frond_model_load_bytes(const void* bytes, size_t size, frond_model* out);
/* Destroys a model; plants made from it keep what they need. Null and stale handles are ignored. */
FROND_API void frond_model_destroy(frond_model model);
/* Returns whether a handle is of a model that exists. */
FROND_API bool frond_model_is_valid(frond_model model);
/* Reports sizes, counts and quality of a model. */
FROND_API frond_result frond_model_get_info(frond_model model, frond_model_info* out);
/* Describes a part of the surface; part: 0 .. frond_model_info.part_count - 1. Strings live as long as the model. */
FROND_API frond_result frond_model_get_part(frond_model model, int part, frond_part* out);
/* Describes an organ; organ: 0 .. frond_model_info.organ_count - 1. Strings live as long as the model. */
FROND_API frond_result frond_model_get_organ(frond_model model, int organ, frond_organ* out);
/* Copies which organ each capsule of the chain belongs to, as frond_model_get_organ counts them; -1: to none.
 * capsule_count must be frond_model_info.capsule_count; out: capsule_count. */
FROND_API frond_result frond_model_get_capsule_organs(frond_model model, int32_t* out, int capsule_count);
/* Gives a texture of the surface; texture: 0 .. frond_model_info.texture_count - 1. Borrowed from the model. */
FROND_API frond_result frond_model_get_texture(frond_model model, int texture, frond_texture_view* out);

/* ---- plant: one instance, which moves ---------------------------------------------------------------------- */

typedef struct frond_plant_def {
    uint32_t cookie;           /* do not set */
    frond_vec3 position;       /* position of the model's origin [m] */
    frond_quat rotation;       /* need not have length one; default identity */
    frond_mechanics mechanics; /* default FROND_MECHANICS_TET_COROTATIONAL */
    /* Order of the displacements within a tet, 1 (default) or 2. Linear tets are quick but lock: a beam one cell
     * across, of cells five times as long as thick, bends by 3 % of what it should, for which a cage made by Frond is
     * calibrated and the caller's own tets are not. Quadratic tets have a node in the middle of each edge too and bend
     * such cells within 5 %, with some twenty times the work a step. Cages that Frond makes are fitted to their rods
     * anew when a plant first uses order 2, which takes some seconds. Chain mechanics move alike with both. */
    int element_order;
    frond_integrator integrator; /* default FROND_INTEGRATOR_BDF2 */
    double mass_damping;         /* Rayleigh: D = mass_damping M + stiffness_damping K [1/s], default 0.1 */
    double stiffness_damping;    /* [s], default 0.002 */
    double material_damping; /* how much of their materials' damping_ratio the organs have, on top of the two above [-],
                              * 0 (none) .. 100, default 1 */
    double root_height;      /* cage nodes lower than this above the plant's foot are pinned [m]; 0 (default) chooses
                              * from the shape; negative pins none. A node on an edge is pinned if both its ends are. */
    frond_effects effects;   /* default FROND_EFFECT_DEFAULT */
    /* Default FROND_COLLISION_ORGANS. Chain mechanics have no other; the caller's own tets always touch by their cage,
     * which is their true shape. */
    frond_collision collision;
    /* Starts asleep, as modelled, as if it had come to rest so: a field of thousands then costs no steps until
     * something moves them. Default false. */
    bool starts_asleep;
    /* Bullet's collision filter: the plant collides with what has a group in its mask and has its group in the own
     * mask, plants too. Default 1 and -1 (all). */
    int group, mask;
    void* user;          /* the caller's own, see frond_plant_get_user */
    frond_tuning tuning; /* for comparisons */
} frond_plant_def;

/* The render mesh in the world's frame, ready for vertex buffers. */
typedef struct frond_surface_view {
    const float* positions; /* vertex_count*3 [m] */
    const float* normals;   /* vertex_count*3, length one */
    const float* uvs;       /* vertex_count*2, or null */
    const uint8_t* colors;  /* vertex_count*4 RGBA, or null */
    const int32_t* indices; /* triangle_count*3 */
    int vertex_count, triangle_count;
} frond_surface_view;

/* A capsule as it is now in the world's frame. */
typedef struct frond_capsule {
    frond_vec3 begin, end; /* centres of the two half spheres [m] */
    double radius;         /* [m] */
} frond_capsule;

/* A point at which a body of the Bullet world, another plant or the plant itself touched a plant in the last substep,
 * or was about to. Each of two plants reports it; where a plant touches itself it is reported once. Plants that sleep
 * report the contacts with which they fell asleep. */
typedef struct frond_contact {
    frond_vec3 point;   /* point on the plant [m] */
    frond_vec3 normal;  /* direction from the body to the plant, length one */
    frond_vec3 impulse; /* impulse on the plant in that substep [N s]; the body got the opposite */
    double gap;         /* before the substep, below zero they overlapped [m] */
    int capsule;        /* the plant's; where plants touch, the one that the touching region of the cage belongs to */
    const void* body;   /* the btCollisionObject; borrowed from the host */
    frond_plant other;  /* the plant that touches it; null: a body */
} frond_contact;

/* Returns the default settings of a plant. */
static inline frond_plant_def frond_default_plant_def(void) {
    frond_plant_def def;
    frond_fill_def(&def, FROND_DEF_COOKIE('P'));
    return def;
}
/* Makes a plant, which stands in the world from its next step on, until it or the world is destroyed. It keeps what it
 * needs of the model. */
FROND_API frond_result frond_plant_create(frond_world world, frond_model model, const frond_plant_def* def,
                                          frond_plant* out);
/* Destroys a plant with its grabs. Null and stale handles are ignored. */
FROND_API void frond_plant_destroy(frond_plant plant);
/* Returns whether a handle is of a plant that exists. */
FROND_API bool frond_plant_is_valid(frond_plant plant);
/* Returns whether a plant is awake. False for stale handles, and for plants that sleep: see
 * frond_world_def.sleep_distance. */
FROND_API bool frond_plant_is_awake(frond_plant plant);
/* Gives what went wrong with a plant in the last substep, and what moved it without a force: bits FROND_TROUBLE_*. None
 * while it sleeps. */
FROND_API frond_result frond_plant_get_trouble(frond_plant plant, uint32_t* out);
/* Wakes a plant for a reason that Frond cannot see, such as a static body that was put elsewhere. */
FROND_API frond_result frond_plant_wake(frond_plant plant);
/* Returns frond_plant_def.user; null for an invalid handle. */
FROND_API void* frond_plant_get_user(frond_plant plant);
/* Gives the def with which a plant would be made as it is set now: with its position, rotation, mechanics, integrator
 * and effects of the last calls that set them. */
FROND_API frond_result frond_plant_get_def(frond_plant plant, frond_plant_def* out);
/* Puts a plant elsewhere [m] and turns it, with its shape, velocities, pins and fragments; rotation need not have
 * length one. A plant at rest stays at rest, unless gravity now acts from another side. Grabs and bonds hold it to
 * where they did. It wakes, and so does what leaned on it. */
FROND_API frond_result frond_plant_set_transform(frond_plant plant, frond_vec3 position, frond_quat rotation);
/* Puts a plant back to how frond_plant_create makes it with the def of frond_plant_get_def: as modelled, whole, at
 * rest, without plastic strain, pinned at its root, without forces, asleep if the def says so; from there its steps
 * give the same bits. Grabs and bonds stay, except that bonds on fragments have let go. */
FROND_API frond_result frond_plant_reset(frond_plant plant);
/* Switches what acts on this plant, which wakes; what is off costs nothing from the next step on. */
FROND_API frond_result frond_plant_set_effects(frond_plant plant, frond_effects effects);
/* Returns the number of cage nodes: those of frond_cage_view first, in their order; with element_order 2 one in the
 * middle of each edge follows, ordered by the edge's lower and then its higher node. 0 for an invalid handle. */
FROND_API int frond_plant_get_node_count(frond_plant plant);
/* Returns the number of capsules; 0 for an invalid handle. */
FROND_API int frond_plant_get_capsule_count(frond_plant plant);
/* Holds a cage node where it is. */
FROND_API frond_result frond_plant_pin(frond_plant plant, int node);
/* Lets a pinned cage node go. */
FROND_API frond_result frond_plant_unpin(frond_plant plant, int node);
/* Moves a pinned node [m] within the next step; of rods that one or two nodes hold, by at most half the mean length of
 * a capsule in each step. BAD_ARGUMENT if it is not pinned. */
FROND_API frond_result frond_plant_move_pin(frond_plant plant, int node, frond_vec3 position);
/* Adds a force [N] on a node for the next frond_world_step (all its substeps) only. Forces on one node add up. Where a
 * cage is softer in tension than its organ, as in leaves, the capsule nearest to the node bears force and moment. */
FROND_API frond_result frond_plant_add_force(frond_plant plant, int node, frond_vec3 force);
/* Gives the render mesh as it is now, made when it is requested, once a step; the arrays are the plant's own until
 * its next step. With FROND_EFFECT_SURFACE off, in the plant or its world, it stays as it was, and normals do with
 * FROND_EFFECT_NORMALS off. */
FROND_API frond_result frond_plant_get_surface(frond_plant plant, frond_surface_view* out);
/* Gives the positions that the surface had in the previous frame [m], vertex_count*3, for motion vectors: those that
 * frond_plant_get_surface showed last before the world stepped or was interpolated otherwise. The plant keeps them from
 * the first call on; that one, and the first after the plant was put elsewhere, gives the present positions. Borrowed
 * until the plant's next step. */
FROND_API frond_result frond_plant_get_previous_positions(frond_plant plant, const float** out);
/* Copies the capsules as they are now. capsule_count must be the plant's; out: capsule_count. */
FROND_API frond_result frond_plant_get_capsules(frond_plant plant, frond_capsule* out, int capsule_count);
/* Returns the number of contacts of the last substep; while the plant sleeps, of those with which it fell asleep. 0 for
 * an invalid handle. */
FROND_API int frond_plant_get_contact_count(frond_plant plant);
/* Copies the contacts of the last substep. contact_count must be the plant's; out: contact_count. */
FROND_API frond_result frond_plant_get_contacts(frond_plant plant, frond_contact* out, int contact_count);
/* Finds the highest point of the surface against gravity [m]. */
FROND_API frond_result frond_plant_get_tip(frond_plant plant, frond_vec3* out);

/* ---- detail: near plants in full, far ones for less ---------------------------------------------------------------
 * Call frond_world_set_viewer with the camera's place each frame: that is all. From the first call on plants are
 * simulated in the detail that their distance calls for, as frond_default_detail_def says. Places and velocities go on
 * without a jump: the difference to a shape that the other detail can have is blended out within a second. A body that
 * touches a plant in FROND_DETAIL_MODAL makes it rods at once. Which detail a plant has depends on the calls and on
 * nothing else, unless there is a budget. */

/* Returns the distance at which a plant is to count, given the distance to the viewer that counts otherwise [m] (with
 * by_size [-]): a game's own order of importance. Not finite or below zero counts as zero. */
typedef double frond_detail_fn(frond_plant plant, double distance, void* user);

typedef struct frond_detail_def {
    uint32_t cookie; /* do not set */
    /* From which distance of the plant's middle from the viewer on it has less detail [m], each 0 .. 1e9, none smaller
     * than the one before. */
    double rod_from;   /* default 5 */
    double half_from;  /* rods are stepped every second substep, by twice its length; default 12 */
    double modal_from; /* default 25; the air is queried every fourth substep, the plant drawn at each */
    double still_from; /* default 150 */
    bool by_size;      /* distances count in sizes of the plant, as it looks on the screen, not metres; default false */
    double hysteresis; /* share by which a plant has to come nearer to get detail back [-], 0 .. 0.9, default 0.15 */
    /* Time that a substep of all plants may take [ms], 0 .. 1e6; 0 (default): any. Plants then lose detail, those that
     * count as farthest first, as soon as more is measured, and get it back when there is time again. Results then
     * depend on the machine's speed. */
    double budget;
    frond_detail_fn* distance; /* null (default): the distance as it is */
    void* user;
} frond_detail_def;

/* Returns the default distances of detail. */
static inline frond_detail_def frond_default_detail_def(void) {
    frond_detail_def def;
    frond_fill_def(&def, FROND_DEF_COOKIE('D'));
    return def;
}
/* Sets the distances of detail; null: all plants in full again. Without a viewer, all are at distance zero. */
FROND_API frond_result frond_world_set_detail(frond_world world, const frond_detail_def* def);
/* Sets the viewer's place [m]. Begins with the default def where none was set. */
FROND_API frond_result frond_world_set_viewer(frond_world world, frond_vec3 position);
/* Gives the detail that the plant has now; for one that sleeps, the detail that it should have when it wakes. */
FROND_API frond_result frond_plant_get_detail(frond_plant plant, frond_detail* out);

/* ---- fragments: what broke off -----------------------------------------------------------------------------------
 * With FROND_EFFECT_BREAKING a plant breaks at the capsule whose outermost fibre is strained most, one a substep, if
 * that is more than its organ's strength / young and more than 1.5 times its strain as it stands. Rods distinguish
 * bending from pulling; in a cage a capsule that is pulled breaks at half its strength or more. The capsule and all
 * that grows beyond it become a rigid body with their mass and momentum. It is drawn in the plant's surface, its nodes,
 * capsules and vertices are reported where it is, grabs on it pull it, forces and pins on its nodes end. It collides
 * with other bodies and plants, and with what is left of its own plant once it has been free of that. Bonds on it let
 * go. Triangles across the break stay in the list, without area. */
typedef struct frond_fragment {
    frond_rigid rigid; /* owned by the plant and destroyed with it; frond_rigid_destroy ignores it */
    int capsule;       /* the one at which it came off */
    double mass;       /* [kg] */
} frond_fragment;
/* Returns the number of fragments; 0 for an invalid handle. */
FROND_API int frond_plant_get_fragment_count(frond_plant plant);
/* Describes a fragment, in the order in which they came off: 0 .. frond_plant_get_fragment_count - 1. */
FROND_API frond_result frond_plant_get_fragment(frond_plant plant, int fragment, frond_fragment* out);
/* Breaks a capsule whatever its strength and the effects: a harvest, or a plant that is restored. BAD_ARGUMENT if it
 * came off already or is a root of its own. To restore a plant, reset it, break it at the same capsules in their order,
 * then set its plastic state, its state and the states of its fragments. A fragment keeps the bend that it comes off
 * with; frond_plant_reset puts it back. */
FROND_API frond_result frond_plant_break(frond_plant plant, int capsule);

/* ---- grab: a spring between a point of a plant and a moving point, the mouse ---------------------------------- */

/* Takes hold of the surface vertex nearest to `point` [m]. stiffness [N/m] > 0. The target starts at that vertex. */
FROND_API frond_result frond_grab_create(frond_plant plant, frond_vec3 point, double stiffness, frond_grab* out);
/* Moves the target [m], to which the spring pulls, in the world. */
FROND_API frond_result frond_grab_move(frond_grab grab, frond_vec3 target);
/* Gives the point of the plant that is held now, the target [m], and the force on the plant, which is the stiffness
 * times the way from one to the other [N]. Any may be null. For a moment after a change of mechanics the vertex is
 * drawn elsewhere than it is held. */
FROND_API frond_result frond_grab_get(frond_grab grab, frond_vec3* point, frond_vec3* target, frond_vec3* force);
/* Lets go. Null and stale handles are ignored. */
FROND_API void frond_grab_destroy(frond_grab grab);
/* Returns whether a handle is of a grab that exists. */
FROND_API bool frond_grab_is_valid(frond_grab grab);

/* ---- rigid: bodies that plants touch, for those who have no Bullet world of their own ------------------------- */

typedef struct frond_rigid_state {
    frond_vec3 position;         /* position of the centre of mass [m] */
    frond_quat rotation;         /* need not have length one when it is set */
    frond_vec3 velocity;         /* [m/s] */
    frond_vec3 angular_velocity; /* [rad/s] */
} frond_rigid_state;

typedef struct frond_rigid_def {
    uint32_t cookie;         /* do not set */
    frond_shape shape;       /* default FROND_SHAPE_SPHERE */
    frond_vec3 size;         /* see FROND_SHAPES; default 0.1 each */
    double mass;             /* [kg]; default 1; 0: nothing moves it but frond_rigid_set_state */
    double friction;         /* default 0.5; Bullet multiplies it by the other body's or organ's */
    double restitution;      /* 0 (default) .. 1 [-]; Bullet multiplies it by the other body's or organ's */
    frond_rigid_state state; /* at the beginning; default at the origin, at rest */
} frond_rigid_def;

/* Returns the default settings of a rigid body. */
static inline frond_rigid_def frond_default_rigid_def(void) {
    frond_rigid_def def;
    frond_fill_def(&def, FROND_DEF_COOKIE('R'));
    return def;
}
/* Makes a rigid body in a world. */
FROND_API frond_result frond_rigid_create(frond_world world, const frond_rigid_def* def, frond_rigid* out);
/* Destroys a rigid body. Null and stale handles are ignored. It is destroyed with its world, too. */
FROND_API void frond_rigid_destroy(frond_rigid rigid);
/* Returns whether a handle is of a rigid body that exists. */
FROND_API bool frond_rigid_is_valid(frond_rigid rigid);
/* Gives position, rotation and velocities of a rigid body. */
FROND_API frond_result frond_rigid_get_state(frond_rigid rigid, frond_rigid_state* out);
/* Moves a rigid body: one without mass goes there within the next step and takes plants along; one with mass is
 * put there, with these velocities. BAD_ARGUMENT for a plane. */
FROND_API frond_result frond_rigid_set_state(frond_rigid rigid, const frond_rigid_state* state);
/* Returns the body as frond_contact.body names it; null for an invalid handle. */
FROND_API const void* frond_rigid_get_body(frond_rigid rigid);

/* ---- bond: a point of a plant held to a body: a fruit in a gripper, a pot that is carried --------------------- */

/* Holds the surface vertex nearest to `point` [m] to the place of the body where it is now, turning with the body.
 * Plant and body feel equal and opposite impulses, as contacts do (FROND_EFFECT_TWO_WAY; FROND_RESPONSE_NONE lets go).
 * One bond lets the plant turn about the point; three hold it completely: a plant in a pot has root_height -1 and
 * some bonds around its foot. A body that leaves the world no longer holds it. BAD_ARGUMENT unless both are of one
 * world. In a Bullet world of your own, see bond() in frond_bullet.hpp. */
FROND_API frond_result frond_bond_create(frond_plant plant, frond_vec3 point, frond_rigid rigid, frond_bond* out);
/* Gives the point of the plant that is held [m], and the force on the plant in the last substep [N]. Either may be
 * null. */
FROND_API frond_result frond_bond_get(frond_bond bond, frond_vec3* point, frond_vec3* force);
/* Destroys a bond. Null and stale handles are ignored. It is destroyed with its plant, too. */
FROND_API void frond_bond_destroy(frond_bond bond);
/* Returns whether a handle is of a bond that exists. */
FROND_API bool frond_bond_is_valid(frond_bond bond);

#ifdef __cplusplus
}
#endif
#endif /* FROND_CORE_H */
