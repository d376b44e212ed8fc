// In: two cores. Out: their nearest points.
#include <algorithm>
#include <cmath>

#include "collide/strip.hpp"
#include "surface/triangle_distance.hpp"

namespace frond {

BoxSet::Bounds box_of_way(const Strip& strip, const Vec3* before, const Vec3* after, double around) {
    BoxSet::Bounds box = BoxSet::none();
    for (const Vec3* places : {before, after})
        for (const int corner : strip.corners) {
            const double* p = places[corner].data();
            for (int k = 0; k < 3; ++k) {
                box.lower[k] = std::min(box.lower[k], p[k] - around);
                box.upper[k] = std::max(box.upper[k], p[k] + around);
            }
        }
    return box;
}

using Weights = std::array<double, 4>;

constexpr int TRIANGLES[2][3] = {{0, 1, 2}, {3, 2, 1}};

static Corners triangle_of(const StripCore& core, int triangle) {
    const auto& corners = TRIANGLES[triangle];
    return {core.at[size_t(corners[0])], core.at[size_t(corners[1])], core.at[size_t(corners[2])]};
}

// Returns the weights of a point on the line from corner 0 to corner 2.
static Weights weights_on_line(const StripCore& core, const Vec3& p) {
    const Vec3 along = core.at[2] - core.at[0];
    const double square = along.squaredNorm();
    const double share = square > 0 ? std::clamp((p - core.at[0]).dot(along) / square, 0.0, 1.0) : 0.0;
    return {1 - share, 0, share, 0};
}

static Weights weights_in_triangle(const StripCore& core, int triangle, const Vec3& p) {
    const Corners t = triangle_of(core, triangle);
    const Vec3 u = t[1] - t[0], v = t[2] - t[0], normal = u.cross(v), to = p - t[0];
    const double square = normal.squaredNorm();
    Weights weights = {0, 0, 0, 0};
    if (!(square > 0)) {
        // Without area: the nearest corner, as good as any on so small a piece.
        size_t nearest = 0;
        for (size_t k = 1; k < 3; ++k)
            if ((t[k] - p).squaredNorm() < (t[nearest] - p).squaredNorm()) nearest = k;
        weights[size_t(TRIANGLES[triangle][nearest])] = 1;
        return weights;
    }
    const double by_u = std::clamp(to.cross(v).dot(normal) / square, 0.0, 1.0);
    const double by_v = std::clamp(u.cross(to).dot(normal) / square, 0.0, 1.0 - by_u);
    weights[size_t(TRIANGLES[triangle][0])] = 1 - by_u - by_v;
    weights[size_t(TRIANGLES[triangle][1])] = by_u;
    weights[size_t(TRIANGLES[triangle][2])] = by_v;
    return weights;
}

// Returns the nearest points of parts of two cores: a line, or one of the triangles.
static NearestPair nearest_of_parts(const StripCore& a, int part_a, const StripCore& b, int part_b) {
    if (a.is_line && b.is_line) return nearest_of_segments(a.at[0], a.at[2], b.at[0], b.at[2]);
    if (a.is_line) return nearest_of_segment_and_triangle(a.at[0], a.at[2], triangle_of(b, part_b));
    if (b.is_line) {
        const NearestPair pair = nearest_of_segment_and_triangle(b.at[0], b.at[2], triangle_of(a, part_a));
        return {pair.b, pair.a, pair.squared};
    }
    return nearest_of_triangles(triangle_of(a, part_a), triangle_of(b, part_b));
}

static Weights weights_of(const StripCore& core, int part, const Vec3& p) {
    return core.is_line ? weights_on_line(core, p) : weights_in_triangle(core, part, p);
}

Vec3 point_on(const StripQuad& core, const std::array<double, 4>& weights) {
    return weights[0] * core[0] + weights[1] * core[1] + weights[2] * core[2] + weights[3] * core[3];
}

std::array<Vec3, 3> part_of(const StripCore& core, int part) {
    return core.is_line ? std::array<Vec3, 3>{core.at[0], core.at[2], core.at[2]} : triangle_of(core, part);
}

static StripGap gap_of(const NearestPair& nearest, const StripCore& a, int part_a, const StripCore& b, int part_b) {
    StripGap gap;
    gap.distance = std::sqrt(nearest.squared);
    gap.normal = gap.distance > 0 ? Vec3((nearest.a - nearest.b) / gap.distance) : Vec3(Vec3::UnitY());
    gap.on_a = weights_of(a, part_a, nearest.a);
    gap.on_b = weights_of(b, part_b, nearest.b);
    return gap;
}

StripGap gap_of_parts(const StripCore& a, int part_a, const StripCore& b, int part_b) {
    return gap_of(nearest_of_parts(a, part_a, b, part_b), a, part_a, b, part_b);
}

StripGap gap_between(const StripCore& a, const StripCore& b) {
    NearestPair nearest = {};
    std::array<int, 2> parts = {0, 0};
    nearest.squared = INFINITY;
    for (int i = 0; i < part_count(a); ++i)
        for (int k = 0; k < part_count(b); ++k) {
            // Most parts are farther apart than the nearest so far along the line between its points.
            if (i + k > 0 && are_apart(part_of(a, i), part_of(b, k), nearest.a - nearest.b, nearest.squared)) continue;
            const NearestPair pair = nearest_of_parts(a, i, b, k);
            if (!(pair.squared < nearest.squared)) continue;
            nearest = pair;
            parts = {i, k};
        }
    return gap_of(nearest, a, parts[0], b, parts[1]);
}

}  // namespace frond
