/* arm: a robot arm reaches through three corn plants and stops among them. The force on its links agrees with what
 * the ground under the plants holds. Writes frames, a contact sheet and a moving picture.    arm [MODELS [FOLDER]] */
#include <frond/frond_robot.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "frond_picture.h"

static void check(frond_result result) {
    if (result == FROND_OK) return;
    fprintf(stderr, "%s\n", frond_last_error());
    exit(1);
}

static void check_picture(bool ok) {
    if (ok) return;
    fprintf(stderr, "%s\n", frond_picture_last_error());
    exit(1);
}

enum { PLANTS = 3, STEPS = 600, STEPS_A_FRAME = 6 };

static void add(frond_vec3* sum, frond_vec3 v, double sign) {
    sum->x += sign * v.x;
    sum->y += sign * v.y;
    sum->z += sign * v.z;
}

static double length(frond_vec3 v) {
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/* Returns the force with which the ground holds all plants [N]. */
static frond_vec3 held(const frond_plant* plants) {
    frond_vec3 sum = {0, 0, 0}, force;
    for (int i = 0; i < PLANTS; i++) {
        check(frond_plant_get_root_force(plants[i], (frond_vec3){0, 0, 0}, &force, NULL));
        add(&sum, force, 1);
    }
    return sum;
}

/* Returns the force of all plants on the arm's links [N]. */
static frond_vec3 felt(frond_robot arm) {
    frond_vec3 sum = {0, 0, 0};
    frond_link_state state;
    for (int i = 0; i < frond_robot_get_link_count(arm); i++) {
        check(frond_robot_get_link_state(arm, i, &state));
        add(&sum, state.force, 1);
    }
    return sum;
}

int main(int argc, char** argv) {
    const char* models = argc > 1 ? argv[1] : "models";
    const char* folder = argc > 2 ? argv[2] : "arm_frames";
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_robot_def arm_def = frond_default_robot_def();
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_film_def film_def = frond_default_film_def();
    frond_world world;
    frond_model corn;
    frond_plant plants[PLANTS];
    frond_robot arm;
    frond_picture* picture;
    frond_film* film;
    frond_vec3 standing, pushed, felt_last;
    const frond_color orange = {0.80f, 0.32f, 0.04f, 1};
    char path[1024];

    /* Three plants in a row, and the arm at its end, turned away. */
    check(frond_world_create(&world_def, &world));
    snprintf(path, sizeof path, "%s/corn/corn.obj", models);
    check(frond_model_load(path, &model_def, &corn));
    plant_def.mechanics = FROND_MECHANICS_ROD;
    for (int i = 0; i < PLANTS; i++) {
        plant_def.position = (frond_vec3){0.7 + 0.35 * i, 0, 0};
        check(frond_plant_create(world, corn, &plant_def, &plants[i]));
    }
    snprintf(path, sizeof path, "%s/arm/arm.urdf", models);
    check(frond_robot_load(world, path, &arm_def, &arm));
    check(frond_robot_set_joint(arm, frond_robot_find_link(arm, "turn"), -1.5));
    check(frond_robot_set_joint(arm, frond_robot_find_link(arm, "lift"), 1.4));
    for (int step = 0; step < 10; step++) check(frond_world_step(world, 1.0 / 60));
    standing = held(plants);

    /* The studio. */
    mkdir(folder, 0777);
    picture_def.width = film_def.width = 960;
    picture_def.height = film_def.height = 720;
    film_def.frames_per_second = 20;
    scene.camera =
        frond_picture_frame((frond_vec3){-0.4, 0, -0.8}, (frond_vec3){2.0, 2.2, 0.9}, scene.up, 0.5, 0.2, 4.0 / 3);
    check_picture(frond_picture_create(&picture_def, &picture));
    check_picture(frond_film_create(&film_def, &film));

    /* It turns into the row within three seconds and stays there. */
    check(frond_robot_drive_to(arm, frond_robot_find_link(arm, "turn"), 0.3, 0.6, 0));
    for (int step = 0; step < STEPS; step++) {
        check(frond_world_step(world, 1.0 / 60));
        if (step % STEPS_A_FRAME || step > STEPS / 2) continue;
        check_picture(frond_picture_begin(picture, &scene));
        for (int i = 0; i < PLANTS; i++)
            check_picture(frond_picture_draw_plant(picture, plants[i], corn, FROND_PICTURE_SURFACE));
        check_picture(frond_picture_draw_robot(picture, arm, orange));
        check_picture(frond_picture_end(picture));
        check_picture(frond_film_add(film, frond_picture_get_pixels(picture)));
        snprintf(path, sizeof path, "%s/frame_%03d.png", folder, step / STEPS_A_FRAME);
        check_picture(frond_picture_write(picture, path));
    }
    snprintf(path, sizeof path, "%s/sheet.png", folder);
    check_picture(frond_film_write_sheet(film, path, 4, 3));
    snprintf(path, sizeof path, "%s/arm.webp", folder);
    check_picture(frond_film_write_webp(film, path));

    /* The ground holds what it held before, plus the force of the arm. */
    pushed = held(plants);
    add(&pushed, standing, -1);
    felt_last = felt(arm);
    printf("the arm's links feel (%.3f, %.3f, %.3f) N, the ground (%.3f, %.3f, %.3f) N more than before\n", felt_last.x,
           felt_last.y, felt_last.z, pushed.x, pushed.y, pushed.z);
    add(&pushed, felt_last, -1);

    frond_film_destroy(film);
    frond_picture_destroy(picture);
    frond_world_destroy(world);
    frond_model_destroy(corn);
    return !(length(felt_last) > 1 && length(pushed) < 0.05 * length(felt_last));
}
