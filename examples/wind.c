/* wind: three corn plants in a gusty wind that turns into a gale half-way. Writes frames, a contact sheet and a moving
 * picture.    wind [MODEL [FOLDER]] */
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

enum { STEPS = 240, GALE = 120, STEPS_A_FRAME = 5, PLANTS = 3 };

int main(int argc, char** argv) {
    const char* folder = argc > 2 ? argv[2] : "wind_frames";
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_wind_def wind_def = frond_default_wind_def();
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_film_def film_def = frond_default_film_def();
    frond_world world;
    frond_model model;
    frond_model_info info;
    frond_plant plants[PLANTS];
    frond_vec3 air = {0, 0, 0}, force = {0, 0, 0}, tip = {0, 0, 0};
    frond_picture* picture;
    frond_film* film;
    char path[1024];
    double strongest = 0, farthest = 0;
    int step, i;

    /* The plants, as rods, which are fast. */
    check(frond_world_create(&world_def, &world));
    check(frond_model_load(argc > 1 ? argv[1] : "models/corn/corn.obj", &model_def, &model));
    check(frond_model_get_info(model, &info));
    plant_def.mechanics = FROND_MECHANICS_ROD;
    for (i = 0; i < PLANTS; i++) {
        plant_def.position.x = 0.9 * (i - 1);
        plant_def.position.z = i == 1 ? -0.4 : 0;
        check(frond_plant_create(world, model, &plant_def, &plants[i]));
    }

    /* The studio. */
    mkdir(folder, 0777);
    picture_def.width = film_def.width = 720;
    picture_def.height = film_def.height = 600;
    film_def.frames_per_second = 60.0 / STEPS_A_FRAME;
    info.lower.x -= 0.9;
    info.upper.x += 1.3;
    scene.camera = frond_picture_frame(info.lower, info.upper, scene.up, 0.3, 0.12, 720.0 / 600);
    check_picture(frond_picture_create(&picture_def, &picture));
    check_picture(frond_film_create(&film_def, &film));

    for (step = 0; step < STEPS; step++) {
        /* A breeze of 8 m/s at the height of weather stations, then a gale of 20. */
        if (step == 0 || step == GALE) {
            wind_def.velocity.x = step < GALE ? 8 : 20;
            check(frond_world_set_wind(world, &wind_def));
        }
        check(frond_world_step(world, 1.0 / 60));
        check(frond_world_get_wind_at(world, info.upper, &air));
        check(frond_plant_get_air_force(plants[1], &force));
        check(frond_plant_get_tip(plants[1], &tip));
        if (air.x > strongest) strongest = air.x;
        if (tip.x > farthest) farthest = tip.x;

        if (step % STEPS_A_FRAME) continue;
        check_picture(frond_picture_begin(picture, &scene));
        for (i = 0; i < PLANTS; i++)
            check_picture(frond_picture_draw_plant(picture, plants[i], model, FROND_PICTURE_SURFACE));
        check_picture(frond_picture_end(picture));
        check_picture(frond_film_add(film, frond_picture_get_pixels(picture)));
        snprintf(path, sizeof path, "%s/frame_%03d.png", folder, step / STEPS_A_FRAME);
        check_picture(frond_picture_write(picture, path));
    }

    snprintf(path, sizeof path, "%s/sheet.png", folder);
    check_picture(frond_film_write_sheet(film, path, 6, 3));
    snprintf(path, sizeof path, "%s/wind.webp", folder);
    check_picture(frond_film_write_webp(film, path));
    printf("gusts of %.1f m/s; the tip was blown to %.2f m, the drag at the end is %.2f N; pictures are in %s/\n",
           strongest, farthest, force.x, folder);

    frond_film_destroy(film);
    frond_picture_destroy(picture);
    frond_world_destroy(world);
    frond_model_destroy(model);
    return !(strongest > 10 && force.x > 0); /* it blew, and the plant felt it */
}
