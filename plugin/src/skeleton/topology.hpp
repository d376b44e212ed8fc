// Topology: which triangles of a soup are connected. Vertices at the same position are one point; points that share
// triangles are one component; components that do not touch are joined where they are nearest, so that the whole plant
// is connected. Chain and cage are both built on it.
#pragma once

#include "surface/surface.hpp"

namespace frond {

// Two components held together at one point each: the nearest points of a pair of triangles.
struct Joint {
    int triangle_a, triangle_b;
    Vec3 point_a, point_b;  // equal when the surfaces cross or touch [m]
};

struct Topology {
    std::vector<Vec3> points;         // welded positions
    std::vector<int> vertex_point;    // surface vertex -> point
    std::vector<Triangle> triangles;  // surface triangles by point (a corner may repeat after welding)
    std::vector<int> triangle_component;
    std::vector<char> turned;  // for each triangle whether it is drawn the other way round than most of its neighbours
    int component_count = 0;
    std::vector<Joint> joints;  // a spanning tree over the components, roots (lowest parts) tied last
};

Topology make_topology(const Surface& surface);

}  // namespace frond
