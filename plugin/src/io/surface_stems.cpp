// Makes the surface of a tree of stems. In: tapered straight stems. Out: tubes with rounded ends, one part per stem.
// The round end of a stem reaches into the next one, so that forks and bends look joined.
#include <algorithm>
#include <cmath>

#include "core/convert.hpp"
#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "io/import.hpp"

namespace frond {

// Corners of a ring, rings of a half sphere and at most of a cone, and stems of a plant.
static constexpr int SIDES = 10, CAP_RINGS = 3, MOST_RINGS = 48, MOST_STEMS = 100000;

static void check_stems(const frond_stem* stems, int stem_count) {
    if (!stems) fail(FROND_RESULT_BAD_ARGUMENT, "stems must not be null");
    if (stem_count < 1 || stem_count > MOST_STEMS)
        fail(FROND_RESULT_BAD_ARGUMENT, "stem_count is %d; it must be 1..%d", stem_count, MOST_STEMS);
    for (int i = 0; i < stem_count; ++i) {
        const frond_stem& stem = stems[i];
        const Vec3 begin = to_vec(stem.begin), end = to_vec(stem.end);
        if (stem.parent < -1 || stem.parent >= i)
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "stem %d has parent %d; it must be an earlier stem (0..%d), or -1 for a root", i, stem.parent, i - 1);
        if (!begin.allFinite() || !end.allFinite() || begin.cwiseAbs().maxCoeff() > 1e6 ||
            end.cwiseAbs().maxCoeff() > 1e6)
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "stem %d has an end that is not finite or farther than 1e6 m from the origin", i);
        for (double radius : {stem.radius_begin, stem.radius_end})
            if (!(radius > 0 && radius < 1e6))
                fail(FROND_RESULT_BAD_ARGUMENT, "stem %d has radius %g m; it must be positive", i, radius);
        if (!((end - begin).norm() > 1e-9))
            fail(FROND_RESULT_BAD_ARGUMENT, "stem %d has no length; its begin and end must differ", i);
    }
}

static double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const double along = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (point - (a + along * (b - a))).norm();
}

// Warns of stems that begin in the air. The cage ties them to the plant across the gap.
static void warn_of_gaps(const frond_stem* stems, int stem_count) {
    int gaps = 0, first = -1;
    for (int i = 0; i < stem_count; ++i) {
        if (stems[i].parent < 0) continue;
        const frond_stem& parent = stems[stems[i].parent];
        const double reach = std::max(parent.radius_begin, parent.radius_end) + stems[i].radius_begin;
        const double gap =
            distance_to_segment(to_vec(stems[i].begin), to_vec(parent.begin), to_vec(parent.end)) - reach;
        if (gap <= 0) continue;
        if (gaps++ == 0) first = i;
    }
    if (gaps > 0) warn("%d stems do not touch their parents, the first is stem %d", gaps, first);
}

// A circle of the tube: its position along the axis, and its radius [m].
struct Ring {
    double along, radius;
};

// Lists rings from pole to pole, without the poles: the half sphere at the begin, the cone, the half sphere at the end.
static std::vector<Ring> rings_of(const frond_stem& stem, double length) {
    std::vector<Ring> rings;
    for (int k = CAP_RINGS - 1; k > 0; --k) {
        const double angle = 0.5 * PI * k / CAP_RINGS;
        rings.push_back({-stem.radius_begin * frond::sin(angle), stem.radius_begin * frond::cos(angle)});
    }
    const double wide = std::max(stem.radius_begin, stem.radius_end);
    const int pieces = std::clamp(int(std::ceil(length / (2 * wide))), 1, MOST_RINGS);
    for (int k = 0; k <= pieces; ++k) {
        const double share = double(k) / pieces;
        rings.push_back({length * share, stem.radius_begin + share * (stem.radius_end - stem.radius_begin)});
    }
    for (int k = 1; k < CAP_RINGS; ++k) {
        const double angle = 0.5 * PI * k / CAP_RINGS;
        rings.push_back({length + stem.radius_end * frond::sin(angle), stem.radius_end * frond::cos(angle)});
    }
    return rings;
}

// Returns the corner radius of a prism of SIDES sides that bends as the round stem does: its corners lie a little
// outside the circle, so that the mean squared distance of its faces from the axis is the circle's.
static double corner_radius(double radius) {
    const double sine = frond::sin(PI / SIDES);
    return radius / std::sqrt(1 - 2.0 / 3 * sine * sine);
}

static void add_stem(Surface& surface, const frond_stem& stem, int index) {
    const Vec3 begin = to_vec(stem.begin), end = to_vec(stem.end);
    const double length = (end - begin).norm();
    const Vec3 axis = (end - begin) / length, side = axis.unitOrthogonal(), depth = axis.cross(side);
    const std::vector<Ring> rings = rings_of(stem, length);
    Part part;
    part.name = "stem_" + std::to_string(index);
    part.material = "stem";
    part.first_triangle = int(surface.triangles.size());

    // Pole, rings, pole.
    const int first = int(surface.positions.size()), last = first + 1 + SIDES * int(rings.size());
    surface.positions.push_back(begin - axis * stem.radius_begin);
    for (const Ring& ring : rings)
        for (int k = 0; k < SIDES; ++k) {
            const double angle = 2 * PI * k / SIDES;
            surface.positions.push_back(begin + axis * ring.along +
                                        corner_radius(ring.radius) *
                                            (frond::cos(angle) * side + frond::sin(angle) * depth));
        }
    surface.positions.push_back(end + axis * stem.radius_end);

    const auto at = [first](int ring, int k) { return first + 1 + ring * SIDES + k % SIDES; };
    const int top = int(rings.size()) - 1;
    for (int k = 0; k < SIDES; ++k) surface.triangles.push_back({first, at(0, k + 1), at(0, k)});
    for (int ring = 0; ring < top; ++ring)
        for (int k = 0; k < SIDES; ++k) {
            surface.triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)});
            surface.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)});
        }
    for (int k = 0; k < SIDES; ++k) surface.triangles.push_back({last, at(top, k), at(top, k + 1)});
    part.triangle_count = int(surface.triangles.size()) - part.first_triangle;
    surface.parts.push_back(std::move(part));
    if (surface.triangles.size() > size_t(MAX_TRIANGLES))
        fail(FROND_RESULT_BAD_GEOMETRY, "the stems need more than the %d triangles that are allowed; use fewer",
             MAX_TRIANGLES);
}

Surface surface_from_stems(const frond_stem* stems, int stem_count) {
    check_stems(stems, stem_count);
    warn_of_gaps(stems, stem_count);
    Surface surface;
    surface.up_declared = true;
    for (int i = 0; i < stem_count; ++i) add_stem(surface, stems[i], i);
    return surface;
}

}  // namespace frond
