// The field: thousands of plants of four kinds in strips across a path on which a walker follows a ball.
#include <algorithm>
#include <cmath>

#include "scenes/scene.hpp"

namespace frond::tools {

namespace {

constexpr int ALL = 10000;
constexpr double APART = 0.7, STRIP = 8, PATH = 0.35, RAGGED = 0.12;  // distances and widths [m]
constexpr double WALKER_SPEED = 1.3, BALL_SPEED = 1.8, BALL = 0.2;    // [m/s], [m]
constexpr double GARDEN = 6;                                          // cucumbers grow this close to the path [m]
constexpr double EYES = 1.65;                                         // height of the walker's eyes [m]

// Capsule heights that give some 40 to 70 capsules for each kind.
struct Kind {
    const char* file;
    double capsule_height;  // [m]
};
constexpr Kind KINDS[] = {
    {"wheat/wheat.obj", 0.3}, {"corn/corn.obj", 0.4}, {"sunflower/sunflower.obj", 0.3}, {"cucumber/cucumber.obj", 0.4}};

// Returns a pseudo-random number in 0..1.
double chance(int i, int k) {
    const double x = std::sin(12.9898 * i + 78.233 * k + 0.5) * 43758.5453;
    return x - std::floor(x);
}

int kind_at(double x, double z, int row) {
    const int strip = int(std::floor(x / STRIP)) & 3;
    return strip == 3 && (std::abs(z) > GARDEN || row % 2) ? 0 : strip;
}

void load_kinds(Stage& stage) {
    const double given = stage.settings.model.capsule_height;
    for (const Kind& kind : KINDS) {
        stage.settings.model.capsule_height = given > 0 ? given : kind.capsule_height;
        stage.load(model_path(kind.file));
    }
    stage.settings.model.capsule_height = given;
}

// Adds a gust that oscillates over the patch and decreases to zero at its rim.
void blow(const frond_vec3* points, int count, double time, frond_vec3* velocities, void* user) {
    const Stage& stage = *static_cast<const Stage*>(user);
    for (int i = 0; i < count; i++) {
        const double x = points[i].x - stage.patch.x, z = points[i].z - stage.patch.z;
        const double share = std::max(0.0, 1 - (x * x + z * z) / (stage.patch_radius * stage.patch_radius));
        const double speed = stage.settings.patch_wind * share * (0.7 + 0.3 * std::sin(2.5 * time - 0.6 * x));
        velocities[i].x += speed * std::min(1.0, time);
    }
}

void add_body(Stage& stage, frond_shape shape, frond_vec3 size, double mass, frond_rigid_state state) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = shape;
    def.size = size;
    def.mass = mass;
    def.state = state;
    stage.rigid(def);
}

// Adds one walker on the path, or a crowd that comes in from the side in rows of five.
void add_walkers(Stage& stage, double start) {
    for (int i = 0; i < stage.settings.walkers; i++) {
        frond_rigid_state state = frond_default_rigid_def().state;
        const bool crowd = stage.settings.walkers > 1;
        state.position = {start - (crowd ? 3 + 1.2 * (i / 5) : 0), 0.86, crowd ? 1.3 * (i % 5 - 2) : 0};
        add_body(stage, FROND_SHAPE_CAPSULE, {0.22, 0.62, 0}, 0, state);
    }
}

}  // namespace

void field_defaults(Settings& settings) {
    settings.plant.mechanics = FROND_MECHANICS_ROD;
    settings.plant.starts_asleep = true;
    // Contacts between neighbours' leaves are invisible in a field, and cost several times as much as everything else.
    settings.plant.effects &= ~uint32_t(FROND_EFFECT_PLANT_CONTACT);
}

void build_field(Stage& stage) {
    const int count = stage.settings.plants > 0 ? stage.settings.plants : ALL;
    const int side = int(std::ceil(std::sqrt(double(count))));
    const double half = 0.5 * APART * side;
    load_kinds(stage);
    for (int i = 0; i < count; i++) {
        const int row = i / side;
        const double x = APART * (i % side) - half + RAGGED * (chance(i, 0) - 0.5);
        double z = APART * row - half + RAGGED * (chance(i, 1) - 0.5);
        if (std::abs(z) < PATH) z = std::copysign(PATH + RAGGED * chance(i, 2), z);
        stage.plant(stage.models[size_t(kind_at(x, z, row))], {x, 0, z}, 6.28 * chance(i, 3));
    }
    frond_rigid_state still = frond_default_rigid_def().state;
    add_body(stage, FROND_SHAPE_PLANE, {}, 0, still);
    const double start = -half + (stage.settings.walkers > 1 ? 0.0 : 0.5);
    frond_rigid_state ball = still;
    ball.position = {start + 1.2, BALL, 0.05};
    ball.velocity = {BALL_SPEED, 0, 0};
    ball.angular_velocity = {0, 0, -BALL_SPEED / BALL};
    add_body(stage, FROND_SHAPE_SPHERE, {BALL, 0, 0}, 2, ball);
    add_walkers(stage, start);

    stage.patch = {start + 6, 0, 4};
    stage.patch_radius = 4;
    if (stage.settings.patch_wind > 0) must(frond_world_set_wind_field(stage.world, blow, &stage));
    if (!stage.settings.detail) return;
    frond_detail_def detail = frond_default_detail_def();
    detail.budget = stage.settings.budget;
    must(frond_world_set_detail(stage.world, &detail));
}

void drive_field(Stage& stage) {
    frond_vec3 eyes = {};
    for (size_t i = 2; i < stage.rigids.size(); i++) {
        frond_rigid_state state;
        must(frond_rigid_get_state(stage.rigids[i], &state));
        state.position.x += WALKER_SPEED * stage.settings.dt;
        must(frond_rigid_set_state(stage.rigids[i], &state));
        if (i == 2) eyes = {state.position.x, EYES, state.position.z};
    }
    stage.has_view = true;
    stage.view_lower = {eyes.x - 3, 0, eyes.z - 5};
    stage.view_upper = {eyes.x + 9, 2, eyes.z + 5};
    if (stage.settings.detail) must(frond_world_set_viewer(stage.world, eyes));
}

}  // namespace frond::tools
