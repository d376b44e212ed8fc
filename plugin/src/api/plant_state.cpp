// frond_plant_*: what moves a plant: its nodes' places and speeds, plastic state, pins and forces.
#include <algorithm>
#include <climits>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "plant/pins.hpp"

using namespace frond;

static void check_node(const Plant& plant, int node) {
    if (node < 0 || node >= node_count_of(plant))
        fail(FROND_RESULT_BAD_ARGUMENT, "node is %d; this plant has nodes 0 .. %d", node, node_count_of(plant) - 1);
}

static void check_numbers(const double* numbers, int count, const char* name) {
    if (!numbers) return;
    for (int i = 0; i < count; i++) check_range(numbers[i], -LARGEST_COORDINATE, LARGEST_COORDINATE, name);
}

extern "C" {

int frond_plant_get_node_count(frond_plant plant) {
    const PlantBody* body = find(plant);
    return body ? node_count_of(*body->plant) : 0;
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
    const PlantBody* body = find(plant);
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

}  // extern "C"
