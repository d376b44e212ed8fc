// Pieces: the connected parts of the surface in each cell. First, triangles that share a point or an edge in the cell,
// or that a joint ties, are joined; then parts that belong together without touching there: two walls of a body that
// face each other across its interior, two faces of a thin sheet, and small components with those they hang on.
#include <algorithm>
#include <limits>

#include "cage/cage_copies.hpp"
#include "core/lists.hpp"
#include "core/union_find.hpp"

namespace frond {

// Two faces are one sheet if they are closer than this share of a cell, and within so many cells along the surface.
static constexpr double FACE_GAP = 0.2;
static constexpr int FACE_STEPS = 4;
// A component smaller than this many cells has no copies of its own.
static constexpr double SCRAP = 1.5;
// Largest number of positions of a part that are compared in a distance test.
static constexpr size_t NODE_SAMPLES = 48;

// Returns whether a line segment reaches into an enlarged cell.
static bool reaches(const Voxels& voxels, int cell, const Vec3& a, const Vec3& b) {
    const Vec3 low = voxels.lattice.low(voxels.cells.cells()[size_t(cell)]) - Vec3::Constant(voxels.margin);
    const double size = voxels.lattice.cell_size + 2 * voxels.margin;
    double begin = 0, end = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double from = a[axis] - low[axis], along = b[axis] - a[axis];
        if (along == 0) {
            if (from < 0 || from > size) return false;
            continue;
        }
        const double enter = std::min(-from / along, (size - from) / along);
        const double leave = std::max(-from / along, (size - from) / along);
        begin = std::max(begin, enter);
        end = std::min(end, leave);
    }
    return begin <= end;
}

std::vector<int> find_hosts(const Topology& topology, double cell_size) {
    const size_t count = size_t(topology.component_count);
    std::vector<Eigen::AlignedBox3d> boxes(count);
    for (size_t t = 0; t < topology.triangles.size(); ++t)
        for (int corner : topology.triangles[t])
            boxes[size_t(topology.triangle_component[t])].extend(topology.points[size_t(corner)]);
    std::vector<std::vector<int>> tied(count);
    for (const Joint& joint : topology.joints) {
        const int a = topology.triangle_component[size_t(joint.triangle_a)];
        const int b = topology.triangle_component[size_t(joint.triangle_b)];
        tied[size_t(a)].push_back(b);
        tied[size_t(b)].push_back(a);
    }
    // Starts from the largest component and follows the joints outwards.
    size_t largest = 0;
    for (size_t c = 1; c < count; ++c)
        if (boxes[c].diagonal().squaredNorm() > boxes[largest].diagonal().squaredNorm()) largest = c;
    std::vector<int> host(count, -1), queue = {int(largest)};
    host[largest] = int(largest);
    for (size_t i = 0; i < queue.size(); ++i)
        for (int c : tied[size_t(queue[i])]) {
            if (host[size_t(c)] >= 0) continue;
            host[size_t(c)] = boxes[size_t(c)].diagonal().norm() < SCRAP * cell_size ? host[size_t(queue[i])] : c;
            queue.push_back(c);
        }
    return host;
}

static void join_touching(const Topology& topology, const Patches& patches, const Voxels& voxels, UnionFind& sets) {
    // The last entry at each point and edge, valid if it is in the current cell.
    std::vector<int> at_point(topology.points.size(), -1), at_edge(patches.edges.first.size(), -1);
    const int triangle_count = int(topology.triangles.size());
    for (int cell = 0; cell + 1 < int(voxels.first.size()); ++cell) {
        const int begin = voxels.first[size_t(cell)], end = voxels.first[size_t(cell) + 1];
        for (int e = begin; e < end && voxels.item[size_t(e)] < triangle_count; ++e) {
            const size_t t = size_t(voxels.item[size_t(e)]);
            const Triangle& corner = topology.triangles[t];
            std::array<bool, 3> held;
            for (size_t k = 0; k < 3; ++k) {
                held[k] = voxels.holds(cell, topology.points[size_t(corner[k])]);
                if (!held[k]) continue;
                int& last = at_point[size_t(corner[k])];
                if (last >= begin) sets.join(last, e);
                last = e;
            }
            for (size_t k = 0; k < 3; ++k) {
                const int edge = patches.edges.triangle_edges[t][k];
                if (edge < 0 || held[k] || held[(k + 1) % 3]) continue;
                if (!reaches(voxels, cell, topology.points[size_t(corner[k])],
                             topology.points[size_t(corner[(k + 1) % 3])]))
                    continue;
                int& last = at_edge[size_t(edge)];
                if (last >= begin) sets.join(last, e);
                last = e;
            }
        }
        // Joints tie parts in the cells that hold the joints' ends.
        for (int e = end - 1; e >= begin && voxels.item[size_t(e)] >= triangle_count; --e) {
            const Joint& joint = topology.joints[size_t(voxels.item[size_t(e)] - triangle_count)];
            const int a = voxels.find_entry(cell, joint.triangle_a), b = voxels.find_entry(cell, joint.triangle_b);
            if (a >= 0 && voxels.holds(cell, joint.point_a)) sets.join(a, e);
            if (b >= 0 && voxels.holds(cell, joint.point_b)) sets.join(b, e);
        }
    }
}

static void number(const Voxels& voxels, UnionFind& sets, Pieces& pieces) {
    pieces.count = 0;
    pieces.entry_piece.assign(voxels.item.size(), -1);
    for (size_t e = 0; e < voxels.item.size(); ++e) {
        const size_t root = size_t(sets.find(int(e)));
        pieces.entry_piece[e] = root == e ? pieces.count++ : pieces.entry_piece[root];
    }
    pieces.first.assign(size_t(pieces.count) + 1, 0);
    for (int p : pieces.entry_piece) ++pieces.first[size_t(p) + 1];
    for (size_t p = 1; p < pieces.first.size(); ++p) pieces.first[p] += pieces.first[p - 1];
    std::vector<int> next(pieces.first.begin(), pieces.first.end() - 1);
    pieces.entries.resize(voxels.item.size());
    for (size_t e = 0; e < voxels.item.size(); ++e)
        pieces.entries[size_t(next[size_t(pieces.entry_piece[e])]++)] = int(e);
}

static void link(const Voxels& voxels, Pieces& pieces) {
    pieces.links.clear();
    for (int cell = 0; cell + 1 < int(voxels.first.size()); ++cell) {
        const CellIndex& here = voxels.cells.cells()[size_t(cell)];
        for (int side = 14; side < 27; ++side) {
            const int other =
                voxels.cells.find({here[0] + side % 3 - 1, here[1] + side / 3 % 3 - 1, here[2] + side / 9 - 1});
            if (other < 0) continue;
            // Both are sorted by item.
            int a = voxels.first[size_t(cell)], b = voxels.first[size_t(other)];
            const int end_a = voxels.first[size_t(cell) + 1], end_b = voxels.first[size_t(other) + 1];
            std::array<int, 2> last = {-1, -1};
            while (a < end_a && b < end_b) {
                const int item_a = voxels.item[size_t(a)], item_b = voxels.item[size_t(b)];
                if (item_a == item_b) {
                    const auto [low, high] = std::minmax(pieces.entry_piece[size_t(a)], pieces.entry_piece[size_t(b)]);
                    if (last != std::array<int, 2>{low, high}) pieces.links.push_back({low, high});
                    last = {low, high};
                }
                a += item_a <= item_b;
                b += item_b <= item_a;
            }
        }
    }
    sort_unique(pieces.links);
}

namespace {

struct Nearness {
    double squared = std::numeric_limits<double>::infinity();  // [m^2]
    int entry_a = -1, entry_b = -1;
};

// Finds the parts of a cell that belong together though they do not touch.
struct Gatherer {
    const Topology& topology;
    const Patches& patches;
    const Voxels& voxels;
    const Pieces& pieces;
    std::vector<int> host;
    UnionFind sets;  // sets of parts
    std::vector<std::vector<int>> linked;
    std::vector<int> seen;  // number of the last search that reached each part
    int search = 0;

    bool is_triangle(int entry) const { return size_t(voxels.item[size_t(entry)]) < topology.triangles.size(); }
    int component(int entry) const { return topology.triangle_component[size_t(voxels.item[size_t(entry)])]; }
    const Patch& patch_of(int entry) const {
        return patches.patches[size_t(patches.triangle_patch[size_t(voxels.item[size_t(entry)])])];
    }
};

}  // namespace

static Nearness measure_nearness(const Gatherer& gatherer, int a, int b) {
    const Pieces& pieces = gatherer.pieces;
    const size_t first_a = size_t(pieces.first[size_t(a)]), count_a = size_t(pieces.first[size_t(a) + 1]) - first_a;
    const size_t first_b = size_t(pieces.first[size_t(b)]), count_b = size_t(pieces.first[size_t(b) + 1]) - first_b;
    Nearness best;
    for (size_t i = 0; i < count_a; i += count_a / NODE_SAMPLES + 1)
        for (size_t k = 0; k < count_b; k += count_b / NODE_SAMPLES + 1) {
            const int entry_a = pieces.entries[first_a + i], entry_b = pieces.entries[first_b + k];
            const double squared =
                (gatherer.voxels.centre[size_t(entry_a)] - gatherer.voxels.centre[size_t(entry_b)]).squaredNorm();
            if (squared < best.squared && gatherer.is_triangle(entry_a) && gatherer.is_triangle(entry_b))
                best = {squared, entry_a, entry_b};
        }
    return best;
}

// Returns the outward normal, of any length.
static Vec3 outward(const Gatherer& gatherer, int entry) {
    const size_t t = size_t(gatherer.voxels.item[size_t(entry)]);
    const Triangle& corner = gatherer.topology.triangles[t];
    const Vec3& a = gatherer.topology.points[size_t(corner[0])];
    const Vec3 normal =
        (gatherer.topology.points[size_t(corner[1])] - a).cross(gatherer.topology.points[size_t(corner[2])] - a);
    return gatherer.patches.flipped[t] ? Vec3(-normal) : normal;
}

static bool face_through_inside(const Gatherer& gatherer, const Nearness& nearness) {
    const int a = nearness.entry_a, b = nearness.entry_b;
    if (a < 0 || &gatherer.patch_of(a) != &gatherer.patch_of(b) || !gatherer.patch_of(a).solid) return false;
    const Vec3 way = gatherer.voxels.centre[size_t(b)] - gatherer.voxels.centre[size_t(a)];
    return outward(gatherer, a).dot(way) < 0 && outward(gatherer, b).dot(way) > 0;
}

// Returns whether a part can be reached from another within a few cells along the surface.
static bool is_near_along(Gatherer& gatherer, int from, int to) {
    std::vector<int> front = {from}, next;
    const int mark = ++gatherer.search;
    gatherer.seen[size_t(from)] = mark;
    for (int step = 0; step < FACE_STEPS; ++step) {
        next.clear();
        for (int p : front)
            for (int q : gatherer.linked[size_t(p)]) {
                if (q == to) return true;
                if (gatherer.seen[size_t(q)] == mark) continue;
                gatherer.seen[size_t(q)] = mark;
                next.push_back(q);
            }
        front.swap(next);
    }
    return false;
}

// Joins two walls of a body, or two faces of a sheet.
static void gather_walls(Gatherer& gatherer, const std::vector<int>& in_cell) {
    const double gap = FACE_GAP * gatherer.voxels.lattice.cell_size;
    for (size_t i = 0; i < in_cell.size(); ++i)
        for (size_t k = i + 1; k < in_cell.size(); ++k) {
            const int a = in_cell[i], b = in_cell[k];
            const int entry_a = gatherer.pieces.entries[size_t(gatherer.pieces.first[size_t(a)])];
            const int entry_b = gatherer.pieces.entries[size_t(gatherer.pieces.first[size_t(b)])];
            if (!gatherer.is_triangle(entry_a) || !gatherer.is_triangle(entry_b)) continue;

            if (gatherer.sets.find(a) == gatherer.sets.find(b)) continue;
            const Nearness nearness = measure_nearness(gatherer, a, b);
            if (face_through_inside(gatherer, nearness) ||
                (nearness.squared < gap * gap && is_near_along(gatherer, a, b)))
                gatherer.sets.join(a, b);
        }
}

// Lists the components in a part that are not small; if there are none, `scrap_of` is the one that the part hangs on.
static std::vector<int> list_components(const Gatherer& gatherer, int piece, int& scrap_of) {
    std::vector<int> components;
    scrap_of = -1;
    for (int n = gatherer.pieces.first[size_t(piece)]; n < gatherer.pieces.first[size_t(piece) + 1]; ++n) {
        const int entry = gatherer.pieces.entries[size_t(n)];
        if (!gatherer.is_triangle(entry)) continue;
        const int component = gatherer.component(entry), host = gatherer.host[size_t(component)];
        if (host != component)
            scrap_of = host;
        else if (components.empty() || components.back() != component)
            components.push_back(component);
    }
    if (!components.empty()) scrap_of = -1;
    return components;
}

// Joins parts of small components to the nearest part of the component they hang on; without one, to each other.
static void gather_scraps(Gatherer& gatherer, const std::vector<int>& in_cell) {
    std::vector<int> scrap_of(in_cell.size());
    std::vector<std::array<int, 2>> large;  // component, part
    for (size_t i = 0; i < in_cell.size(); ++i)
        for (int component : list_components(gatherer, in_cell[i], scrap_of[i]))
            large.push_back({component, in_cell[i]});
    sort_unique(large);
    std::vector<std::array<int, 2>> first_scrap;  // host, part
    for (size_t i = 0; i < in_cell.size(); ++i) {
        if (scrap_of[i] < 0) continue;
        double best = std::numeric_limits<double>::infinity();
        int nearest = -1;
        const auto begin = std::lower_bound(large.begin(), large.end(), std::array<int, 2>{scrap_of[i], -1});
        for (auto k = begin; k != large.end() && (*k)[0] == scrap_of[i]; ++k) {
            const double squared = measure_nearness(gatherer, in_cell[i], (*k)[1]).squared;
            if (nearest >= 0 && squared >= best) continue;
            best = squared;
            nearest = (*k)[1];
        }
        if (nearest < 0) {
            for (const auto& [host, piece] : first_scrap)
                if (host == scrap_of[i]) nearest = piece;
            if (nearest < 0) first_scrap.push_back({scrap_of[i], in_cell[i]});
        }
        if (nearest >= 0) gatherer.sets.join(in_cell[i], nearest);
    }
}

Pieces find_pieces(const Topology& topology, const Patches& patches, const Voxels& voxels) {
    UnionFind sets(voxels.item.size());
    join_touching(topology, patches, voxels, sets);
    Pieces pieces;
    number(voxels, sets, pieces);
    link(voxels, pieces);

    Gatherer gatherer{topology,
                      patches,
                      voxels,
                      pieces,
                      find_hosts(topology, voxels.lattice.cell_size),
                      UnionFind(size_t(pieces.count)),
                      {},
                      std::vector<int>(size_t(pieces.count), 0)};
    gatherer.linked.resize(size_t(pieces.count));
    for (const auto& [a, b] : pieces.links) {
        gatherer.linked[size_t(a)].push_back(b);
        gatherer.linked[size_t(b)].push_back(a);
    }
    std::vector<int> in_cell;
    for (size_t cell = 0; cell + 1 < voxels.first.size(); ++cell) {
        // Parts are numbered by their first entry, so those of a cell have consecutive numbers.
        in_cell.clear();
        for (int e = voxels.first[cell]; e < voxels.first[cell + 1]; ++e)
            if (in_cell.empty() || pieces.entry_piece[size_t(e)] > in_cell.back())
                in_cell.push_back(pieces.entry_piece[size_t(e)]);
        if (in_cell.size() < 2) continue;
        gather_walls(gatherer, in_cell);
        gather_scraps(gatherer, in_cell);
    }
    for (size_t e = 0; e < voxels.item.size(); ++e)
        if (const int p = gatherer.sets.find(pieces.entry_piece[e]); p != pieces.entry_piece[e])
            sets.join(pieces.entries[size_t(pieces.first[size_t(p)])], int(e));
    Pieces gathered;
    number(voxels, sets, gathered);
    link(voxels, gathered);
    return gathered;
}

}  // namespace frond
