// Joints: what holds the components of a soup together.
#pragma once

#include "model/topology.hpp"
#include "model/triangle_distance.hpp"

namespace frond {

inline Corners corners_of(const Topology& topology, int triangle) {
    const Triangle& corner = topology.triangles[size_t(triangle)];
    return {topology.points[size_t(corner[0])], topology.points[size_t(corner[1])], topology.points[size_t(corner[2])]};
}

// Fills the joints of a topology whose triangles and components stand.
void join_components(Topology& topology);

// A place [m] where a part of a surface hangs on another one, whatever else is near.
struct Seam {
    int part_a, part_b;  // what hangs, and on what
    Vec3 point;
};
// Puts joints at seams, in place of those that join the same otherwise. The parts are those of the topology's surface.
void join_at(const Surface& surface, const std::vector<Seam>& seams, Topology& topology);

}  // namespace frond
