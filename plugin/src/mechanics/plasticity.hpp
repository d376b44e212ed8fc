// Plasticity: how much of an element's deformation becomes plastic. The law is that of a section in bending with
// elastic, perfectly plastic material: it yields from the rim inwards while its core stays elastic, so its moment rises
// beyond the first yield and tends to a limit (Nadai 1950, "Theory of flow and fracture of solids"). The state is one
// number a point, the accumulated plastic strain; unloading is elastic.
#pragma once

#include <memory>
#include <vector>

namespace frond {

struct Model;

// Yield limits of an element. Strains are those of a rod's outermost fibre, or of a tet as in a pulled bar.
struct Yield {
    double strain = 0;  // strain at which the rim yields [-]; 0: never
    double creep = 0;   // rate at which elastic strain beyond that becomes plastic [1/s]
    double hollow = 0;  // inner over outer radius of a round section [-]
    bool flat = false;  // a sheet
};

// Smallest share of a flow that is tried where the whole of it would go too far or give energy [-].
constexpr double LEAST_FLOW = 0.1;

// Returns the moment of a section at k times the curvature of its first yield, over the moment at first yield: k up to
// 1, then rising to 1.5 for a sheet and 1.70 for a solid round section.
double section_limit(const Yield& yield, double k);

// Returns the share, 0 .. 1, of an element's elastic strain `strain` [-] that stays elastic after a time h [s], and
// updates `hardening`, the accumulated plastic strain over yield.strain.
double elastic_share(const Yield& yield, double strain, double h, double& hardening);

// Returns the limits of an organ, by its material and kind; the strain is the material's.
Yield yield_of(const Model& model, int organ);
// Returns the yield strain, but at least 1.5 times the strain in which the plant stands, whatever its materials.
double firm_strain(double yield_strain, double standing);

}  // namespace frond
