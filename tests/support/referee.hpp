// FCL as referee of collision tests. In: scenes. Out: its results. Only referee.cpp includes FCL's headers. Absolute
// tolerances inside FCL require scenes with a size of about 1.
#pragma once

#include <vector>

#include "collide/capsule.hpp"

namespace frond::test {

// Returns the distance between the surfaces [m], not above 0 if they touch.
double referee_distance(const Capsule& a, const Capsule& b);
bool referee_overlap(const Capsule& a, const Capsule& b);
double referee_distance(const Capsule& a, const Corners& b);
bool referee_overlap(const Capsule& a, const Corners& b);

struct TriangleMesh {
    std::vector<Vec3> points;  // [m]
    std::vector<Triangle> triangles;
};

// The part of one mesh that is inside another.
struct MeshOverlap {
    int pairs = 0;     // number of pairs of triangles that cross
    double depth = 0;  // largest depth [m]; see deepest_overlap
};

// Finds crossing pairs of triangles by FCL. The depth of a pair is the shortest translation that separates its two
// triangles, and the largest of these counts: near zero if only a corner pokes through, and at most the size of a
// triangle.
MeshOverlap deepest_overlap(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace frond::test
