// Rods: the capsules of the chain as beams between nodes that move and turn. Node i of the chain is two nodes of the
// mechanics: 2i, where it is, and 2i+1, its rotation from the modelled shape as a rotation vector.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// A beam from chain node a to b. Its frame has the columns axis, thin, wide: it bends most easily towards `thin`.
struct RodSegment {
    int a, b;             // chain nodes, a < b
    double length;        // at rest [m]
    Mat3 frame;           // in the modelled shape
    Vec3 stretch;         // resistance to stretch and to shear towards thin and wide [N]
    Vec3 bend;            // to twist and to turning about thin and wide [N m^2]
    Vec3 rest_strain;     // stretch and shear without load; (1, 0, 0) for a straight piece at its own length [-]
    Vec3 rest_curvature;  // twist and curvature without load, over the modelled one [1/m]
    double reach_thin, reach_wide;  // of the outermost fibres from the axis, towards thin and wide [m]
    std::array<int, 16> slots;      // of the nodes 2a, 2a+1, 2b, 2b+1 in a BlockMatrix of the pattern
};

// What of a piece's strain is lasting: added to what it would be at rest without.
struct RodPlastic {
    Vec3 rest_strain, rest_curvature;
    double stretch;               // [-]
    double bend_wide, bend_thin;  // curvature towards wide and thin, about the other one [1/m]
    double hardening;             // see elastic_share()
};

struct RodElements : Elements {
    std::vector<RodSegment> segments;
    std::vector<double> mass;         // one a chain node [kg]
    std::vector<Mat3> inertia;        // rotary, one a chain node, in the modelled shape [kg m^2]
    std::vector<RodPlastic> plastic;  // one a segment of a plant that has yielded, else none
};

inline const RodElements& as_rods(const Elements& elements) {
    return static_cast<const RodElements&>(elements);
}

// Elastic strain and curvature of a piece, along and about axis, thin and wide [-], [1/m].
struct RodStrain {
    Vec3 strain, curvature;
};
std::vector<RodStrain> rod_strains(const RodElements& elements, const VecX& x);
// Of a piece's outermost fibre [-].
struct FibreStrain {
    double pull, bend;
    double sum() const { return pull + bend; }
};
FibreStrain fibre_strain(const RodSegment& rod, const RodStrain& strain);
// Sets `yields` of elements that are complete otherwise.
void let_rods_yield(const Model& model, RodElements& elements);

// From a model with chain, sections and organs: `rod` takes the sections as they are, `spring_chain` full cylinders of
// the capsules' own radius, each organ's stiffer in bending as the model says. Where plants stand as modelled, so do
// both.
RodElements make_rod_elements(const Model& model, frond_mechanics which);
// Of `spring_chain`, with other radii, one a chain node [m], and each organ stiffer in bending by a factor; none: by
// nothing.
RodElements make_spring_elements(const Model& model, const std::vector<double>& radii,
                                 const std::vector<double>& stiffer);

}  // namespace frond
