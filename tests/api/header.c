/* The public header compiles as C99, and a C program can do everything that hello does. */
#include "frond/frond.h"

int frond_hello_from_c(double* tip_height) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 0.5, 0}, 0.01, 0.005};
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_world world;
    frond_model model;
    frond_plant plant;
    frond_vec3 tip = {0, 0, 0};
    int i, failures = 0;
    failures += frond_world_create(&world_def, &world) != FROND_OK;
    failures += frond_model_from_stems(&stem, 1, &model_def, &model) != FROND_OK;
    failures += frond_plant_create(world, model, &plant_def, &plant) != FROND_OK;
    for (i = 0; i < 10; i++) failures += frond_world_step(world, 1.0 / 60) != FROND_OK;
    failures += frond_plant_get_tip(plant, &tip) != FROND_OK;
    *tip_height = tip.y;
    frond_world_destroy(world);
    frond_model_destroy(model);
    return failures;
}
