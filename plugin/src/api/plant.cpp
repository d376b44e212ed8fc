// frond_plant_*: an instance, how it is set, and what comes off it.
#include <algorithm>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "world/fragments.hpp"
#include "world/trouble.hpp"

using namespace frond;

static void check_plant_def(const frond_plant_def* def) {
    check_def(def, 'P', "plant");
    check_vec(def->position, "def.position [m]");
    checked_rotation(def->rotation, "def.rotation");
    check_row(def->mechanics, FROND_MECHANICS_COUNT, "def.mechanics");
    check_row(def->integrator, FROND_INTEGRATOR_COUNT, "def.integrator");
    check_row(def->collision, FROND_COLLISION_COUNT, "def.collision");
    check_row(def->tuning.linear_solver, FROND_LINEAR_SOLVER_COUNT, "def.tuning.linear_solver");
    check_row(def->tuning.mass, FROND_MASS_COUNT, "def.tuning.mass");
    check_range(def->element_order, 1, HIGHEST_ORDER, "def.element_order");
    check_range(def->tuning.newton_iterations, 1, 100, "def.tuning.newton_iterations");
    check_range(def->tuning.newton_tolerance, 0, 1, "def.tuning.newton_tolerance");
    check_range(def->tuning.linear_iterations, 1, 10'000'000, "def.tuning.linear_iterations");
    check_range(def->tuning.linear_tolerance, 1e-15, 1, "def.tuning.linear_tolerance");
    check_range(def->tuning.max_substeps, 1, 64, "def.tuning.max_substeps");
    check_range(def->tuning.substep_tolerance, 1e-9, 1, "def.tuning.substep_tolerance");
    check_range(def->mass_damping, 0, 1e6, "def.mass_damping [1/s]");
    check_range(def->stiffness_damping, 0, 1e3, "def.stiffness_damping [s]");
    check_range(def->material_damping, 0, 100, "def.material_damping");
    check_range(def->tuning.spectral_radius, 0, 1, "def.tuning.spectral_radius");
    check_range(def->root_height, -LARGEST_COORDINATE, LARGEST_COORDINATE, "def.root_height [m]");
    check_effects(def->effects, "def.effects");
}

// Returns the capsule that ends at a chain node.
static int capsule_of(const Plant& plant, int node) {
    const auto& capsules = plant.model->capsules;
    const auto ends = [&](const std::array<int, 2>& capsule) { return capsule[1] == node; };
    return int(std::find_if(capsules.begin(), capsules.end(), ends) - capsules.begin());
}

extern "C" {

frond_result frond_plant_create(frond_world world, frond_model model, const frond_plant_def* def, frond_plant* out) {
    return give(out, [&] {
        World& w = get(world);
        const std::shared_ptr<const Model> m = get(model);
        check_plant_def(def);
        PlantBody* body = add_plant(w, create_plant(m, *def), def->group, def->mask, def->starts_asleep);
        return body->handle = handle_for<frond_plant>(body, [&] { remove_plant(w, body); });
    });
}

void frond_plant_destroy(frond_plant plant) {
    call([&] {
        PlantBody* body = find(plant);
        if (!body) return;
        forget(*body);
        remove_plant(*body->world, body);
    });
}

bool frond_plant_is_valid(frond_plant plant) {
    return find(plant) != nullptr;
}

bool frond_plant_is_awake(frond_plant plant) {
    const PlantBody* body = find(plant);
    return body && !body->rest.asleep;
}

frond_result frond_plant_get_detail(frond_plant plant, frond_detail* out) {
    return give(out, [&] {
        const PlantBody& body = get(plant);
        return detail_of(*body.world, body);
    });
}

frond_result frond_plant_get_trouble(frond_plant plant, uint32_t* out) {
    return give(out, [&] { return trouble_of(get(plant)); });
}

frond_result frond_plant_wake(frond_plant plant) {
    return call([&] { wake(get(plant)); });
}

void* frond_plant_get_user(frond_plant plant) {
    const PlantBody* body = find(plant);
    return body ? body->plant->input.user : nullptr;
}

frond_result frond_plant_set_effects(frond_plant plant, frond_effects effects) {
    return call([&] {
        PlantBody& body = get(plant);
        check_effects(effects, "effects");
        Plant& p = awaken(body);
        p.input.effects = effects;
        p.view.surface_stale = true;
    });
}

frond_result frond_plant_get_def(frond_plant plant, frond_plant_def* out) {
    return give(out, [&] { return def_of(get(plant)); });
}

frond_result frond_plant_set_transform(frond_plant plant, frond_vec3 position, frond_quat rotation) {
    return call([&] {
        PlantBody& body = get(plant);
        check_vec(position, "position [m]");
        place_plant(body, to_vec(position), checked_rotation(rotation, "rotation"));
    });
}

frond_result frond_plant_reset(frond_plant plant) {
    return call([&] {
        PlantBody& body = get(plant);
        for (const Rigid* fragment : body.fragment_bodies) slots<frond_rigid>().erase(fragment->handle.id);
        reset_plant(body);
    });
}

frond_result frond_plant_set_mechanics(frond_plant plant, frond_mechanics which) {
    return call([&] {
        PlantBody& body = get(plant);
        check_row(which, FROND_MECHANICS_COUNT, "mechanics");
        if (body.plant->input.supports && !mechanics(which).moves_chain)
            fail(FROND_RESULT_UNSUPPORTED,
                 "supports hold rods, not tets; take them away by frond_plant_set_support with null first");
        set_mechanics(awaken(body), which);
        body.level.own = which;
        body.level.now = FROND_DETAIL_FULL;
        show(body);
    });
}

frond_result frond_plant_set_integrator(frond_plant plant, frond_integrator integrator) {
    return call([&] {
        PlantBody& body = get(plant);
        check_row(integrator, FROND_INTEGRATOR_COUNT, "integrator");
        awaken(body).input.settings.integrator = integrator;
    });
}

int frond_plant_get_fragment_count(frond_plant plant) {
    const PlantBody* body = find(plant);
    return body ? int(body->fragment_bodies.size()) : 0;
}

frond_result frond_plant_get_fragment(frond_plant plant, int fragment, frond_fragment* out) {
    return give(out, [&] {
        const PlantBody& body = get(plant);
        const int count = int(body.fragment_bodies.size());
        if (fragment < 0 || fragment >= count)
            fail(FROND_RESULT_BAD_ARGUMENT, "fragment is %d; %d fragments of this plant have come off", fragment,
                 count);
        Rigid& rigid = *body.fragment_bodies[size_t(fragment)];
        if (!rigid.handle.id) rigid.handle = handle_for<frond_rigid>(&rigid);
        const Fragment& broken = body.plant->state.fragments[size_t(fragment)];
        return frond_fragment{rigid.handle, capsule_of(*body.plant, broken.node), broken.mass};
    });
}

frond_result frond_plant_break(frond_plant plant, int capsule) {
    return call([&] {
        PlantBody& body = get(plant);
        const Plant& p = *body.plant;
        check_range(capsule, 0, double(body.capsules().size()) - 1, "capsule");
        const auto& [begin, end] = p.model->capsules[size_t(capsule)];
        if (begin == end)
            fail(FROND_RESULT_BAD_ARGUMENT, "capsule %d is a root of its own; nothing grows beyond it", capsule);
        if (fragment_of_chain_node(p, size_t(end)))
            fail(FROND_RESULT_BAD_ARGUMENT, "capsule %d has come off already; call frond_plant_reset first", capsule);
        awaken(body);
        break_off(*body.world, body, end);
        show(body);
    });
}

}  // extern "C"
