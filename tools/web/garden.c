/* garden: a world with plants for a page. In: scenes, drags, wind and settings. Out: surfaces to draw, times of stages.
 * All of it by plain numbers and pointers, as a script calls it. */
#include "garden.h"

#include <frond/frond.h>
#include <math.h>
#include <stdlib.h>

#ifdef __EMSCRIPTEN__
#include <emscripten/emscripten.h>
#else
#define EMSCRIPTEN_KEEPALIVE
#endif

#define MOST_PLANTS 400
#define MOST_BALLS 40

static struct {
    frond_model models[MODEL_COUNT];
    frond_world world;
    frond_plant plants[MOST_PLANTS];
    frond_rigid balls[MOST_BALLS], walker;
    frond_grab grab;
    int plant_count, ball_count, model, failed, threads;
    frond_mechanics mechanics;
    frond_integrator integrator;
    frond_effects effects;
    double wind, grab_distance;
    frond_vec3 walker_at;
} garden;

/* Remembers that a call failed; its text is frond_last_error()'s. */
static int check(frond_result result) {
    if (result != FROND_OK) garden.failed = 1;
    return result == FROND_OK;
}

EMSCRIPTEN_KEEPALIVE int garden_failed(void) {
    const int failed = garden.failed;
    garden.failed = 0;
    return failed;
}
EMSCRIPTEN_KEEPALIVE const char* garden_error(void) {
    return frond_last_error();
}

/* Takes a cooked model. */
EMSCRIPTEN_KEEPALIVE double garden_take_model(int which, const void* bytes, size_t size) {
    frond_model_info info;
    frond_model_destroy(garden.models[which]);
    if (!check(frond_model_load_bytes(bytes, size, &garden.models[which]))) return -1;
    return check(frond_model_get_info(garden.models[which], &info)) ? info.ms_total : -1;
}

/* Sets the number of threads of the worlds that are opened next. */
EMSCRIPTEN_KEEPALIVE void garden_set_threads(int count) {
    garden.threads = count;
}

static void blow(void) {
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity.x = garden.wind;
    check(frond_world_set_wind(garden.world, garden.wind > 0 ? &wind : NULL));
}

static void plant(double x, double z, double turn) {
    frond_plant_def def = frond_default_plant_def();
    def.position.x = x;
    def.position.z = z;
    def.rotation.y = sin(0.5 * turn);
    def.rotation.w = cos(0.5 * turn);
    def.mechanics = garden.mechanics;
    def.integrator = garden.integrator;
    def.effects = garden.effects;
    if (garden.plant_count < MOST_PLANTS &&
        check(frond_plant_create(garden.world, garden.models[garden.model], &def, &garden.plants[garden.plant_count])))
        garden.plant_count++;
}

static void place_ground(void) {
    frond_rigid_def ground = frond_default_rigid_def();
    frond_rigid made;
    ground.shape = FROND_SHAPE_PLANE;
    ground.mass = 0;
    check(frond_rigid_create(garden.world, &ground, &made));
}

static void place_walker(void) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_CAPSULE;
    def.size.x = 0.25;
    def.size.y = 0.6;
    def.mass = 0;
    garden.walker_at.x = -2.5;
    garden.walker_at.y = 0.86;
    def.state.position = garden.walker_at;
    check(frond_rigid_create(garden.world, &def, &garden.walker));
}

/* Opens a scene in place of the last one; returns the number of plants. mechanics, integrator: as in frond_types.h. */
EMSCRIPTEN_KEEPALIVE int garden_open(int scene, int mechanics, int integrator, uint32_t effects, double wind,
                                     int plants) {
    frond_world_def def = frond_default_world_def();
    int i;
    def.parallel_for = garden_threads(garden.threads);
    frond_world_destroy(garden.world);
    garden.plant_count = garden.ball_count = 0;
    garden.walker.id = garden.grab.id = 0;
    garden.model = scene == SCENE_CUCUMBER ? MODEL_CUCUMBER : scene == SCENE_FIELD ? MODEL_FIELD_CORN : MODEL_CORN;
    garden.mechanics = (frond_mechanics)mechanics;
    garden.integrator = (frond_integrator)integrator;
    garden.effects = effects;
    garden.wind = wind;
    if (!check(frond_world_create(&def, &garden.world))) return 0;
    place_ground();
    if (scene == SCENE_ROW) {
        for (i = 0; i < 10; i++) plant(0.4 * i - 1.8, i % 2 ? 0.12 : -0.12, 0.7 * i);
        place_walker();
    } else {
        const int side = (int)ceil(sqrt((double)plants));
        for (i = 0; i < plants; i++)
            plant(plants > 1 ? 1.8 * (i % side - 0.5 * (side - 1)) : 0,
                  plants > 1 ? 1.8 * (i / side - 0.5 * (side - 1)) : 0, 1.3 * i);
    }
    blow();
    return garden.plant_count;
}

EMSCRIPTEN_KEEPALIVE void garden_step(double dt) {
    check(frond_world_step(garden.world, dt));
}

EMSCRIPTEN_KEEPALIVE void garden_set_wind(double speed) {
    garden.wind = speed;
    blow();
}
EMSCRIPTEN_KEEPALIVE void garden_set_mechanics(int mechanics) {
    int i;
    for (i = 0; i < garden.plant_count; i++)
        check(frond_plant_set_mechanics(garden.plants[i], (frond_mechanics)mechanics));
}
EMSCRIPTEN_KEEPALIVE void garden_set_integrator(int integrator) {
    int i;
    for (i = 0; i < garden.plant_count; i++)
        check(frond_plant_set_integrator(garden.plants[i], (frond_integrator)integrator));
}
EMSCRIPTEN_KEEPALIVE void garden_set_effects(uint32_t effects) {
    int i;
    for (i = 0; i < garden.plant_count; i++) check(frond_plant_set_effects(garden.plants[i], effects));
}

/* Takes hold of what a ray hits; returns its distance [m], or -1. */
EMSCRIPTEN_KEEPALIVE double garden_take(double ox, double oy, double oz, double dx, double dy, double dz) {
    const frond_vec3 origin = {ox, oy, oz}, direction = {dx, dy, dz};
    frond_ray_hit hit;
    frond_grab_destroy(garden.grab);
    garden.grab.id = 0;
    if (!check(frond_world_cast_ray(garden.world, origin, direction, 100, &hit)) || hit.plant.id == 0) return -1;
    if (!check(frond_grab_create(hit.plant, hit.point, 60, &garden.grab))) return -1;
    return sqrt((hit.point.x - ox) * (hit.point.x - ox) + (hit.point.y - oy) * (hit.point.y - oy) +
                (hit.point.z - oz) * (hit.point.z - oz));
}
EMSCRIPTEN_KEEPALIVE void garden_pull(double x, double y, double z) {
    const frond_vec3 target = {x, y, z};
    if (frond_grab_is_valid(garden.grab)) check(frond_grab_move(garden.grab, target));
}
EMSCRIPTEN_KEEPALIVE void garden_let_go(void) {
    frond_grab_destroy(garden.grab);
    garden.grab.id = 0;
}

EMSCRIPTEN_KEEPALIVE void garden_throw(double ox, double oy, double oz, double vx, double vy, double vz) {
    frond_rigid_def def = frond_default_rigid_def();
    const int place = garden.ball_count % MOST_BALLS;
    def.size.x = 0.11;
    def.mass = 0.43;
    def.state.position.x = ox, def.state.position.y = oy, def.state.position.z = oz;
    def.state.velocity.x = vx, def.state.velocity.y = vy, def.state.velocity.z = vz;
    if (garden.ball_count >= MOST_BALLS) frond_rigid_destroy(garden.balls[place]);
    if (check(frond_rigid_create(garden.world, &def, &garden.balls[place]))) garden.ball_count++;
}
EMSCRIPTEN_KEEPALIVE int garden_get_ball_count(void) {
    return garden.ball_count < MOST_BALLS ? garden.ball_count : MOST_BALLS;
}
/* Gives position and radius of a ball, or with -1 the foot and the radius of the walker, who may not be there. */
EMSCRIPTEN_KEEPALIVE int garden_get_ball(int ball, double* out) {
    frond_rigid_state state;
    const frond_rigid rigid = ball < 0 ? garden.walker : garden.balls[ball];
    if (!frond_rigid_is_valid(rigid) || !check(frond_rigid_get_state(rigid, &state))) return 0;
    out[0] = state.position.x, out[1] = state.position.y, out[2] = state.position.z;
    out[3] = ball < 0 ? 0.25 : 0.11;
    return 1;
}
/* Moves the walker by a step [m]. */
EMSCRIPTEN_KEEPALIVE void garden_walk(double x, double z, double dt) {
    frond_rigid_state state;
    if (!frond_rigid_is_valid(garden.walker) || !check(frond_rigid_get_state(garden.walker, &state))) return;
    garden.walker_at.x += x;
    garden.walker_at.z += z;
    state.position = garden.walker_at;
    state.velocity.x = x / dt;
    state.velocity.z = z / dt;
    check(frond_rigid_set_state(garden.walker, &state));
}

/* Gives a plant's surface: pointers to positions and normals, uvs, indices, numbers of vertices and triangles, and a
 * pointer to colours. */
EMSCRIPTEN_KEEPALIVE int garden_get_surface(int plant, uint32_t* out) {
    frond_surface_view view;
    if (!check(frond_plant_get_surface(garden.plants[plant], &view))) return 0;
    out[0] = (uint32_t)(size_t)view.positions;
    out[1] = (uint32_t)(size_t)view.normals;
    out[2] = (uint32_t)(size_t)view.uvs;
    out[3] = (uint32_t)(size_t)view.indices;
    out[4] = (uint32_t)view.vertex_count;
    out[5] = (uint32_t)view.triangle_count;
    out[6] = (uint32_t)(size_t)view.colors;
    return 1;
}
EMSCRIPTEN_KEEPALIVE int garden_get_part_count(void) {
    frond_model_info info;
    return check(frond_model_get_info(garden.models[garden.model], &info)) ? info.part_count : 0;
}
/* Gives first triangle, count and texture of a part, and its colour. */
EMSCRIPTEN_KEEPALIVE int garden_get_part(int part, int32_t* out, float* color) {
    frond_part view;
    int i;
    if (!check(frond_model_get_part(garden.models[garden.model], part, &view))) return 0;
    out[0] = view.first_triangle;
    out[1] = view.triangle_count;
    out[2] = view.texture;
    for (i = 0; i < 4; i++) color[i] = view.color[i];
    return 1;
}
/* Gives the bytes of an image file and their number. */
EMSCRIPTEN_KEEPALIVE int garden_get_texture(int texture, uint32_t* out) {
    frond_texture_view view;
    if (!check(frond_model_get_texture(garden.models[garden.model], texture, &view))) return 0;
    out[0] = (uint32_t)(size_t)view.bytes;
    out[1] = (uint32_t)view.byte_count;
    return 1;
}

/* Gives the tip of the first plant, and the times of the last substep's stages [ms]: all, collide, effects, assembly,
 * solve, response, capsules, surface. */
EMSCRIPTEN_KEEPALIVE int garden_get_tip(double* out) {
    frond_vec3 tip;
    if (!check(frond_plant_get_tip(garden.plants[0], &tip))) return 0;
    out[0] = tip.x, out[1] = tip.y, out[2] = tip.z;
    return 1;
}
EMSCRIPTEN_KEEPALIVE int garden_get_times(double* out) {
    frond_profile p;
    if (!check(frond_world_get_profile(garden.world, &p))) return 0;
    out[0] = p.ms_step, out[1] = p.ms_collide, out[2] = p.ms_effects, out[3] = p.ms_assembly;
    out[4] = p.ms_solve, out[5] = p.ms_response, out[6] = p.ms_capsules, out[7] = p.ms_surface;
    return 1;
}
/* Returns the world's hash in two halves, the lower one first. */
EMSCRIPTEN_KEEPALIVE void garden_get_hash(uint32_t* out) {
    uint64_t hash = 0;
    check(frond_world_get_state_hash(garden.world, &hash));
    out[0] = (uint32_t)hash;
    out[1] = (uint32_t)(hash >> 32);
}
