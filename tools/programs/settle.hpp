// settled_energy: what a plant stores at rest between the pins that hold it.
#pragma once

#include <functional>

#include "frond/frond.h"

namespace frond::programs {

// Returns the elastic and potential energy [J] that a plant has once it came to rest under its weight and between its
// pins alone. It comes to rest in a copy of this process, so here nothing changes; `step` steps the world there [s].
// Throws a SceneError.
double settled_energy(frond_world world, frond_plant plant, const std::function<void(double)>& step);

}  // namespace frond::programs
