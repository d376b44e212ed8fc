#include "programs/settle.hpp"

#include <unistd.h>

#include "programs/copy.hpp"
#include "scenes/scene.hpp"

namespace frond::programs {

using tools::must;

// Implicit Euler stops what sways. What is far would rest in other mechanics.
static double settle(frond_world world, frond_plant plant, const std::function<void(double)>& step) {
    constexpr int STEPS = 240;
    const frond_effects holds = FROND_EFFECT_GRAVITY | FROND_EFFECT_DAMPING | FROND_EFFECT_FIBRES;
    must(frond_world_set_detail(world, nullptr));
    must(frond_world_set_effects(world, holds));
    must(frond_plant_set_effects(plant, holds));
    must(frond_plant_set_integrator(plant, FROND_INTEGRATOR_IMPLICIT_EULER));
    for (int i = 0; i < STEPS; i++) step(1.0 / 60);
    frond_energy energy = {};
    must(frond_plant_get_energy(plant, &energy));
    return energy.elastic + energy.gravity;
}

double settled_energy(frond_world world, frond_plant plant, const std::function<void(double)>& step) {
    double energy = 0;
    bool is_read = false;
    const auto write_it = [&](int out) {
        const double settled = settle(world, plant, step);
        _exit(write(out, &settled, sizeof settled) == ssize_t(sizeof settled) ? 0 : 1);
    };
    run_in_copy(write_it, [&](int in, int) { is_read = read(in, &energy, sizeof energy) == ssize_t(sizeof energy); });
    if (!is_read) throw tools::SceneError("a plant could not come to rest in a copy of the process");
    return energy;
}

}  // namespace frond::programs
