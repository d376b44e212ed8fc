// The scenes.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "scenes/rosette.hpp"

namespace frond::tools {
namespace {

// ---- the plants of the paper, with its cage sizes --------------------------------------------------------------

void corn_defaults(Settings& settings) {
    settings.model.cage_size = PAPER_CORN_CELL;
    settings.grab_stiffness = 30;
}
void cucumber_defaults(Settings& settings) {
    settings.model.cage_size = PAPER_CUCUMBER_CELL;
}
void build_corn(Stage& stage) {
    stage.plant(stage.load(model_path("corn/corn.obj")), {0, 0, 0});
}
void build_cucumber(Stage& stage) {
    stage.plant(stage.load(model_path("cucumber/cucumber.obj")), {0, 0, 0});
}
// A plant of any size and stiffness.
void tug_defaults(Settings& settings) {
    settings.grab_stiffness = 0;
}
void rest(Stage&) {}

// ---- the user's drag ---------------------------------------------------------------------------------------------

// Returns the plant's height, or half its width if it creeps [m].
double reach_of(const Stage& stage) {
    const frond_vec3 &a = stage.lower, &b = stage.upper;
    return std::max({b.y - a.y, (b.x - a.x) / 2, (b.z - a.z) / 2});
}

// Returns a stiffness that carries a few times the plant's weight when stretched by the plant's height [N/m].
double gentle_stiffness(const Stage& stage) {
    constexpr double WEIGHTS = 3;
    frond_model_info info;
    must(frond_model_get_info(stage.plant_models[0], &info));
    return std::max(WEIGHTS * 9.81 * info.mass / reach_of(stage), 1e-6);
}

void take_hold(Stage& stage, frond_vec3 point) {
    for (frond_grab grab : stage.grabs) frond_grab_destroy(grab);
    stage.grabs.resize(1);
    must(frond_grab_create(stage.plants[0], point, stage.drag_stiffness, &stage.grabs[0]));
}

// Takes a stiffer spring if the plant has followed by less than half of the displacement.
void pull_harder(Stage& stage, double way) {
    constexpr double FOLLOWS = 0.5, HARDER = 1.3;
    frond_vec3 at;
    must(frond_grab_get(stage.grabs[0], &at, nullptr, nullptr));
    if (way < 0.01 * reach_of(stage) || at.x - stage.drag_start.x > FOLLOWS * way) return;
    stage.drag_stiffness *= HARDER;
    take_hold(stage, at);
}

constexpr double GRAB_AT = 0.5, PULLED_AT = 1.5, LET_GO_AT = 2.0;  // [s]

// Takes hold of the axis at three quarters of the height, pulls it aside, holds it and lets it go.
void drag(Stage& stage) {
    const double t = stage.time, half_step = 0.5 * stage.settings.dt;
    if (stage.settings.pull == 0) return;
    if (t > LET_GO_AT - half_step) {
        for (frond_grab grab : stage.grabs) frond_grab_destroy(grab);
        stage.grabs.clear();
        return;
    }
    if (t < GRAB_AT - half_step) return;
    if (stage.grabs.empty()) {
        const double given = stage.settings.grab_stiffness;
        stage.drag_stiffness = given > 0 ? given : gentle_stiffness(stage);
        take_hold(stage, point_on_axis(stage.plant_models[0], 0.75));
        must(frond_grab_get(stage.grabs[0], nullptr, &stage.drag_start, nullptr));
    }
    const double s = std::clamp((t - GRAB_AT) / (PULLED_AT - GRAB_AT), 0.0, 1.0), eased = s * s * (3 - 2 * s);
    const double way = stage.settings.pull * reach_of(stage) * eased;
    const frond_vec3& from = stage.drag_start;
    if (stage.settings.grab_stiffness == 0 && s < 1) pull_harder(stage, way);
    must(frond_grab_move(stage.grabs[0], {from.x + way, from.y - 0.3 * way, from.z}));
}

// ---- bodies that touch plants ---------------------------------------------------------------------------------

frond_rigid_def rigid_def(frond_shape shape, frond_vec3 size, double mass, frond_vec3 place) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = shape;
    def.size = size;
    def.mass = mass;
    def.state.position = place;
    return def;
}
void add_ground(Stage& stage) {
    stage.rigid(rigid_def(FROND_SHAPE_PLANE, {}, 0, {0, 0, 0}));
}

// A football, thrown at the stalk.
void build_ball(Stage& stage) {
    build_corn(stage);
    add_ground(stage);
    frond_rigid_def ball = rigid_def(FROND_SHAPE_SPHERE, {0.11, 0, 0}, 0.43, {-1.6, 1.1, 0.02});
    ball.state.velocity = {6, 1.2, 0};
    stage.rigid(ball);
}

// A walker's capsule moves along a row of ten plants.
constexpr int ROW = 10;
constexpr double ROW_STEP = 0.35, WALK_SPEED = 1.2;  // [m], [m/s]
void build_walk(Stage& stage) {
    const frond_model model = stage.load(model_path("corn/corn.obj"));
    for (int i = 0; i < ROW; i++) stage.plant(model, {ROW_STEP * i, 0, i % 2 ? 0.15 : -0.15});
    add_ground(stage);
    stage.rigid(rigid_def(FROND_SHAPE_CAPSULE, {0.22, 0.62, 0}, 0, {-1, 0.86, 0}));
}
void walk(Stage& stage) {
    frond_rigid_state state;
    must(frond_rigid_get_state(stage.rigids.back(), &state));
    state.position.x += WALK_SPEED * stage.settings.dt;
    must(frond_rigid_set_state(stage.rigids.back(), &state));
}

// Two of the paper's plants, so close that their leaves overlap (its figure 5).
void build_corn_pair(Stage& stage) {
    const frond_model model = stage.load(model_path("corn/corn.obj"));
    stage.plant(model, {-0.45, 0, 0}, 0.1);
    stage.plant(model, {0.45, 0, 0.03}, -0.05);
}

// Two plants that stand in each other's leaves, of which the user pulls one away.
void build_tangle(Stage& stage) {
    const frond_model model = stage.load(model_path("corn/corn.obj"));
    stage.plant(model, {0, 0, 0});
    stage.plant(model, {-0.35, 0, 0.06}, 0.5);
}

// A field of touching plants, in rows that are staggered against each other.
constexpr int FIELD = 17;
void build_corn_field(Stage& stage) {
    constexpr double STEP = 0.8;  // [m]
    const frond_model model = stage.load(model_path("corn/corn.obj"));
    const int count = stage.settings.plants > 0 ? stage.settings.plants : FIELD;
    for (int i = 0; i < count; i++) {
        const int row = i / 5, place = i % 5;
        const double x = STEP * (place + (row % 2 ? 0.5 : 0)), z = 0.87 * STEP * row;
        stage.plant(model, {x, 0, z}, 2.4 * i);
    }
}

// A ribbon-shaped leaf whose lower half is held upright, and whose tip the user lays down onto that, and further.
constexpr double FLAG_LENGTH = 0.6, FLAG_WIDTH = 0.08, FLAG_HELD = 0.3;  // [m]
void flag_defaults(Settings& settings) {
    settings.model.rest = FROND_REST_WITHOUT_GRAVITY;
    settings.model.capsule_height = 0.03;
    settings.plant.mechanics = FROND_MECHANICS_ROD;
    settings.plant.effects |= FROND_EFFECT_SELF_CONTACT;
    settings.plant.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);  // plastic, it would stay crumpled
    settings.world.gravity = {0, 0, 0};
    settings.plant.root_height = FLAG_HELD;
    settings.grab_stiffness = 5;
}
void build_flag(Stage& stage) {
    constexpr int LONG = 40, WIDE = 2;
    std::vector<float> xyz;
    std::vector<int32_t> indices;
    for (int i = 0; i <= LONG; i++)
        for (int k = 0; k <= WIDE; k++)
            for (const double value : {0.0, FLAG_LENGTH * i / LONG, FLAG_WIDTH * (double(k) / WIDE - 0.5)})
                xyz.push_back(float(value));
    for (int32_t i = 0; i < LONG; i++)
        for (int32_t k = 0; k < WIDE; k++) {
            const int32_t a = i * (WIDE + 1) + k, b = a + WIDE + 1;
            indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    frond_material material;
    must(frond_material_preset("blade", &material));
    material.young = 2e7;
    const frond_organ_material organ = {"blade", material};
    frond_model_def def = stage.settings.model;
    def.organs = &organ;
    def.organ_count = 1;
    def.scale = 1;
    def.up = {0, 1, 0};
    frond_model model = {};
    must(frond_model_from_triangles(xyz.data(), int(xyz.size() / 3), indices.data(), int(indices.size() / 3), &def,
                                    &model));
    stage.plant(stage.keep(model), {0, 0, 0});
}

// Moves the tip over and down in a half circle, and then through the lower half.
void fold(Stage& stage) {
    constexpr double PI = 3.14159265358979, BEGIN = 0.2, DOWN = 2.0, PAST = 3.0;  // [s]
    constexpr double FAR = 0.06;                                                  // beyond the lower half [m]
    const double t = stage.time;
    if (t < BEGIN) return;
    if (stage.grabs.empty()) {
        stage.drag_stiffness = stage.settings.grab_stiffness;
        take_hold(stage, {0, FLAG_LENGTH, 0});
    }
    const double turn = PI * std::clamp((t - BEGIN) / (DOWN - BEGIN), 0.0, 1.0);
    const double past = std::clamp((t - DOWN) / (PAST - DOWN), 0.0, 1.0), radius = FLAG_LENGTH - FLAG_HELD;
    const double x = radius * std::sin(turn) - FAR * past, y = FLAG_HELD + radius * std::cos(turn);
    must(frond_grab_move(stage.grabs[0], {x, y, 0}));
}

// A crate that is released a little above the cucumber's leaves.
void build_crate(Stage& stage) {
    build_cucumber(stage);
    add_ground(stage);
    stage.rigid(rigid_def(FROND_SHAPE_BOX, {0.1, 0.06, 0.1}, 0.1, {0.14, 1.35, 0.06}));
}

// A small cardboard box that is released a little above a rosette's leaves.
void build_box(Stage& stage) {
    stage.plant(make_rosette(stage), {0, 0, 0});
    add_ground(stage);
    frond_rigid_def box = rigid_def(FROND_SHAPE_BOX, {0.12, 0.06, 0.12}, 0.08, {0, 0.39, 0});
    box.state.rotation = {0, std::sin(0.2), 0, std::cos(0.2)};
    stage.rigid(box);
}

// A cucumber with its stake, tilted so far that it comes to lean on a trellis of four slats on two posts.
constexpr double LEAN = 0.16;  // [rad]
void build_trellis(Stage& stage) {
    stage.settings.plant.rotation = {0, 0, -std::sin(0.5 * LEAN), std::cos(0.5 * LEAN)};
    build_cucumber(stage);
    add_ground(stage);
    constexpr double AWAY = 0.36, WIDE = 0.5;  // [m]
    for (const double side : {-WIDE, WIDE})
        stage.rigid(rigid_def(FROND_SHAPE_BOX, {0.02, 1.1, 0.02}, 0, {AWAY + 0.03, 1.1, side}));
    for (const double height : {0.5, 1.0, 1.5, 2.0})
        stage.rigid(rigid_def(FROND_SHAPE_BOX, {0.01, 0.02, WIDE + 0.05}, 0, {AWAY, height, 0}));
}

// ---- a plant of rods --------------------------------------------------------------------------------------------

constexpr int TWIG_PIECES = 60;
constexpr double TWIG_PIECE = 0.05;  // [m]
void twig_defaults(Settings& settings) {
    settings.model.capsule_height = TWIG_PIECE;
    settings.model.cage_size = 0.3;
    settings.plant.mechanics = FROND_MECHANICS_ROD;
    settings.grab_stiffness = 10;
}
// A stem with five branches, each ten segments long.
void build_twig(Stage& stage) {
    constexpr int BRANCHES = 5;
    const double length = TWIG_PIECES / (BRANCHES + 1) * TWIG_PIECE;
    std::vector<frond_stem> stems = {{-1, {0, 0, 0}, {0, length, 0}, 0.008, 0.005}};
    for (int i = 0; i < BRANCHES; i++) {
        const double y = length * (i + 4) / (BRANCHES + 5), turn = 2.4 * i, out = 0.7 * length;
        stems.push_back({0, {0, y, 0}, {out * std::cos(turn), y + out, out * std::sin(turn)}, 0.004, 0.002});
    }
    frond_model model = {};
    must(frond_model_from_stems(stems.data(), int(stems.size()), &stage.settings.model, &model));
    stage.models.push_back(model);
    stage.plant(model, {0, 0, 0});
}

// ---- breaking ---------------------------------------------------------------------------------------------------

void snap_defaults(Settings& settings) {
    corn_defaults(settings);
    settings.plant.effects |= FROND_EFFECT_BREAKING;
    settings.grab_stiffness = 100;
}
void build_snap(Stage& stage) {
    build_corn(stage);
    add_ground(stage);
}
// Rods, since in a cage a fruit, its peduncle and the stem beside it share cells.
void pick_defaults(Settings& settings) {
    settings.model.cage_size = 0.1;
    settings.plant.mechanics = FROND_MECHANICS_ROD;
    settings.plant.effects |= FROND_EFFECT_BREAKING;
    settings.grab_stiffness = 20;
}
void build_pick(Stage& stage) {
    build_cucumber(stage);
    add_ground(stage);
}

// Takes hold of a point and moves it steadily until something breaks off; then lets go.
void pull_off(Stage& stage, frond_vec3 (*place)(const Stage&), const frond_vec3& speed) {
    const double t = stage.time - GRAB_AT;
    if (t < -0.5 * stage.settings.dt) return;
    if (frond_plant_get_fragment_count(stage.plants[0]) > 0) {
        for (frond_grab grab : stage.grabs) frond_grab_destroy(grab);
        stage.grabs.clear();
        return;
    }
    if (stage.grabs.empty()) {
        stage.drag_stiffness = stage.settings.grab_stiffness;
        take_hold(stage, place(stage));
        must(frond_grab_get(stage.grabs[0], nullptr, &stage.drag_start, nullptr));
    }
    const frond_vec3& from = stage.drag_start;
    must(frond_grab_move(stage.grabs[0], {from.x + speed.x * t, from.y + speed.y * t, from.z + speed.z * t}));
}

// Bends a corn stalk over until it snaps.
void snap(Stage& stage) {
    pull_off(stage, [](const Stage& s) { return point_on_axis(s.plant_models[0], 0.75); }, {0.35, -0.1, 0});
}

// Returns the lower end of an organ [m]; its height is infinite if the organ has no triangle.
frond_vec3 lower_end(const Stage& stage, const frond_organ& organ, int part_count) {
    frond_surface_view view;
    must(frond_plant_get_surface(stage.plants[0], &view));
    frond_vec3 end = {0, INFINITY, 0};
    for (int i = 0; i < part_count; i++) {
        frond_part part;
        must(frond_model_get_part(stage.plant_models[0], i, &part));
        if (std::string(part.organ) != organ.name) continue;
        for (int t = 3 * part.first_triangle; t < 3 * (part.first_triangle + part.triangle_count); t++) {
            const float* p = view.positions + 3 * size_t(view.indices[t]);
            if (double(p[1]) < end.y) end = {double(p[0]), double(p[1]), double(p[2])};
        }
    }
    return end;
}

// Returns the lower end of the heaviest fruit that hangs above the lowest leaves.
frond_vec3 end_of_fruit(const Stage& stage) {
    const frond_model model = stage.plant_models[0];
    frond_model_info info;
    must(frond_model_get_info(model, &info));
    frond_vec3 best = {};
    double heaviest = 0;
    for (int i = 0; i < info.organ_count; i++) {
        frond_organ organ;
        must(frond_model_get_organ(model, i, &organ));
        if (std::string(organ.kind) != "fruit" || organ.mass <= heaviest) continue;
        const frond_vec3 end = lower_end(stage, organ, info.part_count);
        if (end.y < info.lower.y + 0.25 * (info.upper.y - info.lower.y) || !std::isfinite(end.y)) continue;
        heaviest = organ.mass;
        best = end;
    }
    if (heaviest == 0) throw SceneError("the plant bears no fruit");
    return best;
}
// Pulls a cucumber off its peduncle.
void pick(Stage& stage) {
    pull_off(stage, end_of_fruit, {-0.06, 0.02, 0});
}

// ---- robots ---------------------------------------------------------------------------------------------------

void arm_defaults(Settings& settings) {
    settings.plant.mechanics = FROND_MECHANICS_ROD;
}
// Three corn plants in a row, and an arm at its end that is turned away.
void build_arm(Stage& stage) {
    const frond_model model = stage.load(model_path("corn/corn.obj"));
    for (int i = 0; i < 3; i++) stage.plant(model, {0.7 + 0.35 * i, 0, 0});
    const frond_robot_def def = frond_default_robot_def();
    frond_robot arm = {};
    must(frond_robot_load(stage.world, model_path("arm/arm.urdf").c_str(), &def, &arm));
    stage.robots.push_back(arm);
    must(frond_robot_set_joint(arm, frond_robot_find_link(arm, "turn"), -1.5));
    must(frond_robot_set_joint(arm, frond_robot_find_link(arm, "lift"), 1.4));
    stage.has_view = true;
    stage.view_lower = {-0.4, 0, -0.8};
    stage.view_upper = {2.0, 2.2, 0.9};
}
// Turns the arm into the row within three seconds and holds it there.
void reach_in(Stage& stage) {
    const frond_robot arm = stage.robots.front();
    must(frond_robot_drive_to(arm, frond_robot_find_link(arm, "turn"), 0.12, 0.6, 0));
}

// ---- wind -----------------------------------------------------------------------------------------------------

// A fresh breeze: 12 m/s at the height of weather stations, some 8 m/s among the leaves.
void wind_defaults(Settings& settings) {
    corn_defaults(settings);
    settings.wind.velocity = {12, 0, 0};
    settings.wind.turbulence = 0.3;
}
// A stand of six plants in two rows.
void build_wind(Stage& stage) {
    constexpr double ALONG = 0.9, APART = 0.7;  // [m]
    const frond_model model = stage.load(model_path("corn/corn.obj"));
    for (int i = 0; i < 6; i++) stage.plant(model, {ALONG * (i % 3) + (i / 3) * 0.4, 0, APART * (i / 3)});
}

}  // namespace

double contact_depth(frond_plant plant, double above) {
    std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
    must(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())));
    double depth = 0;
    for (const frond_contact& contact : contacts)
        if (contact.point.y > above) depth = std::max(depth, -contact.gap);
    return depth;
}

// Finds, among the chain's nodes near that height, the one that carries most others.
frond_vec3 point_on_axis(frond_model model, double share) {
    frond_chain_view chain;
    frond_model_info info;
    must(frond_model_get_chain(model, &chain));
    must(frond_model_get_info(model, &info));
    std::vector<int> carried(size_t(chain.node_count), 1);
    for (int i = chain.node_count - 1; i > 0; i--)
        if (chain.parents[i] >= 0) carried[size_t(chain.parents[i])] += carried[size_t(i)];
    const double height = info.lower.y + share * (info.upper.y - info.lower.y);
    const double reach = 0.1 * (info.upper.y - info.lower.y);
    int best = 0;
    double best_score = -1e30;
    for (int i = 0; i < chain.node_count; i++) {
        const double miss = std::abs(chain.nodes[3 * i + 1] - height);
        const double score = miss < reach ? carried[size_t(i)] : -miss;
        if (score > best_score) {
            best_score = score;
            best = i;
        }
    }
    return {chain.nodes[3 * best], chain.nodes[3 * best + 1], chain.nodes[3 * best + 2]};
}

const std::vector<Scene>& scenes() {
    static const std::vector<Scene> table = {
        {"corn", "a corn plant stands in gravity", 5, corn_defaults, build_corn, rest},
        {"cucumber", "a cucumber plant stands in gravity", 5, cucumber_defaults, build_cucumber, rest},
        {"drag", "a corn plant is pulled aside and let go", 5, corn_defaults, build_corn, drag},
        {"cucumber_drag", "a cucumber plant is pulled aside and let go", 5, cucumber_defaults, build_cucumber, drag},
        {"ball", "a football is thrown at a corn plant", 3, corn_defaults, build_ball, rest},
        {"walk", "a walker's capsule pushes through a row of ten corn plants", 4, corn_defaults, build_walk, walk},
        {"corn_pair", "two corn plants in each other's leaves come apart", 2, corn_defaults, build_corn_pair, rest,
         "response=none"},
        {"tangle", "one of two tangled corn plants is pulled away and let go", 4, corn_defaults, build_tangle, drag},
        {"corn_field", "17 corn plants touch", 3, corn_defaults, build_corn_field, rest},
        {"flag", "a ribbon of a leaf is folded, and its layers are pressed on each other", 4, flag_defaults, build_flag,
         fold, "self_contact=off"},
        {"crate", "a small crate is let fall on a cucumber's leaves", 3, cucumber_defaults, build_crate, rest},
        {"box", "a cardboard box of 80 g is set down on a rosette's leaves and rests there", 4, nullptr, build_box,
         rest},
        {"trellis", "a cucumber leans on a trellis of static boxes", 4, cucumber_defaults, build_trellis, rest},
        {"twig", "a twig of 60 rods is pulled aside and let go", 5, twig_defaults, build_twig, drag},
        {"snap", "a corn stalk is bent over until it snaps", 7, snap_defaults, build_snap, snap},
        {"pick", "a cucumber is pulled off its peduncle", 4, pick_defaults, build_pick, pick},
        {"arm", "a robot arm reaches into a row of three corn plants", 6, arm_defaults, build_arm, reach_in},
        {"wind", "a stand of corn in a gusty wind", 8, wind_defaults, build_wind, rest},
        {"field", "10,000 plants of four kinds: one walks a path through them, a ball rolls ahead, wind on a patch", 8,
         field_defaults, build_field, drive_field},
        {"tug", "a plant file: it stands, is pulled aside and let go", 5, tug_defaults, nullptr, drag},
    };
    return table;
}

Casting cast(const std::string& name_or_file) {
    std::string names;
    for (const Scene& scene : scenes()) {
        if (name_or_file == scene.name && scene.build) return {&scene, ""};
        if (scene.build) names += std::string(names.empty() ? "" : ", ") + scene.name;
    }
    if (std::filesystem::exists(name_or_file)) return {&scenes().back(), name_or_file};
    throw SceneError("\"" + name_or_file + "\" is neither a file nor a scene; there are the scenes " + names);
}

Play::Play(const Casting& casting, const Settings& settings) : casting(casting), stage(settings) {
    if (casting.scene->build)
        casting.scene->build(stage);
    else
        stage.plant(stage.load(casting.file), {0, 0, 0});
}

void Play::step() {
    casting.scene->drive(stage);
    must(frond_world_step(stage.world, stage.settings.dt));
    stage.time += stage.settings.dt;
}

}  // namespace frond::tools
