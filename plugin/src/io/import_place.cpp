// Places a surface. In: file units and axes. Out: metres and +y up. What the caller leaves open is guessed: the scale
// only if the file's own gives a size that no plant has, the up axis only if the file declares none.
#include <algorithm>
#include <cmath>

#include "core/decompose.hpp"
#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "io/import.hpp"
#include "io/surface_scenery.hpp"
#include "skeleton/organ_clues.hpp"

namespace frond {

// Plausible heights [m], and the range in which a guess must lie.
static constexpr double SMALLEST_PLANT = 0.02, TALLEST_PLANT = 120;
static constexpr double TALLEST_HERB = 6;  // sunflowers, tree ferns; a plant in a pot
static constexpr double GUESS_LOWER = 0.1, GUESS_UPPER = 3;
// z must score this much more than y to be taken as up.
static constexpr double UP_MARGIN = 0.25;
// A plant farther from the origin than this many times its size loses precision in float.
static constexpr double FARTHEST = 100;

static bool is_usable(const Vec3& position) {
    return position.allFinite() && position.cwiseAbs().maxCoeff() < 1e18;
}

static Eigen::AlignedBox3d box_of(const std::vector<Vec3>& positions) {
    Eigen::AlignedBox3d box;
    for (const Vec3& position : positions)
        if (is_usable(position)) box.extend(position);
    return box;
}

// Scores how much the low end along an axis resembles a plant's foot, 0..4: it starts at zero, stands on the origin and
// below the middle, and is small compared with the whole.
static double score_foot(const std::vector<Vec3>& positions, int axis) {
    const Eigen::AlignedBox3d box = box_of(positions);
    if (box.isEmpty()) return 0;
    const double size = box.diagonal().norm(), height = box.sizes()[axis];
    if (size <= 0 || height < 0.02 * size) return 0;
    const int side = (axis + 1) % 3, depth = (axis + 2) % 3;

    // Centre and spread of the vertices in the lowest twentieth.
    const double band = box.min()[axis] + 0.05 * height;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double squares = 0, count = 0;
    for (const Vec3& position : positions) {
        if (!is_usable(position) || position[axis] > band) continue;
        const Eigen::Vector2d flat(position[side], position[depth]);
        sum += flat;
        squares += (flat - Eigen::Vector2d(box.center()[side], box.center()[depth])).squaredNorm();
        count += 1;
    }
    if (count == 0) return 0;
    const Eigen::Vector2d foot = sum / count;
    const Eigen::Vector2d middle(box.center()[side], box.center()[depth]);
    const double spread = std::sqrt(std::max(0.0, squares / count - (foot - middle).squaredNorm()));
    const double at_zero = frond::exp(-10 * std::abs(box.min()[axis]) / size);
    const double on_origin = frond::exp(-5 * foot.norm() / size);
    const double below_middle = frond::exp(-5 * (foot - middle).norm() / size);
    const double compact = frond::exp(-5 * spread / size);
    return at_zero + on_origin + below_middle + compact;
}

// Gives a bonus to the axis along which the plant is by far the longest, if there is one.
static double score_length(const std::vector<Vec3>& positions, int axis) {
    const Eigen::AlignedBox3d box = box_of(positions);
    if (box.isEmpty()) return 0;
    const double others = std::max(box.sizes()[(axis + 1) % 3], box.sizes()[(axis + 2) % 3]);
    return box.sizes()[axis] > 1.5 * others ? 0.4 : 0;
}

// Returns whether a surface lies along x, as single organs are often drawn: by far the longest along x, from the
// origin, with its foot there.
static bool lies_along_x(const Surface& surface, double other_score) {
    constexpr double LONG = 2.5,
                     MARGIN = 1;  // least length over width [-]; by how much a foot is clearer than on other axes
    const Eigen::AlignedBox3d box = box_of(surface.positions);
    if (box.isEmpty() || box.sizes().x() < LONG * std::max(box.sizes().y(), box.sizes().z())) return false;
    return score_foot(surface.positions, 0) > other_score + MARGIN;
}

static Vec3 guess_up(const Surface& surface) {
    const auto score = [&surface](int axis) {
        return score_foot(surface.positions, axis) + score_length(surface.positions, axis);
    };
    const double y = score(1), z = score(2);
    if (lies_along_x(surface, std::max(y, z))) return Vec3::UnitX();
    return z > y + UP_MARGIN ? Vec3::UnitZ() : Vec3::UnitY();
}

// Returns the shortest rotation that takes an axis to +y.
static Mat3 turn_to_y(const Vec3& up) {
    if (up.y() < -1 + 1e-12) return Vec3(1, -1, -1).asDiagonal();
    return turn_between(up, Vec3::UnitY()).toRotationMatrix();
}

// Returns the power of ten (so millimetres and centimetres too) that brings the height nearest to one metre.
static double guess_scale(double height) {
    double best = 1, best_distance = 1e300;
    for (int power = -300; power <= 300; ++power) {
        const double scale = frond::pow(10.0, power), scaled = height * scale;
        if (!(scaled >= GUESS_LOWER && scaled <= GUESS_UPPER)) continue;
        const double distance = std::abs(frond::log10(scaled));
        if (distance < best_distance) {
            best = scale;
            best_distance = distance;
        }
    }
    return best;
}

static void check_options(const ImportOptions& options) {
    if (!std::isfinite(options.scale) || options.scale < 0)
        fail(FROND_RESULT_BAD_ARGUMENT, "the scale is %g; it must be positive, or 0 to choose", options.scale);
    if (!options.up.allFinite()) fail(FROND_RESULT_BAD_ARGUMENT, "the up axis is not finite");
    if (!options.up.isZero(0) && !(options.up.norm() > 1e-150 && options.up.norm() < 1e150))
        fail(FROND_RESULT_BAD_ARGUMENT, "the up axis has no usable length; give it length one");
}

// Rotates positions and normals so that another axis becomes +y.
static void turn_surface(Surface& surface, const Vec3& up) {
    if (up == surface.up) return;
    const Mat3 turn = turn_to_y(up) * turn_to_y(surface.up).transpose();
    for (Vec3& position : surface.positions) position = turn * position;
    for (Vec3f& normal : surface.normals) normal = (turn * normal.cast<double>()).cast<float>();
    surface.up = up;
}

// Returns the largest plausible height: a plant that is named a lily is not 20 m high.
static double tallest_of(const Surface& surface, const std::string& file) {
    std::vector<std::string> names = {file};
    for (const Part& part : surface.parts) {
        names.push_back(part.name);
        names.push_back(part.material);
    }
    return names_a_herb(names) ? TALLEST_HERB : TALLEST_PLANT;
}

static void scale_surface(Surface& surface, const ImportOptions& options) {
    const double wanted = options.scale;
    double factor = wanted > 0 ? wanted / surface.scale : 1;
    if (wanted == 0) {
        // A flat plant (a leaf lying on the ground) is judged by its length.
        const Eigen::AlignedBox3d box = box_of(surface.positions);
        const double size = box.isEmpty() ? 0 : box.diagonal().norm();
        const double height = size > 0 && box.sizes().y() < 0.05 * size ? size : box.sizes().y();
        const bool is_absurd = height < SMALLEST_PLANT || height > tallest_of(surface, options.name);
        if (size > 0 && is_absurd && surface.scale_declared) {
            warn("the plant is %.3g m tall by its file's own unit; set the scale if that is wrong", height);
        } else if (size > 0 && is_absurd) {
            factor = guess_scale(height);
            warn(
                "the plant would be %.3g m tall; taking one file unit as %.3g m, so that it is %.3g m; set the scale "
                "if "
                "that is wrong",
                height, surface.scale * factor, height * factor);
        }
    }
    if (factor != 1)
        for (Vec3& position : surface.positions) position *= factor;
    surface.scale *= factor;
}

// Moves a plant that is implausibly far away, so that its foot is at the origin.
static void fetch_surface(Surface& surface) {
    const Vec3 lower = surface.lower(), upper = surface.upper();
    const double distance = lower.cwiseMax(-upper).cwiseMax(0).norm(), size = (upper - lower).norm();
    if (distance <= FARTHEST * size) return;
    const Vec3 foot(0.5 * (lower.x() + upper.x()), lower.y(), 0.5 * (lower.z() + upper.z()));
    warn("the plant is %.3g m from its origin, %.0f times its size; its foot was moved to the origin", distance,
         distance / size);
    for (Vec3& position : surface.positions) position -= foot;
}

void place_surface(Surface& surface, const ImportOptions& options) {
    check_options(options);
    if (surface.placed) return;
    if (!options.up.isZero(0))
        turn_surface(surface, options.up.normalized());
    else if (!surface.up_declared)
        turn_surface(surface, guess_up(surface));
    scale_surface(surface, options);
    clean_surface(surface);
    if (leave_out_scenery(surface)) {
        scale_surface(surface, options);
        clean_surface(surface);
    }
    if (const int count = fill_lost_triangles(surface))
        warn("%d triangles that the mesh had lost were put back between their neighbours", count);
    fetch_surface(surface);
    surface.placed = true;
}

// The surface records scale and up; it holds the points during this call only.
void place_points(std::vector<Vec3>& points, const ImportOptions& options, Surface& surface) {
    check_options(options);
    surface.positions.swap(points);
    if (!options.up.isZero(0)) turn_surface(surface, options.up.normalized());
    scale_surface(surface, options);
    surface.positions.swap(points);
}

}  // namespace frond
