// Stage: what fuzzed calls act on; and the calls that only read.
#pragma once

#include <vector>

#include "fuzz/input.hpp"

namespace frond::fuzz {

// Handles that are valid, destroyed and invented.
struct Stage {
    Input& input;
    frond_model model = {};
    frond_world world = {};
    std::vector<frond_plant> plants;
    std::vector<frond_grab> grabs;
    std::vector<frond_rigid> rigids;
    std::vector<frond_bond> bonds;
    std::vector<uint8_t> snapshot;

    template <class Handle>
    Handle any(const std::vector<Handle>& list) {
        if (list.empty() || input.byte() >= 250) return {input.raw<uint64_t>()};
        return list[size_t(input.below(int(list.size())))];
    }
    frond_plant plant() { return any(plants); }
    int node() { return input.integer(); }
};

inline void list_what_there_is(Stage& s) {
    std::vector<frond_plant> plants(size_t(frond_world_get_plant_count(s.world)));
    require(frond_world_get_plants(s.world, plants.data(), int(plants.size())) == FROND_OK, "no list of plants");
    for (frond_plant plant : plants) require(frond_plant_is_valid(plant), "a plant that is not there is listed");
    std::vector<frond_event_info> events(size_t(frond_world_get_event_count(s.world)));
    const int count = s.input.byte() < 220 ? int(events.size()) : s.input.integer();
    if (frond_world_take_events(s.world, events.data(), count) != FROND_OK) return;
    for (const frond_event_info& event : events) {
        require(frond_plant_is_valid(event.plant), "an event of a plant that is not there");
        require(frond_event_name(event.event)[0] != '?', "an event without a name");
    }
}

inline void look_at_plant(Stage& s) {
    const frond_plant plant = s.plant();
    frond_surface_view view;
    frond_energy energy;
    frond_vec3 vec, moment;
    frond_detail detail;
    frond_fragment broken;
    frond_plant_get_surface(plant, &view);
    frond_plant_get_energy(plant, &energy);
    frond_plant_get_tip(plant, &vec);
    frond_plant_get_air_force(plant, &vec);
    frond_plant_get_momentum(plant, &vec);
    frond_plant_get_root_force(plant, s.input.vec(), &vec, &moment);
    frond_plant_get_detail(plant, &detail);
    uint32_t trouble;
    frond_plant_get_trouble(plant, &trouble);
    if (frond_plant_get_fragment_count(plant) > 0) frond_plant_get_fragment(plant, s.input.integer(), &broken);
    std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
    frond_plant_get_contacts(plant, contacts.data(), int(contacts.size()));
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
    frond_plant_get_capsules(plant, capsules.data(), int(capsules.size()));
    std::vector<double> strains(capsules.size());
    frond_plant_get_strains(plant, strains.data(), int(strains.size()));
    require(frond_plant_is_valid(plant) || !frond_plant_is_awake(plant), "a plant that is not there is awake");
    require(frond_plant_get_user(plant) == nullptr, "a user's pointer from nowhere");
    const float* previous = nullptr;
    require((frond_plant_get_previous_positions(plant, &previous) == FROND_OK) == (previous != nullptr),
            "previous positions are and are not");
}

inline void look_at_world(Stage& s) {
    frond_ray_hit hit;
    frond_report report;
    frond_profile profile;
    frond_energy_ledger ledger;
    frond_vec3 vec;
    frond_rigid_state state;
    uint64_t hash;
    require(frond_world_is_valid(s.world) && frond_world_get_report(s.world, &report) == FROND_OK, "no report");
    require(frond_world_get_profile(s.world, &profile) == FROND_OK, "no profile");
    require(frond_world_get_state_hash(s.world, &hash) == FROND_OK, "no hash");
    if (s.input.below(4) == 0) require(frond_world_get_energy_ledger(s.world, &ledger) == FROND_OK, "no energy ledger");
    frond_world_cast_ray(s.world, s.input.vec(), s.input.vec(), s.input.number(), &hit);
    if (frond_world_get_wind_at(s.world, s.input.vec(), &vec) == FROND_OK)
        require(std::isfinite(vec.x) && std::isfinite(vec.y) && std::isfinite(vec.z), "wind is not finite");
    const frond_grab grab = s.any(s.grabs);
    const frond_bond bond = s.any(s.bonds);
    const frond_rigid rigid = s.any(s.rigids);
    require((frond_grab_get(grab, &vec, nullptr, nullptr) == FROND_OK) == frond_grab_is_valid(grab),
            "a grab is and is not");
    require((frond_bond_get(bond, &vec, &vec) == FROND_OK) == frond_bond_is_valid(bond), "a bond is and is not");
    require((frond_rigid_get_body(rigid) != nullptr) == frond_rigid_is_valid(rigid), "a body is and is not");
    if (frond_rigid_get_state(rigid, &state) == FROND_OK)
        require(std::isfinite(state.position.x + state.rotation.w + state.velocity.y + state.angular_velocity.z),
                "a body is not finite");
}

inline void look_at_model(Stage& s) {
    const frond_model model = s.input.byte() < 200 ? s.model : frond_model{s.input.raw<uint64_t>()};
    frond_model_info info;
    frond_part part;
    frond_organ organ;
    frond_texture_view texture;
    frond_cage_view cage;
    frond_chain_view chain;
    frond_advice advice;
    require((frond_model_get_info(model, &info) == FROND_OK) == frond_model_is_valid(model), "a model is and is not");
    frond_model_get_part(model, s.input.integer(), &part);
    frond_model_get_organ(model, s.input.integer(), &organ);
    frond_model_get_texture(model, s.input.integer(), &texture);
    frond_model_get_cage(model, &cage);
    frond_model_get_chain(model, &chain);
    int32_t organs[8];
    frond_model_get_capsule_organs(model, organs, s.input.byte() % 8);
    frond_recommend(model, s.input.number(), s.input.number(), &advice);
    const int number = s.input.integer();
    for (const char* name :
         {frond_result_name(frond_result(number)), frond_effect_name(frond_effects(number)),
          frond_mechanics_name(frond_mechanics(number)), frond_integrator_name(frond_integrator(number)),
          frond_linear_solver_name(frond_linear_solver(number)), frond_mass_name(frond_mass(number)),
          frond_collision_name(frond_collision(number)), frond_hash_layout_name(frond_hash_layout(number)),
          frond_response_name(frond_response(number)), frond_detail_name(frond_detail(number)),
          frond_shape_name(frond_shape(number)), frond_version_string()})
        require(name && name[0], "something has no name");
    frond_material material;
    const char kind[] = {char(s.input.byte()), char(s.input.byte()), 0};
    require(frond_material_preset(kind, &material) != FROND_OK, "a material that nobody knows");
    require(frond_default_material().density > 0, "no material");
}

}  // namespace frond::fuzz
