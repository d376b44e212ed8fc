// Regions of a plant: connected runs of slabs that are one sheet, one tube or one solid, each a candidate for an organ.
#pragma once

#include "skeleton/organ_slabs.hpp"

namespace frond {

enum class Form { SHEET, TUBE, SOLID };

struct Region {
    Form form = Form::SHEET;
    int parent = -1;  // region that it grows out of; -1 at a root
    int part = -1, component = -1;
    bool same_mesh = false;     // it and its parent are one mesh
    double area = 0;            // [m^2]
    double length = 0;          // along the way from the ground [m]
    double volume = 0;          // enclosed by a solid [m^3]
    double neck = 0;            // radius where a solid grows out of its parent [m]
    Vec3 begin = Vec3::Zero();  // where it grows out of its parent [m]
    Vec3 middle = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  // of a sheet, integral over its area [m^2]
    Eigen::AlignedBox3d box;
    double begin_radius = 0, end_radius = 0;  // of a tube at its two ends [m]
    Vec3 sum = Vec3::Zero();                  // sum of area times position, from Bands::origin [m^3]
    Mat3 square = Mat3::Zero();               // sum of area times position times its transpose [m^4]
    int tubes = 0, sheets = 0, solids = 0;    // regions that grow out of it

    // Returns how many times wider than thick it is, if it is straight.
    double flatness() const;
    double radius() const { return length > 0 ? area / (6.283185307179586 * length) : 0; }
};

struct Regions {
    std::vector<Region> regions;  // parents first
    std::vector<int> region_of;   // by triangle
};

// Returns for each region the one that it is a piece of, or itself: slivers and second faces.
std::vector<int> join_pieces(const std::vector<Region>& regions);
Regions find_regions(const Surface& surface, const Topology& topology);

}  // namespace frond
