// Chain root. In: a surface with organs. Out: the points at its foot.
// Organs that can stand on the ground come first (stems, branches, roots; pots and stakes on their own); leaves only if
// there is nothing else. A component is rooted if it reaches down to the ground of its class and does not stand on
// another one. A plant that lies has no foot below it: it is rooted at one end.
#include <algorithm>
#include <cmath>

#include "core/decompose.hpp"
#include "skeleton/chain.hpp"

namespace frond {

namespace {

enum Class { NEVER, PLANT, SUPPORT };

// Shares of the plant's height or size.
constexpr double FOOT = 0.02;       // points no higher than this above a component's lowest point are its foot
constexpr double LEVEL = 0.005;     // a component that begins no higher than this is certainly on the ground
constexpr double HANGS = 0.3;       // a component hangs from joints above this share of its own height
constexpr double GROUND = 0.03;     // tolerance for feet on uneven ground
constexpr double STANDS_ON = 0.05;  // a component stands on joints no higher than this above its foot
constexpr double GAP = 0.01;        // a joint across a wider gap carries nothing
constexpr double LIES = 0.1;        // a plant lower than this share of its size, and on its feet over half of it, lies
constexpr double TOO_HIGH = 0.5;    // a plant does not stand on a stem that begins above this

struct Feet {
    std::vector<Class> triangle;             // class of each triangle
    std::vector<std::array<double, 3>> low;  // component -> lowest point by class [m]
    std::vector<double> lowest;              // component -> lowest point of all its triangles [m]
    std::array<double, 3> ground;            // lowest point by class [m]
};

bool is_one_of(const std::string& kind, std::initializer_list<const char*> kinds) {
    return std::any_of(kinds.begin(), kinds.end(), [&](const char* one) { return kind == one; });
}

void measure_feet(const Topology& topology, Feet& feet) {
    feet.low.assign(size_t(topology.component_count), {INFINITY, INFINITY, INFINITY});
    feet.lowest.assign(size_t(topology.component_count), INFINITY);
    feet.ground = {INFINITY, INFINITY, INFINITY};
    for (size_t t = 0; t < topology.triangles.size(); t++)
        for (int p : topology.triangles[t]) {
            const double y = topology.points[size_t(p)].y();
            const size_t component = size_t(topology.triangle_component[t]);
            double& low = feet.low[component][feet.triangle[t]];
            low = std::min(low, y);
            feet.lowest[component] = std::min(feet.lowest[component], y);
            feet.ground[feet.triangle[t]] = std::min(feet.ground[feet.triangle[t]], y);
        }
}

// Chooses which triangles may be rooted; widens the choice until there are some and they reach low enough.
Feet choose_feet(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs) {
    Feet feet;
    const double bottom = surface.lower().y(), height = surface.height();
    for (int choice = 0; choice < 3; choice++) {
        feet.triangle.assign(topology.triangles.size(), NEVER);
        for (const Part& part : surface.parts) {
            if (part.organ < 0 || size_t(part.organ) >= organs.size()) continue;
            const std::string& kind = organs[size_t(part.organ)].kind;
            Class what = NEVER;
            if (kind == "support") what = SUPPORT;
            if (choice == 0 && is_one_of(kind, {"stem", "branch", "root"})) what = PLANT;
            if (choice == 1 && is_one_of(kind, {"stem", "branch", "root", "petiole", "peduncle"})) what = PLANT;
            std::fill_n(feet.triangle.begin() + part.first_triangle, part.triangle_count, what);
        }
        if (choice == 2)
            for (Class& what : feet.triangle)
                if (what == NEVER) what = PLANT;
        measure_feet(topology, feet);
        const double lowest = std::min(feet.ground[PLANT], feet.ground[SUPPORT]);
        if (lowest <= bottom + TOO_HIGH * height) break;
    }
    // A plant does not stand on a ring or clip that holds it in the air, nor on a stalk in the air above a pot.
    for (const Class what : {PLANT, SUPPORT})
        if (feet.ground[what] > bottom + TOO_HIGH * height) feet.ground[what] = -INFINITY;
    return feet;
}

// How a component is held up, as bits.
enum Hold { STANDS_ON_SUPPORT = 1, STANDS = 2, HANGS_HIGH = 4 };

std::vector<int> find_holds(const Surface& surface, const Topology& topology, const Feet& feet) {
    const double height = surface.height(), size = surface.size();
    std::vector<Eigen::AlignedBox3d> boxes(size_t(topology.component_count));
    for (size_t t = 0; t < topology.triangles.size(); t++)
        for (int p : topology.triangles[t])
            boxes[size_t(topology.triangle_component[t])].extend(topology.points[size_t(p)]);
    std::vector<int> holds(boxes.size(), 0);
    for (const Joint& joint : topology.joints)
        for (int turn = 0; turn < 2; turn++) {
            const int held_triangle = turn ? joint.triangle_b : joint.triangle_a;
            const int other_triangle = turn ? joint.triangle_a : joint.triangle_b;
            const size_t held = size_t(topology.triangle_component[size_t(held_triangle)]);
            const size_t other = size_t(topology.triangle_component[size_t(other_triangle)]);
            if ((joint.point_a - joint.point_b).norm() > GAP * size) continue;
            const double y = (turn ? joint.point_b : joint.point_a).y(), foot = feet.low[held][PLANT];
            const double tall = boxes[held].sizes().y();
            const bool larger = boxes[other].sizes().squaredNorm() > boxes[held].sizes().squaredNorm();
            if (larger && y > boxes[held].min().y() + HANGS * tall && tall > STANDS_ON * height)
                holds[held] |= HANGS_HIGH;
            if (y > foot + STANDS_ON * height) continue;
            if (feet.lowest[other] < foot) holds[held] |= STANDS;
            if (feet.triangle[size_t(other_triangle)] == SUPPORT && feet.ground[SUPPORT] < foot - LEVEL * height)
                holds[held] |= STANDS_ON_SUPPORT;
        }
    return holds;
}

// Moves the roots of a plant that lies, such as a leaf drawn level, to one end of its longest axis: that which is
// nearer to the file's origin.
void root_at_end(const Surface& surface, const Topology& topology, RootPoints& roots) {
    if (surface.height() > LIES * surface.size()) return;
    Eigen::AlignedBox3d feet;
    for (int p : roots.points) feet.extend(topology.points[size_t(p)]);
    if (feet.sizes().norm() < 0.5 * surface.size()) return;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& point : topology.points) middle += point / double(topology.points.size());
    Mat3 spread = Mat3::Zero();
    for (const Vec3& point : topology.points) spread += (point - middle) * (point - middle).transpose();
    Vec3 along = symmetric_parts(spread).vectors.col(2);
    const auto extent = [&] {
        std::array<double, 2> ends = {INFINITY, -INFINITY};
        for (const Vec3& point : topology.points)
            ends = {std::min(ends[0], along.dot(point)), std::max(ends[1], along.dot(point))};
        return ends;
    };
    std::array<double, 2> ends = extent();
    if (std::abs(ends[1]) < std::abs(ends[0])) {
        along = -along;
        ends = extent();
    }
    roots = {};
    for (size_t i = 0; i < topology.points.size(); i++) {
        const double way = along.dot(topology.points[i]) - ends[0];
        if (way > FOOT * (ends[1] - ends[0])) continue;
        roots.points.push_back(int(i));
        roots.heights.push_back(way);
    }
}

}  // namespace

// Returns the lowest points of organs that the plant stands on, each by itself.
static RootPoints feet_of(const Surface& surface, const Topology& topology, const std::vector<int>& rooted) {
    const double height = surface.height();
    std::vector<double> above(topology.points.size(), INFINITY);
    for (int organ : rooted) {
        std::vector<int> points;
        double low = INFINITY;
        for (const Part& part : surface.parts)
            for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
                if (part.organ == organ)
                    for (int p : topology.triangles[size_t(t)]) {
                        points.push_back(p);
                        low = std::min(low, topology.points[size_t(p)].y());
                    }
        for (int p : points) {
            const double y = topology.points[size_t(p)].y() - low;
            if (y <= FOOT * height) above[size_t(p)] = std::min(above[size_t(p)], y);
        }
    }
    RootPoints roots;
    for (size_t i = 0; i < above.size(); i++) {
        if (!std::isfinite(above[i])) continue;
        roots.points.push_back(int(i));
        roots.heights.push_back(above[i]);
    }
    return roots;
}

RootPoints find_root_points(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
                            const std::vector<int>& rooted) {
    if (!rooted.empty()) return feet_of(surface, topology, rooted);
    const Feet feet = choose_feet(surface, topology, organs);
    const double height = surface.height();
    const std::vector<int> holds = find_holds(surface, topology, feet);
    std::vector<double> above(topology.points.size(), INFINITY);
    for (size_t t = 0; t < topology.triangles.size(); t++) {
        const Class what = feet.triangle[t];
        if (what == NEVER) continue;
        const size_t component = size_t(topology.triangle_component[t]);
        const double low = feet.low[component][what], lift = low - feet.ground[what];
        const int hold = what == PLANT ? holds[component] : 0;
        if (lift > (hold & (STANDS | HANGS_HIGH) ? LEVEL : GROUND) * height || (hold & STANDS_ON_SUPPORT)) continue;
        // A hanging component that happens to touch the ground is rooted only if none of its class reaches lower.
        if ((hold & HANGS_HIGH) && lift > 0) continue;
        for (int p : topology.triangles[t]) {
            const double y = topology.points[size_t(p)].y() - low;
            if (y <= FOOT * height) above[size_t(p)] = std::min(above[size_t(p)], y);
        }
    }
    // If nothing fits, the lowest points of all are taken.
    if (std::none_of(above.begin(), above.end(), [](double y) { return std::isfinite(y); })) {
        for (const Triangle& t : topology.triangles)
            for (int p : t) {
                const double y = topology.points[size_t(p)].y() - surface.lower().y();
                if (y <= FOOT * height) above[size_t(p)] = std::max(y, 0.0);
            }
    }
    RootPoints roots;
    for (size_t i = 0; i < above.size(); i++)
        if (std::isfinite(above[i])) {
            roots.points.push_back(int(i));
            roots.heights.push_back(above[i]);
        }
    root_at_end(surface, topology, roots);
    return roots;
}

}  // namespace frond
