/* trellis: a cucumber with its stake, tilted, comes to lean on a trellis of static boxes. Writes a picture of it,
 * with the contact points.    trellis [MODEL [FOLDER]] */
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

enum { POSTS = 2, SLATS = 4, STEPS = 240 };

int main(int argc, char** argv) {
    const char* folder = argc > 2 ? argv[2] : "trellis_pictures";
    const double lean = 0.16, away = 0.36, wide = 0.5; /* [rad], [m], [m] */
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_rigid_def ground_def = frond_default_rigid_def(), defs[POSTS + SLATS];
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    const frond_color wood = {0.45f, 0.30f, 0.16f, 1};
    frond_world world;
    frond_model model;
    frond_model_info info;
    frond_plant plant;
    frond_rigid ground, boxes[POSTS + SLATS];
    frond_vec3 before, tip;
    frond_picture* picture;
    char path[1024];
    frond_contact* contacts;
    int count, leaning = 0, i;

    /* The plant, turned about its foot. */
    check(frond_world_create(&world_def, &world));
    check(frond_model_load(argc > 1 ? argv[1] : "models/cucumber/cucumber.obj", &model_def, &model));
    check(frond_model_get_info(model, &info));
    plant_def.rotation = (frond_quat){0, 0, -sin(lean / 2), cos(lean / 2)};
    check(frond_plant_create(world, model, &plant_def, &plant));
    ground_def.shape = FROND_SHAPE_PLANE;
    check(frond_rigid_create(world, &ground_def, &ground));

    /* Two posts and four slats, all static. */
    for (i = 0; i < POSTS + SLATS; i++) {
        defs[i] = frond_default_rigid_def();
        defs[i].shape = FROND_SHAPE_BOX;
        defs[i].mass = 0;
        defs[i].size = i < POSTS ? (frond_vec3){0.02, 1.1, 0.02} : (frond_vec3){0.01, 0.02, wide + 0.05};
        defs[i].state.position =
            i < POSTS ? (frond_vec3){away + 0.03, 1.1, i ? wide : -wide} : (frond_vec3){away, 0.5 * (i - POSTS + 1), 0};
        check(frond_rigid_create(world, &defs[i], &boxes[i]));
    }

    for (i = 0; i < STEPS; i++) {
        if (i == STEPS - 30) check(frond_plant_get_tip(plant, &before));
        check(frond_world_step(world, 1.0 / 60));
    }
    check(frond_plant_get_tip(plant, &tip));

    /* Count the contacts with slats; the ground is touched too. */
    count = frond_plant_get_contact_count(plant);
    contacts = malloc((size_t)(count + 1) * sizeof *contacts);
    check(frond_plant_get_contacts(plant, contacts, count));
    for (i = 0; i < count; i++) leaning += contacts[i].point.y > 0.4 && contacts[i].impulse.x < 0;
    free(contacts);

    mkdir(folder, 0777);
    picture_def.width = 800;
    picture_def.height = 900;
    info.upper.x += 0.4;
    scene.camera = frond_picture_frame(info.lower, info.upper, scene.up, 0.5, 0.12, 800.0 / 900);
    check_picture(frond_picture_create(&picture_def, &picture));
    check_picture(frond_picture_begin(picture, &scene));
    check_picture(frond_picture_draw_plant(picture, plant, model, FROND_PICTURE_SURFACE | FROND_PICTURE_CONTACTS));
    for (i = 0; i < POSTS + SLATS; i++) check_picture(frond_picture_draw_rigid(picture, &defs[i], boxes[i], wood));
    check_picture(frond_picture_end(picture));
    snprintf(path, sizeof path, "%s/trellis.png", folder);
    check_picture(frond_picture_write(picture, path));
    printf(
        "the plant leans on the trellis at %d places, its tip moved by %.1f mm in the last half second; a picture is in"
        " %s/\n",
        leaning, 1000 * hypot(tip.x - before.x, tip.y - before.y), folder);

    frond_picture_destroy(picture);
    frond_world_destroy(world);
    frond_model_destroy(model);
    return leaning == 0 || hypot(tip.x - before.x, tip.y - before.y) > 0.005; /* it leans, and has come to rest */
}
