// Impulses: what keeps bodies that touch from passing through each other, with Coulomb friction. Says nothing of what
// the bodies are: they are seen through how velocities at the touching points answer to impulses there.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace frond {

// A touch of two bodies a and b. Velocities are of a against b, impulses on a; b gets the opposite.
struct Touch {
    Vec3 normal;         // from b to a, length one
    Vec3 velocity;       // without any impulses [m/s]
    double least_speed;  // along the normal: how fast they must part, or, below zero, may still approach [m/s]
    double friction;     // [-]
};

// Blocks of W, the velocity at a touch by an impulse at another one [1/kg]. Symmetric as a whole: both of (i, j) and
// (j, i) are given, and every (i, i).
struct Coupling {
    int other;
    Mat3 block;
};

struct ImpulseLimits {
    int iterations = 200;
    double tolerance = 1e-6;  // change of an impulse in a round, over the largest one [-]
};

struct ImpulseReport {
    int iterations = 0;
    bool converged = false;
};

// The impulses [N s] for which, at every touch, either nothing pushes and the bodies part, or they push and move as fast
// as they must along the normal, and across it friction stops the sliding or is at its limit against it.
ImpulseReport find_impulses(const std::vector<Touch>& touches, const std::vector<std::vector<Coupling>>& coupling,
                            const ImpulseLimits& limits, std::vector<Vec3>& impulses);

}  // namespace frond
