// Nearest points. In: two triangles. Out: the pair of points where they cross, or else where they are nearest. Either
// an edge of one passes through the other, or the nearest points are a corner and a face or lie on two edges (Ericson
// 2005, Real-Time Collision Detection, chapter 5).
#include "surface/triangle_distance.hpp"

#include <algorithm>

namespace frond {

static Vec3 nearest_in_segment(const Vec3& a, const Vec3& b, const Vec3& point) {
    const Vec3 along = b - a;
    const double squared = along.squaredNorm();
    if (!(squared > 0)) return a;
    return a + std::clamp(along.dot(point - a) / squared, 0.0, 1.0) * along;
}

Vec3 nearest_in_triangle(const Corners& triangle, const Vec3& point) {
    const Vec3 &a = triangle[0], &b = triangle[1], &c = triangle[2];
    const Vec3 ab = b - a, ac = c - a, normal = ab.cross(ac);
    const double squared = normal.squaredNorm();
    // The nearest point is on the face, if there is one and the given point projects inside all three edges.
    if (squared > 0) {
        const Vec3 ap = point - a;
        const double weight_b = ap.cross(ac).dot(normal), weight_c = ab.cross(ap).dot(normal);
        if (weight_b >= 0 && weight_c >= 0 && weight_b + weight_c <= squared)
            return a + (weight_b / squared) * ab + (weight_c / squared) * ac;
    }
    Vec3 best = nearest_in_segment(a, b, point);
    for (const Vec3& other : {nearest_in_segment(b, c, point), nearest_in_segment(c, a, point)})
        if ((other - point).squaredNorm() < (best - point).squaredNorm()) best = other;
    return best;
}

NearestPair nearest_of_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
    const Vec3 along_a = a1 - a0, along_b = b1 - b0, between = a0 - b0;
    const double aa = along_a.squaredNorm(), bb = along_b.squaredNorm(), ab = along_a.dot(along_b);
    const double a_between = along_a.dot(between), b_between = along_b.dot(between);
    // The nearest points of the two lines come first; then each is clamped to its segment, which moves the other.
    const double determinant = aa * bb - ab * ab;
    double s = 0;
    if (determinant > 1e-14 * aa * bb) s = std::clamp((ab * b_between - a_between * bb) / determinant, 0.0, 1.0);
    double t = bb > 0 ? (ab * s + b_between) / bb : 0;
    if (t < 0 || t > 1 || !(bb > 0)) {
        t = std::clamp(t, 0.0, 1.0);
        s = aa > 0 ? std::clamp((ab * t - a_between) / aa, 0.0, 1.0) : 0;
    }
    const Vec3 a = a0 + s * along_a, b = b0 + t * along_b;
    return {a, b, (a - b).squaredNorm()};
}

// Finds where a segment passes through a triangle's face, if it does.
static bool crosses(const Vec3& begin, const Vec3& end, const Corners& triangle, Vec3& place) {
    const Vec3 ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0], normal = ab.cross(ac);
    const double squared = normal.squaredNorm();
    if (!(squared > 0)) return false;
    const double before = normal.dot(begin - triangle[0]), after = normal.dot(end - triangle[0]);
    if ((before > 0) == (after > 0) || before == after) return false;
    const Vec3 through = begin + before / (before - after) * (end - begin), offset = through - triangle[0];
    const double weight_b = offset.cross(ac).dot(normal), weight_c = ab.cross(offset).dot(normal);
    if (weight_b < 0 || weight_c < 0 || weight_b + weight_c > squared) return false;
    place = through;
    return true;
}

NearestPair nearest_of_segment_and_triangle(const Vec3& begin, const Vec3& end, const Corners& triangle) {
    Vec3 place;
    if (crosses(begin, end, triangle, place)) return {place, place, 0};
    NearestPair best = nearest_of_segments(begin, end, triangle[0], triangle[1]);
    const auto take = [&best](const NearestPair& pair) {
        if (pair.squared < best.squared) best = pair;
    };
    take(nearest_of_segments(begin, end, triangle[1], triangle[2]));
    take(nearest_of_segments(begin, end, triangle[2], triangle[0]));
    for (const Vec3& tip : {begin, end}) {
        const Vec3 in_triangle = nearest_in_triangle(triangle, tip);
        take({tip, in_triangle, (tip - in_triangle).squaredNorm()});
    }
    return best;
}

bool are_apart(const Corners& a, const Corners& b, const Vec3& direction, double squared) {
    const double a0 = direction.dot(a[0]), a1 = direction.dot(a[1]), a2 = direction.dot(a[2]);
    const double b0 = direction.dot(b[0]), b1 = direction.dot(b[1]), b2 = direction.dot(b[2]);
    const double gap =
        std::max(std::min({b0, b1, b2}) - std::max({a0, a1, a2}), std::min({a0, a1, a2}) - std::max({b0, b1, b2}));
    return gap > 0 && gap * gap > squared * direction.squaredNorm();
}

NearestPair nearest_of_triangles(const Corners& a, const Corners& b) {
    // If they cross, takes the middle of their line of intersection.
    Vec3 sum = Vec3::Zero(), place;
    int count = 0;
    for (size_t k = 0; k < 3; ++k) {
        for (const bool a_through_b : {true, false}) {
            const Corners& through = a_through_b ? a : b;
            if (!crosses(through[k], through[(k + 1) % 3], a_through_b ? b : a, place)) continue;
            sum += place;
            ++count;
        }
    }
    if (count > 0) return {sum / count, sum / count, 0};

    NearestPair best = nearest_of_segments(a[0], a[1], b[0], b[1]);
    const auto take = [&best](const NearestPair& pair) {
        if (pair.squared < best.squared) best = pair;
    };
    for (size_t i = 0; i < 3; ++i)
        for (size_t k = 0; k < 3; ++k) take(nearest_of_segments(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 in_b = nearest_in_triangle(b, a[k]), in_a = nearest_in_triangle(a, b[k]);
        take({a[k], in_b, (a[k] - in_b).squaredNorm()});
        take({in_a, b[k], (in_a - b[k]).squaredNorm()});
    }
    return best;
}

}  // namespace frond
