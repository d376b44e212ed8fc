// Target: URDF files, as plants and as robots, and steps of both.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

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

// Returns a robot of links with numbers of all kinds, mostly a tree.
std::string made_up(Input& input) {
    static const char* const JOINTS[] = {"fixed", "revolute", "continuous", "prismatic", "floating", "planar", "ball"};
    const int links = 1 + input.below(8);
    std::string text = "<robot name=\"r\">";
    for (int i = 0; i < links; i++) {
        text += "<link name=\"l" + std::to_string(i) + "\">";
        if (input.below(3)) text += shape(input, "visual");
        if (input.below(3)) text += shape(input, "collision");
        if (input.below(2))
            text += "<inertial><mass value=\"" + text_of(input.number()) + "\"/><inertia ixx=\"" +
                    text_of(input.number()) + "\" iyy=\"1e-3\" izz=\"1e-3\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
        text += "</link>";
    }
    for (int i = 1; i < links; i++) {
        const int parent = input.byte() < 240 ? input.below(i) : input.below(links);
        text += "<joint name=\"j" + std::to_string(i) + "\" type=\"" + JOINTS[input.below(7)] + "\"><parent link=\"l" +
                std::to_string(parent) + "\"/><child link=\"l" + std::to_string(i) +
                "\"/><origin xyz=" + vec_text(input) + " rpy=" + vec_text(input) + "/><axis xyz=" + vec_text(input) +
                "/><limit lower=\"" + text_of(input.number()) + "\" upper=\"" + text_of(input.number()) +
                "\" effort=\"10\" velocity=\"1\"/></joint>";
    }
    return text + "</robot>";
}

frond_world world_of_all() {
    static const frond_world world = [] {
        frond_set_log(nullptr, nullptr);
        const frond_world_def def = frond_default_world_def();
        frond_world made = {};
        require(frond_world_create(&def, &made) == FROND_OK, "no world");
        return made;
    }();
    return world;
}

void try_plant(const std::string& path) {
    const frond_model_def def = frond_default_model_def();
    const frond_plant_def plant_def = frond_default_plant_def();
    frond_model model = {};
    frond_plant plant = {};
    const frond_result result = frond_model_load(path.c_str(), &def, &model);
    require(result == FROND_OK || (model.id == 0 && frond_last_error()[0] != 0),
            "a failed call left a model, or no text");
    require(result != FROND_RESULT_INTERNAL, "an internal error");
    if (result != FROND_OK) return;
    if (frond_plant_create(world_of_all(), model, &plant_def, &plant) == FROND_OK) {
        require(frond_world_step(world_of_all(), 1.0 / 60) == FROND_OK, "no step");
        require_finite(plant);
        frond_plant_destroy(plant);
    }
    require(frond_model_write_urdf(model, path.c_str()) != FROND_RESULT_INTERNAL, "an internal error");
    frond_model_destroy(model);
}

// Calls functions of joints and links, mostly with valid link numbers.
void drive(Input& input, frond_robot robot, frond_plant plant) {
    const int count = frond_robot_get_link_count(robot);
    for (int i = 0; i < 12 && !input.is_empty(); i++) {
        const int link = input.byte() < 230 ? input.below(count) : input.integer();
        frond_bond bond = {};
        switch (input.below(6)) {
            case 0:
                frond_robot_set_joint(robot, link, input.number());
                break;
            case 1:
                frond_robot_drive_to(robot, link, input.number(), input.number(), input.number());
                break;
            case 2:
                frond_robot_drive_at(robot, link, input.number(), input.number());
                break;
            case 3:
                frond_robot_release(robot, link);
                break;
            case 4:
                frond_robot_bond(plant, input.vec(), robot, link, &bond);
                break;
            default:
                require(frond_world_step(world_of_all(), 1.0 / 60) == FROND_OK, "no step");
        }
    }
}

void look(frond_robot robot) {
    require(frond_robot_is_valid(robot), "a robot that was loaded is not valid");
    for (int link = 0; link < frond_robot_get_link_count(robot); link++) {
        frond_link_state state = {};
        frond_robot_link about = {};
        require(frond_robot_get_link_state(robot, link, &state) == FROND_OK, "a valid link has no state");
        require(std::isfinite(state.position.x + state.rotation.w + state.force.y + state.joint_position),
                "a link is not finite");
        require(frond_robot_get_link(robot, link, &about) == FROND_OK, "a valid link is not told of");
        require(frond_robot_find_link(robot, about.name) >= 0, "a link is not found by its name");
        require(frond_joint_name(about.joint)[0] != '?', "a joint has no name");
    }
    frond_surface_view view;
    require(frond_robot_get_surface(robot, &view) == FROND_OK, "a robot has no surface");
}

void try_robot(Input& input, const std::string& path) {
    static const frond_plant plant = [] {
        const frond_stem stem = {-1, {0, 0, 0}, {0, 0.4, 0}, 0.02, 0.01};
        const frond_model_def def = frond_default_model_def();
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = FROND_MECHANICS_ROD;
        frond_model model = {};
        frond_plant made = {};
        require(frond_model_from_stems(&stem, 1, &def, &model) == FROND_OK, "no model");
        require(frond_plant_create(world_of_all(), model, &plant_def, &made) == FROND_OK, "no plant");
        return made;
    }();
    const frond_robot_def def = frond_default_robot_def();
    frond_robot robot = {};
    const frond_result result = frond_robot_load(world_of_all(), path.c_str(), &def, &robot);
    require(result == FROND_OK || (robot.id == 0 && frond_last_error()[0] != 0),
            "a failed call left a robot, or no text");
    require(result != FROND_RESULT_INTERNAL, "an internal error");
    if (result != FROND_OK) return;
    for (int i = 0; i < 3; i++) require(frond_world_step(world_of_all(), 1.0 / 60) == FROND_OK, "no step");
    look(robot);
    drive(input, robot, plant);
    look(robot);
    require_finite(plant);
    frond_robot_destroy(robot);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    world_of_all();
    static const std::string path =
        (std::filesystem::temp_directory_path() / ("frond_fuzz_" + std::to_string(getpid()) + ".urdf")).string();
    Input input = {data, size};
    const bool is_text = input.byte() % 4 == '<' % 4;
    if (is_text) input = {data, size};
    const std::string text =
        is_text ? std::string(reinterpret_cast<const char*>(input.data), input.left) : made_up(input);
    const auto write = [&] { std::ofstream(path, std::ios::binary).write(text.data(), long(text.size())); };
    write();
    try_plant(path);
    write();
    try_robot(input, path);
    std::remove(path.c_str());
    return 0;
}
