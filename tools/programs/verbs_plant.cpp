// Operations that make plants, destroy them, and change their settings.
#include <cmath>

#include "programs/run.hpp"
#include "programs/source.hpp"

namespace frond::programs {

namespace {

// Effects are given as those that differ from the default.
frond_effects effects_of(const Operation& o) {
    frond_effects effects = FROND_EFFECT_DEFAULT;
    if (whole(o, "self")) effects |= FROND_EFFECT_SELF_CONTACT;
    if (whole(o, "breaking")) effects |= FROND_EFFECT_BREAKING;
    if (!whole(o, "plasticity")) effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
    return effects & ~frond_effects(whole(o, "without"));
}

frond_quat rotation_of(const Operation& o) {
    const double turn = 0.5 * number(o, "turn"), tilt = 0.5 * number(o, "tilt");
    // First about y, then about z.
    const double cy = std::cos(turn), sy = std::sin(turn), cz = std::cos(tilt), sz = std::sin(tilt);
    return {sz * sy, cz * sy, sz * cy, cz * cy};
}

frond_plant_def def_of(const Operation& o) {
    frond_plant_def def = frond_default_plant_def();
    def.position = {number(o, "x"), number(o, "y"), number(o, "z")};
    def.rotation = rotation_of(o);
    def.mechanics = frond_mechanics(whole(o, "mechanics"));
    def.integrator = frond_integrator(whole(o, "integrator"));
    def.root_height = number(o, "root_height");
    def.mass_damping = number(o, "mass_damping");
    def.stiffness_damping = number(o, "stiffness_damping");
    def.material_damping = number(o, "material_damping");
    def.effects = effects_of(o);
    def.starts_asleep = whole(o, "starts_asleep") != 0;
    def.tuning.linear_solver = frond_linear_solver(whole(o, "linear_solver"));
    def.tuning.mass = frond_mass(whole(o, "mass"));
    def.tuning.newton_iterations = whole(o, "newton_iterations");
    def.tuning.spectral_radius = number(o, "spectral_radius");
    def.tuning.max_substeps = 1 << whole(o, "substeps");
    return def;
}
void create(Run& run, const Operation& o) {
    run.add_plant(o.id, o.of[0], def_of(o));
}
void write_create(Source& s, const Operation& o) {
    const frond_plant_def def = def_of(o);
    const std::string name = "def_" + std::to_string(o.id);
    s.line("frond_plant_def %s = frond_default_plant_def();", name.c_str());
    s.line("%s.position = vec(%s);", name.c_str(), vec_text(def.position).c_str());
    if (number(o, "turn") != 0 || number(o, "tilt") != 0)
        s.line("%s.rotation.x = %s, %s.rotation.y = %s, %s.rotation.z = %s, %s.rotation.w = %s;", name.c_str(),
               text_of(def.rotation.x).c_str(), name.c_str(), text_of(def.rotation.y).c_str(), name.c_str(),
               text_of(def.rotation.z).c_str(), name.c_str(), text_of(def.rotation.w).c_str());
    s.fields(name, o,
             {{"mechanics|frond_mechanics", "mechanics"},
              {"integrator|frond_integrator", "integrator"},
              {"root_height", "root_height"},
              {"mass_damping", "mass_damping"},
              {"stiffness_damping", "stiffness_damping"},
              {"material_damping", "material_damping"},
              {"starts_asleep", "starts_asleep"},
              {"tuning.linear_solver|frond_linear_solver", "linear_solver"},
              {"tuning.mass|frond_mass", "mass"},
              {"tuning.newton_iterations", "newton_iterations"},
              {"tuning.spectral_radius", "spectral_radius"}});
    if (def.effects != FROND_EFFECT_DEFAULT) s.line("%s.effects = %u;", name.c_str(), def.effects);
    if (def.tuning.max_substeps != 1) s.line("%s.tuning.max_substeps = %d;", name.c_str(), def.tuning.max_substeps);
    s.line("frond_plant plant_%d = {0};", o.id);
    s.line("frond_plant_create(world, model_%d, &%s, &plant_%d);", o.of[0], name.c_str(), o.id);
}

void destroy(Run& run, const Operation& o) {
    run.remove_plant(o.of[0]);
}
void write_destroy(Source& s, const Operation& o) {
    s.line("frond_plant_destroy(%s);", plant_name(o).c_str());
}

void set_mechanics(Run& run, const Operation& o) {
    run.change_mechanics(o.of[0], frond_mechanics(whole(o, "to")));
}
void write_mechanics(Source& s, const Operation& o) {
    s.line("frond_plant_set_mechanics(%s, (frond_mechanics)%d);", plant_name(o).c_str(), whole(o, "to"));
}

void set_integrator(Run& run, const Operation& o) {
    run.check(frond_plant_set_integrator(run.plants.at(o.of[0]).handle, frond_integrator(whole(o, "to"))));
}
void write_integrator(Source& s, const Operation& o) {
    s.line("frond_plant_set_integrator(%s, (frond_integrator)%d);", plant_name(o).c_str(), whole(o, "to"));
}

void set_effects(Run& run, const Operation& o) {
    run.check(frond_plant_set_effects(run.plants.at(o.of[0]).handle, effects_of(o)));
}
void write_effects(Source& s, const Operation& o) {
    s.line("frond_plant_set_effects(%s, %u);", plant_name(o).c_str(), effects_of(o));
}

}  // namespace

std::vector<Verb> plant_verbs() {
    constexpr Kind NONE = Kind::NONE, PLANT = Kind::PLANT;
    constexpr Scale WHOLE = Scale::WHOLE;
    constexpr double IMPLICIT = FROND_INTEGRATOR_SYMPLECTIC_EULER - 1;  // the last of them
    const std::vector<Parameter> effects = {{"self", 0, 0, 1, 0.3, WHOLE},
                                            {"breaking", 0, 0, 1, 0.2, WHOLE},
                                            {"plasticity", 1, 0, 1, 0.6, WHOLE},
                                            {"without", 0, 0, FROND_EFFECT_ALL, 0.05, WHOLE}};
    std::vector<Parameter> making = {
        {"x", 0, -1, 1, 0.6},
        {"y", 0, 0, 1, 0.05},
        {"z", 0, -1, 1, 0.5},
        {"turn", 0, -3.14, 3.14, 0.3},
        {"tilt", 0, -1.5, 1.5, 0.05},
        {"mechanics", FROND_MECHANICS_TET_COROTATIONAL, 0, FROND_MECHANICS_COUNT - 1, 0.75, WHOLE},
        {"integrator", FROND_INTEGRATOR_BDF2, 0, IMPLICIT, 0.4, WHOLE},
        {"root_height", 0, -1, -1, 0.15},
        {"mass_damping", 0.1, 0, 2, 0.2},
        {"stiffness_damping", 0.002, 0, 0.01, 0.2},
        {"material_damping", 1, 0, 3, 0.2},
        {"starts_asleep", 0, 0, 1, 0.2, WHOLE},
        {"linear_solver", FROND_LINEAR_SOLVER_BLOCK, 0, FROND_LINEAR_SOLVER_COUNT - 1, 0.05, WHOLE},
        {"mass", FROND_MASS_LUMPED, 0, 1, 0.2, WHOLE},
        {"newton_iterations", 1, 1, 8, 0.2, WHOLE},
        {"spectral_radius", 0.8, 0, 1, 0.1},
        {"substeps", 0, 0, 3, 0.1, WHOLE}};
    making.insert(making.end(), effects.begin(), effects.end());
    return {
        {"plant", PLANT, {Kind::MODEL, NONE}, 3, making, create, write_create},
        {"destroy", NONE, {PLANT, NONE}, 1, {}, destroy, write_destroy},
        {"mechanics",
         NONE,
         {PLANT, NONE},
         4,
         {{"to", FROND_MECHANICS_ROD, 0, FROND_MECHANICS_COUNT - 1, 0.9, WHOLE}},
         set_mechanics,
         write_mechanics},
        {"integrator",
         NONE,
         {PLANT, NONE},
         2,
         {{"to", FROND_INTEGRATOR_BDF2, 0, IMPLICIT, 0.9, WHOLE}},
         set_integrator,
         write_integrator},
        {"plant_effects", NONE, {PLANT, NONE}, 2, effects, set_effects, write_effects},
    };
}

}  // namespace frond::programs
