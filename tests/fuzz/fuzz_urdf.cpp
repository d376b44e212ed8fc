// Target: URDF files, as plants and as robots, and steps of both.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "frond/frond_robot.h"
#include "fuzz/input.hpp"

using namespace frond::fuzz;

namespace {

std::string text_of(double number) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

std::string vec_text(Input& input) {
    const std::string x = text_of(input.number()), y = text_of(input.number());
    return "\"" + x + " " + y + " " + text_of(input.number()) + "\"";
}

std::string geometry(Input& input) {
    const std::string a = text_of(input.number()), b = text_of(input.number());
    switch (input.below(5)) {
        case 0:
            return "<sphere radius=\"" + a + "\"/>";
        case 1:
            return "<box size=" + vec_text(input) + "/>";
        case 2:
            return "<capsule radius=\"" + a + "\" length=\"" + b + "\"/>";
        case 3:
            return "<mesh filename=\"no_such.obj\" scale=" + vec_text(input) + "/>";
        default:
            return "<cylinder radius=\"" + a + "\" length=\"" + b + "\"/>";
    }
}

std::string shape(Input& input, const char* tag) {
    const std::string origin = "<origin xyz=" + vec_text(input) + " rpy=" + vec_text(input) + "/>";
    return std::string("<") + tag + ">" + origin + "<geometry>" + geometry(input) + "</geometry></" + tag + ">";
}

// A tree, mostly, of links with numbers of all kinds.
std::string made_up(Input& input) {
    static const char* const JOINTS[] = {"fixed", "revolute", "continuous", "prismatic", "floating", "planar", "ball"};
    const int links = 1 + input.below(8);
    std::string text = "<robot name=\"r\">";
    for (int i = 0; i < links; i++) {
        text += "<link name=\"l" + std::to_string(i) + "\">";
        if (input.below(3)) text += shape(input, "visual");
        if (input.below(3)) text += shape(input, "collision");
        if (input.below(2))
            text += "<inertial><mass value=\"" + text_of(input.number()) + "\"/><inertia ixx=\"" + text_of(input.number()) +
                    "\" iyy=\"1e-3\" izz=\"1e-3\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
        text += "</link>";
    }
    for (int i = 1; i < links; i++) {
        const int parent = input.byte() < 240 ? input.below(i) : input.below(links);
        text += "<joint name=\"j" + std::to_string(i) + "\" type=\"" + JOINTS[input.below(7)] + "\"><parent link=\"l" +
                std::to_string(parent) + "\"/><child link=\"l" + std::to_string(i) + "\"/><origin xyz=" + vec_text(input) +
                " rpy=" + vec_text(input) + "/><axis xyz=" + vec_text(input) + "/><limit lower=\"" + text_of(input.number()) +
                "\" upper=\"" + text_of(input.number()) + "\" effort=\"10\" velocity=\"1\"/></joint>";
    }
    return text + "</robot>";
}

void try_plant(frond_world world, const std::string& path) {
    const frond_model_def def = frond_default_model_def();
    const frond_plant_def plant_def = frond_default_plant_def();
    frond_model model = {};
    frond_plant plant = {};
    const frond_result result = frond_model_load(path.c_str(), &def, &model);
    require(result == FROND_OK || (model.id == 0 && frond_last_error()[0] != 0), "a failed call left a model, or no text");
    require(result != FROND_INTERNAL, "an internal error");
    if (result != FROND_OK) return;
    if (frond_plant_create(world, model, &plant_def, &plant) == FROND_OK) {
        require(frond_world_step(world, 1.0 / 60) == FROND_OK, "no step");
        require_finite(plant);
        frond_plant_destroy(plant);
    }
    frond_model_destroy(model);
}

void try_robot(frond_world world, const std::string& path) {
    const frond_robot_def def = frond_default_robot_def();
    frond_robot robot = {};
    const frond_result result = frond_robot_load(world, path.c_str(), &def, &robot);
    require(result == FROND_OK || (robot.id == 0 && frond_last_error()[0] != 0), "a failed call left a robot, or no text");
    require(result != FROND_INTERNAL, "an internal error");
    if (result != FROND_OK) return;
    for (int i = 0; i < 3; i++) require(frond_world_step(world, 1.0 / 60) == FROND_OK, "no step");
    for (int link = 0; link < frond_robot_get_link_count(robot); link++) {
        frond_link_state state = {};
        require(frond_robot_get_link_state(robot, link, &state) == FROND_OK, "a valid link has no state");
    }
    frond_robot_destroy(robot);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const frond_world world = [] {
        frond_set_log(nullptr, nullptr);
        const frond_world_def def = frond_default_world_def();
        frond_world made = {};
        require(frond_world_create(&def, &made) == FROND_OK, "no world");
        return made;
    }();
    static const std::string path =
        (std::filesystem::temp_directory_path() / ("frond_fuzz_" + std::to_string(getpid()) + ".urdf")).string();
    Input input = {data, size};
    const bool is_text = input.byte() % 4 == '<' % 4;
    if (is_text) input = {data, size};
    const std::string text =
        is_text ? std::string(reinterpret_cast<const char*>(input.data), input.left) : made_up(input);
    std::ofstream(path, std::ios::binary).write(text.data(), long(text.size()));
    try_plant(world, path);
    try_robot(world, path);
    std::remove(path.c_str());
    return 0;
}
