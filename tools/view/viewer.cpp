// The running scene, its time and the settings that can be changed while it runs.
#include "view/viewer.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/vector.hpp"
#include "studio/studio.hpp"

namespace frond::tools {

namespace {

Shades shades_of(frond_plant plant) {
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
    must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
    Shades nearest(size_t(view.vertex_count), 0);
    for (size_t v = 0; v < nearest.size(); v++) {
        const float* at = view.positions + 3 * v;
        const frond_vec3 p = {double(at[0]), double(at[1]), double(at[2])};
        double least = INFINITY;
        for (size_t i = 0; i < capsules.size(); i++) {
            const frond_vec3 along = capsules[i].end - capsules[i].begin, to = p - capsules[i].begin;
            const double share = std::clamp(dot(to, along) / std::max(dot(along, along), 1e-30), 0.0, 1.0);
            const double distance = length(to - share * along) - capsules[i].radius;
            if (distance >= least) continue;
            least = distance;
            nearest[v] = int(i);
        }
    }
    return nearest;
}

frond_energy energy_of(const Stage& stage) {
    frond_energy sum = {};
    for (frond_plant plant : stage.plants) {
        frond_energy energy;
        must(frond_plant_get_energy(plant, &energy));
        for (const PlantEnergy& row : ENERGIES) sum.*row.joule += energy.*row.joule;
    }
    return sum;
}

void note_energies(Viewer& viewer) {
    const frond_energy now = energy_of(viewer.play->stage);
    for (size_t i = 0; i < viewer.energies.size(); i++) viewer.energies[i].add(now.*ENERGIES[i].joule);
}

void note_cost(Viewer& viewer) {
    constexpr double LATELY = 0.1;
    must(frond_world_get_report(viewer.play->stage.world, &viewer.report));
    viewer.trouble |= viewer.report.trouble;
    frond_profile now;
    must(frond_world_get_profile(viewer.play->stage.world, &now));
    for (size_t i = 0; i < viewer.stage_times.size(); i++) viewer.stage_times[i].add(now.*STAGE_TIMES[i].ms);
    const frond_profile before = viewer.cost;
    viewer.cost = now;
    if (before.ms_step == 0) return;
    const auto smooth = [&](double& value, double old) { value = old + LATELY * (value - old); };
    smooth(viewer.cost.ms_step, before.ms_step);
    for (const StageTime& stage : STAGE_TIMES) smooth(viewer.cost.*stage.ms, before.*stage.ms);
    for (int bit = 0; bit < FROND_EFFECT_COUNT; bit++) smooth(viewer.cost.ms_of_effect[bit], before.ms_of_effect[bit]);
}

}  // namespace

void History::add(double value) {
    values[size_t(next)] = float(value);
    next = (next + 1) % int(values.size());
}

Viewer make_viewer(const Casting& casting, const Settings& settings, int width, int height) {
    Viewer viewer;
    viewer.casting = casting;
    viewer.settings = settings;
    viewer.width = width;
    viewer.height = height;
    const double wind = wind_speed(settings);
    if (wind > 0) viewer.wind_direction = (1 / wind) * settings.wind.velocity;
    // One substep per step, so that pictures between two steps are known.
    viewer.settings.dt = std::min(settings.dt, settings.world.max_substep);
    reset(viewer);
    const double aspect = double(width) / height;
    viewer.camera = camera_of(frame_stage(viewer.play->stage, 0.5, 0.15, aspect).camera);
    return viewer;
}

void reset(Viewer& viewer) {
    viewer.play = std::make_unique<Play>(viewer.casting, viewer.settings);
    viewer.hand = {};
    viewer.drag = Viewer::Drag::NONE;
    viewer.wanted = Wanted(viewer.settings);
    const Stage& stage = viewer.play->stage;
    viewer.own_rigids = stage.rigids.size();
    viewer.left_over = 0;
    viewer.report = {};
    viewer.cost = {};
    viewer.stage_times = {};
    viewer.energies = {};
    viewer.trouble = 0;
    viewer.shades.clear();
    for (size_t i = 0; i < stage.plants.size(); i++)
        if (!viewer.shades.count(stage.plant_models[i].id))
            viewer.shades[stage.plant_models[i].id] = shades_of(stage.plants[i]);
}

void step_once(Viewer& viewer) {
    follow_mouse(viewer);
    viewer.play->step();
    note_cost(viewer);
    if (viewer.measures_energy) note_energies(viewer);
}

void advance(Viewer& viewer, double seconds) {
    constexpr int MOST = 4;  // steps per frame: beyond this the simulation slows down
    constexpr double LATELY = 0.1;
    viewer.frame_time += (viewer.frame_time > 0 ? LATELY : 1) * (seconds - viewer.frame_time);
    const double dt = viewer.settings.dt;
    if (viewer.is_paused) {
        viewer.left_over = 0;
    } else {
        viewer.left_over += seconds;
        for (int i = 0; i < MOST && viewer.left_over >= dt; i++, viewer.left_over -= dt) step_once(viewer);
        if (viewer.left_over >= dt) viewer.left_over = 0;
    }
    const double fraction = viewer.is_paused ? 1 : viewer.left_over / dt;
    must(frond_world_set_interpolation(viewer.play->stage.world, fraction));
}

void set_mechanics(Viewer& viewer, frond_mechanics mechanics) {
    for (frond_plant plant : viewer.play->stage.plants) must(frond_plant_set_mechanics(plant, mechanics));
    viewer.settings.plant.mechanics = mechanics;
}

void set_integrator(Viewer& viewer, frond_integrator integrator) {
    for (frond_plant plant : viewer.play->stage.plants) must(frond_plant_set_integrator(plant, integrator));
    viewer.settings.plant.integrator = integrator;
}

void toggle_effect(Viewer& viewer, frond_effects effect) {
    viewer.settings.plant.effects ^= effect;
    for (frond_plant plant : viewer.play->stage.plants)
        must(frond_plant_set_effects(plant, viewer.settings.plant.effects));
}

double wind_speed(const Settings& settings) {
    return length(settings.wind.velocity);
}

void set_wind_speed(Viewer& viewer, double speed) {
    frond_wind_def wind = viewer.settings.wind;
    wind.velocity = speed * viewer.wind_direction;
    must(frond_world_set_wind(viewer.play->stage.world, &wind));
    viewer.settings.wind = wind;
    if (!(viewer.settings.plant.effects & FROND_EFFECT_WIND)) toggle_effect(viewer, FROND_EFFECT_WIND);
}

void take_wanted(Viewer& viewer) {
    const Settings before = viewer.settings;
    viewer.settings.stiffness = viewer.wanted.stiffness;
    viewer.settings.model.capsule_height = viewer.wanted.capsule_height;
    viewer.settings.model.cage_size = viewer.wanted.cage_size;
    try {
        reset(viewer);
        viewer.refusal.clear();
    } catch (const SceneError& error) {
        viewer.settings = before;
        viewer.wanted = Wanted(before);
        viewer.refusal = error.what();
    }
}

// Throws a ball with a football's mass for its size, fast enough to fly as far as the plants are high.
void throw_ball(Viewer& viewer) {
    constexpr double SIZE = 0.05, BALL = 0.11, MASS = 0.43;  // radius in plant heights [-]; a football's [m], [kg]
    constexpr size_t MOST = 20;
    Stage& stage = viewer.play->stage;
    const auto is_plane = [](const frond_rigid_def& def) { return def.shape == FROND_SHAPE_PLANE; };
    frond_rigid_def def = frond_default_rigid_def();
    if (std::none_of(stage.rigid_defs.begin(), stage.rigid_defs.end(), is_plane)) {
        def.shape = FROND_SHAPE_PLANE;
        def.mass = 0;
        def.state.position.y = frame_stage(stage, 0, 0, 1).ground_height;
        stage.rigid(def);
        viewer.own_rigids = stage.rigids.size();
        def = frond_default_rigid_def();
    }
    const Ray ray = ray_through(viewer.camera, viewer.mouse_x, viewer.mouse_y, viewer.width, viewer.height);
    const double height = stage.has_view ? stage.view_upper.y - stage.view_lower.y : stage.upper.y - stage.lower.y;
    const Pick hit = pick(stage, ray);
    const frond_vec3 aim = hit.plant.id ? hit.point : meet_facing_plane(viewer.camera, ray, viewer.camera.target);
    const double speed = 2 * std::sqrt(9.81 * height), way = std::min(height, 0.8 * length(aim - ray.origin));
    def.size = {SIZE * height, 0, 0};
    def.mass = MASS * std::pow(def.size.x / BALL, 3);
    def.state.position = aim - way * ray.direction;
    def.state.velocity = speed * ray.direction;
    def.state.velocity.y += 0.5 * 9.81 * way / speed;  // compensates the fall due to gravity on the way to the target
    stage.rigid(def);
    if (stage.rigids.size() <= viewer.own_rigids + MOST) return;
    frond_rigid_destroy(stage.rigids[viewer.own_rigids]);
    stage.rigids.erase(stage.rigids.begin() + long(viewer.own_rigids));
    stage.rigid_defs.erase(stage.rigid_defs.begin() + long(viewer.own_rigids));
}

}  // namespace frond::tools
