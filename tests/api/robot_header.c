/* The robot header compiles as C99, and a C program can load a robot and move it. */
#include "frond/frond_robot.h"

int frond_robot_from_c(const char* file, double* reached) {
    frond_world_def world_def = frond_default_world_def();
    frond_robot_def robot_def = frond_default_robot_def();
    frond_world world;
    frond_robot robot;
    frond_link_state state;
    int i, elbow, failures = 0;
    failures += frond_world_create(&world_def, &world) != FROND_OK;
    failures += frond_robot_load(world, file, &robot_def, &robot) != FROND_OK;
    elbow = frond_robot_find_link(robot, "elbow");
    failures += frond_robot_drive_to(robot, elbow, 1, 0, 0) != FROND_OK;
    for (i = 0; i < 120; i++) failures += frond_world_step(world, 1.0 / 60) != FROND_OK;
    failures += frond_robot_get_link_state(robot, elbow, &state) != FROND_OK;
    *reached = state.joint_position;
    frond_world_destroy(world);
    return failures;
}
