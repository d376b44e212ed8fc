// URDF texts and files for tests, and the models loaded from them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "frond/frond.h"
#include "support/system.hpp"

// A temporary folder for files, deleted with this object.
struct UrdfFolder {
    const std::string path = make_temporary_folder();
    UrdfFolder() = default;
    UrdfFolder(const UrdfFolder&) = delete;
    UrdfFolder& operator=(const UrdfFolder&) = delete;
    ~UrdfFolder() { std::filesystem::remove_all(path); }
    std::string write(const std::string& name, const std::string& text) const {
        const std::string file = path + "/" + name;
        std::filesystem::create_directories(std::filesystem::path(file).parent_path());
        std::ofstream(file) << text;
        return file;
    }
};

inline std::string urdf_robot(const std::string& inside) {
    return "<?xml version=\"1.0\"?>\n<robot name=\"r\">\n" + inside + "</robot>\n";
}
inline std::string urdf_visual(const std::string& geometry, const std::string& xyz = "0 0 0") {
    return "<visual><origin xyz=\"" + xyz + "\"/><geometry>" + geometry + "</geometry></visual>";
}
inline std::string urdf_link(const std::string& name, const std::string& inside) {
    return "<link name=\"" + name + "\">" + inside + "</link>\n";
}
inline std::string urdf_joint(const std::string& parent, const std::string& child, const std::string& xyz = "0 0 0",
                              const std::string& type = "fixed", const std::string& more = "") {
    return "<joint name=\"" + parent + "_" + child + "\" type=\"" + type + "\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/><origin xyz=\"" + xyz + "\"/>" + more + "</joint>\n";
}
// Returns a stem of one link, half a metre high.
inline std::string urdf_stem(const std::string& name = "stem") {
    return urdf_link(name, urdf_visual("<cylinder radius=\"0.01\" length=\"0.5\"/>", "0 0 0.25"));
}

// A model, and its organs by name.
struct Loaded {
    frond_model model = {};
    frond_model_info info = {};
    std::map<std::string, frond_organ> organs;
    explicit Loaded(const std::string& path) {
        const frond_model_def def = frond_default_model_def();
        EXPECT_EQ(frond_model_load(path.c_str(), &def, &model), FROND_OK) << frond_last_error();
        if (!model.id) return;
        EXPECT_EQ(frond_model_get_info(model, &info), FROND_OK);
        for (int i = 0; i < info.organ_count; i++) {
            frond_organ organ;
            EXPECT_EQ(frond_model_get_organ(model, i, &organ), FROND_OK);
            organs[organ.name] = organ;
        }
    }
    Loaded(const Loaded&) = delete;
    Loaded& operator=(const Loaded&) = delete;
    ~Loaded() { frond_model_destroy(model); }
};

// Returns the distance of the tip from its start after a second [m].
inline double wandering(frond_model model, frond_mechanics mechanics) {
    const frond_world_def world_def = frond_default_world_def();
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = mechanics;
    frond_world world = {};
    frond_plant plant = {};
    frond_vec3 before = {}, after = {};
    EXPECT_EQ(frond_world_create(&world_def, &world), FROND_OK);
    EXPECT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    EXPECT_EQ(frond_plant_get_tip(plant, &before), FROND_OK);
    for (int i = 0; i < 60; i++) EXPECT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK);
    EXPECT_EQ(frond_plant_get_tip(plant, &after), FROND_OK);
    frond_world_destroy(world);
    return std::hypot(after.x - before.x, after.y - before.y, after.z - before.z);
}
