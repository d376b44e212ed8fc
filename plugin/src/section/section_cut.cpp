// Surface and chain -> outlines. Planes across a capsule cut its triangles in line segments, directed so that they run
// around what they enclose; Green's theorem then gives area and second moments of each outline, exactly for a mesh that
// is closed there. Several outlines, a trunk and twigs beside it, are beams side by side: nothing joins them in shear.
// Where most of what is cut does not close (open sheets, forks, soups) there is no outline.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/decompose.hpp"
#include "core/union_find.hpp"
#include "section/section_parts.hpp"

namespace frond {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double CLOSED = 1e-6;  // largest gap of a closed outline, as a share of its perimeter
// Gauss points and weights along the capsule: exact for a taper.
constexpr std::array<double, 3> PLANES = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> WEIGHTS = {5.0 / 18, 8.0 / 18, 5.0 / 18};

// Sums over segments, about the axis.
struct Sums {
    double perimeter = 0, area = 0;
    Vector2d end = Vector2d::Zero();    // sum of all segments as vectors: zero if they form a closed loop
    Vector2d first = Vector2d::Zero();  // moment of area
    Matrix2d second = Matrix2d::Zero();

    void add(const Vector2d& p, const Vector2d& q) {
        const double cross = p.x() * q.y() - p.y() * q.x();
        perimeter += (q - p).norm();
        end += q - p;
        area += cross / 2;
        first += cross / 6 * (p + q);
        second += cross / 24 * (2 * p * p.transpose() + 2 * q * q.transpose() + p * q.transpose() + q * p.transpose());
    }
    void add(const Sums& other) {
        perimeter += other.perimeter;
        area += other.area;
        end += other.end;
        first += other.first;
        second += other.second;
    }
    bool is_loop() const { return perimeter > 0 && end.norm() < CLOSED * perimeter; }
    bool closed() const { return is_loop() && area != 0; }
};

// Where a plane cuts a triangle, from p to q, and which edges it cuts there.
struct Segment {
    int triangle;
    std::array<std::pair<int, int>, 2> edges;  // points of the topology, the smaller first
    Vector2d p, q;
};

// Finds the segment in which a plane across the axis cuts a triangle, directed by the triangle's normal.
bool cut_triangle(const Topology& topology, int triangle, const CapsuleFrame& frame, double along, Segment& segment) {
    // Welded, so that outlines close where a soup's triangles only nearly meet.
    const Triangle& points = topology.triangles[size_t(triangle)];
    std::array<Vec3, 3> corners;
    std::array<double, 3> side;
    for (size_t k = 0; k < 3; k++) {
        corners[k] = topology.points[size_t(points[k])];
        side[k] = (corners[k] - frame.begin).dot(frame.axis) - along;
    }
    std::array<Vec3, 2> ends;
    size_t count = 0;
    for (size_t k = 0; k < 3; k++) {
        const size_t next = (k + 1) % 3;
        if ((side[k] < 0) == (side[next] < 0)) continue;
        segment.edges[count] = std::minmax(points[k], points[next]);
        ends[count++] = corners[k] + side[k] / (side[k] - side[next]) * (corners[next] - corners[k]);
    }
    if (count < 2) return false;
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const bool turned = topology.turned[size_t(triangle)] != 0;
    if (((ends[1] - ends[0]).dot(frame.axis.cross(normal)) < 0) != turned) std::swap(ends[0], ends[1]);
    const auto flatten = [&](const Vec3& x) {
        return Vector2d((x - frame.begin).dot(frame.across), (x - frame.begin).dot(frame.other));
    };
    segment.triangle = triangle;
    segment.p = flatten(ends[0]);
    segment.q = flatten(ends[1]);
    return true;
}

// Lists for each chain node the triangles of its own organ, or of that organ's ribs, with a corner assigned to it.
std::vector<std::vector<int>> triangles_by_node(const Surface& surface, const Chain& chain, bool of_ribs) {
    std::vector<std::vector<int>> lists(chain.nodes.size());
    std::vector<int> between;
    const auto organ_of = [&](const Part& part) {
        if (!of_ribs) return part.organ;
        return part.organ < 0 || chain.rib_of.empty() ? -1 : chain.rib_of[size_t(part.organ)];
    };
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++) {
            const auto append = [&](int at) {
                const size_t node = size_t(at);
                if (chain.nodes[node].organ != organ_of(part) || (of_ribs && organ_of(part) < 0)) return;
                if (lists[node].empty() || lists[node].back() != t) lists[node].push_back(t);
            };
            for (int corner : surface.triangles[size_t(t)]) append(chain.vertex_node[size_t(corner)]);
            list_nodes_between(chain, surface.triangles[size_t(t)], between);
            for (int node : between) append(node);
        }
    return lists;
}

// Lists the triangles that a plane through a capsule may cut: its own and those of the capsules before and after it.
std::vector<std::vector<int>> triangles_by_capsule(const Surface& surface, const Chain& chain, bool of_ribs = false) {
    const std::vector<std::vector<int>> own = triangles_by_node(surface, chain, of_ribs);
    std::vector<std::vector<int>> lists = own;
    const auto append = [&](size_t to, size_t from) {
        lists[to].insert(lists[to].end(), own[from].begin(), own[from].end());
    };
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        const int parent = chain.nodes[i].parent;
        if (parent < 0 || chain.nodes[size_t(parent)].organ != chain.nodes[i].organ) continue;
        append(i, size_t(parent));
        append(size_t(parent), i);
    }
    for (std::vector<int>& list : lists) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return lists;
}

// Returns the second moments about the centroid, zero if they are none.
Matrix2d central_moments(const Sums& sums) {
    const double sign = sums.area < 0 ? -1 : 1;
    const Matrix2d moments = sign * (sums.second - sums.first * sums.first.transpose() / sums.area);
    return moments.determinant() > 0 && moments.trace() > 0 ? moments : Matrix2d(Matrix2d::Zero());
}

// Segments that meet at the edges that the plane cuts, as one outline.
struct Loop {
    Sums sums;
    std::vector<Segment> segments;

    // Whether a place is enclosed, by how often a ray from it crosses the outline.
    bool encloses(const Vector2d& place) const {
        bool inside = false;
        for (const Segment& s : segments) {
            if ((s.p.y() > place.y()) == (s.q.y() > place.y())) continue;
            const double x = s.p.x() + (place.y() - s.p.y()) / (s.q.y() - s.p.y()) * (s.q.x() - s.p.x());
            if (x > place.x()) inside = !inside;
        }
        return inside;
    }
};

// Collects segments into loops. What is drawn twice counts once.
std::vector<Loop> collect_loops(std::vector<Segment> segments) {
    const auto ends_of = [](const Segment& s) { return std::minmax(s.edges[0], s.edges[1]); };
    std::stable_sort(segments.begin(), segments.end(),
                     [&](const Segment& a, const Segment& b) { return ends_of(a) < ends_of(b); });
    segments.erase(std::unique(segments.begin(), segments.end(),
                               [&](const Segment& a, const Segment& b) { return ends_of(a) == ends_of(b); }),
                   segments.end());
    std::map<std::pair<int, int>, int> first;  // edge -> first segment that ends there
    UnionFind sets(segments.size());
    for (size_t i = 0; i < segments.size(); i++)
        for (const auto& edge : segments[i].edges) sets.join(int(i), first.emplace(edge, int(i)).first->second);
    std::vector<Loop> loops;
    std::vector<int> number(segments.size(), -1);
    for (size_t i = 0; i < segments.size(); i++) {
        int& loop = number[size_t(sets.find(int(i)))];
        if (loop < 0) {
            loop = int(loops.size());
            loops.emplace_back();
        }
        loops[size_t(loop)].sums.add(segments[i].p, segments[i].q);
        loops[size_t(loop)].segments.push_back(segments[i]);
    }
    return loops;
}

// What a plane cuts: the outlines of a solid, or all of a sheet; none if its area is zero.
struct PlaneCut {
    double area = 0;
    Matrix2d moments = Matrix2d::Zero();
};

// A sheet drawn with two faces may bow, so that its outline need not be compact.
PlaneCut sheet_outline(const Sums& all) {
    if (!all.closed()) return {};
    const Matrix2d moments = central_moments(all);
    return {moments.trace() > 0 ? std::abs(all.area) : 0, moments};
}

// Drops cuts through a pointed end within a capsule, as it does not represent the rest.
void drop_points(std::array<PlaneCut, 3>& cuts) {
    constexpr double POINT = 0.25;  // share of the largest area
    const double most = std::max({cuts[0].area, cuts[1].area, cuts[2].area});
    for (PlaneCut& cut : cuts)
        if (cut.area < POINT * most) cut = {};
}

// Returns the taper if the sizes of all cuts, which grow with the root of the area, are those of one cone; else zero.
double taper_of(const std::array<PlaneCut, 3>& cuts) {
    constexpr double STRAIGHT = 0.02;  // distance of the middle size from the mean of the others, over it [-]
    const double a = std::sqrt(cuts[0].area), b = std::sqrt(cuts[1].area), c = std::sqrt(cuts[2].area);
    if (!(a > 0 && b > 0 && c > 0) || std::abs(a + c - 2 * b) > STRAIGHT * b) return 0;
    return std::clamp((c - a) / ((a + c) * (PLANES[2] - PLANES[0])), -LARGEST_TAPER, LARGEST_TAPER);
}

// Corrects the cuts at a plant's foot and tips. The foot ends in a face or a cap, which the ground holds: its section
// is continued from above. Towards a tip the load vanishes faster than the section, so that the middle cut represents
// the whole capsule.
void repair_ends(bool foot, bool tip, std::array<PlaneCut, 3>& cuts) {
    if (tip && cuts[1].area > 0) cuts[0] = cuts[2] = cuts[1];
    if (!foot || tip || !(cuts[1].area > 0 && cuts[2].area > 0) || cuts[0].area >= cuts[1].area) return;
    cuts[0] = cuts[1];
    if (cuts[1].area <= cuts[2].area) return;
    cuts[0].area += cuts[1].area - cuts[2].area;
    cuts[0].moments += cuts[1].moments - cuts[2].moments;
}

// Averages the areas and the inverse second moments, since in bending it is compliances that add up, each over what the
// taper alone makes of it.
void average(const std::array<PlaneCut, 3>& cuts, const CapsuleFrame& frame, Outline& outline) {
    double area = 0, squares = 0, fourths = 0;
    Matrix2d inverse = Matrix2d::Zero();
    for (size_t plane = 0; plane < cuts.size(); plane++) {
        if (!(cuts[plane].area > 0 && cuts[plane].moments.determinant() > 0)) continue;
        const double size = 1 + outline.taper * (2 * PLANES[plane] - 1);
        area += WEIGHTS[plane] * cuts[plane].area;
        squares += WEIGHTS[plane] * frond::pow(size, 2);
        inverse += WEIGHTS[plane] * cuts[plane].moments.inverse();
        fourths += WEIGHTS[plane] * frond::pow(size, -4);
    }
    if (!(area > 0)) return;
    const SymmetricParts2 parts = symmetric_parts_2(Matrix2d((inverse / fourths).inverse()));
    outline.found = true;
    outline.area = area / squares;
    outline.inertia_thin = parts.values[0];
    outline.inertia_wide = parts.values[1];
    const Vector2d direction = parts.vectors.col(0);
    outline.thin = (direction.x() * frame.across + direction.y() * frame.other).normalized();
}

// Cuts triangles with the plane across a capsule.
std::vector<Segment> cut_with_plane(const Topology& topology, const std::vector<int>& triangles,
                                    const CapsuleFrame& frame, double share) {
    std::vector<Segment> segments;
    Segment segment;
    for (int t : triangles)
        if (cut_triangle(topology, t, frame, share * frame.length, segment)) segments.push_back(segment);
    return segments;
}

// The surface around one capsule.
struct Around {
    const Surface& surface;
    const Topology& topology;
    const Chain& chain;
    const CapsuleFrame& frame;
    int capsule;

    // Whether of all capsules that share a loop's surface this one's axis is nearest to its middle: a plane across a
    // branch also cuts the trunk that it begins in, and other branches.
    bool owns(const Loop& loop, double share) const {
        const Vector2d middle = loop.sums.first / loop.sums.area;
        const Vec3 place =
            frame.begin + share * frame.length * frame.axis + middle.x() * frame.across + middle.y() * frame.other;
        std::vector<int> others;
        for (const Segment& segment : loop.segments) {
            const Triangle& triangle = surface.triangles[size_t(segment.triangle)];
            list_nodes_between(chain, triangle, others);
            for (int corner : triangle) {
                others.push_back(chain.vertex_node[size_t(corner)]);
                others.push_back(chain.vertex_capsule[size_t(corner)]);
            }
            for (int other : others)
                if (other != capsule && distance_from(other, place) < middle.norm()) return false;
        }
        return true;
    }
    double distance_from(int other, const Vec3& place) const {
        const int parent = chain.nodes[size_t(other)].parent;
        if (parent < 0) return INFINITY;
        const Vec3 begin = chain.nodes[size_t(parent)].position, along = chain.nodes[size_t(other)].position - begin;
        const double square = along.squaredNorm();
        const double s = square > 0 ? std::clamp((place - begin).dot(along) / square, 0.0, 1.0) : 0.0;
        return (place - begin - s * along).norm();
    }
};

// Collects the closed outlines of a capsule; none if what is left open is longer than they are.
std::vector<Loop> own_outlines(const Around& around, std::vector<Loop> loops, double share) {
    double closed = 0, open = 0;
    std::vector<Loop> own;
    for (Loop& loop : loops) {
        if (!loop.sums.closed()) {
            open += loop.sums.perimeter;
        } else if (around.owns(loop, share)) {
            closed += loop.sums.perimeter;
            own.push_back(std::move(loop));
        }
    }
    if (closed < open) own.clear();
    return own;
}

// Adds up outlines: beams side by side, each bent about its own middle. Of what lies within another, the other face of
// the same mesh is a hole, and the rest is where tissue is already.
PlaneCut add_beams(const Topology& topology, const std::vector<Loop>& loops) {
    PlaneCut cut;
    const auto component = [&](const Loop& loop) {
        return topology.triangle_component[size_t(loop.segments.front().triangle)];
    };
    const auto is_within = [](const Loop& inner, const Loop& outer) {
        return std::abs(inner.sums.area) < std::abs(outer.sums.area) && outer.encloses(inner.segments.front().p);
    };
    for (const Loop& loop : loops) {
        Sums beam = loop.sums;
        bool is_first = true;
        for (const Loop& other : loops) {
            if (is_within(loop, other)) is_first = false;
            const bool faces_it = other.sums.area * loop.sums.area < 0 && component(other) == component(loop);
            if (faces_it && is_within(other, loop)) beam.add(other.sums);
        }
        if (!is_first) continue;
        cut.area += std::abs(beam.area);
        cut.moments += central_moments(beam);
    }
    return cut;
}

Outline cut_capsule(const Around& around, const std::vector<int>& triangles, bool sheet, bool foot, bool tip) {
    std::array<PlaneCut, 3> cuts;
    double area = 0, perimeter = 0;
    bool doubled = true;
    for (size_t plane = 0; plane < cuts.size(); plane++) {
        const std::vector<Segment> segments = cut_with_plane(around.topology, triangles, around.frame, PLANES[plane]);
        Sums all;
        for (const Segment& segment : segments) all.add(segment.p, segment.q);
        doubled = doubled && all.is_loop();  // two faces in one place enclose nothing
        area += std::abs(all.area);
        perimeter += all.perimeter;
        cuts[plane] = sheet ? sheet_outline(all)
                            : add_beams(around.topology, own_outlines(around, collect_loops(segments), PLANES[plane]));
    }
    Outline outline;
    outline.doubled = doubled;
    // The thickness of the rectangle with the mean area and perimeter.
    const double half = perimeter / 2 / PLANES.size(), mean = area / PLANES.size();
    if (doubled) outline.gap = (half - std::sqrt(std::max(half * half - 4 * mean, 0.0))) / 2;
    drop_points(cuts);
    // A sheet's thickness does not change with its width, so it has no taper.
    outline.taper = sheet ? 0 : taper_of(cuts);
    if (outline.taper == 0) repair_ends(foot, tip, cuts);
    average(cuts, around.frame, outline);
    return outline;
}

}  // namespace

std::vector<Outline> cut_outlines(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
                                  const Chain& chain, const std::vector<CapsuleFrame>& frames) {
    const std::vector<std::vector<int>> triangles = triangles_by_capsule(surface, chain);
    std::vector<char> is_tip(chain.nodes.size(), 1);
    for (const ChainNode& node : chain.nodes)
        if (node.parent >= 0 && chain.nodes[size_t(node.parent)].organ == node.organ) is_tip[size_t(node.parent)] = 0;
    std::vector<Outline> outlines(chain.nodes.size());
    for (size_t i = 0; i < outlines.size(); i++) {
        const int parent = chain.nodes[i].parent;
        if (parent < 0 || triangles[i].empty()) continue;
        const bool foot = chain.nodes[size_t(parent)].parent < 0;
        const bool sheet = is_sheet(organs[size_t(std::max(chain.nodes[i].organ, 0))]);
        const Around around = {surface, topology, chain, frames[i], int(i)};
        outlines[i] = cut_capsule(around, triangles[i], sheet, foot, is_tip[i]);
    }
    return outlines;
}

std::vector<RibCut> cut_ribs(const Surface& surface, const Topology& topology, const Chain& chain,
                             const std::vector<CapsuleFrame>& frames) {
    std::vector<RibCut> cuts(chain.nodes.size());
    if (std::all_of(chain.rib_of.begin(), chain.rib_of.end(), [](int blade) { return blade < 0; })) return cuts;
    const std::vector<std::vector<int>> triangles = triangles_by_capsule(surface, chain, true);
    std::vector<int> organ(surface.triangles.size(), -1);
    for (const Part& part : surface.parts)
        std::fill_n(organ.begin() + part.first_triangle, part.triangle_count, part.organ);
    for (size_t i = 0; i < cuts.size(); i++) {
        RibCut& rib = cuts[i];
        double weight = 0;
        for (size_t plane = 0; plane < PLANES.size() && !triangles[i].empty(); plane++) {
            Sums all;
            for (const Loop& loop : collect_loops(cut_with_plane(topology, triangles[i], frames[i], PLANES[plane])))
                if (loop.sums.closed()) all.add(loop.sums);
            if (!(std::abs(all.area) > 0)) continue;
            weight += WEIGHTS[plane];
            rib.area += WEIGHTS[plane] * std::abs(all.area);
            rib.middle += WEIGHTS[plane] * all.first / all.area;
            rib.moments += WEIGHTS[plane] * central_moments(all);
        }
        if (!(weight > 0)) continue;
        // A rib that ends within the capsule counts by what there is of it.
        rib.middle /= weight;
        rib.organ = organ[size_t(triangles[i].front())];
    }
    return cuts;
}

}  // namespace frond
