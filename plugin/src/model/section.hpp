// Section: cross-section of a capsule of the chain, and the stiffness and mass that follow from it.
#pragma once

#include "model/chain.hpp"

namespace frond {

// Forces and moments of a rod are its stiffnesses times the strains along and about `axis`, `thin` and `wide()`:
//   stretch by e        -> force   stretching() e        along axis
//   curvature k         -> moment  bending_thin() k      about wide(): the axis bends towards thin
//   curvature k         -> moment  bending_wide() k      about thin: the axis bends towards wide()
//   twist by a per metre -> moment twisting() a          about axis
struct Section {
    Vec3 axis;            // along the capsule, unit length
    Vec3 thin;            // across it, where it is thinnest, unit length
    double length;        // length of the capsule [m]
    double area;          // area of tissue; for a tube, of its wall [m^2]
    double inertia_thin;  // second moment against bending towards `thin` [m^4]
    double inertia_wide;  // second moment against bending towards wide() [m^4]
    double torsion;       // constant J: twisting moment = G J times twist per length [m^4]
    double thickness;     // outer size along `thin`: of the sheet, or of an equal ellipse or rectangle [m]
    double width;         // outer size along wide(); of a sheet as if it were laid flat [m]
    double density;       // density of the tissue [kg/m^3]
    double young;         // Young's modulus along the axis [Pa]
    double shear;         // shear modulus G that goes with `torsion` [Pa]

    Vec3 wide() const { return axis.cross(thin); }
    double stretching() const { return young * area; }            // EA [N]
    double bending_thin() const { return young * inertia_thin; }  // EI [N m^2]
    double bending_wide() const { return young * inertia_wide; }  // EI [N m^2]
    double twisting() const { return shear * torsion; }           // GJ [N m^2]
    double mass() const { return density * area; }                // per length [kg/m]
    // Returns the rotary inertia per length about axis, thin and wide() [kg m].
    Vec3 rotary_inertia() const { return density * Vec3(inertia_thin + inertia_wide, inertia_wide, inertia_thin); }
};

// Measures the section of the capsule between each chain node and its parent, from the surface that belongs to it.
// Blades and flowers are sheets of their material's thickness, or as thick as their two faces are apart, and may be
// bowed; everything else is solid, or a tube if its material is hollow.
std::vector<Section> measure_sections(const Surface& surface, const Topology& topology,
                                      const std::vector<Organ>& organs, const Chain& chain);

// Completes a section from its outline (axis to inertia_wide): sizes, the hole, torsion and the material's constants.
void finish_section(const Organ& organ, Section& section);

// Returns whether an organ is a sheet: a blade or a flower.
bool is_sheet(const Organ& organ);

// Returns the share of an organ's outline that is a hole [-]: hollow squared; 0 for blades and flowers.
double hole_share(const Organ& organ);

// Computes Saint-Venant's torsion constant of one compact outline from its area and principal second moments [m^4]:
// exact for ellipses and rectangles of any aspect, within 6 % for an equilateral triangle; never more than the polar
// moment.
double torsion_constant(double area, double inertia_thin, double inertia_wide);
// Computes the torsion constant of a rectangle by Saint-Venant's series; w t^3 / 3 for a thin strip [m^4].
double strip_torsion_constant(double width, double thickness);

// Transform by which the caller's stems were moved with the surface made of them.
struct StemPlacement {
    Mat3 turn = Mat3::Identity();
    double scale = 1;
    Vec3 shift = Vec3::Zero();  // [m]
    Vec3 image(const Vec3& p) const { return scale * (turn * p) + shift; }
};

// Makes the chain of a tree of stems, whose capsules lie on the stems' axes from end to end, and its sections. The
// surface is that of surface_from_stems(), placed and with organs; its parts are named "stem_<index>". Stems of which
// are_capsules is true are one capsule each, others two at least; empty: none is.
Chain make_chain_of_stems(const frond_stem* stems, int stem_count, const Surface& surface, const StemPlacement& placed,
                          const std::vector<Organ>& organs, const ChainOptions& options, std::vector<Section>& sections,
                          const std::vector<uint8_t>& are_capsules = {});

}  // namespace frond
