#include "step/report.hpp"

#include <algorithm>

#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

void add_effect(World& world, frond_effects effect, double ms) {
    world.report.effects_run |= effect;
    size_t bit = 0;
    while (effect >> bit != 1) bit++;
    world.profile.ms_of_effect[bit] += ms;
}

void add_to_report(World& world, PlantBody& body) {
    frond_report& report = world.report;
    const Plant& plant = *body.plant;
    if (plant.trouble != 0) note_trouble(world, body, plant.trouble);
    if (plant.state.modal) return;
    if (plant.state.stretched > 0) note_of_plant(world, body, FROND_TROUBLE_TAUT);
    report.solver_iterations += plant.report.iterations;
    report.residual = std::max(report.residual, plant.report.residual);
    world.profile.ms_effects += plant.ms_effects;
    world.profile.ms_assembly += plant.report.ms_assembly;
    world.profile.ms_solve += plant.report.ms_solve;
    const frond_effects effects = plant.input.effects & world.effects;
    report.effects_run |= effects & (FROND_EFFECT_GRAVITY | FROND_EFFECT_DAMPING);
    if (effects & FROND_EFFECT_USER_FORCE && (plant.input.has_user_force || !plant.input.grabs.empty()))
        add_effect(world, FROND_EFFECT_USER_FORCE, plant.ms_user_force);
    const frond_effects air = effects & (FROND_EFFECT_WIND | FROND_EFFECT_AIR_DRAG);
    if (world.wind && air) {
        add_effect(world, air & FROND_EFFECT_WIND ? FROND_EFFECT_WIND : FROND_EFFECT_AIR_DRAG, plant.ms_air);
        report.effects_run |= air;
    }
    if (effects & FROND_EFFECT_FIBRES && plant.fibres) add_effect(world, FROND_EFFECT_FIBRES, plant.ms_fibres);
    if (effects & FROND_EFFECT_PLASTICITY) add_effect(world, FROND_EFFECT_PLASTICITY, plant.ms_plasticity);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
