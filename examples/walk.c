/* walk: a character's capsule walks through a row of ten corn plants and pushes their leaves along. Writes a picture
 * of it in their midst.    walk [MODEL [FOLDER]] */
#include <frond/frond.h>
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

enum { PLANTS = 10, STEPS = 180, MIDST = 130 };

int main(int argc, char** argv) {
    const char* folder = argc > 2 ? argv[2] : "walk_pictures";
    const double apart = 0.35, speed = 1.2; /* distance of the plants [m], speed of the character [m/s] */
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_rigid_def ground_def = frond_default_rigid_def(), walker_def = frond_default_rigid_def();
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    const frond_color cloth = {0.15f, 0.25f, 0.55f, 1};
    frond_world world;
    frond_model model;
    frond_model_info info;
    frond_plant plants[PLANTS];
    frond_vec3 tips[PLANTS], tip;
    frond_rigid ground, walker;
    frond_rigid_state state;
    frond_picture* picture;
    char path[1024];
    double farthest = 0;
    int moved = 0, step, i;

    /* A row of plants, a little to the left and to the right of the path. */
    check(frond_world_create(&world_def, &world));
    check(frond_model_load(argc > 1 ? argv[1] : "models/corn/corn.obj", &model_def, &model));
    check(frond_model_get_info(model, &info));
    for (i = 0; i < PLANTS; i++) {
        plant_def.position = (frond_vec3){apart * i, 0, i % 2 ? 0.15 : -0.15};
        check(frond_plant_create(world, model, &plant_def, &plants[i]));
        check(frond_plant_get_tip(plants[i], &tips[i]));
    }
    ground_def.shape = FROND_SHAPE_PLANE;
    check(frond_rigid_create(world, &ground_def, &ground));

    /* The character: 1.68 m, moved by the program, not by forces. */
    walker_def.shape = FROND_SHAPE_CAPSULE;
    walker_def.size = (frond_vec3){0.22, 0.62, 0};
    walker_def.mass = 0;
    walker_def.state.position = (frond_vec3){-1, 0.86, 0};
    check(frond_rigid_create(world, &walker_def, &walker));

    mkdir(folder, 0777);
    picture_def.width = 1000;
    picture_def.height = 620;
    info.lower.x -= 0.5;
    info.upper.x += apart * (PLANTS - 1);
    scene.camera = frond_picture_frame(info.lower, info.upper, scene.up, 0.3, 0.12, 1000.0 / 620);
    check_picture(frond_picture_create(&picture_def, &picture));

    for (step = 0; step < STEPS; step++) {
        check(frond_rigid_get_state(walker, &state));
        state.position.x += speed / 60;
        check(frond_rigid_set_state(walker, &state));
        check(frond_world_step(world, 1.0 / 60));
        for (i = 0; i < PLANTS; i++) {
            check(frond_plant_get_tip(plants[i], &tip));
            farthest = fmax(farthest, hypot(tip.x - tips[i].x, tip.z - tips[i].z));
        }
        if (step != MIDST) continue;
        check_picture(frond_picture_begin(picture, &scene));
        for (i = 0; i < PLANTS; i++)
            check_picture(frond_picture_draw_plant(picture, plants[i], model, FROND_PICTURE_SURFACE));
        check_picture(frond_picture_draw_rigid(picture, &walker_def, walker, cloth));
        check_picture(frond_picture_end(picture));
        snprintf(path, sizeof path, "%s/walk.png", folder);
        check_picture(frond_picture_write(picture, path));
    }
    for (i = 0; i < PLANTS; i++) {
        check(frond_plant_get_tip(plants[i], &tip));
        moved += hypot(tip.x - tips[i].x, tip.z - tips[i].z) > 0.05;
    }
    printf("tips moved by up to %.2f m, those of %d plants are aside at the end; a picture is in %s/\n", farthest,
           moved, folder);

    frond_picture_destroy(picture);
    frond_world_destroy(world);
    frond_model_destroy(model);
    return moved == 0 || farthest > 2; /* they were pushed aside, and not thrown about */
}
