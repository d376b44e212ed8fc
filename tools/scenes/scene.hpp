// Scene: a short simulation with plants, written once and run by the frond command, tests and benchmarks. Uses public
// headers only.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "frond/frond_robot.h"

namespace frond::tools {

// A failed call of the library, or an invalid word from the user; the text gives the remedy.
struct SceneError : std::runtime_error {
    using std::runtime_error::runtime_error;
};
// Throws a SceneError with frond_last_error() if a call failed.
void must(frond_result result);

// All settings that a user may change with --set key=value.
struct Settings {
    frond_world_def world = frond_default_world_def();
    frond_model_def model = frond_default_model_def();
    frond_plant_def plant = frond_default_plant_def();
    frond_wind_def wind = frond_default_wind_def();  // the world has air only if the velocity is not zero
    double dt = 1.0 / 60;                            // [s]
    double pull = 0.2;                               // displacement by the user's drag, share of the plant's height [-]
    int plants = 0;                                  // number of plants in a field; 0: as many as it has
    int walkers = 1;                                 // number of walkers in a field
    double patch_wind = 5;                           // wind speed over a patch of a field [m/s]
    double budget = 0;                               // time for a step of all plants [ms]; 0: unlimited
    bool detail = true;                              // a field's distant plants are simulated at lower detail
    int threads = 1;
    double grab_stiffness = 60;  // [N/m]; 0: as stiff as needed to move the plant
    struct OrganOverride {
        std::string organ;
        double frond_material::*field;
        double value;
    };
    std::vector<OrganOverride> organs;  // material.<organ or kind>.<field>=value
    double stiffness = 1;               // factor on Young's modulus of all organs of plant files [-]
};
// Applies one "key=value"; throws a SceneError that names the existing keys or values.
void apply_setting(Settings& settings, const std::string& assignment);
// Returns lines of "key  description", for --help.
std::string settings_help();

// Sizes of cage cells with which the two models reach the paper's counts of nodes and tets [m].
constexpr double PAPER_CORN_CELL = 0.24, PAPER_CUCUMBER_CELL = 0.205;

// Threads for a world. Makes as many as requested, less the caller's own; they wait between jobs.
class Team {
public:
    explicit Team(int threads);
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;
    ~Team();
    // A frond_parallel_for_fn; user: the team.
    static void parallel_for(int count, frond_job_fn* job, void* data, void* user);

private:
    struct Work;
    std::unique_ptr<Work> work;
};

// The objects of a running scene.
struct Stage {
    Settings settings;
    std::unique_ptr<Team> team;  // null if there is one thread
    frond_world world = {};
    std::vector<frond_model> models;
    std::vector<frond_plant> plants;
    std::vector<frond_model> plant_models;  // one per plant
    std::vector<frond_grab> grabs;
    std::vector<frond_rigid_def> rigid_defs;  // as they were created
    std::vector<frond_rigid> rigids;
    std::vector<frond_robot> robots;
    frond_vec3 lower = {}, upper = {};  // box of all plants at the start [m]
    bool has_view = false;              // pictures show the box below and the plants in it instead of all plants
    frond_vec3 view_lower = {}, view_upper = {};
    std::vector<frond_vec3> places;  // position of each plant [m]
    frond_vec3 patch = {};           // middle of the patch over which the wind blows [m]
    double patch_radius = 0;         // [m]
    double time = 0;                 // [s]
    frond_vec3 drag_start = {};      // position at which the user took hold [m]
    double drag_stiffness = 0;       // current stiffness of the user's spring [N/m]

    explicit Stage(const Settings& settings);
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    ~Stage();
    frond_model load(const std::string& path);
    // Takes ownership of the model.
    frond_model keep(frond_model model);
    // Adds a plant, turned about its vertical axis by `turn` [rad].
    frond_plant plant(frond_model model, frond_vec3 position, double turn = 0);
    frond_rigid rigid(const frond_rigid_def& def);
    // Returns whether a plant stands in view or somewhat beside it.
    bool sees(size_t plant) const;
};

struct Scene {
    const char* name;
    const char* text;
    double duration;  // [s]
    void (*set_defaults)(Settings& settings);
    void (*build)(Stage& stage);
    void (*drive)(Stage& stage);    // called before each step
    const char* without = nullptr;  // a setting with which the scene is also run and pictured, for comparison
};
const std::vector<Scene>& scenes();
// Sets defaults for the scene `field`.
void field_defaults(Settings& settings);
void build_field(Stage& stage);
void drive_field(Stage& stage);
// The scene of that name, or the scene "tug" with a plant file. Throws a SceneError that names the existing scenes.
struct Casting {
    const Scene* scene;
    std::string file;  // empty: the scene's own plants
};
Casting cast(const std::string& name_or_file);
// Sets up the stage; the user's assignments override the scene's defaults.
struct Play {
    Casting casting;
    Stage stage;
    Play(const Casting& casting, const Settings& settings);
    void step();  // drives the scene and advances by settings.dt
};
Settings settings_of(const Casting& casting, const std::vector<std::string>& assignments);

// Returns the depth of the plant's deepest contact above a height in the last step [m]; 0 if there is none.
double contact_depth(frond_plant plant, double above = -1e30);
// Returns a point of the main axis at a share of the plant's height [m].
frond_vec3 point_on_axis(frond_model model, double share);

// Returns the path of a model, "corn/corn.obj", in FROND_MODELS, the source tree or the installation.
std::string model_path(const std::string& name);

}  // namespace frond::tools
