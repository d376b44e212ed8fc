// Impulses: keep bodies in contact from passing through each other, with Coulomb friction. Independent of what the
// bodies are: they appear only by their compliance, the velocities at contacts by impulses there.
#pragma once

#include <functional>
#include <vector>

#include "core/types.hpp"
#include "frond/frond.h"

namespace frond {

// A contact of two bodies a and b. Velocities are of a relative to b; impulses act on a, and the opposite on b.
struct Touch {
    Vec3 normal;           // from b to a, length one
    Vec3 velocity;         // relative velocity without any impulses [m/s]
    double bias_velocity;  // velocity along the normal at which they must part or, below zero, may still approach [m/s]
    double friction;       // coefficient of friction [-]
    double depth = 0;      // overlap; below zero they are apart [m]
    // Velocity along the normal at which positions must part, or may still approach, besides what velocities do [m/s].
    double least_correction = NO_CORRECTION;
    static constexpr double NO_CORRECTION = -1e30;  // left to velocities
    double most_correction = 1e30;                  // largest impulse of the position correction [N s]
    static constexpr double ANY_PUSH = 1e30;
    double most_push = ANY_PUSH;  // largest impulse along the normal [N s]
    // A bond holds in all directions, without normal, bias velocity and friction: a moves at `wanted` against b.
    bool is_bond = false;
    Vec3 wanted = Vec3::Zero();  // [m/s]
};

// A block of W, the velocity at a contact by an impulse at another one [1/kg].
struct Coupling {
    int other;
    Mat3 block;
};

// W, row by row on request, since most contacts only wait and need no row. Symmetric as a whole: both (i, j) and (j, i)
// are given, and (i, i) of everything that can move.
struct CouplingTable {
    std::function<const std::vector<Coupling>&(int touch)> row;  // the result lives as long as the table
    std::vector<std::vector<int>> islands;  // each contact is in one, and coupled to none of another
};

struct ImpulseLimits {
    int iterations = 200;
    double tolerance = 1e-6;  // largest change of an impulse in a round, over the largest impulse [-]
};

struct ResponseSettings {
    ImpulseLimits limits;    // for FROND_RESPONSE_IMPULSE
    double stiffness = 1e3;  // for FROND_RESPONSE_PENALTY [N/m]
    double h = 0;            // length of the step [s]
};

// A row of the table of responses.
struct ResponseRow {
    const char* name;
    // Finds impulses on a, the opposite on b, one a contact [N s]; the search begins with the given ones. Null: nothing
    // pushes.
    void (*find)(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                 std::vector<Vec3>& impulses);
};
const ResponseRow& response_row(frond_response which);
void push_by_impulse(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     std::vector<Vec3>& impulses);
void push_by_penalty(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     std::vector<Vec3>& impulses);

// A contact with less compliance along its normal is immovable and bears no impulse: near two roots 23,000 N s were
// found. No plant weighs as much as 10^7 kg.
constexpr double IMMOVABLE = 1e-7;  // [1/kg]

// Returns the inverse of a contact's own block of W, zero in directions in which nothing moves.
Mat3 firm_inverse(const Mat3& block);

struct ImpulseReport {
    int iterations = 0;
    bool converged = false;
};

// Finds the impulses [N s] for which, at every contact, either there is no impulse and the bodies part, or there is
// one, they move at their bias velocity along the normal, if the largest push can do that, and friction stops the
// sliding or opposes it at its limit.
// The search begins with the given impulses, if there are any, and ends where a round changes no contact's velocity by
// more than `unfelt` [m/s], or at its limits.
ImpulseReport find_impulses(const std::vector<Touch>& touches, const CouplingTable& coupling,
                            const ImpulseLimits& limits, std::vector<Vec3>& impulses, double unfelt = 0);

}  // namespace frond
