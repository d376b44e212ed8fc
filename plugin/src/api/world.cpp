// frond_world_*, and the C++ functions that attach to a host's world.
#include "api/call.hpp"
#include "api/handles.hpp"
#include "world/robot.hpp"

using namespace frond;

// Checks a def, makes the world and gives it a handle.
static frond_world open_world(btDynamicsWorld* bullet, const frond_world_def& def) {
    check_def(&def, 'W', "world");
    check_vec(def.gravity, "def.gravity");
    check_range(def.max_substep, 1e-6, 1.0, "def.max_substep");
    check_effects(def.effects, "def.effects");
    check_row(def.tuning.hash_layout, FROND_HASH_LAYOUT_COUNT, "def.tuning.hash_layout");
    check_range(def.tuning.hash_table_size, 0, 1e8, "def.tuning.hash_table_size");
    check_range(def.tuning.hash_cell_size, 0, 1e3, "def.tuning.hash_cell_size [m]");
    check_row(def.response, FROND_RESPONSE_COUNT, "def.response");
    check_range(def.tuning.response_iterations, 1, 1e5, "def.tuning.response_iterations");
    check_range(def.tuning.response_tolerance, 0, 1, "def.tuning.response_tolerance");
    check_range(def.tuning.penalty_stiffness, 1e-6, 1e12, "def.tuning.penalty_stiffness [N/m]");
    check_range(def.sleep_distance, 0, 0.01, "def.sleep_distance [m]");
    std::shared_ptr<World> made = make_world(bullet, def);
    made->release.plant = [](PlantBody& body) { forget(body); };
    made->release.rigid = [](const Rigid& rigid) { slots<frond_rigid>().erase(rigid.handle.id); };
    made->release.robot = [](const Robot& robot) { slots<frond_robot>().erase(robot.handle); };
    return handle_for<frond_world>(std::move(made));
}

// Releases the handles of all that is in a world.
static void forget_all(const World& world) {
    for (const auto& body : world.bodies) forget(*body);
    for (const auto& rigid : world.rigids) slots<frond_rigid>().erase(rigid->handle.id);
    for (const auto& robot : world.robots) slots<frond_robot>().erase(robot->handle);
}

static int nearest_node(const Plant& plant, const Vec3& point) {
    const auto distance = [&](int i) { return (node_place(plant, i) - point).squaredNorm(); };
    int nearest = 0;
    for (int i = 1; i < node_count_of(plant); i++)
        if (distance(i) < distance(nearest)) nearest = i;
    return nearest;
}

// Returns whether the plant's surface was made since the last substep.
static bool has_made_surface(const World& world, const Plant& plant) {
    return !plant.view.surface_stale && plant.view.surface_made == uint32_t(world.substep) && plant.ms_surface > 0;
}

// Completes the last substep's report by sums over the plants.
static frond_report full_report(const World& world) {
    frond_report report = world.report;
    report.time = world.time;
    report.plant_count = int(world.bodies.size());
    for (const auto& body : world.bodies) {
        const Plant& plant = *body->plant;
        report.node_count += node_count_of(plant);
        report.tet_count += int(plant.model->cage.tets.size());
        if (has_made_surface(world, plant))
            report.effects_run |= plant.input.effects & world.effects & (FROND_EFFECT_SURFACE | FROND_EFFECT_NORMALS);
    }
    return report;
}

static frond_profile full_profile(const World& world) {
    frond_profile profile = world.profile;
    for (const auto& body : world.bodies) {
        const Plant& plant = *body->plant;
        if (!has_made_surface(world, plant)) continue;
        profile.ms_surface += plant.ms_surface;
        profile.ms_of_effect[3] += plant.ms_surface - plant.ms_normals;
        profile.ms_of_effect[4] += plant.ms_normals;
    }
    return profile;
}

extern "C" {

frond_result frond_world_create(const frond_world_def* def, frond_world* out) {
    return give(out, [&] {
        check_pointer(def, "def");
        return open_world(nullptr, *def);
    });
}

void frond_world_destroy(frond_world world) {
    call([&] {
        const std::shared_ptr<World> taken = slots<frond_world>().erase(world.id);
        if (taken) forget_all(*taken);
    });
}

bool frond_world_is_valid(frond_world world) {
    return bool(find(world));
}

frond_result frond_world_step(frond_world world, double dt) {
    return call([&] {
        World& w = get(world);
        check_range(dt, 0, 1, "dt [s]");
        if (!w.own) fail(FROND_RESULT_UNSUPPORTED, "this world is the host's; call its stepSimulation");
        advance(w, dt);
    });
}

frond_result frond_world_set_gravity(frond_world world, frond_vec3 gravity) {
    return call([&] {
        World& w = get(world);
        check_vec(gravity, "gravity");
        w.bullet->setGravity(btVector3(btScalar(gravity.x), btScalar(gravity.y), btScalar(gravity.z)));
    });
}

frond_result frond_world_set_effects(frond_world world, frond_effects effects) {
    return call([&] {
        World& w = get(world);
        check_effects(effects, "effects");
        w.effects = effects;
    });
}

frond_result frond_world_set_interpolation(frond_world world, double fraction) {
    return call([&] {
        World& w = get(world);
        if (fraction != FROND_INTERPOLATION_AS_MOTION_STATES) check_range(fraction, 0, 2, "fraction");
        w.interpolation = fraction;
    });
}

frond_result frond_world_get_report(frond_world world, frond_report* out) {
    return give(out, [&] { return full_report(get(world)); });
}

frond_result frond_world_get_profile(frond_world world, frond_profile* out) {
    return give(out, [&] { return full_profile(get(world)); });
}

frond_result frond_world_get_state_hash(frond_world world, uint64_t* out) {
    return give(out, [&] { return state_hash(get(world)); });
}

frond_result frond_world_get_energy_ledger(frond_world world, frond_energy_ledger* out) {
    return give(out, [&] { return ledger_now(get(world)); });
}

int frond_world_get_plant_count(frond_world world) {
    const std::shared_ptr<World> found = find(world);
    return found ? int(found->bodies.size()) : 0;
}

frond_result frond_world_get_plants(frond_world world, frond_plant* out, int plant_count) {
    return call([&] {
        const World& w = get(world);
        check_count(plant_count, int(w.bodies.size()), "plant_count", "world");
        if (plant_count > 0) check_pointer(out, "out");
        for (const auto& body : w.bodies) *out++ = body->handle;
    });
}

int frond_world_get_event_count(frond_world world) {
    const std::shared_ptr<World> found = find(world);
    if (!found) return 0;
    found->events.are_kept = true;
    return int(found->events.list.size());
}

frond_result frond_world_take_events(frond_world world, frond_event_info* out, int event_count) {
    return call([&] {
        World& w = get(world);
        check_count(event_count, int(w.events.list.size()), "event_count", "world");
        if (event_count > 0) check_pointer(out, "out");
        std::copy(w.events.list.begin(), w.events.list.end(), out);
        w.events.list.clear();
    });
}

frond_result frond_world_shift_origin(frond_world world, frond_vec3 origin) {
    return call([&] {
        World& w = get(world);
        check_vec(origin, "origin [m]");
        for (const auto& body : w.bodies)
            if (!((body->plant->position - to_vec(origin)).lpNorm<Eigen::Infinity>() <= LARGEST_COORDINATE))
                fail(FROND_RESULT_BAD_ARGUMENT, "origin is farther than %g m from a plant; choose one that is nearer",
                     LARGEST_COORDINATE);
        shift_origin(w, to_vec(origin));
    });
}

frond_result frond_world_cast_ray(frond_world world, frond_vec3 origin, frond_vec3 direction, double max_distance,
                                  frond_ray_hit* out) {
    return give(out, [&] {
        World& w = get(world);
        check_vec(origin, "origin");
        check_vec(direction, "direction");
        check_range(max_distance, 1e-9, LARGEST_COORDINATE, "max_distance [m]");
        const Vec3 from = to_vec(origin), way = to_vec(direction);
        if (!(way.norm() > 0)) fail(FROND_RESULT_BAD_ARGUMENT, "direction is zero; pass the direction of the ray");
        const RayHit hit = cast_ray(w, from, from + max_distance * way.normalized());
        if (!hit.body) return frond_ray_hit{};
        const int node = nearest_node(*look_at(*hit.body).plant, hit.point);
        return frond_ray_hit{hit.body->handle, hit.capsule, node, from_vec(hit.point), (hit.point - from).norm()};
    });
}

}  // extern "C"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

frond_result attach(btDynamicsWorld* world, const frond_world_def* def, frond_world* out) {
    return give(out, [&] {
        check_pointer(world, "world");
        return open_world(world, def ? *def : frond_default_world_def());
    });
}

frond_result forget(frond_world world) {
    return call([&] {
        World& w = get(world);
        if (w.own) fail(FROND_RESULT_UNSUPPORTED, "this world is Frond's own; call frond_world_destroy");
        if (is_held(w))
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "the Bullet world still has objects of this frond_world; if it is to go on, or to be deleted later, "
                 "call "
                 "frond_world_destroy");
        w.is_gone = true;
        forget_all(*slots<frond_world>().erase(world.id));
    });
}

btDynamicsWorld* bullet_world(frond_world world) {
    const std::shared_ptr<World> found = find(world);
    return found ? found->bullet : nullptr;
}

btCollisionObject* bullet_object(frond_plant plant) {
    return find(plant);
}

frond_plant plant_of(const btCollisionObject* object) {
    const PlantBody* body = object ? PlantBody::of(object) : nullptr;
    return body ? body->handle : frond_plant{};
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
