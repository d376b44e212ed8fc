// A stem of rods that nothing but supports holds, through the C API.
#pragma once

#include <cmath>
#include <vector>

#include "support/stand.hpp"

namespace frond::test {

constexpr double STEM_RADIUS = 0.01;

// Thickness, in z, and width of a section; zero: round.
struct Rectangle {
    double width = 0, thickness = 0;
};

struct Supported : Stand {
    frond_plant plant = {};
    frond_organ organ = {};
    double mass = 0;
    int tip = 0;

    static frond_world_def sleepless() {
        frond_world_def def = frond_default_world_def();
        def.sleep_distance = 0;
        def.max_substep = 1;
        return def;
    }
    // Without damping, air and gravity unless the def says otherwise.
    static frond_plant_def bare() {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = FROND_MECHANICS_ROD;
        def.root_height = -1;
        def.mass_damping = def.stiffness_damping = def.material_damping = 0;
        def.effects &= ~uint32_t(FROND_EFFECT_GRAVITY | FROND_EFFECT_AIR_DRAG | FROND_EFFECT_WIND);
        return def;
    }
    Supported(const frond_vec3& end, double young, const frond_plant_def& plant_def, int pieces = 20,
              const Rectangle& rectangle = {}, const frond_world_def& world_def = sleepless())
        : Stand(world_def) {
        frond_model_def def = frond_default_model_def();
        frond_organ_material material = {"stem", {}};
        must(frond_material_preset("stem", &material.material));
        material.material.young = young;
        material.material.hollow = material.material.twist_to_bend = material.material.yield_strain = 0;
        material.material.strength = material.material.damping_ratio = 0;
        def.organs = &material;
        def.organ_count = 1;
        def.scale = 1;
        def.up = {0, 1, 0};
        def.rest = FROND_REST_WITHOUT_GRAVITY;
        def.capsule_height = std::sqrt(end.x * end.x + end.y * end.y + end.z * end.z) / pieces;
        const frond_stem stem = {-1, {0, 0, 0}, end, STEM_RADIUS, STEM_RADIUS};
        frond_stem_section section = {};
        if (rectangle.width > 0) {
            section.outline = FROND_OUTLINE_RECTANGLE;
            section.width = rectangle.width;
            section.thickness = rectangle.thickness;
            section.thin = {0, 0, 1};
        }
        must(frond_model_from_stem_sections(&stem, &section, 1, &def, &model));
        must(frond_model_get_organ(model, 0, &organ));
        plant = add(plant_def, {0, 0, 0});
        tip = frond_plant_get_chain_node_count(plant) - 1;
        mass = organ.mass;
    }
    void support(int node, frond_held_turns turns, const frond_vec3& axis = {0, 0, 1}, bool holds_place = true) {
        const frond_support support = {holds_place, turns, axis};
        must(frond_plant_set_support(plant, node, &support));
    }
    std::vector<frond_chain_state> state() const {
        std::vector<frond_chain_state> states(size_t(tip) + 1);
        must(frond_plant_get_chain_state(plant, states.data(), tip + 1));
        return states;
    }
    frond_chain_state state(int node) const { return state()[size_t(node)]; }
    // Steps under a force on a node.
    void under(int node, const frond_vec3& force, int count) {
        for (int i = 0; i < count; i++) {
            must(frond_plant_add_chain_load(plant, node, force, {0, 0, 0}));
            steps(1);
        }
    }
    frond_energy_ledger ledger() const {
        frond_energy_ledger out = {};
        must(frond_world_get_energy_ledger(world, &out));
        return out;
    }
};

// Returns the part of a rotation vector along an axis of length one.
inline double turn_about(const frond_quat& q, const frond_vec3& axis) {
    const double sine = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
    const double angle = 2 * std::atan2(q.w < 0 ? -sine : sine, std::abs(q.w));
    return sine > 0 ? angle / sine * (q.x * axis.x + q.y * axis.y + q.z * axis.z) : 0;
}

}  // namespace frond::test
