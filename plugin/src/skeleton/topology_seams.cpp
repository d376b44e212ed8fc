// Seams: positions at which a file says that two parts are joined, however near others are. They enter the spanning
// tree of joints first; next, of the joints that were found by distance, those within a part or between parts neither
// of which hangs on another by a seam; then those that still connect something.
#include <algorithm>
#include <limits>

#include "core/union_find.hpp"
#include "skeleton/topology_joints.hpp"

namespace frond {

// Finds the point of a part that is nearest to another point, and its triangle.
static void find_nearest(const Topology& topology, const Part& part, const Vec3& to, int& triangle, Vec3& nearest) {
    double least = std::numeric_limits<double>::infinity();
    for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
        const Vec3 point = nearest_in_triangle(corners_of(topology, t), to);
        const double squared = (point - to).squaredNorm();
        if (squared >= least) continue;
        least = squared;
        triangle = t;
        nearest = point;
    }
}

void join_at(const Surface& surface, const std::vector<Seam>& seams, Topology& topology) {
    constexpr int ROUNDS = 8;  // between two parts at most
    UnionFind sets(size_t(topology.component_count));
    std::vector<Joint> joints;
    const auto keep = [&](const Joint& joint) {
        if (sets.join(topology.triangle_component[size_t(joint.triangle_a)],
                      topology.triangle_component[size_t(joint.triangle_b)]))
            joints.push_back(joint);
    };
    for (const Seam& seam : seams) {
        // Alternates between the two parts, from the seam on, until the points are nearest there.
        Joint joint = {-1, -1, seam.point, seam.point};
        for (int round = 0; round < ROUNDS; ++round) {
            find_nearest(topology, surface.parts[size_t(seam.part_a)], joint.point_b, joint.triangle_a, joint.point_a);
            find_nearest(topology, surface.parts[size_t(seam.part_b)], joint.point_a, joint.triangle_b, joint.point_b);
        }
        keep(joint);
    }
    std::vector<int> part_of(topology.triangles.size(), -1);
    for (size_t p = 0; p < surface.parts.size(); ++p)
        std::fill_n(part_of.begin() + surface.parts[p].first_triangle, surface.parts[p].triangle_count, int(p));
    std::vector<char> hangs(surface.parts.size(), 0);
    for (const Seam& seam : seams) hangs[size_t(seam.part_a)] = 1;
    for (const bool any : {false, true})
        for (const Joint& joint : topology.joints) {
            const int a = part_of[size_t(joint.triangle_a)], b = part_of[size_t(joint.triangle_b)];
            if (any || a == b || !(hangs[size_t(a)] || hangs[size_t(b)])) keep(joint);
        }
    topology.joints = std::move(joints);
}

}  // namespace frond
