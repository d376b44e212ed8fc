// Strip: a piece of an organ as plants touch it: all points within a radius of its core, a quad in a blade's middle
// plane or a stem's axis. Cores of what has not gone through each other are apart, so that the line between their
// nearest points shows on which side each is, however deep they are pressed into each other.
#pragma once

#include <optional>

#include "collide/hash.hpp"

namespace frond {

struct Strip {
    std::array<int, 4> corners;  // numbers of the core's points: left and right below, left and right above
    int piece;                   // region, as in Collider::tet_piece
    double radius;               // [m]
    bool is_line;                // left and right are one
};

// Corners of a core in their order; of its triangles, 0 1 2 and 3 2 1, one may have no area.
using StripQuad = std::array<Vec3, 4>;
struct StripCore {
    StripQuad at;
    bool is_line;
};

// Returns the box around a core before and after a step, given by the places of all corners, and around it [m].
BoxSet::Bounds box_of_way(const Strip& strip, const Vec3* before, const Vec3* after, double around);

// Nearest points of two cores: their weights of the corners. The normal points from b to a.
struct StripGap {
    double distance;  // [m]; 0 where they cross
    Vec3 normal;
    std::array<double, 4> on_a, on_b;
};
StripGap gap_between(const StripCore& a, const StripCore& b);
// Returns the gap of parts of two cores: of a triangle, 0 or 1, or of a line.
StripGap gap_of_parts(const StripCore& a, int part_a, const StripCore& b, int part_b);
inline int part_count(const StripCore& core) {
    return core.is_line ? 1 : 2;
}
// Returns the corners of a part; of a line the last one twice.
std::array<Vec3, 3> part_of(const StripCore& core, int part);
Vec3 point_on(const StripQuad& core, const std::array<double, 4>& weights);

// First time at which two cores come as near as `near` [m]; their corners move along straight lines at constant speed.
// Nothing where they never do. No such time is missed: it is approached from below. `now`: their gap before the step.
struct StripImpact {
    double time;  // share of the step, 0..1 [-]; 0 where they are as near from the start
    StripGap gap;
};
std::optional<StripImpact> first_impact(const StripCore& a_before, const StripCore& a_after, const StripCore& b_before,
                                        const StripCore& b_after, double near, const StripGap& now);

}  // namespace frond
