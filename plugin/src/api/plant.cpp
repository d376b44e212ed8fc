// frond_plant_*: one instance.
#include <algorithm>
#include <climits>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "world/fragments.hpp"
#include "world/is_in.hpp"

using namespace frond;

static void check_effects(frond_effects effects) {
    if (effects & ~uint32_t(FROND_EFFECT_ALL))
        fail(FROND_RESULT_BAD_ARGUMENT, "effects has unknown bits; use FROND_EFFECT_*");
}

static void check_rotation(const Quat& rotation, const char* name) {
    const double length = rotation.norm();
    if (!(length > 1e-9 && length < 1e9))
        fail(FROND_RESULT_BAD_ARGUMENT, "%s has no direction; (0,0,0,1) turns nothing", name);
}

static void check_plant_def(const frond_plant_def* def) {
    check_def(def, 'P', "plant");
    check_vec(def->position, "def.position [m]");
    check_rotation(Quat(def->rotation.w, def->rotation.x, def->rotation.y, def->rotation.z), "def.rotation");
    check_row(number_of(def->mechanics), FROND_MECHANICS_COUNT, "def.mechanics");
    check_row(number_of(def->integrator), FROND_INTEGRATOR_COUNT, "def.integrator");
    check_row(number_of(def->collision), FROND_COLLISION_COUNT, "def.collision");
    check_row(number_of(def->tuning.linear_solver), FROND_LINEAR_SOLVER_COUNT, "def.tuning.linear_solver");
    check_row(number_of(def->tuning.mass), FROND_MASS_COUNT, "def.tuning.mass");
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
    check_effects(def->effects);
}

static void check_node(const Plant& plant, int node) {
    if (node < 0 || node >= node_count_of(plant))
        fail(FROND_RESULT_BAD_ARGUMENT, "node is %d; this plant has nodes 0 .. %d", node, node_count_of(plant) - 1);
}

static void check_numbers(const double* numbers, int count, const char* name) {
    if (!numbers) return;
    for (int i = 0; i < count; i++) check_range(numbers[i], -LARGEST_COORDINATE, LARGEST_COORDINATE, name);
}

// Returns the capsule that ends at a chain node.
static int capsule_of(const Plant& plant, int node) {
    const auto& capsules = plant.model->capsules;
    const auto ends = [&](const std::array<int, 2>& capsule) { return capsule[1] == node; };
    return int(std::find_if(capsules.begin(), capsules.end(), ends) - capsules.begin());
}

static frond_effects effects_of(const PlantBody& body) {
    return body.plant->input.effects & body.world->effects;
}

// Returns the contacts of one plant, with normals and impulses as they act on it.
static std::vector<frond_contact> contacts_of(const PlantBody& body) {
    std::vector<frond_contact> out;
    const LastContacts* kept = body.rest.contacts.get();
    for (const Contact& c : kept ? kept->with_bodies : body.world->contacts)
        if (c.plant == &body && (!kept || is_in(*body.world->bullet, c.other)))
            out.push_back(
                {from_vec(c.on_plant), from_vec(c.normal), from_vec(c.impulse), c.gap, c.capsule, c.other, {}});
    for (const PlantContact& c : kept ? kept->with_plants : body.world->plant_contacts) {
        const size_t side = c.plants[0] == &body ? 0 : 1;
        if (c.plants[side] != &body) continue;
        const double sign = side == 0 ? 1 : -1;
        const Vec3 point = side == 0 ? c.point : Vec3(c.point + c.depth * c.normal);
        const PlantBody* other = c.plants[1 - side];
        out.push_back({from_vec(point), from_vec(sign * c.normal), from_vec(sign * c.impulse), -c.depth,
                       c.sides[side].piece, other, other->handle});
    }
    return out;
}

// Makes the surface as it is now. The last one goes to the previous frame, if that is requested.
static void make_surface(PlantBody& body) {
    Plant& p = *body.plant;
    const World& world = *body.world;
    const double back = body.rest.asleep ? 0 : surfaces_back(world);
    if (p.view.previous && (p.view.previous->substep != world.substep || p.view.previous->back != float(back))) {
        p.view.previous->positions = p.view.surface_positions;
        p.view.previous->substep = world.substep;
        p.view.previous->back = float(back);
    }
    if (p.view.surface_positions.empty()) update_surface(*look_at(body).plant, FROND_EFFECT_ALL, back);
    if ((p.view.surface_stale || p.view.surface_back != float(back)) && effects_of(body) & FROND_EFFECT_SURFACE)
        update_surface(*look_at(body).plant, effects_of(body), back);
}

extern "C" {

frond_result frond_plant_create(frond_world world, frond_model model, const frond_plant_def* def, frond_plant* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        World& w = get(world);
        const std::shared_ptr<const Model> m = get(model);
        check_plant_def(def);
        PlantBody* body = add_plant(w, create_plant(m, *def), def->group, def->mask, def->starts_asleep);
        body->handle.id = plant_slots().insert(body);
        if (!body->handle.id) {
            remove_plant(w, body);
            fail(FROND_RESULT_OUT_OF_MEMORY, "too many plants; destroy some");
        }
        *out = body->handle;
    });
}

void frond_plant_destroy(frond_plant plant) {
    call([&] {
        PlantBody* body = plant_slots().find(plant.id);
        if (!body) return;
        forget(*body);
        remove_plant(*body->world, body);
    });
}

bool frond_plant_is_valid(frond_plant plant) {
    return plant_slots().find(plant.id) != nullptr;
}

bool frond_plant_is_awake(frond_plant plant) {
    const PlantBody* body = plant_slots().find(plant.id);
    return body && !body->rest.asleep;
}

frond_result frond_plant_get_detail(frond_plant plant, frond_detail* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = FROND_DETAIL_FULL;
        const PlantBody& body = get(plant);
        *out = detail_of(*body.world, body);
    });
}

frond_result frond_plant_wake(frond_plant plant) {
    return call([&] { wake(get(plant)); });
}

void* frond_plant_get_user(frond_plant plant) {
    const PlantBody* body = plant_slots().find(plant.id);
    return body ? body->plant->input.user : nullptr;
}

frond_result frond_plant_set_effects(frond_plant plant, frond_effects effects) {
    return call([&] {
        PlantBody& body = get(plant);
        check_effects(effects);
        Plant& p = awaken(body);
        p.input.effects = effects;
        p.view.surface_stale = true;
    });
}

frond_result frond_plant_get_def(frond_plant plant, frond_plant_def* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        *out = def_of(get(plant));
    });
}

frond_result frond_plant_set_transform(frond_plant plant, frond_vec3 position, frond_quat rotation) {
    return call([&] {
        PlantBody& body = get(plant);
        check_vec(position, "position [m]");
        const Quat q(rotation.w, rotation.x, rotation.y, rotation.z);
        check_rotation(q, "rotation");
        place_plant(body, to_vec(position), q.normalized());
    });
}

frond_result frond_plant_reset(frond_plant plant) {
    return call([&] {
        PlantBody& body = get(plant);
        for (const Rigid* fragment : body.fragment_bodies) rigid_slots().erase(fragment->handle.id);
        reset_plant(body);
    });
}

frond_result frond_plant_set_mechanics(frond_plant plant, frond_mechanics which) {
    return call([&] {
        PlantBody& body = get(plant);
        check_row(number_of(which), FROND_MECHANICS_COUNT, "mechanics");
        set_mechanics(awaken(body), which);
        body.level.own = which;
        body.level.now = FROND_DETAIL_FULL;
        show(body);
    });
}

frond_result frond_plant_set_integrator(frond_plant plant, frond_integrator integrator) {
    return call([&] {
        PlantBody& body = get(plant);
        check_row(number_of(integrator), FROND_INTEGRATOR_COUNT, "integrator");
        awaken(body).input.settings.integrator = integrator;
    });
}

int frond_plant_get_node_count(frond_plant plant) {
    const PlantBody* body = plant_slots().find(plant.id);
    return body ? node_count_of(*body->plant) : 0;
}

int frond_plant_get_capsule_count(frond_plant plant) {
    const PlantBody* body = plant_slots().find(plant.id);
    return body ? int(body->capsules().size()) : 0;
}

frond_result frond_plant_get_state(frond_plant plant, double* positions, double* velocities, int node_count) {
    return call([&] {
        const Plant& p = *look_at(get(plant)).plant;
        check_count(node_count, node_count_of(p), "node_count");
        const VecX v = velocities ? cage_velocities(p) : VecX();
        for (int i = 0; i < node_count; i++) {
            if (positions) Eigen::Map<Vec3>(positions + 3 * i) = node_place(p, i);
            if (velocities) Eigen::Map<Vec3>(velocities + 3 * i) = node_velocity(p, v, i);
        }
    });
}

frond_result frond_plant_set_state(frond_plant plant, const double* positions, const double* velocities,
                                   int node_count) {
    return call([&] {
        PlantBody& body = get(plant);
        check_count(node_count, node_count_of(*body.plant), "node_count");
        check_numbers(positions, 3 * node_count, "positions");
        check_numbers(velocities, 3 * node_count, "velocities");
        set_state(awaken(body), positions, velocities);
        show(body);
    });
}

int frond_plant_get_plastic_count(frond_plant plant) {
    const PlantBody* body = plant_slots().find(plant.id);
    return body ? int(plastic_of(*body->plant).size()) : 0;
}

frond_result frond_plant_get_plastic(frond_plant plant, double* values, int count) {
    return call([&] {
        const std::vector<double> plastic = plastic_of(*get(plant).plant);
        check_count(count, int(plastic.size()), "count");
        if (count > 0) check_pointer(values, "values");
        std::copy(plastic.begin(), plastic.end(), values);
    });
}

frond_result frond_plant_set_plastic(frond_plant plant, const double* values, int count) {
    return call([&] {
        PlantBody& body = get(plant);
        check_range(count, 0, INT_MAX, "count");
        if (count > 0) check_pointer(values, "values");
        check_numbers(values, count, "values");
        set_plastic(awaken(body), std::vector<double>(values, values + count));
    });
}

frond_result frond_plant_pin(frond_plant plant, int node) {
    return call([&] {
        PlantBody& body = get(plant);
        check_node(*body.plant, node);
        pin_node(awaken(body), node);
    });
}

frond_result frond_plant_unpin(frond_plant plant, int node) {
    return call([&] {
        PlantBody& body = get(plant);
        check_node(*body.plant, node);
        unpin_node(awaken(body), node);
    });
}

frond_result frond_plant_move_pin(frond_plant plant, int node, frond_vec3 position) {
    return call([&] {
        PlantBody& body = get(plant);
        check_node(*body.plant, node);
        check_vec(position, "position [m]");
        if (!is_pinned(*body.plant, node))
            fail(FROND_RESULT_BAD_ARGUMENT, "node %d is not pinned; call frond_plant_pin", node);
        move_pin(awaken(body), node, body.plant->to_model(to_vec(position)));
    });
}

frond_result frond_plant_add_force(frond_plant plant, int node, frond_vec3 force) {
    return call([&] {
        PlantBody& body = get(plant);
        check_node(*body.plant, node);
        check_vec(force, "force [N]");
        Plant& p = awaken(body);
        VecX& forces = forces_of(p).on_nodes;
        if (forces.size() == 0) forces = VecX::Zero(3 * Eigen::Index(node_count_of(p)));
        point(forces, node) += to_vec(force);
        p.input.has_user_force = true;
    });
}

frond_result frond_plant_get_energy(frond_plant plant, frond_energy* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        const PlantBody& body = look_at(get(plant));
        *out = energy_of(*body.plant, gravity_of(*body.world));
    });
}

frond_result frond_plant_get_previous_positions(frond_plant plant, const float** out) {
    return call([&] {
        check_pointer(out, "out");
        *out = nullptr;
        PlantBody& body = get(plant);
        Plant& p = *body.plant;
        if (!p.view.previous) {
            p.view.previous = std::make_unique<PreviousSurface>();
            p.view.previous->substep = body.world->substep;
            p.view.previous->back = float(body.rest.asleep ? 0 : surfaces_back(*body.world));
        }
        make_surface(body);
        *out = (p.view.previous->positions.empty() ? p.view.surface_positions : p.view.previous->positions).data();
    });
}

frond_result frond_plant_get_surface(frond_plant plant, frond_surface_view* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        PlantBody& body = get(plant);
        Plant& p = *body.plant;
        make_surface(body);
        const Surface& surface = p.model->surface;
        out->positions = p.view.surface_positions.data();
        out->normals = p.view.surface_normals.data();
        out->uvs = surface.uvs.empty() ? nullptr : surface.uvs.front().data();
        out->colors = surface.colors.empty() ? nullptr : surface.colors.front().data();
        out->indices = (p.state.fragments.empty() ? surface.triangles : p.state.parting->triangles).front().data();
        out->vertex_count = int(surface.positions.size());
        out->triangle_count = int(surface.triangles.size());
    });
}

frond_result frond_plant_get_capsules(frond_plant plant, frond_capsule* out, int capsule_count) {
    return call([&] {
        check_pointer(out, "out");
        const PlantBody& body = look_at(get(plant));
        check_count(capsule_count, int(body.capsules().size()), "capsule_count");
        const Plant& p = *body.plant;
        for (size_t i = 0; i < body.capsules().size(); i++) {
            const auto [begin, end] = capsule_ends(p, i);
            out[i].begin = from_vec(p.to_world(begin));
            out[i].end = from_vec(p.to_world(end));
            out[i].radius = double(body.capsules()[i]->getRadius());
        }
    });
}

frond_result frond_plant_get_strains(frond_plant plant, double* out, int capsule_count) {
    return call([&] {
        check_pointer(out, "out");
        const PlantBody& body = look_at(get(plant));
        check_count(capsule_count, int(body.capsules().size()), "capsule_count");
        const std::vector<double> strains = capsule_strains(*body.plant);
        std::copy(strains.begin(), strains.end(), out);
    });
}

int frond_plant_get_contact_count(frond_plant plant) {
    const PlantBody* body = plant_slots().find(plant.id);
    return body ? int(contacts_of(*body).size()) : 0;
}

frond_result frond_plant_get_contacts(frond_plant plant, frond_contact* out, int contact_count) {
    return call([&] {
        const std::vector<frond_contact> contacts = contacts_of(get(plant));
        check_count(contact_count, int(contacts.size()), "contact_count");
        if (contact_count > 0) check_pointer(out, "out");
        std::copy(contacts.begin(), contacts.end(), out);
    });
}

int frond_plant_get_fragment_count(frond_plant plant) {
    const PlantBody* body = plant_slots().find(plant.id);
    return body ? int(body->fragment_bodies.size()) : 0;
}

frond_result frond_plant_get_fragment(frond_plant plant, int fragment, frond_fragment* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        const PlantBody& body = get(plant);
        const int count = int(body.fragment_bodies.size());
        if (fragment < 0 || fragment >= count)
            fail(FROND_RESULT_BAD_ARGUMENT, "fragment is %d; %d fragments of this plant have come off", fragment,
                 count);
        Rigid& rigid = *body.fragment_bodies[size_t(fragment)];
        if (!rigid.handle.id) rigid.handle.id = rigid_slots().insert(&rigid);
        if (!rigid.handle.id) fail(FROND_RESULT_OUT_OF_MEMORY, "too many rigid bodies; destroy some");
        const Fragment& broken = body.plant->state.fragments[size_t(fragment)];
        *out = {rigid.handle, capsule_of(*body.plant, broken.node), broken.mass};
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

frond_result frond_plant_get_air_force(frond_plant plant, frond_vec3* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        *out = from_vec(air_force(*look_at(get(plant)).plant));
    });
}

frond_result frond_plant_get_momentum(frond_plant plant, frond_vec3* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        const Plant& p = *look_at(get(plant)).plant;
        const VecX& mass = node_mass_of(*p.system);
        Vec3 sum = Vec3::Zero();
        for (int i = 0; i < mass.size(); i++) sum += mass[i] * point(p.state.motion.v, i);
        *out = from_vec(p.rotation * sum);
    });
}

frond_result frond_plant_get_tip(frond_plant plant, frond_vec3* out) {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        const PlantBody& body = look_at(get(plant));
        const Vec3 gravity = gravity_of(*body.world);
        const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity) : Vec3(Vec3::UnitY());
        Vec3 tip = vertex_position(*body.plant, 0);
        for (int v = 1; v < int(body.plant->model->surface.positions.size()); v++) {
            const Vec3 p = vertex_position(*body.plant, v);
            if (up.dot(p) > up.dot(tip)) tip = p;
        }
        *out = from_vec(tip);
    });
}

}  // extern "C"
