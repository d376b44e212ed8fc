// Plasticity: what of an element's deformation becomes lasting. The law is that of a section in bending whose material
// is elastic and perfectly plastic: it yields from the rim inwards while its core stays elastic, so what it bears rises
// beyond the first yield and tends to a limit (Nadai 1950, "Theory of flow and fracture of solids"). One number a point
// remembers how far it has come, the strain that was lasting in sum; unloading is elastic.
#pragma once

#include <memory>
#include <vector>

namespace frond {

struct Model;

// When an element yields. Strains are those of the outermost fibre of a rod, or of a tet as in a pulled bar.
struct Yield {
    double strain = 0;  // at which the rim begins to [-]; 0: never
    double creep = 0;   // share of what is elastic beyond that which becomes lasting, a second [1/s]
    double hollow = 0;  // inner over outer radius of a round section [-]
    bool flat = false;  // a sheet
};

// The moment of a section bent by k times the curvature of its first yield, over the moment then: from k below 1,
// to 1.5 of a sheet and 1.70 of a solid round one.
double section_limit(const Yield& yield, double k);

// For an element with elastic strain `strain` [-] after a time h [s]: the share of it that stays elastic, 0 .. 1, and
// `hardening` brought up to date, which is the lasting strain in sum over yield.strain. `bending` is the share of the
// strain that is from bending; what is from pulling has no core that could stay elastic.
double elastic_share(const Yield& yield, double strain, double bending, double h, double& hardening);

// The limits follow from an organ's material and kind; strain is measured as the material's.
Yield yield_of(const Model& model, int organ);
// A plant stands on its materials, whatever they are: no element yields with less than 1.5 times the strain that it
// stands with.
double firm_strain(double yield_strain, double standing);

}  // namespace frond
