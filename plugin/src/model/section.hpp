// Section: what a capsule of the chain looks like when it is cut across: the sizes that decide how an organ bends.
#pragma once

#include "model/chain.hpp"

namespace frond {

struct Section {
    Vec3 axis;            // along the capsule, length one
    Vec3 thin;            // across it, where it is thinnest, length one
    double length;        // of the capsule [m]
    double area;          // of tissue [m^2]
    double inertia_thin;  // second moment against bending towards `thin` [m^4]
    double inertia_wide;  // against bending the other way [m^4]
    double inertia_polar() const { return inertia_thin + inertia_wide; }
};

// One a chain node, for the capsule between it and its parent; from the surface that belongs to it. Blades and flowers
// are sheets as thick as their material says, whose bow counts; everything else is solid.
std::vector<Section> measure_sections(const Surface& surface, const std::vector<Organ>& organs, const Chain& chain);

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
                          const ChainOptions& options, std::vector<Section>& sections);

}  // namespace frond
