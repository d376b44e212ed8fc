/* ball: a football is thrown at a corn plant. It brushes through the leaves and hits the stalk; both feel the
 * impulse. Writes frames, a contact sheet and a moving picture.    ball [MODEL [FOLDER]] */
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

enum { STEPS = 96, STEPS_A_FRAME = 2 };

int main(int argc, char** argv) {
    const char* folder = argc > 2 ? argv[2] : "ball_frames";
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_rigid_def ground_def = frond_default_rigid_def(), ball_def = frond_default_rigid_def();
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_film_def film_def = frond_default_film_def();
    const frond_color leather = {0.60f, 0.20f, 0.08f, 1};
    frond_world world;
    frond_model model;
    frond_model_info info;
    frond_plant plant;
    frond_rigid ground, ball;
    frond_rigid_state state;
    frond_picture* picture;
    frond_film* film;
    char path[1024];
    int touched = 0;

    /* The plant on the ground. */
    check(frond_world_create(&world_def, &world));
    check(frond_model_load(argc > 1 ? argv[1] : "models/corn/corn.obj", &model_def, &model));
    check(frond_plant_create(world, model, &plant_def, &plant));
    check(frond_model_get_info(model, &info));
    ground_def.shape = FROND_SHAPE_PLANE;
    check(frond_rigid_create(world, &ground_def, &ground));

    /* The ball: 11 cm, 430 g, 7 m/s. */
    ball_def.size.x = 0.11;
    ball_def.mass = 0.43;
    ball_def.state.position = (frond_vec3){-1.7, 1.0, 0.03};
    ball_def.state.velocity = (frond_vec3){7, 1.2, 0};
    check(frond_rigid_create(world, &ball_def, &ball));

    /* The studio. */
    mkdir(folder, 0777);
    picture_def.width = film_def.width = 600;
    picture_def.height = film_def.height = 720;
    film_def.frames_per_second = 30;
    info.lower.x -= 0.4;
    scene.camera = frond_picture_frame(info.lower, info.upper, scene.up, 0.3, 0.12, 600.0 / 720);
    check_picture(frond_picture_create(&picture_def, &picture));
    check_picture(frond_film_create(&film_def, &film));

    for (int step = 0; step < STEPS; step++) {
        check(frond_world_step(world, 1.0 / 60));
        touched += frond_plant_get_contact_count(plant) > 0;

        if (step % STEPS_A_FRAME) continue;
        check_picture(frond_picture_begin(picture, &scene));
        check_picture(frond_picture_draw_plant(picture, plant, model, FROND_PICTURE_SURFACE));
        check_picture(frond_picture_draw_rigid(picture, &ball_def, ball, leather));
        check_picture(frond_picture_end(picture));
        check_picture(frond_film_add(film, frond_picture_get_pixels(picture)));
        snprintf(path, sizeof path, "%s/frame_%03d.png", folder, step / STEPS_A_FRAME);
        check_picture(frond_picture_write(picture, path));
    }

    snprintf(path, sizeof path, "%s/sheet.png", folder);
    check_picture(frond_film_write_sheet(film, path, 6, 2));
    snprintf(path, sizeof path, "%s/ball.webp", folder);
    check_picture(frond_film_write_webp(film, path));
    check(frond_rigid_get_state(ball, &state));
    printf("the ball touched the plant in %d steps and left at %.1f m/s; pictures are in %s/\n", touched,
           state.velocity.x, folder);

    frond_film_destroy(film);
    frond_picture_destroy(picture);
    frond_world_destroy(world);
    frond_model_destroy(model);
    return touched == 0 || state.velocity.x > 6; /* both sides felt the impulse */
}
