/* hello: a plant in gravity; prints the height of its tip. */
#include <frond/frond.h>
#include <stdio.h>
#include <stdlib.h>

static void check(frond_result result) {
    if (result == FROND_OK) return;
    fprintf(stderr, "%s\n", frond_last_error());
    exit(1);
}

int main(int argc, char** argv) {
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_world world;
    frond_model model;
    frond_plant plant;
    frond_vec3 tip = {0, 0, 0};

    check(frond_world_create(&world_def, &world));
    check(frond_model_load(argc > 1 ? argv[1] : "models/corn/corn.obj", &model_def, &model));
    check(frond_plant_create(world, model, &plant_def, &plant));
    for (int step = 0; step < 120; step++) check(frond_world_step(world, 1.0 / 60));
    check(frond_plant_get_tip(plant, &tip));
    printf("after 2 s the tip is %.3f m high\n", tip.y);

    frond_world_destroy(world);
    frond_model_destroy(model);
    return tip.y > 0 ? 0 : 1;
}
