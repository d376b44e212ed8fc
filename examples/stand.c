/* stand: a cucumber plant whose file shows it without gravity comes to its natural stand, for four heights h of its
 * capsules, as in the paper's Fig 6. Writes a picture.    stand [MODEL [FOLDER]] */
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

enum { PLANTS = 4, STEPS = 480 };

/* Returns the mean height of all vertices [m]. */
static double mean_height(frond_plant plant) {
    frond_surface_view view;
    double sum = 0;
    check(frond_plant_get_surface(plant, &view));
    for (int i = 0; i < view.vertex_count; i++) sum += view.positions[3 * i + 1];
    return sum / view.vertex_count;
}

int main(int argc, char** argv) {
    const double heights[PLANTS] = {0.20, 0.10, 0.05, 0.03};
    const char* folder = argc > 2 ? argv[2] : "stand_frames";
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_world world;
    frond_model models[PLANTS];
    frond_model_info info;
    frond_plant plants[PLANTS];
    double start, sunk;
    frond_picture* picture;
    char path[1024];
    bool stand = true;
    int i;

    /* Rods: the plant is drawn as it grew and sags under its weight, the more smoothly the more capsules it has. */
    model_def.rest = FROND_REST_WITHOUT_GRAVITY;
    plant_def.mechanics = FROND_MECHANICS_ROD;
    plant_def.mass_damping = 4; /* comes to rest soon */
    check(frond_world_create(&world_def, &world));
    for (i = 0; i < PLANTS; i++) {
        model_def.capsule_height = heights[i];
        check(frond_model_load(argc > 1 ? argv[1] : "models/cucumber/cucumber.obj", &model_def, &models[i]));
        plant_def.position.x = 1.1 * i;
        check(frond_plant_create(world, models[i], &plant_def, &plants[i]));
    }
    start = mean_height(plants[0]);
    for (i = 0; i < STEPS; i++) check(frond_world_step(world, 1.0 / 60));

    /* The studio. */
    mkdir(folder, 0777);
    picture_def.width = 1200;
    picture_def.height = 700;
    check(frond_model_get_info(models[0], &info));
    info.upper.x += 1.1 * (PLANTS - 1);
    scene.camera = frond_picture_frame(info.lower, info.upper, scene.up, 0.2, 0.1, 1200.0 / 700);
    check_picture(frond_picture_create(&picture_def, &picture));
    check_picture(frond_picture_begin(picture, &scene));
    for (i = 0; i < PLANTS; i++)
        check_picture(
            frond_picture_draw_plant(picture, plants[i], models[i], FROND_PICTURE_SURFACE | FROND_PICTURE_CAPSULES));
    check_picture(frond_picture_end(picture));
    snprintf(path, sizeof path, "%s/stand.png", folder);
    check_picture(frond_picture_write(picture, path));

    for (i = 0; i < PLANTS; i++) {
        frond_energy energy;
        sunk = start - mean_height(plants[i]);
        check(frond_plant_get_energy(plants[i], &energy));
        printf("h = %.0f cm, %d capsules: it sank by %.0f mm\n", 100 * heights[i],
               frond_plant_get_capsule_count(plants[i]), 1000 * sunk);
        stand = stand && sunk > 0.005 && sunk < 0.2 && energy.kinetic < 1e-4;
    }

    frond_picture_destroy(picture);
    frond_world_destroy(world);
    for (i = 0; i < PLANTS; i++) frond_model_destroy(models[i]);
    return !stand; /* they sagged, and came to rest upright */
}
