// Rods: the capsules of the chain as beams between nodes that move and turn. Node i of the chain is two nodes of the
// mechanics: 2i, where it is, and 2i+1, its rotation from the modelled shape as a rotation vector.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// A beam from chain node a to b. Its frame has the columns axis, thin, wide: it bends most easily towards `thin`.
struct RodSegment {
    int a, b;                   // chain nodes, a < b
    double length;              // at rest [m]
    Mat3 frame;                 // in the modelled shape
    Vec3 stretch;               // resistance to stretch and to shear towards thin and wide [N]
    Vec3 bend;                  // to twist and to turning about thin and wide [N m^2]
    Vec3 rest_strain;           // stretch and shear without load; (1, 0, 0) for a straight piece at its own length [-]
    Vec3 rest_curvature;        // twist and curvature without load, over the modelled one [1/m]
    std::array<int, 16> slots;  // of the nodes 2a, 2a+1, 2b, 2b+1 in a BlockMatrix of the pattern
};

struct RodElements : Elements {
    std::vector<RodSegment> segments;
    std::vector<double> mass;   // one a chain node [kg]
    std::vector<Mat3> inertia;  // rotary, one a chain node, in the modelled shape [kg m^2]
};

inline const RodElements& as_rods(const Elements& elements) {
    return static_cast<const RodElements&>(elements);
}

// From a model with chain, sections and organs. `rod` takes the sections as they are; `spring_chain` round ones of the
// capsules' own radius, stress-free in the modelled shape.
RodElements make_rod_elements(const Model& model, frond_mechanics which);

}  // namespace frond
