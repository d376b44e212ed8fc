// frond_fill_def, frond_default_material: all defaults of the C API.
#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include "api/call.hpp"
#include "cage/cage.hpp"
#include "core/decompose.hpp"
#include "frond/frond_robot.h"
#include "skeleton/organ.hpp"

using namespace frond;

static frond_world_def world_def() {
    frond_world_def def = {};
    def.gravity = {0, -9.81, 0};
    def.effects = FROND_EFFECT_ALL;
    def.max_substep = 1.0 / 60;
    def.response = FROND_RESPONSE_IMPULSE;
    def.sleep_distance = 5e-5;
    def.tuning.hash_layout = FROND_HASH_LAYOUT_GRID;
    def.tuning.response_iterations = 200;
    def.tuning.response_tolerance = 1e-6;
    def.tuning.penalty_stiffness = 1000;
    return def;
}

static frond_wind_def wind_def() {
    frond_wind_def def = {};
    def.turbulence = 0.2;
    def.length_scale = 20;
    def.seed = 1;
    def.profile = FROND_WIND_PROFILE_LOG;
    def.reference_height = 10;
    def.roughness = 0.03;
    def.exponent = 1.0 / 7;
    def.density = 1.2;
    return def;
}

static frond_model_def model_def() {
    frond_model_def def = {};
    def.cage_smoothness = CageOptions().smoothness;
    def.allow_stiffening = 3;
    return def;
}

static frond_plant_def plant_def() {
    frond_plant_def def = {};
    def.rotation = {0, 0, 0, 1};
    def.mechanics = FROND_MECHANICS_TET_COROTATIONAL;
    def.element_order = 1;
    def.integrator = FROND_INTEGRATOR_BDF2;
    def.mass_damping = 0.1;
    def.stiffness_damping = 0.002;
    def.material_damping = 1;
    def.effects = FROND_EFFECT_DEFAULT;
    def.group = 1;
    def.mask = -1;
    def.tuning.linear_solver = FROND_LINEAR_SOLVER_BLOCK;
    def.tuning.linear_iterations = 10000;
    def.tuning.linear_tolerance = 1e-6;
    def.tuning.mass = FROND_MASS_LUMPED;
    def.tuning.newton_iterations = 1;
    def.tuning.newton_tolerance = 1e-6;
    def.tuning.spectral_radius = 0.8;
    def.tuning.max_substeps = 1;
    def.tuning.substep_tolerance = 1e-4;
    return def;
}

static frond_detail_def detail_def() {
    frond_detail_def def = {};
    def.rod_from = 5;
    def.half_from = 12;
    def.modal_from = 25;
    def.still_from = 150;
    def.hysteresis = 0.15;
    return def;
}

static frond_rigid_def rigid_def() {
    frond_rigid_def def = {};
    def.shape = FROND_SHAPE_SPHERE;
    def.size = {0.1, 0.1, 0.1};
    def.mass = 1;
    def.friction = 0.5;
    def.state.rotation = {0, 0, 0, 1};
    return def;
}

static frond_robot_def robot_def() {
    frond_robot_def def = {};
    const Quat upright = turn_between(Vec3::UnitZ(), Vec3::UnitY());
    def.rotation = from_quat(upright);
    def.is_fixed = true;
    def.friction = 0.5;
    def.group = btBroadphaseProxy::DefaultFilter;
    def.mask = btBroadphaseProxy::AllFilter;
    return def;
}

template <class Def>
static void fill(void* out, Def def) {
    std::memcpy(out, &def, sizeof def);
}

static void fill_kind(void* def, uint32_t kind) {
    switch (kind) {
        case 'W':
            return fill(def, world_def());
        case 'A':
            return fill(def, wind_def());
        case 'M':
            return fill(def, model_def());
        case 'P':
            return fill(def, plant_def());
        case 'D':
            return fill(def, detail_def());
        case 'R':
            return fill(def, rigid_def());
        case 'U':
            return fill(def, robot_def());
    }
}

extern "C" {

void frond_fill_def(void* def, uint32_t cookie) {
    if (!def) return;
    if (is_of_this_version(cookie)) fill_kind(def, cookie >> 24);
    fill(def, cookie);  // it comes first in every def, whatever the version
}

frond_material frond_default_material(void) {
    return *material_preset("stem");
}

}  // extern "C"
