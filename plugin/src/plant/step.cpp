// One step of a plant: effects -> solve -> accept, with what becomes lasting, or rewind -> chain.
#include "core/timer.hpp"
#include "plant/plant.hpp"

namespace frond {

// Force per node, gravity and springs of this step, in the model's frame.
static void gather_loads(Plant& plant, const Surroundings& surroundings, frond_effects effects) {
    const Quat to_model = plant.rotation.conjugate();
    Loads& loads = plant.loads;
    loads.gravity = effects & FROND_GRAVITY ? Vec3(to_model * surroundings.gravity) : Vec3(Vec3::Zero());
    loads.springs = plant.pin_springs;
    loads.force.setZero();
    if (!(effects & FROND_USER_FORCE)) return;

    if (plant.has_user_force) {
        const Mat3 turn = to_model.toRotationMatrix();
        for (int i = 0; i < node_count_of(plant); i++) {
            const Vec3 force = turn * point(plant.user_force, i);
            if (!plant.follow)
                point(loads.force, i) = force;
            else if (force != Vec3::Zero())
                add_grip_force(plant.follow->grips[size_t(i)], plant.motion.x, force, loads.force);
        }
    }
    for (const Grab& grab : plant.grabs)
        loads.springs.push_back({vertex_grip(plant, grab.vertex), plant.to_model(grab.target), grab.stiffness});
}

static bool is_sound(const Motion& motion, double size) {
    constexpr double FARTHEST = 100;  // a plant stretched to so many times its size has run away [-]
    const double far_away = FARTHEST * size;
    return motion.x.allFinite() && motion.v.allFinite() && motion.x.cwiseAbs().maxCoeff() < far_away;
}

// What is bent beyond its yield keeps a part of that.
static void keep_sets(Plant& plant, double h) {
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const Elements& shared = elements_of(*plant.system);
    if (shared.yields.empty()) return;
    if (!plant.own_elements) {
        if (!row.yields(shared, plant.motion.x)) return;
        plant.own_elements = row.copy(shared);
        use_elements(*plant.workspace, plant.own_elements.get());
    }
    row.flow(*plant.own_elements, plant.motion.x, h);
}

void step_plant(Plant& plant, const Surroundings& surroundings, double h) {
    const frond_effects effects = plant.effects & surroundings.effects;
    Motion& motion = plant.motion;
    plant.x_good = motion.x;
    plant.v_good = motion.v;
    plant.trouble = 0;

    // Effects.
    Timer timer;
    apply_pins(plant);
    gather_loads(plant, surroundings, effects);
    SolveSettings settings = plant.settings;
    if (!(effects & FROND_DAMPING)) settings.mass_damping = settings.stiffness_damping = settings.full_damping = 0;
    plant.ms_effects = timer.lap();

    // Solve.
    plant.report = solve_step(*plant.workspace, settings, plant.loads, h, motion);
    if (!plant.report.converged) plant.trouble |= FROND_TROUBLE_NOT_CONVERGED;
    if (plant.report.inverted > 0) plant.trouble |= FROND_TROUBLE_INVERTED;

    // Accept, or go back to the last good state and stand still there.
    if (!plant.report.ok || !is_sound(motion, plant.model->surface.size())) {
        motion.x = plant.x_good;
        motion.v.setZero();
        motion.history.valid = false;
        plant.trouble |= FROND_TROUBLE_REWOUND;
    } else if (effects & FROND_PLASTICITY) {
        keep_sets(plant, h);
    }
    moved(plant);
}

void clear_user_force(Plant& plant) {
    if (!plant.has_user_force) return;
    plant.user_force.setZero();
    plant.has_user_force = false;
}

}  // namespace frond
