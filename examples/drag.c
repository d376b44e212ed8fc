/* drag: a corn plant is pulled aside by the user's hand and let go, as in the paper's Fig 7. Writes frames, a contact
 * sheet and a moving picture.    drag [MODEL [FOLDER]] */
#include <frond/frond.h>
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

enum { STEPS = 240, TAKE = 15, HOLD = 75, LET_GO = 90, STEPS_A_FRAME = 4 };

int main(int argc, char** argv) {
    const char* folder = argc > 2 ? argv[2] : "drag_frames";
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_film_def film_def = frond_default_film_def();
    frond_world world;
    frond_model model;
    frond_model_info info;
    frond_plant plant;
    frond_grab grab = {0};
    frond_vec3 tip = {0, 0, 0}, start = {0, 0, 0}, pulled = {0, 0, 0};
    double farthest = 0;
    frond_picture* picture;
    frond_film* film;
    char path[1024];

    /* The plant. */
    check(frond_world_create(&world_def, &world));
    check(frond_model_load(argc > 1 ? argv[1] : "models/corn/corn.obj", &model_def, &model));
    check(frond_plant_create(world, model, &plant_def, &plant));
    check(frond_model_get_info(model, &info));
    check(frond_plant_get_tip(plant, &start));

    /* The studio: a camera that sees the plant with a margin for its motion. */
    mkdir(folder, 0777);
    picture_def.width = film_def.width = 600;
    picture_def.height = film_def.height = 720;
    film_def.frames_per_second = 60.0 / STEPS_A_FRAME;
    info.upper.x += 0.2 * info.upper.y;
    scene.camera = frond_picture_frame(info.lower, info.upper, scene.up, 0.3, 0.12, 600.0 / 720);
    check_picture(frond_picture_create(&picture_def, &picture));
    check_picture(frond_film_create(&film_def, &film));

    for (int step = 0; step < STEPS; step++) {
        /* The hand takes hold of the stem at three quarters of its height, pulls it aside, holds it and lets go. */
        if (step == TAKE) {
            const frond_vec3 stem = {0, 0.75 * info.upper.y, 0};
            check(frond_grab_create(plant, stem, 200, &grab));
            check(frond_grab_get(grab, &pulled, NULL, NULL));
        }
        if (step > TAKE && step <= HOLD) {
            pulled.x += 0.3 * info.upper.y / (HOLD - TAKE);
            pulled.y -= 0.1 * info.upper.y / (HOLD - TAKE);
            check(frond_grab_move(grab, pulled));
        }
        if (step == LET_GO) frond_grab_destroy(grab);
        check(frond_world_step(world, 1.0 / 60));
        check(frond_plant_get_tip(plant, &tip));
        if (tip.x - start.x > farthest) farthest = tip.x - start.x;

        if (step % STEPS_A_FRAME) continue;
        check_picture(frond_picture_begin(picture, &scene));
        check_picture(frond_picture_draw_plant(picture, plant, model, FROND_PICTURE_SURFACE));
        if (frond_grab_is_valid(grab)) check_picture(frond_picture_draw_grab(picture, grab));
        check_picture(frond_picture_end(picture));
        check_picture(frond_film_add(film, frond_picture_get_pixels(picture)));
        snprintf(path, sizeof path, "%s/frame_%03d.png", folder, step / STEPS_A_FRAME);
        check_picture(frond_picture_write(picture, path));
    }

    snprintf(path, sizeof path, "%s/sheet.png", folder);
    check_picture(frond_film_write_sheet(film, path, 6, 2));
    snprintf(path, sizeof path, "%s/drag.webp", folder);
    check_picture(frond_film_write_webp(film, path));
    printf("the tip was drawn aside by %.3f m and ends %.3f m from where it began; pictures are in %s/\n", farthest,
           tip.x - start.x, folder);

    frond_film_destroy(film);
    frond_picture_destroy(picture);
    frond_world_destroy(world);
    frond_model_destroy(model);
    return !(farthest > 0.15 && tip.x - start.x < 0.7 * farthest); /* it was pulled aside, and went back */
}
