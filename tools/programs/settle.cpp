#include "programs/settle.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include "scenes/scene.hpp"

namespace frond::programs {

using tools::must;

// Implicit Euler stops what sways.
static double settle(frond_world world, frond_plant plant, const std::function<void(double)>& step) {
    constexpr int STEPS = 240;
    const frond_effects holds = FROND_EFFECT_GRAVITY | FROND_EFFECT_DAMPING | FROND_EFFECT_FIBRES;
    must(frond_world_set_effects(world, holds));
    must(frond_plant_set_effects(plant, holds));
    must(frond_plant_set_integrator(plant, FROND_INTEGRATOR_IMPLICIT_EULER));
    for (int i = 0; i < STEPS; i++) step(1.0 / 60);
    frond_energy energy = {};
    must(frond_plant_get_energy(plant, &energy));
    return energy.elastic + energy.gravity;
}

double settled_energy(frond_world world, frond_plant plant, const std::function<void(double)>& step) {
    int ends[2];
    if (pipe(ends) != 0) throw tools::SceneError("no pipe");
    const pid_t child = fork();
    if (child == 0) {
        double energy = 0;
        bool is_written = false;
        try {
            energy = settle(world, plant, step);
            is_written = write(ends[1], &energy, sizeof energy) == ssize_t(sizeof energy);
        } catch (const std::exception&) {
        }
        _exit(is_written ? 0 : 1);
    }
    close(ends[1]);
    double energy = 0;
    const bool is_read = child > 0 && read(ends[0], &energy, sizeof energy) == ssize_t(sizeof energy);
    close(ends[0]);
    int status = 0;
    if (child > 0) waitpid(child, &status, 0);
    if (!is_read) throw tools::SceneError("a plant could not come to rest in a copy of the process");
    return energy;
}

}  // namespace frond::programs
