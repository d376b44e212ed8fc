// FCL as referee of collision tests: scenes come in, its answers go out. Only referee.cpp sees FCL's headers.
// Absolute tolerances inside FCL ask for scenes of a size of about 1.
#pragma once

#include <vector>

#include "collide/capsule.hpp"

namespace frond::test {

// Distance between the surfaces [m], not above 0 where they touch.
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
    int pairs = 0;     // of triangles that cross
    double depth = 0;  // deepest [m]; see deepest_overlap
};

// Crossing pairs of triangles are found by FCL. Depth is judged pair by pair, as the shortest way by which the two
// triangles of a pair come apart, and the largest of those is taken: of order zero when a corner only pokes through,
// and at most the size of a triangle.
MeshOverlap deepest_overlap(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace frond::test
