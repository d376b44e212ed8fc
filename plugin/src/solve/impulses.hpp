// Impulses: what keeps bodies that touch from passing through each other, with Coulomb friction. Says nothing of what
// the bodies are: they are seen through how velocities at the touching points answer to impulses there.
#pragma once

#include <functional>
#include <vector>

#include "core/types.hpp"
#include "frond/frond.h"

namespace frond {

// A touch of two bodies a and b. Velocities are of a against b, impulses on a; b gets the opposite.
struct Touch {
    Vec3 normal;           // from b to a, length one
    Vec3 velocity;         // without any impulses [m/s]
    double bias_velocity;  // along the normal: how fast they must part, or, below zero, may still approach [m/s]
    double friction;       // [-]
    double depth = 0;      // by which they overlap; below zero they are apart [m]
    // Along the normal, how fast places must part, or may still approach, besides what velocities do [m/s].
    double least_correction = NO_CORRECTION;
    static constexpr double NO_CORRECTION = -1e30;  // velocities see to that
    double most_correction = 1e30;                  // by an impulse of at most [N s]
    // Of a bond, which holds both ways and across: how fast a shall move against b. What stands above then does not
    // count.
    bool is_bond = false;
    Vec3 wanted = Vec3::Zero();  // [m/s]
};

// A block of W, the velocity at a touch by an impulse at another one [1/kg].
struct Coupling {
    int other;
    Mat3 block;
};

// W, row by row as they are asked for, since most touches only wait and then nobody has to know theirs. Symmetric as a
// whole: both of (i, j) and (j, i) are given, and every (i, i) of what can move.
struct CouplingTable {
    std::function<const std::vector<Coupling>&(int touch)> row;  // what is returned lives as long as the table
    std::vector<std::vector<int>> islands;  // each touch is in one of them, and answers to none of another
};
// Of rows that are known already and live longer.
CouplingTable coupling_table(const std::vector<std::vector<Coupling>>& rows);

struct ImpulseLimits {
    int iterations = 200;
    double tolerance = 1e-6;  // change of an impulse in a round, over the largest one [-]
};

// What a response does for each touch: impulses for a, the opposite for b; those that come in are where the search
// begins. Shifts move places and give no velocity [N s].
struct Pushes {
    std::vector<Vec3> impulses, corrections;
};

struct ResponseSettings {
    ImpulseLimits limits;    // of FROND_RESPONSE_IMPULSE
    double stiffness = 1e3;  // of FROND_RESPONSE_PENALTY [N/m]
    double h = 0;            // of the step [s]
};

// A row of the table of responses.
struct ResponseRow {
    const char* name;
    // Null: nothing pushes. Empty shifts: none.
    void (*find)(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                 Pushes& out);
};
const ResponseRow& response_row(frond_response which);
void push_by_impulse(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     Pushes& out);
void push_by_penalty(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     Pushes& out);

// Of what a touch answers to itself, without the ways in which nothing moves.
Mat3 firm_inverse(const Mat3& block);

struct ImpulseReport {
    int iterations = 0;
    bool converged = false;
};

// The impulses [N s] for which, at every touch, either nothing pushes and the bodies part, or they push and move as
// fast as they must along the normal, and across it friction stops the sliding or is at its limit against it. The
// search begins with those that come in, if there are any, and ends where a round changes no touch's speed by more than
// `unfelt` [m/s], or its limits are reached.
ImpulseReport find_impulses(const std::vector<Touch>& touches, const CouplingTable& coupling,
                            const ImpulseLimits& limits, std::vector<Vec3>& impulses, double unfelt = 0);

}  // namespace frond
