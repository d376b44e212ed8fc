// Bands: a surface cut by its distance from the root into bands of equal height, and the connected slabs of each band
// (level sets of geodesic distance: Verroust, Lazarus 2000). Triangles are cut exactly where the distance, linear in
// each, crosses from one band to the next, so that coarse meshes give the same slabs as fine ones.
#pragma once

#include "skeleton/topology.hpp"

namespace frond {

// Two triangles that share an edge, and the edge's points.
struct SharedEdge {
    int triangle_a, triangle_b;
    int u, v;
};

// Slab: a connected part of one band, in one component and one group of triangles.
struct Piece {
    int component = 0, band = 0, group = 0;
    int organ = -1;              // organ of most of its area
    double area = 0;             // [m^2]
    Vec3 sum = Vec3::Zero();     // sum of area times position, from Bands::origin [m^3]
    Mat3 square = Mat3::Zero();  // sum of area times position times its transpose [m^4]
    double near, far;            // smallest and largest distance, from the component's start [m]
    Vec3 near_end, far_end;      // positions of its nearest and its farthest end [m]
};

// Two slabs that touch, and where.
struct SlabLink {
    int low, high;               // slabs; across a level line the distance grows from `low` to `high`
    double length = 0;           // [m]
    Vec3 middle = Vec3::Zero();  // [m]
    bool level = false;          // along a level line between two bands; else an edge or a point between groups
};

struct Bands {
    double height;                 // height of a band [m]
    Vec3 origin;                   // [m]
    std::vector<double> distance;  // distance of each point from the root [m]
    std::vector<double> entry;     // component -> distance at which it begins [m]
    // Triangle t has one fragment per band that it passes through: first[t] .. first[t+1]-1, from band first_band[t]
    // upwards.
    std::vector<int> first, first_band;
    std::vector<int> piece;  // fragment -> slab
    std::vector<Piece> pieces;
    std::vector<SlabLink> links;

    // Returns the slab of a triangle at a distance from the start of its component.
    int piece_at(int triangle, double local_distance) const;
};

std::vector<SharedEdge> find_shared_edges(const Topology& topology);
// Computes the length of the shortest path along edges and joints from `roots` to each point [m] (Dijkstra 1959); root
// i starts at the distance start[i] [m]. A part that cannot be reached starts at zero at its lowest point, which is
// added to `roots`.
std::vector<double> measure_distances(const Topology& topology, std::vector<int>& roots,
                                      const std::vector<double>& start = {});
// Estimates how many fragments cut_bands() would make.
double count_fragments(const Topology& topology, const std::vector<double>& distance, double height);
Bands cut_bands(const Topology& topology, const std::vector<SharedEdge>& edges, const std::vector<double>& distance,
                const std::vector<int>& triangle_group, const std::vector<int>& triangle_organ, double height);

}  // namespace frond
