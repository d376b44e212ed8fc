// frond_plant_*: loads, supports, state and section forces of the chain, and what the roots hold.
#include "api/call.hpp"
#include "api/handles.hpp"
#include "plant/chain_state.hpp"
#include "plant/root_force.hpp"

using namespace frond;

namespace {

int chain_node_count_of(const Plant& plant) {
    return int(plant.model->chain.nodes.size());
}

void check_index(int index, int count, const char* name) {
    if (index < 0 || index >= count)
        fail(FROND_RESULT_BAD_ARGUMENT, "%s is %d; this plant has 0 .. %d", name, index, count - 1);
}

// Refuses tets, whose nodes do not turn.
void check_moves_chain(const Plant& plant) {
    if (!plant.follow)
        fail(FROND_RESULT_UNSUPPORTED, "the plant is moved by tets; call frond_plant_set_mechanics with rods first");
}

// Returns the axis in the world's frame, of length one; any if a support needs none.
Vec3 checked_axis(const frond_support& support) {
    check_row(support.held_turns, FROND_HELD_TURNS_COUNT, "held_turns");
    if (support.held_turns == FROND_HELD_TURNS_NONE || support.held_turns == FROND_HELD_TURNS_ALL) return Vec3::UnitY();
    check_vec(support.axis, "axis");
    const double length = to_vec(support.axis).norm();
    if (!(length > 1e-9))
        fail(FROND_RESULT_BAD_ARGUMENT, "axis has no direction; give the one that held_turns is about");
    return to_vec(support.axis) / length;
}

// Refuses a plant that may become one of tets by a change of detail, and a node that went with a fragment.
void check_may_be_supported(const PlantBody& body, int chain_node) {
    const Plant& plant = *body.plant;
    check_index(chain_node, chain_node_count_of(plant), "chain_node");
    check_moves_chain(plant);
    if (!mechanics(body.level.own).moves_chain)
        fail(FROND_RESULT_UNSUPPORTED,
             "the plant is one of tets as soon as its detail is full; call "
             "frond_plant_set_mechanics with rods first");
    if (fragment_of_chain_node(plant, size_t(chain_node)))
        fail(FROND_RESULT_BAD_ARGUMENT, "chain node %d has come off with a fragment", chain_node);
}

ChainNodeState checked(const frond_chain_state& state) {
    check_vec(state.position, "position [m]");
    check_vec(state.velocity, "velocity [m/s]");
    check_vec(state.angular_velocity, "angular_velocity [rad/s]");
    return {to_vec(state.position), checked_rotation(state.rotation, "rotation"), to_vec(state.velocity),
            to_vec(state.angular_velocity)};
}

// Returns the gravity that acts on a plant; zero if it is not to have weight.
Vec3 weight_of(const PlantBody& body) {
    const bool has_weight = body.plant->input.effects & body.world->effects & FROND_EFFECT_GRAVITY;
    return has_weight ? gravity_of(*body.world) : Vec3(Vec3::Zero());
}

// Writes a force and a moment for which the caller asked, each of which may be null; zero on failure.
template <class Compute>
frond_result give_wrench(frond_vec3* force, frond_vec3* moment, Compute&& compute) {
    return call([&] {
        for (frond_vec3* out : {force, moment})
            if (out) *out = {};
        const Wrench held = compute();
        if (force) *force = from_vec(held.force);
        if (moment) *moment = from_vec(held.moment);
    });
}

}  // namespace

extern "C" {

int frond_plant_get_chain_node_count(frond_plant plant) {
    const PlantBody* body = find(plant);
    return body ? chain_node_count_of(*body->plant) : 0;
}

frond_result frond_plant_add_chain_load(frond_plant plant, int chain_node, frond_vec3 force, frond_vec3 moment) {
    return call([&] {
        PlantBody& body = get(plant);
        check_index(chain_node, chain_node_count_of(*body.plant), "chain_node");
        check_vec(force, "force [N]");
        check_vec(moment, "moment [N m]");
        add_chain_load(awaken(body), chain_node, to_vec(force), to_vec(moment));
    });
}

frond_result frond_plant_add_distributed_load(frond_plant plant, int capsule, frond_vec3 force_per_length) {
    return call([&] {
        PlantBody& body = get(plant);
        check_index(capsule, int(body.capsules().size()), "capsule");
        check_vec(force_per_length, "force_per_length [N/m]");
        add_distributed_load(awaken(body), size_t(capsule), to_vec(force_per_length));
    });
}

frond_result frond_plant_set_support(frond_plant plant, int chain_node, const frond_support* support) {
    return call([&] {
        PlantBody& body = get(plant);
        check_may_be_supported(body, chain_node);
        if (!support) return remove_support(awaken(body), chain_node);
        const Vec3 axis = checked_axis(*support);
        Plant& p = awaken(body);
        set_support(p, chain_node, support->holds_place, support->held_turns, p.rotation.conjugate() * axis);
    });
}

frond_result frond_plant_get_support_force(frond_plant plant, int chain_node, frond_vec3* force, frond_vec3* moment) {
    return give_wrench(force, moment, [&] {
        PlantBody& body = get(plant);
        check_index(chain_node, chain_node_count_of(*body.plant), "chain_node");
        if (!support_of(*body.plant, chain_node))
            fail(FROND_RESULT_BAD_ARGUMENT, "chain node %d has no support; call frond_plant_set_support", chain_node);
        look_at(body);
        return support_force(*body.plant, weight_of(body), body.world->effects, chain_node);
    });
}

frond_result frond_plant_get_root_force(frond_plant plant, frond_vec3 about, frond_vec3* force, frond_vec3* moment) {
    return give_wrench(force, moment, [&] {
        PlantBody& body = look_at(get(plant));
        check_vec(about, "about [m]");
        return root_force(*body.plant, weight_of(body), body.world->effects, to_vec(about));
    });
}

frond_result frond_plant_get_chain_state(frond_plant plant, frond_chain_state* out, int chain_node_count) {
    return call([&] {
        check_pointer(out, "out");
        const Plant& p = *look_at(get(plant)).plant;
        check_count(chain_node_count, chain_node_count_of(p), "chain_node_count");
        check_moves_chain(p);
        for (const ChainNodeState& state : chain_state(p))
            *out++ = {from_vec(state.place), from_quat(state.rotation), from_vec(state.velocity), from_vec(state.spin)};
    });
}

frond_result frond_plant_set_chain_state(frond_plant plant, const frond_chain_state* states, int chain_node_count) {
    return call([&] {
        check_pointer(states, "states");
        PlantBody& body = get(plant);
        check_count(chain_node_count, chain_node_count_of(*body.plant), "chain_node_count");
        check_moves_chain(*body.plant);
        std::vector<ChainNodeState> all;
        for (int i = 0; i < chain_node_count; i++) all.push_back(checked(states[i]));
        set_chain_state(awaken(body), all);
        show(body);
    });
}

frond_result frond_plant_get_section_forces(frond_plant plant, frond_section_force* out, int capsule_count) {
    return call([&] {
        check_pointer(out, "out");
        const PlantBody& body = look_at(get(plant));
        check_count(capsule_count, int(body.capsules().size()), "capsule_count");
        check_moves_chain(*body.plant);
        for (const SectionForce& f : section_forces(*body.plant)) {
            const Vec3 wide = f.axis.cross(f.thin);
            *out++ = {from_vec(f.axis),  from_vec(f.thin),     f.force.dot(f.axis), f.force.dot(f.thin),
                      f.force.dot(wide), f.moment.dot(f.axis), f.moment.dot(wide),  -f.moment.dot(f.thin)};
        }
    });
}

}  // extern "C"
