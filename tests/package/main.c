/* A program outside the source tree that uses the installed package: a stem sways. */
#include <frond/frond.h>
#include <stdio.h>

int main(void) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 1, 0}, 0.02, 0.01};
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_world world;
    frond_model model;
    frond_plant plant;
    frond_vec3 tip;
    if (frond_world_create(&world_def, &world) || frond_model_from_stems(&stem, 1, &model_def, &model) ||
        frond_plant_create(world, model, &plant_def, &plant) || frond_world_step(world, 0.1) ||
        frond_plant_get_tip(plant, &tip)) {
        printf("%s\n", frond_last_error());
        return 1;
    }
    printf("frond %s: tip at %.3f m\n", frond_version_string(), tip.y);
    return tip.y > 0.5 ? 0 : 1;
}
