// Section: cross-section of a capsule of the chain, and the stiffness and mass that follow from it.
#pragma once

#include <cmath>

#include "core/elementary.hpp"
#include "skeleton/chain.hpp"

namespace frond {

// Forces and moments of a rod are its stiffnesses times the strains along and about `axis`, `thin` and `wide()`:
//   stretch by e        -> force   stretching() e        along axis
//   curvature k         -> moment  bending_thin() k      about wide(): the axis bends towards thin
//   curvature k         -> moment  bending_wide() k      about thin: the axis bends towards wide()
//   twist by a per metre -> moment twisting() a          about axis
// A section may taper: its sizes change linearly along the capsule. Its numbers are those in the middle, and the
// stiffnesses those by which the whole capsule yields, as integrals of 1/EA, 1/EI and 1/GJ along it.
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
    double taper = 0;     // sizes at the capsule's begin and end are 1 - taper and 1 + taper times those above [-]

    Vec3 wide() const { return axis.cross(thin); }
    double stretching() const { return young * area * narrowing(); }             // EA [N]
    double bending_thin() const { return young * inertia_thin * resistance(); }  // EI [N m^2]
    double bending_wide() const { return young * inertia_wide * resistance(); }  // EI [N m^2]
    double twisting() const { return shear * torsion * resistance(); }           // GJ [N m^2]
    // Returns the stiffness against tilt that bends the capsule like an S, over bending_*() [1/m^2].
    double tilting_per_bending() const { return 12 / (length * length) * frond::pow(filling() / narrowing(), 2); }
    // Returns where a force across does not turn the ends against each other, as a share of the length from the begin.
    double elastic_centre() const { return 0.5 - 2 * taper / (3 + taper * taper); }
    double mass() const { return density * area * filling(); }  // per length, the mean [kg/m]
    // Returns the shares of mass() and of rotary_inertia() that belong to the end, so that their centres are right.
    double mass_at_end() const { return 0.5 + taper / (3 * filling()); }
    // Returns the mean squared distance of its mass from their centre along the capsule, over the length's square.
    double mass_spread() const {
        return (1.0 / 12 + taper * taper / 20) / filling() - frond::pow(mass_at_end() - 0.5, 2);
    }
    double inertia_at_end() const { return 0.5 + taper * (2.0 / 3 + 0.4 * taper * taper) / fourth_power(); }
    // Returns the mean rotary inertia per length about axis, thin and wide() [kg m].
    Vec3 rotary_inertia() const {
        return density * fourth_power() * Vec3(inertia_thin + inertia_wide, inertia_wide, inertia_thin);
    }

private:
    // Means along the capsule of powers of its size over that in the middle: 2, 4, and the inverses of -2 and -4.
    double filling() const { return 1 + taper * taper / 3; }
    double fourth_power() const { return 1 + taper * taper * (2 + taper * taper / 5); }
    double narrowing() const { return 1 - taper * taper; }
    double resistance() const { return frond::pow(narrowing(), 3) / filling(); }
};

// Largest taper of a section: a pointed end counts as one of a nineteenth of the other end's size, as a point would
// bend without resistance.
constexpr double LARGEST_TAPER = 0.9;

// Measures the section of the capsule between each chain node and its parent, from the surface that belongs to it.
// Blades and flowers are sheets of their material's thickness, or as thick as their two faces are apart, and may be
// bowed; everything else is solid, or a tube if its material is hollow.
std::vector<Section> measure_sections(const Surface& surface, const Topology& topology,
                                      const std::vector<Organ>& organs, const Chain& chain);

// Completes a section from its outline (axis to inertia_wide, taper): sizes, the hole, torsion and the material's
// constants.
void finish_section(const Organ& organ, Section& section);

// Returns the share of an organ's outline that is a hole [-]: hollow squared; 0 for blades and flowers.
double hole_share(const Organ& organ);
// Returns the share of a sheet's face that is there, as textures cut out the rest [-]; 1 for what is no sheet.
double seen_share(const Organ& organ);

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

// What a chain of stems was made of, kept so that it can be made anew with capsules of another length.
struct StemSource {
    std::vector<frond_stem> stems;             // as the caller gave them; empty: the chain is not made of stems
    std::vector<frond_stem_section> sections;  // their own sections; empty: they have none
    StemPlacement placed;
    double radius = 0;  // as ChainOptions::radius [m]
};

// Makes the chain of a tree of stems, whose capsules lie on the stems' axes from end to end, and its sections. The
// surface is that of surface_from_stems(), placed and with organs; its parts are named "stem_<index>". Stems of which
// are_capsules is true are one capsule each, others two at least; empty: none is. `own`: their own sections, if any.
Chain make_chain_of_stems(const frond_stem* stems, int stem_count, const Surface& surface, const StemPlacement& placed,
                          const std::vector<Organ>& organs, const ChainOptions& options, std::vector<Section>& sections,
                          const std::vector<uint8_t>& are_capsules = {}, const frond_stem_section* own = nullptr);
// Throws BAD_ARGUMENT for a section that cannot be.
void check_stem_sections(const frond_stem_section* sections, int stem_count);

}  // namespace frond
