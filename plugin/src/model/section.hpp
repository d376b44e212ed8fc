// Section: what a capsule of the chain looks like when it is cut across, and how stiff and heavy that makes it.
#pragma once

#include "model/chain.hpp"

namespace frond {

// Forces and moments of a rod are the products of the strains along and about `axis`, `thin` and `wide()`:
//   stretch by e        -> pull    stretching() e        along axis
//   curvature k         -> moment  bending_thin() k      about wide(): the axis bends towards thin
//   curvature k         -> moment  bending_wide() k      about thin: the axis bends towards wide()
//   twist by a per metre -> moment twisting() a          about axis
struct Section {
    Vec3 axis;            // along the capsule, length one
    Vec3 thin;            // across it, where it is thinnest, length one
    double length;        // of the capsule [m]
    double area;          // of tissue: a tube's is its wall's [m^2]
    double inertia_thin;  // second moment against bending towards `thin` [m^4]
    double inertia_wide;  // against bending the other way [m^4]
    double torsion;       // constant J: twisting moment = G J times twist per length [m^4]
    double thickness;     // outer size along `thin`: of the sheet, or of the ellipse or rectangle alike [m]
    double width;         // outer size across that; of a sheet as if it were laid flat [m]
    double density;       // of the tissue [kg/m^3]
    double young;         // along the axis [Pa]
    double shear;         // modulus G that goes with `torsion` [Pa]

    Vec3 wide() const { return axis.cross(thin); }
    double stretching() const { return young * area; }            // EA [N]
    double bending_thin() const { return young * inertia_thin; }  // EI [N m^2]
    double bending_wide() const { return young * inertia_wide; }  // EI [N m^2]
    double twisting() const { return shear * torsion; }           // GJ [N m^2]
    double mass() const { return density * area; }                // a metre [kg/m]
    // Rotary inertia a metre about axis, thin and wide() [kg m].
    Vec3 rotary_inertia() const { return density * Vec3(inertia_thin + inertia_wide, inertia_wide, inertia_thin); }
};

// One a chain node, for the capsule between it and its parent; from the surface that belongs to it. Blades and flowers
// are sheets as thick as their material says, whose bow counts; everything else is solid, or a tube if its material is
// hollow.
std::vector<Section> measure_sections(const Surface& surface, const Topology& topology,
                                      const std::vector<Organ>& organs, const Chain& chain);

// From the outline, axis to inertia_wide, to the organ: sizes, the hole, torsion and the material's constants.
void finish_section(const Organ& organ, Section& section);

// Blades and flowers.
bool is_sheet(const Organ& organ);

// Share of an organ's outline that is a hole [-]: hollow squared; 0 for blades and flowers.
double hole_share(const Organ& organ);

// Saint-Venant's torsion constant of one compact outline from its area and principal second moments [m^4]: exact for
// ellipses and rectangles of any aspect, within 6 % for an equilateral triangle; never more than the polar moment.
double torsion_constant(double area, double inertia_thin, double inertia_wide);
// The torsion constant of a rectangle: Saint-Venant's series; w t^3 / 3 for a thin strip [m^4].
double strip_torsion_constant(double width, double thickness);

// How stems given by a caller were moved with the surface made of them.
struct StemPlacement {
    Mat3 turn = Mat3::Identity();
    double scale = 1;
    Vec3 shift = Vec3::Zero();  // [m]
    Vec3 image(const Vec3& p) const { return scale * (turn * p) + shift; }
};

// The chain of a tree of stems, whose capsules lie on the stems' axes from end to end, and their sections. The surface
// is that of surface_from_stems(), placed, its organs found: parts are named "stem_<index>".
Chain make_chain_of_stems(const frond_stem* stems, int stem_count, const Surface& surface, const StemPlacement& placed,
                          const std::vector<Organ>& organs, const ChainOptions& options,
                          std::vector<Section>& sections);

}  // namespace frond
