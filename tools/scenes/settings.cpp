// Assignments of key=value for every public option.
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>

#include "scenes/scene.hpp"

namespace frond::tools {

void must(frond_result result) {
    if (result != FROND_OK) throw SceneError(frond_last_error());
}

namespace {

struct Key {
    const char* name;
    const char* text;
    std::function<void(Settings&, const std::string&)> set;
};

double number(const std::string& text) {
    errno = 0;
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end || errno || !std::isfinite(value)) throw SceneError("\"" + text + "\" is not a number");
    return value;
}

double number(const std::string& text, double least, double most) {
    const double value = number(text);
    if (value >= least && value <= most) return value;
    char range[80];
    std::snprintf(range, sizeof range, " is not between %.10g and %.10g", least, most);
    throw SceneError(text + range);
}

int whole(const std::string& text, int least, int most) {
    const double value = number(text, least, most);
    if (value != std::floor(value)) throw SceneError(text + " is not a whole number");
    return int(value);
}

frond_vec3 vector(const std::string& text) {
    const size_t first = text.find(','), second = text.find(',', first + 1);
    if (first == std::string::npos || second == std::string::npos)
        throw SceneError("\"" + text + "\" is not a vector; write x,y,z");
    return {number(text.substr(0, first)), number(text.substr(first + 1, second - first - 1)),
            number(text.substr(second + 1))};
}

// Returns the row of a table with the given name.
template <class Row>
Row row(const std::string& text, int count, const char* (*name)(Row)) {
    std::string names;
    for (int i = 0; i < count; i++) {
        if (text == name(Row(i))) return Row(i);
        names += std::string(i ? ", " : "") + name(Row(i));
    }
    throw SceneError("\"" + text + "\" is none of " + names);
}

// Keys for a number, a count, a vector or a row of a table. The path leads to the field, member by member.
template <class... Path>
Key real(const char* name, const char* text, Path... path) {
    return {name, text, [=](Settings& s, const std::string& value) { (s.*....*path) = number(value); }};
}
template <class... Path>
Key count(const char* name, const char* text, Path... path) {
    return {name, text, [=](Settings& s, const std::string& value) {
                (s.*....*path) = whole(value, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
            }};
}
template <class... Path>
Key triple(const char* name, const char* text, Path... path) {
    return {name, text, [=](Settings& s, const std::string& value) { (s.*....*path) = vector(value); }};
}
template <class Row, class... Path>
Key choice(const char* name, const char* text, int rows, const char* (*row_name)(Row), Path... path) {
    return {name, text,
            [=](Settings& s, const std::string& value) { (s.*....*path) = row<Row>(value, rows, row_name); }};
}
// Key for an effect of all plants, on or off.
Key effect(const char* name, const char* text, frond_effects bit) {
    return {name, text, [=](Settings& s, const std::string& value) {
                if (value != "on" && value != "off") throw SceneError("\"" + value + "\" is neither on nor off");
                s.plant.effects = value == "on" ? s.plant.effects | bit : s.plant.effects & ~bit;
            }};
}

const std::vector<Key>& keys() {
    static const std::vector<Key> table = {
        {"dt", "time step [s]", [](Settings& s, const std::string& value) { s.dt = number(value, 1e-6, 1); }},
        {"pull", "how far the user drags, share of the height",
         [](Settings& s, const std::string& value) { s.pull = number(value); }},
        {"plants", "of corn_field, 0: 17, or of field, 0: 10000",
         [](Settings& s, const std::string& value) { s.plants = whole(value, 0, 100000); }},
        {"walkers", "of field", [](Settings& s, const std::string& value) { s.walkers = whole(value, 0, 1000); }},
        {"patch_wind", "over a patch of field [m/s]",
         [](Settings& s, const std::string& value) { s.patch_wind = number(value); }},
        {"detail", "0 or 1: far plants of field are simulated for less",
         [](Settings& s, const std::string& value) { s.detail = whole(value, 0, 1) != 0; }},
        {"budget", "of a step of all plants of field [ms], 0: any",
         [](Settings& s, const std::string& value) { s.budget = number(value, 0, 1000); }},
        {"threads", "that step plants",
         [](Settings& s, const std::string& value) { s.threads = whole(value, 1, 256); }},
        {"grab_stiffness", "of the user's spring [N/m], 0: as it takes",
         [](Settings& s, const std::string& value) { s.grab_stiffness = number(value); }},
        {"stiffness", "factor on Young's modulus of all organs",
         [](Settings& s, const std::string& value) { s.stiffness = number(value, 1e-6, 1e6); }},
        triple("gravity", "x,y,z [m/s^2]", &Settings::world, &frond_world_def::gravity),
        real("max_substep", "longest solver step [s]", &Settings::world, &frond_world_def::max_substep),
        choice("hash_layout", "where cages meet, row of the table", FROND_HASH_LAYOUT_COUNT, frond_hash_layout_name,
               &Settings::world, &frond_world_def::tuning, &frond_contact_tuning::hash_layout),
        count("hash_table_size", "n of the paper, 0: chosen", &Settings::world, &frond_world_def::tuning,
              &frond_contact_tuning::hash_table_size),
        real("hash_cell_size", "l of the paper [m], 0: chosen", &Settings::world, &frond_world_def::tuning,
             &frond_contact_tuning::hash_cell_size),
        choice("response", "what contacts do, row of the table", FROND_RESPONSE_COUNT, frond_response_name,
               &Settings::world, &frond_world_def::response),
        count("response_iterations", "rounds over all contacts", &Settings::world, &frond_world_def::tuning,
              &frond_contact_tuning::response_iterations),
        real("response_tolerance", "share of the largest impulse", &Settings::world, &frond_world_def::tuning,
             &frond_contact_tuning::response_tolerance),
        real("penalty_stiffness", "of response=penalty [N/m]", &Settings::world, &frond_world_def::tuning,
             &frond_contact_tuning::penalty_stiffness),
        real("sleep_distance", "of what rests [m], 0: nothing sleeps", &Settings::world,
             &frond_world_def::sleep_distance),
        effect("breaking", "on or off: what is strained beyond its strength", FROND_EFFECT_BREAKING),
        effect("fibres", "on or off: cages held to their organs' lengths", FROND_EFFECT_FIBRES),
        effect("plasticity", "on or off", FROND_EFFECT_PLASTICITY),
        effect("rigid_contact", "on or off", FROND_EFFECT_RIGID_CONTACT),
        effect("two_way", "on or off", FROND_EFFECT_TWO_WAY),
        effect("plant_contact", "on or off", FROND_EFFECT_PLANT_CONTACT),
        effect("self_contact", "on or off", FROND_EFFECT_SELF_CONTACT),
        effect("friction", "on or off", FROND_EFFECT_FRICTION),
        triple("wind", "x,y,z at 10 m height [m/s], 0,0,0: no air", &Settings::wind, &frond_wind_def::velocity),
        real("turbulence", "of the wind, share of its speed", &Settings::wind, &frond_wind_def::turbulence),
        real("gust_length", "length scale of gusts [m]", &Settings::wind, &frond_wind_def::length_scale),
        real("scale", "metres per file unit, 0: guess", &Settings::model, &frond_model_def::scale),
        triple("up", "up axis of the file, 0,0,0: guess", &Settings::model, &frond_model_def::up),
        real("capsule_height", "h of the paper [m], 0: chosen", &Settings::model, &frond_model_def::capsule_height),
        real("capsule_radius", "r of the paper [m], 0: fitted", &Settings::model, &frond_model_def::capsule_radius),
        real("cage_size", "edge of a cage cell [m], 0: chosen", &Settings::model, &frond_model_def::cage_size),
        real("cage_offset", "reach outside the surface [m]", &Settings::model, &frond_model_def::cage_offset),
        real("cage_smoothness", "0..1", &Settings::model, &frond_model_def::cage_smoothness),
        real("allow_stiffening", "largest factor by which organs may be made stiffer", &Settings::model,
             &frond_model_def::allow_stiffening),
        choice("mechanics", "row of the table", FROND_MECHANICS_COUNT, frond_mechanics_name, &Settings::plant,
               &frond_plant_def::mechanics),
        {"rest", "as_modelled, or without_gravity: then it droops",
         [](Settings& s, const std::string& value) {
             if (value != "as_modelled" && value != "without_gravity")
                 throw SceneError("\"" + value + "\" is none of as_modelled, without_gravity");
             s.model.rest = value == "as_modelled" ? FROND_REST_STANDS_AS_MODELLED : FROND_REST_WITHOUT_GRAVITY;
         }},
        count("element_order", "of the tets, 1 or 2", &Settings::plant, &frond_plant_def::element_order),
        choice("collision", "organs or cage", FROND_COLLISION_COUNT, frond_collision_name, &Settings::plant,
               &frond_plant_def::collision),
        choice("integrator", "row of the table", FROND_INTEGRATOR_COUNT, frond_integrator_name, &Settings::plant,
               &frond_plant_def::integrator),
        choice("linear_solver", "row of the table", FROND_LINEAR_SOLVER_COUNT, frond_linear_solver_name,
               &Settings::plant, &frond_plant_def::tuning, &frond_tuning::linear_solver),
        choice("mass", "lumped or consistent", FROND_MASS_COUNT, frond_mass_name, &Settings::plant,
               &frond_plant_def::tuning, &frond_tuning::mass),
        count("newton_iterations", "solves per step", &Settings::plant, &frond_plant_def::tuning,
              &frond_tuning::newton_iterations),
        real("newton_tolerance", "share of the first residual", &Settings::plant, &frond_plant_def::tuning,
             &frond_tuning::newton_tolerance),
        count("linear_iterations", "of an iterative solver", &Settings::plant, &frond_plant_def::tuning,
              &frond_tuning::linear_iterations),
        real("linear_tolerance", "of an iterative solver", &Settings::plant, &frond_plant_def::tuning,
             &frond_tuning::linear_tolerance),
        count("max_substeps", "of a step, where its error asks for them", &Settings::plant, &frond_plant_def::tuning,
              &frond_tuning::max_substeps),
        real("substep_tolerance", "error of a place in a step, share of the size", &Settings::plant,
             &frond_plant_def::tuning, &frond_tuning::substep_tolerance),
        real("mass_damping", "Rayleigh [1/s]", &Settings::plant, &frond_plant_def::mass_damping),
        real("stiffness_damping", "Rayleigh [s]", &Settings::plant, &frond_plant_def::stiffness_damping),
        real("material_damping", "share of the organs' damping ratios", &Settings::plant,
             &frond_plant_def::material_damping),
        real("spectral_radius", "of generalized_alpha, 0..1", &Settings::plant, &frond_plant_def::tuning,
             &frond_tuning::spectral_radius),
        real("root_height", "pinned above the foot [m], 0: chosen, < 0: none", &Settings::plant,
             &frond_plant_def::root_height),
    };
    return table;
}

const struct {
    const char* name;
    double frond_material::*field;
} MATERIAL_FIELDS[] = {{"density", &frond_material::density},
                       {"young", &frond_material::young},
                       {"poisson", &frond_material::poisson},
                       {"thickness", &frond_material::thickness},
                       {"hollow", &frond_material::hollow},
                       {"twist_to_bend", &frond_material::twist_to_bend},
                       {"damping_ratio", &frond_material::damping_ratio},
                       {"friction", &frond_material::friction},
                       {"restitution", &frond_material::restitution},
                       {"yield_strain", &frond_material::yield_strain},
                       {"creep_rate", &frond_material::creep_rate},
                       {"strength", &frond_material::strength},
                       {"drag", &frond_material::drag},
                       {"midrib", &frond_material::midrib}};

std::string material_key() {
    std::string names;
    for (const auto& row : MATERIAL_FIELDS) names += std::string(names.empty() ? "" : "|") + row.name;
    return "material.<organ or kind>.<" + names + ">";
}

void apply_material(Settings& settings, const std::string& key, const std::string& value) {
    const size_t dot = key.rfind('.');
    const std::string organ = dot > 9 ? key.substr(9, dot - 9) : "";
    for (const auto& row : MATERIAL_FIELDS)
        if (!organ.empty() && key.substr(dot + 1) == row.name) {
            settings.organs.push_back({organ, row.field, number(value)});
            return;
        }
    throw SceneError("write " + material_key() + "=value");
}

}  // namespace

void apply_setting(Settings& settings, const std::string& assignment) {
    const size_t equals = assignment.find('=');
    if (equals == std::string::npos) throw SceneError("\"" + assignment + "\": write key=value");
    const std::string name = assignment.substr(0, equals), value = assignment.substr(equals + 1);
    if (name.rfind("material.", 0) == 0) return apply_material(settings, name, value);
    std::string names;
    for (const Key& key : keys()) {
        if (name == key.name) {
            try {
                return key.set(settings, value);
            } catch (const SceneError& error) {
                throw SceneError(name + ": " + error.what());
            }
        }
        names += std::string(names.empty() ? "" : ", ") + key.name;
    }
    throw SceneError("there is no setting \"" + name + "\"; there are " + names + ", material.<organ>.<field>");
}

std::string settings_help() {
    std::string help;
    for (const Key& key : keys())
        help += "  " + std::string(key.name) + std::string(20 - std::string(key.name).size(), ' ') + key.text + "\n";
    return help + "  " + material_key() + "\n";
}

Settings settings_of(const Casting& casting, const std::vector<std::string>& assignments) {
    Settings settings;
    if (casting.scene->set_defaults) casting.scene->set_defaults(settings);
    for (const std::string& assignment : assignments) apply_setting(settings, assignment);
    return settings;
}

}  // namespace frond::tools
