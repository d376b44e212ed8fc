// Gaps of two capsules, or of a capsule and a triangle: shapes come in; distance, normal and nearest points go out. The
// nearest points of the axes distinguish sides from ends (Ericson 2005, Real-Time Collision Detection, chapter 5).
#include <algorithm>

#include "collide/capsule.hpp"

namespace frond {

static Vec3 any_normal_to(const Vec3& direction) {
    int least;
    direction.cwiseAbs().minCoeff(&least);
    const Vec3 normal = direction.cross(Vec3::Unit(least));
    return normal.squaredNorm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitY());
}

Gap gap_between(const Capsule& a, const Capsule& b) {
    const NearestPair pair = nearest_of_segments(a.begin, a.end, b.begin, b.end);
    const double distance = std::sqrt(pair.squared);
    Gap gap = {distance - a.radius - b.radius, (pair.a - pair.b) / distance, pair.a, pair.b};
    if (!(distance > 0)) {
        // The axes touch: the exit is perpendicular to both.
        const Vec3 along_a = a.end - a.begin, along_b = b.end - b.begin, across = along_a.cross(along_b);
        const bool parallel = across.squaredNorm() <= 1e-20 * along_a.squaredNorm() * along_b.squaredNorm();
        const Vec3& longer = along_a.squaredNorm() > along_b.squaredNorm() ? along_a : along_b;
        gap.normal = parallel ? any_normal_to(longer) : Vec3(across.normalized());
    }
    return gap;
}

Gap gap_between(const Capsule& a, const Corners& b) {
    const NearestPair pair = nearest_of_segment_and_triangle(a.begin, a.end, b);
    const double distance = std::sqrt(pair.squared);
    Gap gap = {distance - a.radius, (pair.a - pair.b) / distance, pair.a, pair.b};
    if (!(distance > 0)) {
        // The axis passes through the face: the exit is on the side on which less of it has to be moved.
        const Vec3 across = (b[1] - b[0]).cross(b[2] - b[0]);
        const double area = across.norm();
        gap.normal = area > 0 ? Vec3(across / area) : any_normal_to(a.end - a.begin);
        const double at_begin = gap.normal.dot(a.begin - pair.b), at_end = gap.normal.dot(a.end - pair.b);
        const double below = -std::min({at_begin, at_end, 0.0}), above = std::max({at_begin, at_end, 0.0});
        if (above < below) gap.normal = -gap.normal;
        gap.distance = -a.radius - (area > 0 ? std::min(below, above) : 0);
    }
    return gap;
}

}  // namespace frond
