// Viewer: a scene to play in. In: a window's events, as calls. Out: a frame of a picture and a panel of Dear ImGui. It
// is independent of windows.
#pragma once

#include <array>
#include <iterator>
#include <map>
#include <memory>

#include "scenes/scene.hpp"
#include "view/camera.hpp"

namespace frond::tools {

enum class Overlay { CAGE, CAPSULES, CONTACTS, STRAIN, COUNT };
enum class Button { LEFT, MIDDLE, RIGHT };

// A spring from the plant to the mouse, as in the paper's figure 7.
struct Hand {
    frond_grab grab = {};
    frond_vec3 hold = {}, start = {};     // hit of the first click's ray on the plant; where the spring began [m]
    frond_vec3 target = {}, wanted = {};  // target of the spring, and the mouse's position [m]
};

// Nearest capsule of each vertex of a model's surface, shared by all plants of the model.
using Shades = std::vector<int>;

// Recent values of a quantity, one per step; the oldest is at `next`.
struct History {
    std::array<float, 240> values = {};
    int next = 0;
    void add(double value);
};

// The stages of a step, in the order in which they run, and the energies of plants.
struct StageTime {
    const char* name;
    double frond_profile::*ms;
};
constexpr StageTime STAGE_TIMES[] = {
    {"collide", &frond_profile::ms_collide},   {"effects", &frond_profile::ms_effects},
    {"assembly", &frond_profile::ms_assembly}, {"solve", &frond_profile::ms_solve},
    {"response", &frond_profile::ms_response}, {"capsules", &frond_profile::ms_capsules},
    {"surface", &frond_profile::ms_surface}};
struct PlantEnergy {
    const char* name;
    double frond_energy::*joule;
};
constexpr PlantEnergy ENERGIES[] = {
    {"kinetic", &frond_energy::kinetic}, {"elastic", &frond_energy::elastic}, {"gravity", &frond_energy::gravity}};

// Settings of models, which need a restart: as the panel's sliders show them, ahead of the viewer's own settings while
// the mouse holds a slider.
struct Wanted {
    double stiffness = 1;                      // [-]
    double capsule_height = 0, cage_size = 0;  // [m], 0: chosen by the library
    Wanted() = default;
    explicit Wanted(const Settings& settings)
        : stiffness(settings.stiffness),
          capsule_height(settings.model.capsule_height),
          cage_size(settings.model.cage_size) {}
};

struct Viewer {
    Casting casting;
    Settings settings;  // including changes made since the start
    Wanted wanted;
    std::string refusal;  // why the wanted settings were refused; empty: they were not
    std::unique_ptr<Play> play;
    Camera camera;
    int width, height;  // size of the picture [pixel]
    std::array<bool, size_t(Overlay::COUNT)> overlays = {};
    bool is_paused = false, shows_panel = true;
    double left_over = 0;  // elapsed time that has not been stepped yet [s]
    frond_report report = {};
    frond_profile cost = {};                                  // smoothed
    std::array<History, std::size(STAGE_TIMES)> stage_times;  // [ms]
    std::array<History, std::size(ENERGIES)> energies;        // of all plants together [J]
    bool measures_energy = false;
    frond_vec3 wind_direction = {1, 0, 0};
    uint32_t trouble = 0;   // bits of all steps so far
    double frame_time = 0;  // smoothed [s]
    double mouse_x = 0, mouse_y = 0;
    enum class Drag { NONE, HAND, ORBIT, PAN } drag = Drag::NONE;
    Button drag_button = Button::LEFT;
    Hand hand;
    size_t own_rigids = 0;              // number of bodies of the scene; the others were thrown
    std::map<uint64_t, Shades> shades;  // by model id
};

// Makes a viewer with the stage as the scene begins. Throws a SceneError.
Viewer make_viewer(const Casting& casting, const Settings& settings, int width, int height);
// Restarts with the current settings. Throws a SceneError, and then changes nothing.
void reset(Viewer& viewer);
// Advances time unless paused: several steps, one or none.
void advance(Viewer& viewer, double seconds);
void step_once(Viewer& viewer);

// A command of a key or of its button in the panel.
struct Command {
    char key;
    std::string (*name)(const Viewer& viewer);
    void (*run)(Viewer& viewer);
};
const std::vector<Command>& commands();

// Actions of the user. Keys without a command are ignored.
void press(Viewer& viewer, char key);
void move_mouse(Viewer& viewer, double x, double y);
void press_button(Viewer& viewer, Button button);
void release_button(Viewer& viewer, Button button);
void turn_wheel(Viewer& viewer, double clicks);

// Settings that can be changed while the scene runs.
void set_mechanics(Viewer& viewer, frond_mechanics mechanics);
void set_integrator(Viewer& viewer, frond_integrator integrator);
void toggle_effect(Viewer& viewer, frond_effects effect);
// Sets the mean wind at the reference height [m/s]; plants feel it from now on.
void set_wind_speed(Viewer& viewer, double speed);
double wind_speed(const Settings& settings);
// Applies the wanted settings and restarts; if the library refuses, keeps the current ones and sets `refusal`.
void take_wanted(Viewer& viewer);
// Throws a ball from beside the camera at the point under the mouse.
void throw_ball(Viewer& viewer);

// First hit of a ray on the surfaces of plants.
struct Pick {
    frond_plant plant;  // null: no hit
    frond_vec3 point;   // [m]
    double distance;    // [m]
};
Pick pick(const Stage& stage, const Ray& ray);
// Takes hold of the plant under the mouse; returns false if there is none.
bool take_hold(Viewer& viewer);
void move_hand(Viewer& viewer);
// Moves the spring to the mouse before each step, no faster than a hand moves, however far the mouse went in a frame.
void follow_mouse(Viewer& viewer);
void let_go(Viewer& viewer);

// Shows the panel at the left, as widgets of Dear ImGui in its current frame.
void show_panel(Viewer& viewer);

// Strain that is shown in red [-].
constexpr double RED_STRAIN = 0.01;
// Returns a colour from blue over green and yellow to red.
std::array<uint8_t, 4> strain_color(double strain);

// Draws one frame of the picture, which has the viewer's size.
void draw(Viewer& viewer, frond_picture* picture);

}  // namespace frond::tools
