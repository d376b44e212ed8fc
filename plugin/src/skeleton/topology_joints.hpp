// Joints: connections between the components of a triangle soup.
#pragma once

#include "skeleton/topology.hpp"
#include "surface/triangle_distance.hpp"

namespace frond {

inline Corners corners_of(const Topology& topology, int triangle) {
    const Triangle& corner = topology.triangles[size_t(triangle)];
    return {topology.points[size_t(corner[0])], topology.points[size_t(corner[1])], topology.points[size_t(corner[2])]};
}

// Fills the joints of a topology whose triangles and components are known.
void join_components(Topology& topology);

// A position [m] where a part of a surface hangs on another one, whatever else is near.
struct Seam {
    int part_a, part_b;  // the part that hangs, and the part that it hangs on
    Vec3 point;
};
// Puts joints at seams, in place of joints that connect the same components elsewhere. The parts are those of the
// topology's surface.
void join_at(const Surface& surface, const std::vector<Seam>& seams, Topology& topology);

}  // namespace frond
