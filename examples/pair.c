/* pair: two corn plants that overlap with their leaves come apart. Writes a picture without contact response (a) and
 * one with it (b), with contact points.    pair [MODEL [FOLDER]] */
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

/* Runs two plants for two seconds; returns how deep they overlap at the end [m]. */
static double play(frond_model model, frond_response response, frond_picture* picture, const frond_picture_scene* scene,
                   const char* path) {
    frond_world_def world_def = frond_default_world_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_world world;
    frond_plant plants[2];
    frond_contact* contacts;
    double depth = 0;
    int i, count;

    world_def.response = response;
    check(frond_world_create(&world_def, &world));
    for (i = 0; i < 2; i++) {
        plant_def.position.x = i ? 0.45 : -0.45;
        plant_def.position.z = i ? 0.03 : 0;
        check(frond_plant_create(world, model, &plant_def, &plants[i]));
    }
    for (i = 0; i < 120; i++) check(frond_world_step(world, 1.0 / 60));

    count = frond_plant_get_contact_count(plants[0]);
    contacts = malloc((size_t)(count + 1) * sizeof *contacts);
    check(frond_plant_get_contacts(plants[0], contacts, count));
    for (i = 0; i < count; i++)
        if (-contacts[i].gap > depth) depth = -contacts[i].gap;
    free(contacts);

    check_picture(frond_picture_begin(picture, scene));
    for (i = 0; i < 2; i++)
        check_picture(
            frond_picture_draw_plant(picture, plants[i], model, FROND_PICTURE_SURFACE | FROND_PICTURE_CONTACTS));
    check_picture(frond_picture_end(picture));
    check_picture(frond_picture_write(picture, path));
    frond_world_destroy(world);
    return depth;
}

int main(int argc, char** argv) {
    const char* folder = argc > 2 ? argv[2] : "pair_pictures";
    frond_model_def model_def = frond_default_model_def();
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_model model;
    frond_model_info info;
    frond_picture* picture;
    double without, with;
    char path[1024];

    check(frond_model_load(argc > 1 ? argv[1] : "models/corn/corn.obj", &model_def, &model));
    check(frond_model_get_info(model, &info));
    mkdir(folder, 0777);
    picture_def.width = 900;
    picture_def.height = 720;
    info.lower.x -= 0.45;
    info.upper.x += 0.45;
    scene.camera = frond_picture_frame(info.lower, info.upper, scene.up, 0.3, 0.12, 900.0 / 720);
    check_picture(frond_picture_create(&picture_def, &picture));

    snprintf(path, sizeof path, "%s/pair_a.png", folder);
    without = play(model, FROND_RESPONSE_NONE, picture, &scene, path);
    snprintf(path, sizeof path, "%s/pair_b.png", folder);
    with = play(model, FROND_RESPONSE_IMPULSE, picture, &scene, path);
    printf(
        "after 2 s the plants are %.1f mm deep in each other without response, %.2f mm with it; pictures are in %s/\n",
        1000 * without, 1000 * with, folder);

    frond_picture_destroy(picture);
    frond_model_destroy(model);
    return without < 0.01 || with > 0.002; /* they overlapped, and came apart */
}
