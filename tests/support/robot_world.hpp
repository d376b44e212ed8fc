// A world with a robot from a URDF file.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "frond/frond_robot.h"

struct RobotWorld {
    frond_world world = {};
    frond_robot robot = {};
    explicit RobotWorld(const std::string& file, bool weightless = false, frond_vec3 place = {0, 0, 0}) {
        frond_world_def def = frond_default_world_def();
        if (weightless) def.gravity = {0, 0, 0};
        EXPECT_EQ(frond_world_create(&def, &world), FROND_OK);
        frond_robot_def robot_def = frond_default_robot_def();
        robot_def.position = place;
        EXPECT_EQ(frond_robot_load(world, file.c_str(), &robot_def, &robot), FROND_OK) << frond_last_error();
    }
    ~RobotWorld() { frond_world_destroy(world); }
    int link(const char* name) const {
        const int found = frond_robot_find_link(robot, name);
        EXPECT_GE(found, 0) << name;
        return found;
    }
    frond_link_state state(const char* name) const {
        frond_link_state out = {};
        EXPECT_EQ(frond_robot_get_link_state(robot, link(name), &out), FROND_OK) << frond_last_error();
        return out;
    }
    void step(int count) const {
        for (int i = 0; i < count; i++) ASSERT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK);
    }
};

inline double length(const frond_vec3& v) {
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}
