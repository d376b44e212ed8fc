// Viewer: a scene to play in. What a window tells comes in as calls, what it shows goes out as a frame of a picture; of
// windows it knows nothing.
#pragma once

#include <array>
#include <functional>
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
    frond_vec3 hold = {}, start = {};     // where the ray of the first click met the plant; where the spring began [m]
    frond_vec3 target = {}, wanted = {};  // where the spring pulls to, and where the mouse is [m]
};

// Which capsule each vertex of a model's surface is nearest to; one model's plants share it.
using Shades = std::vector<int>;

struct Viewer {
    Casting casting;
    Settings settings;  // with what was switched since
    std::unique_ptr<Play> play;
    Camera camera;
    int width, height;  // of the picture [pixel]
    std::array<bool, size_t(Overlay::COUNT)> overlays = {};
    bool is_paused = false, shows_panel = true;
    double left_over = 0;  // of the time that passed, not stepped yet [s]
    frond_report report = {};
    frond_profile cost = {};  // smoothed
    uint32_t trouble = 0;     // of all steps so far
    double frame_time = 0;    // smoothed [s]
    double mouse_x = 0, mouse_y = 0;
    enum class Drag { NONE, HAND, ORBIT, PAN } drag = Drag::NONE;
    Button drag_button = Button::LEFT;
    Hand hand;
    size_t own_rigids = 0;              // of the scene; the others were thrown
    std::map<uint64_t, Shades> shades;  // by model
};

// The stage as the scene begins. Throws a SceneError.
Viewer make_viewer(const Casting& casting, const Settings& settings, int width, int height);
// From the start again, with what was switched.
void reset(Viewer& viewer);
// Time passes, as long as it is not paused; several steps, one or none.
void advance(Viewer& viewer, double seconds);
void step_once(Viewer& viewer);

// What the user does. Keys are those that the panel names; others are ignored.
void press(Viewer& viewer, char key);
void move_mouse(Viewer& viewer, double x, double y);
void press_button(Viewer& viewer, Button button);
void release_button(Viewer& viewer, Button button);
void turn_wheel(Viewer& viewer, double clicks);

// What is switched.
void set_mechanics(Viewer& viewer, frond_mechanics mechanics);
void set_integrator(Viewer& viewer, frond_integrator integrator);
void toggle_effect(Viewer& viewer, frond_effects effect);
// From beside the camera, at what is under the mouse.
void throw_ball(Viewer& viewer);

// Where the surfaces of plants are first met by a ray.
struct Pick {
    frond_plant plant;  // null: nowhere
    frond_vec3 point;   // [m]
    double distance;    // [m]
};
Pick pick(const Stage& stage, const Ray& ray);
// Takes hold of a plant where the mouse is; false where none is.
bool take_hold(Viewer& viewer);
void move_hand(Viewer& viewer);
// Before each step: the spring goes where the mouse is, no faster than a hand does, however far the mouse went in a
// frame.
void follow_mouse(Viewer& viewer);
void let_go(Viewer& viewer);

// Lines of text at the left: what a key or a click there does, and what the last steps cost.
struct Row {
    std::string text;
    char key = 0;                         // that does it; 0: none
    std::function<void(Viewer&)> action;  // empty: it only tells
};
constexpr double ROW_HEIGHT = 15, PANEL_LEFT = 12, PANEL_TOP = 10, PANEL_WIDTH = 290;  // [pixel]
std::vector<Row> panel_of(const Viewer& viewer);

// The strain at which a colour is red [-].
constexpr double RED_STRAIN = 0.01;
// From blue over green and yellow to red.
std::array<uint8_t, 4> strain_color(double strain);

// One frame of the picture, whose size is the viewer's.
void draw(Viewer& viewer, frond_picture* picture);

}  // namespace frond::tools
