// Bands: a surface cut along its distance from the root into slices of one height, and the pieces that each slice falls
// into (level sets of geodesic distance: Verroust, Lazarus 2000). Triangles are cut exactly where the distance, linear
// in each, crosses from one band to the next, so that coarse meshes give the same pieces as fine ones.
#pragma once

#include "model/topology.hpp"

namespace frond {

// Two triangles that share an edge, by points.
struct SharedEdge {
    int triangle_a, triangle_b;
    int u, v;
};

// A connected part of one band of one component, of one group of triangles.
struct Piece {
    int component = 0, band = 0, group = 0;
    int organ = -1;              // that most of it belongs to
    double area = 0;             // [m^2]
    Vec3 sum = Vec3::Zero();     // of area times place [m^3], places from Bands::origin
    Mat3 square = Mat3::Zero();  // of area times place times place transposed [m^4]
    double near, far;            // smallest and largest distance from where its component begins [m]
    Vec3 near_end, far_end;      // where it is nearest and farthest [m]
};

// Two pieces that touch.
struct Contact {
    int low, high;               // pieces; in `high` the distance goes on when the contact is level
    double length = 0;           // [m]
    Vec3 middle = Vec3::Zero();  // [m]
    bool level = false;          // a level line between two bands; else an edge or a point between groups
};

struct Bands {
    double height;                 // of a band [m]
    Vec3 origin;                   // [m]
    std::vector<double> distance;  // of each point from the root [m]
    std::vector<double> entry;     // component -> distance where it begins [m]
    // Triangle t has one fragment a band that it passes through: first[t] .. first[t+1]-1, from band first_band[t]
    // upward.
    std::vector<int> first, first_band;
    std::vector<int> piece;  // fragment -> piece
    std::vector<Piece> pieces;
    std::vector<Contact> contacts;

    // The piece of a triangle at a distance from where its component begins.
    int piece_at(int triangle, double local_distance) const;
};

std::vector<SharedEdge> find_shared_edges(const Topology& topology);
// Shortest way along edges and joints to each point from the nearest of `roots`, which have a way of `start` behind
// them already [m] (Dijkstra 1959). A part that cannot be reached starts anew at its lowest point, which is added to
// `roots`.
std::vector<double> measure_distances(const Topology& topology, std::vector<int>& roots,
                                      const std::vector<double>& start = {});
// How many fragments cut_bands() would make.
double count_fragments(const Topology& topology, const std::vector<double>& distance, double height);
Bands cut_bands(const Topology& topology, const std::vector<SharedEdge>& edges, const std::vector<double>& distance,
                const std::vector<int>& triangle_group, const std::vector<int>& triangle_organ, double height);

}  // namespace frond
