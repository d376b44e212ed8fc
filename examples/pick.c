/* pick: a hand reaches for a cucumber, closes its fingers, pulls it away until its stalk breaks, and lowers it.
 * Writes frames, a contact sheet and a moving picture.    pick [MODELS [FOLDER]] */
#include <frond/frond_robot.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
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

enum { COME = 30, CLOSE = 150, DRAW = 210, LOWER = 420, STEPS = 540, STEPS_A_FRAME = 15 };

/* Returns the lower end of an organ [m]. */
static frond_vec3 lower_end(frond_plant plant, frond_model model, const char* organ) {
    frond_vec3 end = {0, INFINITY, 0};
    frond_surface_view view;
    frond_model_info info;
    frond_part part;
    check(frond_plant_get_surface(plant, &view));
    check(frond_model_get_info(model, &info));
    for (int i = 0; i < info.part_count; i++) {
        check(frond_model_get_part(model, i, &part));
        if (strcmp(part.organ, organ)) continue;
        for (int k = 3 * part.first_triangle; k < 3 * (part.first_triangle + part.triangle_count); k++) {
            const float* p = view.positions + 3 * view.indices[k];
            if (p[1] < end.y) end = (frond_vec3){p[0], p[1], p[2]};
        }
    }
    return end;
}

static double dot(frond_vec3 a, frond_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

int main(int argc, char** argv) {
    const char* models = argc > 1 ? argv[1] : "models";
    const char* folder = argc > 2 ? argv[2] : "pick_frames";
    const frond_color steel = {0.30f, 0.33f, 0.38f, 1};
    frond_world_def world_def = frond_default_world_def();
    frond_model_def model_def = frond_default_model_def();
    frond_plant_def plant_def = frond_default_plant_def();
    frond_robot_def hand_def = frond_default_robot_def();
    frond_picture_def picture_def = frond_default_picture_def();
    frond_picture_scene scene = frond_default_picture_scene();
    frond_film_def film_def = frond_default_film_def();
    frond_world world;
    frond_model cucumber;
    frond_plant plant;
    frond_robot hand;
    frond_link_state palm, finger;
    frond_fragment broken = {0};
    frond_rigid_state fruit = {0};
    frond_vec3 end;
    frond_picture* picture;
    frond_film* film;
    double strongest = 0, turn, away;
    int reach, rise, left, right, broken_at = -1;
    char path[1024];

    /* With rods, a fruit comes off its stalk. They take their masses from the cage's cells, which fruit and stalk
     * share, so these are small. */
    model_def.cage_size = 0.1;
    check(frond_world_create(&world_def, &world));
    snprintf(path, sizeof path, "%s/cucumber/cucumber.obj", models);
    check(frond_model_load(path, &model_def, &cucumber));
    plant_def.mechanics = FROND_MECHANICS_ROD;
    plant_def.effects |= FROND_EFFECT_BREAKING;
    check(frond_plant_create(world, cucumber, &plant_def, &plant));
    end = lower_end(plant, cucumber, "fruit_3");

    /* The hand stands beyond the fruit, seen from the stem; it is open, with rubber on its fingers. */
    turn = 0.5 * atan2(-end.x, -end.z);
    away = 1 + 0.72 / hypot(end.x, end.z);
    hand_def.position = (frond_vec3){away * end.x, 0, away * end.z};
    hand_def.rotation =
        (frond_quat){-sqrt(0.5) * cos(turn), sqrt(0.5) * sin(turn), sqrt(0.5) * sin(turn), sqrt(0.5) * cos(turn)};
    hand_def.friction = 2;
    snprintf(path, sizeof path, "%s/arm/picker.urdf", models);
    check(frond_robot_load(world, path, &hand_def, &hand));
    reach = frond_robot_find_link(hand, "reach");
    rise = frond_robot_find_link(hand, "rise");
    left = frond_robot_find_link(hand, "left");
    right = frond_robot_find_link(hand, "right");
    check(frond_robot_set_joint(hand, rise, end.y + 0.05));

    /* The studio. */
    mkdir(folder, 0777);
    picture_def.width = film_def.width = 600;
    picture_def.height = film_def.height = 600;
    film_def.frames_per_second = 60.0 / STEPS_A_FRAME;
    scene.camera = frond_picture_frame((frond_vec3){end.x - 0.4, 0, end.z - 0.5},
                                       (frond_vec3){end.x + 0.8, 1.3, end.z + 0.1}, scene.up, 0.4, 0.1, 1);
    check_picture(frond_picture_create(&picture_def, &picture));
    check_picture(frond_film_create(&film_def, &film));

    for (int step = 0; step < STEPS; step++) {
        /* Reach for the fruit, close the fingers, pull away, lower. */
        if (step == COME) check(frond_robot_drive_to(hand, reach, 0.48, 0.3, 0));
        if (step == CLOSE) check(frond_robot_drive_at(hand, left, 0.1, 0));
        if (step == CLOSE) check(frond_robot_drive_at(hand, right, 0.1, 0));
        if (step == DRAW) check(frond_robot_drive_to(hand, reach, 0, 0.15, 0));
        if (step == LOWER) check(frond_robot_drive_to(hand, rise, 0.25, 0.3, 0));
        check(frond_world_step(world, 1.0 / 60));
        for (int link = left; link <= right; link++) {
            check(frond_robot_get_link_state(hand, link, &finger));
            if (step >= DRAW && broken_at < 0) strongest = fmax(strongest, sqrt(dot(finger.force, finger.force)));
        }
        if (broken_at < 0 && frond_plant_get_fragment_count(plant)) broken_at = step;

        if (step % STEPS_A_FRAME) continue;
        check_picture(frond_picture_begin(picture, &scene));
        check_picture(frond_picture_draw_plant(picture, plant, cucumber, FROND_PICTURE_SURFACE));
        check_picture(frond_picture_draw_robot(picture, hand, steel));
        check_picture(frond_picture_end(picture));
        check_picture(frond_film_add(film, frond_picture_get_pixels(picture)));
        snprintf(path, sizeof path, "%s/frame_%03d.png", folder, step / STEPS_A_FRAME);
        check_picture(frond_picture_write(picture, path));
    }
    snprintf(path, sizeof path, "%s/sheet.png", folder);
    check_picture(frond_film_write_sheet(film, path, 6, 2));
    snprintf(path, sizeof path, "%s/pick.webp", folder);
    check_picture(frond_film_write_webp(film, path));

    /* The fragment is in the hand. */
    check(frond_robot_get_link_state(hand, left, &palm));
    if (broken_at >= 0) {
        check(frond_plant_get_fragment(plant, 0, &broken));
        check(frond_rigid_get_state(broken.rigid, &fruit));
    }
    printf("a fruit of %.0f g came off after %.2f s; a finger felt up to %.1f N; it is %.2f m above the hand\n",
           1000 * broken.mass, broken_at / 60.0, strongest, fruit.position.y - palm.position.y);

    frond_film_destroy(film);
    frond_picture_destroy(picture);
    frond_world_destroy(world);
    frond_model_destroy(cucumber);
    end = (frond_vec3){fruit.position.x - palm.position.x, fruit.position.y - palm.position.y,
                       fruit.position.z - palm.position.z};
    return !(broken_at > DRAW &&
             sqrt(dot(end, end)) < 0.25); /* its stalk held until it was pulled, and the hand holds it */
}
