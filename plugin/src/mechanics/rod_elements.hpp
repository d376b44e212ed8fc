// Rods: the capsules of the chain as beams between nodes that move and rotate. Node i of the chain is two nodes of the
// mechanics: 2i, its position, and 2i+1, its rotation from the modelled shape as a rotation vector.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// A beam from chain node a to b. Its frame has the columns axis, thin, wide: it bends most easily towards `thin`.
struct RodSegment {
    int a, b;             // chain nodes, a < b
    bool closes_loop;     // see ChainLoop; the others are a forest, each node the second of one at most
    double length;        // length at rest [m]
    Mat3 frame;           // axis, thin and wide in the modelled shape
    Vec3 stretch;         // stiffness against stretch and against shear towards thin and wide [N]
    Vec3 bend;            // stiffness against twist and against bending about thin and wide [N m^2]
    double centre;        // elastic centre from the middle towards b [m]; only taper moves it
    double warping;       // growth of twist stiffness by the square of twist, see measure_twist() [m^2]
    Vec3 rest_strain;     // stretch and tilt without load; (1, 0, 0) for a straight segment at its own length [-]
    Vec3 rest_curvature;  // elastic twist and curvature without load, relative to the modelled shape [1/m]
    Vec3 set_curvature;   // plastic ones; there is no plastic twist [1/m]
    double set_w;         // quaternion of half the rotation between its ends by set_curvature
    Vec3 set_p;
    double shared_mass;             // mass between its nodes, taken from either [kg]
    double reach_thin, reach_wide;  // distances of the outermost fibres from the axis, towards thin and wide [m]
    std::array<int, 16> slots;      // blocks of the nodes 2a, 2a+1, 2b, 2b+1 in a BlockMatrix of the pattern
};

// Sets set_curvature and what follows from it [1/m].
void give_set(RodSegment& rod, const Vec3& curvature);

struct RodElements : Elements {
    std::vector<RodSegment> segments;
    std::vector<double> mass;       // one a chain node [kg]
    std::vector<Mat3> inertia;      // rotary, one a chain node, in the modelled shape [kg m^2]
    std::vector<int> root;          // of each chain node: the first node that segments lead to it from, or itself
    std::vector<double> hardening;  // see elastic_share(); one a segment, empty unless the plant has yielded
};

// Sets `root` from the segments.
void find_roots(RodElements& elements);

inline const RodElements& as_rods(const Elements& elements) {
    return static_cast<const RodElements&>(elements);
}

// Elastic strain and curvature of a segment, along and about axis, thin and wide [-], [1/m].
struct RodStrain {
    Vec3 strain, curvature;
};
std::vector<RodStrain> rod_strains(const RodElements& elements, const VecX& x);
// Strain of a segment's outermost fibre, by axial load and by bending [-].
struct FibreStrain {
    double pull, bend;
    double sum() const { return pull + bend; }
};
FibreStrain fibre_strain(const RodSegment& rod, const RodStrain& strain);
// Force and moment in the middle of a segment, of what is beyond it on what is before it [N], [N m], and its directions
// along the chord and towards its thin side.
struct RodSectionForce {
    Vec3 force, moment, axis, thin;
};
std::vector<RodSectionForce> rod_section_forces(const RodElements& elements, const VecX& x);
// Sets `yields` of elements that are otherwise complete.
void let_rods_yield(const Model& model, RodElements& elements);

// Makes elements from a model with chain, sections and organs: `rod` has the true sections, `spring_chain` full
// cylinders of the capsules' radius, with the model's bending factor of each organ. Both stand as modelled if plants
// do.
RodElements make_rod_elements(const Model& model, frond_mechanics which);
// Makes `spring_chain` with other radii, one a chain node [m], and a factor on each organ's bending; empty: none.
RodElements make_spring_elements(const Model& model, const std::vector<double>& radii,
                                 const std::vector<double>& stiffer);

}  // namespace frond
