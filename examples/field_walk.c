/* field_walk: a character follows a rolling ball on a path through a field of 2,500 plants that sleep until somebody
 * comes; distant plants are simulated at lower detail. Writes a picture from above and one from eye level.
 *
 *     field_walk [MODELS [FOLDER]] */
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

enum { KINDS = 4, SIDE = 50, PLANTS = SIDE * SIDE, STEPS = 240, SHOT = 200 };

int main(int argc, char** argv) {
    static const char* const FILES[KINDS] = {"corn/corn.obj", "sunflower/sunflower.obj", "wheat/wheat.obj",
                                             "cucumber/cucumber.obj"};
    static frond_plant plants[PLANTS];
    static frond_vec3 places[PLANTS];
    static int kinds[PLANTS];
    const char* folder = argc > 2 ? argv[2] : "field_pictures";
    const double apart = 0.7, speed = 1.3, seen = 14; /* distances of plants [m]; speed [m/s]; view [m] */
    const frond_color cloth = {0.15f, 0.25f, 0.55f, 1}, leather = {0.55f, 0.16f, 0.07f, 1};
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_rigid_def ground_def = frond_default_rigid_def(), ball_def = ground_def, walker_def = ground_def;
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_world world;
    frond_model models[KINDS];
    frond_rigid ground, ball, walker;
    frond_rigid_state state;
    frond_report report;
    frond_picture* picture;
    char path[1024];
    int most_awake = 0, touched = 0, step, i, shot;

    /* Four kinds in strips across the path; all begin asleep, so that they cost nothing yet. */
    check(frond_world_create(&world_def, &world));
    model_def.capsule_height = 0.4;
    for (i = 0; i < KINDS; i++) {
        snprintf(path, sizeof path, "%s/%s", argc > 1 ? argv[1] : "models", FILES[i]);
        check(frond_model_load(path, &model_def, &models[i]));
    }
    plant_def.mechanics = FROND_MECHANICS_ROD;
    plant_def.starts_asleep = true;
    plant_def.effects &= ~FROND_EFFECT_PLANT_CONTACT; /* leaves overlap: one plant would wake the whole field */
    for (i = 0; i < PLANTS; i++) {
        const double x = apart * (i % SIDE), z = apart * (i / SIDE - SIDE / 2 + 0.5);
        const int strip = (int)(x / 4) % KINDS;
        kinds[i] = strip == 3 && fabs(z) > 3 ? 2 : strip;
        places[i] = (frond_vec3){x + 0.1 * sin(7.0 * i), 0, z + 0.1 * sin(11.0 * i)};
        plant_def.position = places[i];
        plant_def.rotation = (frond_quat){0, sin(1.3 * i), 0, cos(1.3 * i)};
        check(frond_plant_create(world, models[kinds[i]], &plant_def, &plants[i]));
    }

    ground_def.shape = FROND_SHAPE_PLANE;
    check(frond_rigid_create(world, &ground_def, &ground));
    ball_def.size.x = 0.2;
    ball_def.mass = 2;
    ball_def.state.position = (frond_vec3){1.5, 0.2, 0.05};
    ball_def.state.velocity = (frond_vec3){2, 0, 0};
    ball_def.state.angular_velocity = (frond_vec3){0, 0, -10};
    check(frond_rigid_create(world, &ball_def, &ball));
    walker_def.shape = FROND_SHAPE_CAPSULE;
    walker_def.size = (frond_vec3){0.22, 0.62, 0};
    walker_def.mass = 0;
    walker_def.state.position = (frond_vec3){-0.5, 0.86, 0};
    check(frond_rigid_create(world, &walker_def, &walker));

    mkdir(folder, 0777);
    picture_def.width = 960;
    picture_def.height = 540;
    picture_def.sky_samples = 4;
    check_picture(frond_picture_create(&picture_def, &picture));

    for (step = 0; step < STEPS; step++) {
        check(frond_rigid_get_state(walker, &state));
        state.position.x += speed / 60;
        check(frond_rigid_set_state(walker, &state));
        /* All that a game has to do for the field: set the position of the camera. */
        check(frond_world_set_viewer(world, (frond_vec3){state.position.x - 2, 1.7, 0}));
        check(frond_world_step(world, 1.0 / 60));
        check(frond_world_get_report(world, &report));
        if (report.awake_count > most_awake) most_awake = report.awake_count;
        touched += report.contact_count > 0;
        for (shot = 0; step == SHOT && shot < 2; shot++) {
            const frond_vec3 at = state.position;
            scene.camera.target = (frond_vec3){at.x + (shot ? 4 : 2), shot ? 0.9 : 0, 0};
            scene.camera.eye = shot ? (frond_vec3){at.x - 4, 2, 0.9} : (frond_vec3){at.x - 5, 10, 7};
            check_picture(frond_picture_begin(picture, &scene));
            for (i = 0; i < PLANTS; i++)
                if (hypot(places[i].x - at.x - 4, places[i].z) < seen)
                    check_picture(
                        frond_picture_draw_plant(picture, plants[i], models[kinds[i]], FROND_PICTURE_SURFACE));
            check_picture(frond_picture_draw_rigid(picture, &walker_def, walker, cloth));
            check_picture(frond_picture_draw_rigid(picture, &ball_def, ball, leather));
            check_picture(frond_picture_end(picture));
            snprintf(path, sizeof path, "%s/%s.png", folder, shot ? "eyes" : "above");
            check_picture(frond_picture_write(picture, path));
        }
    }
    printf("%d plants, at most %d awake, bodies touched some in %d of %d steps; pictures are in %s/\n", PLANTS,
           most_awake, touched, STEPS, folder);

    frond_picture_destroy(picture);
    frond_world_destroy(world);
    for (i = 0; i < KINDS; i++) frond_model_destroy(models[i]);
    return touched < STEPS / 4 || most_awake < 5 || most_awake > PLANTS / 10; /* only plants near the path wake */
}
