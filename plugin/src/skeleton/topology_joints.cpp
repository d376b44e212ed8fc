// Joints. In: components. Out: a spanning tree of the nearest points between them. Boruvka's algorithm (1926): in each
// round, every tree that does not hold a root yet finds its cheapest edge to another one, so that their number halves.
// Distances come from one box tree per component and one over all components, searched nearest first.
//
// A joint costs its length and a little more, so that a leaf that crosses other leaves and almost touches its stem
// hangs on the stem: more if the other end is no larger than this one, and more if this end is not the largest of its
// tree. Components that stand on the ground side by side are roots: each first collects what hangs on it, and only then
// are they tied to each other, at the foot, where that does no harm.
#include "skeleton/topology_joints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "surface/box_tree.hpp"

namespace frond {

// Cost of hanging on another component, as a share of one's own size. It falls with the ratio of sizes if the other one
// is more than 1 / ALIKE times as large.
static constexpr double LIKENESS = 0.1, ALIKE = 0.5;
// Cost of joining a tree by a component that is not its largest, as a share of the difference in size.
static constexpr double HEAD = 0.1;
// A root begins no higher than the first share of the plant's height and is at least as high as the second.
static constexpr double ROOT_FOOT = 0.02, ROOT_HEIGHT = 0.4;
static constexpr double INFINITE = std::numeric_limits<double>::infinity();

namespace {

struct Edge {
    double cost = INFINITE;  // without the HEAD cost
    int item_a = -1, item_b = -1;
    Joint joint{-1, -1, Vec3::Zero(), Vec3::Zero()};
};

// Lower bound of the cost of anything below a node.
struct Promise {
    double cost;
    int item, node;  // item -1: a node of the tree over the items, else of that item's triangles
    // Puts the cheapest on top of a heap; equal ones are ordered by number.
    bool operator<(const Promise& other) const {
        if (cost != other.cost) return cost > other.cost;
        return item != other.item ? item > other.item : node > other.node;
    }
};

// Items to be joined, each a list of triangles.
struct Forest {
    const Topology& topology;
    double likeness, head;
    std::vector<std::vector<int>> item_triangles;
    std::vector<char> is_root;  // for each item whether it is a root

    std::vector<Box> triangle_box;
    BoxTree triangle_tree;       // one tree per item
    std::vector<int> item_tree;  // root of each item's tree
    std::vector<Box> item_box;
    std::vector<double> item_size;  // [m]
    std::vector<int> by_size;       // items, the largest first
    BoxTree tree;                   // over the items
    std::vector<double> largest;    // size of the largest item below each node of that tree [m]

    std::vector<int> parent;     // union-find
    std::vector<int> node_set;   // the set of all items below a node, or -1 if they differ
    std::vector<Edge> cheapest;  // cheapest edge that each item has found
    std::vector<Promise> heap;   // heap of a search
    std::vector<double> least;   // lower bound of the cost of each item's edges not found yet

    Forest(const Topology& t, double like, double first) : topology(t), likeness(like), head(first) {}
    int set_of(int item) {
        while (parent[size_t(item)] != item) item = parent[size_t(item)] = parent[size_t(parent[size_t(item)])];
        return item;
    }
};

}  // namespace

// Returns the cost of an item for hanging on another one.
static double likeness_cost(const Forest& forest, double size, double other) {
    return forest.likeness * size * (size < ALIKE * other ? size / other : 1);
}

static void plant_trees(Forest& forest) {
    const size_t item_count = forest.item_triangles.size();
    forest.triangle_box.resize(forest.topology.triangles.size());
    for (const std::vector<int>& triangles : forest.item_triangles) {
        for (int t : triangles)
            for (const Vec3& corner : corners_of(forest.topology, t)) forest.triangle_box[size_t(t)].extend(corner);
        forest.item_tree.push_back(grow_tree(forest.triangle_tree, forest.triangle_box, triangles, 2));
        forest.item_box.push_back(forest.triangle_tree.nodes[size_t(forest.item_tree.back())].box);
        forest.item_size.push_back(forest.item_box.back().diagonal().norm());
    }
    forest.tree = make_box_tree(forest.item_box, 1);
    const size_t node_count = forest.tree.nodes.size();
    forest.largest.resize(node_count);
    for (size_t n = node_count; n-- > 0;) {
        const BoxTree::Node& node = forest.tree.nodes[n];
        if (node.right < 0) {
            forest.largest[n] = forest.item_size[size_t(forest.tree.items[size_t(node.first)])];
        } else {
            forest.largest[n] = std::max(forest.largest[n + 1], forest.largest[size_t(node.right)]);
        }
    }
    forest.parent.resize(item_count);
    std::iota(forest.parent.begin(), forest.parent.end(), 0);
    forest.node_set.resize(node_count);
    forest.by_size = forest.parent;
    std::stable_sort(forest.by_size.begin(), forest.by_size.end(),
                     [&](int a, int b) { return forest.item_size[size_t(a)] > forest.item_size[size_t(b)]; });
    forest.cheapest.resize(item_count);
    forest.least.assign(item_count, 0);
}

// Tests cheaply, to avoid most exact tests: along the line of the nearest points so far, and along both normals.
static bool are_farther(const Corners& a, const Corners& b, const Vec3& way, double bound) {
    return are_apart(a, b, way, bound) || are_apart(a, b, (a[1] - a[0]).cross(a[2] - a[0]), bound) ||
           are_apart(a, b, (b[1] - b[0]).cross(b[2] - b[0]), bound);
}

// Finds the nearest pair of triangles below two nodes, if nearer than `bound` [m^2], which is lowered.
static void find_nearest(const Forest& forest, int node_a, int node_b, double& bound, Joint& joint) {
    const BoxTree::Node& a = forest.triangle_tree.nodes[size_t(node_a)];
    const BoxTree::Node& b = forest.triangle_tree.nodes[size_t(node_b)];
    if (a.right < 0 && b.right < 0) {
        for (int i = a.first; i < a.first + a.count; ++i)
            for (int k = b.first; k < b.first + b.count; ++k) {
                const int t = forest.triangle_tree.items[size_t(i)], u = forest.triangle_tree.items[size_t(k)];
                if (forest.triangle_box[size_t(t)].squaredExteriorDistance(forest.triangle_box[size_t(u)]) >= bound)
                    continue;
                const Corners corners_t = corners_of(forest.topology, t), corners_u = corners_of(forest.topology, u);
                if (are_farther(corners_t, corners_u, joint.point_b - joint.point_a, bound)) continue;
                const NearestPair pair = nearest_of_triangles(corners_t, corners_u);
                if (pair.squared >= bound) continue;
                bound = pair.squared;
                joint = {t, u, pair.a, pair.b};
            }
        return;
    }
    // Opens the larger of the two, its nearer half first; if both halves overlap the other, that with the nearer
    // centre.
    const bool open_a =
        b.right < 0 || (a.right >= 0 && a.box.diagonal().squaredNorm() > b.box.diagonal().squaredNorm());
    int near = (open_a ? node_a : node_b) + 1, far = open_a ? a.right : b.right;
    const Box& other = open_a ? b.box : a.box;
    const auto distance_of = [&](int half) {
        const Box& box = forest.triangle_tree.nodes[size_t(half)].box;
        return std::make_pair(box.squaredExteriorDistance(other), (box.center() - other.center()).squaredNorm());
    };
    std::pair<double, double> near_distance = distance_of(near), far_distance = distance_of(far);
    if (far_distance < near_distance) {
        std::swap(near, far);
        std::swap(near_distance, far_distance);
    }
    if (near_distance.first < bound) find_nearest(forest, open_a ? near : node_a, open_a ? node_b : near, bound, joint);
    if (far_distance.first < bound) find_nearest(forest, open_a ? far : node_a, open_a ? node_b : far, bound, joint);
}

// Tries a part of another item as the end of a cheaper edge.
static void try_part(const Forest& forest, int item, const Promise& part, Edge& best) {
    const double fixed = likeness_cost(forest, forest.item_size[size_t(item)], forest.item_size[size_t(part.item)]);
    if (fixed >= best.cost) return;
    double bound = (best.cost - fixed) * (best.cost - fixed);
    Joint joint{-1, -1, Vec3::Zero(), Vec3::Zero()};
    find_nearest(forest, forest.item_tree[size_t(item)], part.node, bound, joint);
    if (joint.triangle_a < 0) return;
    const double cost = std::sqrt(bound) + fixed;
    if (cost < best.cost) best = {cost, item, part.item, joint};
}

// Finds the cheapest edge from an item to another set, if cheaper than `best`. The node with the lowest bound is opened
// first, in the tree over the items and then in their triangles' trees: the item's own stem before all leaves around.
static void search(Forest& forest, int item, int set, Edge& best) {
    std::vector<Promise>& heap = forest.heap;
    heap.clear();
    const Box& box = forest.item_box[size_t(item)];
    const double size = forest.item_size[size_t(item)];
    const auto offer = [&](int other, int node) {
        if (other < 0 && forest.node_set[size_t(node)] == set) return;
        const BoxTree& tree = other < 0 ? forest.tree : forest.triangle_tree;
        const double largest = other < 0 ? forest.largest[size_t(node)] : forest.item_size[size_t(other)];
        const double least = tree.nodes[size_t(node)].box.exteriorDistance(box) + likeness_cost(forest, size, largest);
        if (least >= best.cost) return;
        heap.push_back({least, other, node});
        std::push_heap(heap.begin(), heap.end());
    };
    offer(-1, 0);
    while (!heap.empty() && heap.front().cost < best.cost) {
        const Promise top = heap.front();
        std::pop_heap(heap.begin(), heap.end());
        heap.pop_back();
        const BoxTree::Node& node = (top.item < 0 ? forest.tree : forest.triangle_tree).nodes[size_t(top.node)];
        if (top.item < 0 && node.right < 0) {
            const int other = forest.tree.items[size_t(node.first)];
            offer(other, forest.item_tree[size_t(other)]);
        } else if (top.item >= 0 && (node.right < 0 || node.box.diagonal().norm() < size)) {
            try_part(forest, item, top, best);
        } else {
            offer(top.item, top.node + 1);
            offer(top.item, node.right);
        }
    }
}

// Finds the cheapest edge out of each set that holds no root; indexed by the set's first item.
static std::vector<Edge> find_cheapest(Forest& forest, const std::vector<char>& rooted) {
    const int item_count = int(forest.parent.size());
    for (size_t n = forest.tree.nodes.size(); n-- > 0;) {
        const BoxTree::Node& node = forest.tree.nodes[n];
        const int left = node.right < 0 ? forest.set_of(forest.tree.items[size_t(node.first)]) : forest.node_set[n + 1];
        const int right = node.right < 0 ? left : forest.node_set[size_t(node.right)];
        forest.node_set[n] = left == right ? left : -1;
    }
    std::vector<Edge> best(static_cast<size_t>(item_count));
    std::vector<double> head_size(size_t(item_count), 0);
    for (int i = 0; i < item_count; ++i) {
        double& size = head_size[size_t(forest.set_of(i))];
        size = std::max(size, forest.item_size[size_t(i)]);
    }
    // Edges known from earlier rounds and the largest items come first: that saves most of the searches.
    for (const bool known : {true, false}) {
        for (int i : forest.by_size) {
            const int set = forest.set_of(i);
            if (rooted[size_t(set)]) continue;
            Edge& cheapest = forest.cheapest[size_t(i)];
            Edge& found = best[size_t(set)];
            const double head_cost = forest.head * (head_size[size_t(set)] - forest.item_size[size_t(i)]);
            const bool stands = cheapest.item_b >= 0 && forest.set_of(cheapest.item_b) != set;
            if (!known && !stands && forest.least[size_t(i)] + head_cost < found.cost) {
                cheapest = {};
                cheapest.cost = found.cost - head_cost;
                search(forest, i, set, cheapest);
                forest.least[size_t(i)] = cheapest.cost;
            } else if (!stands) {
                continue;
            }
            if (cheapest.item_b < 0 || cheapest.cost + head_cost >= found.cost) continue;
            found = cheapest;
            found.cost += head_cost;
        }
    }
    return best;
}

// Joins the items until every set holds a root.
static std::vector<Edge> grow_forest(Forest& forest) {
    plant_trees(forest);
    std::vector<Edge> edges;
    std::vector<char> rooted = forest.is_root;
    for (bool grown = true; grown;) {
        grown = false;
        for (const Edge& edge : find_cheapest(forest, rooted)) {
            if (edge.item_a < 0 || rooted[size_t(forest.set_of(edge.item_a))]) continue;
            const int a = forest.set_of(edge.item_a), b = forest.set_of(edge.item_b);
            if (a == b) continue;
            forest.parent[size_t(std::max(a, b))] = std::min(a, b);
            rooted[size_t(std::min(a, b))] = rooted[size_t(a)] || rooted[size_t(b)];
            edges.push_back(edge);
            grown = true;
        }
    }
    return edges;
}

// Finds components that begin at the foot of the plant and are high enough to be stems; else the largest one.
static std::vector<char> find_roots(const Topology& topology, const std::vector<Box>& boxes) {
    Box all;
    for (const Box& box : boxes) all.extend(box);
    const double height = all.sizes().y(), foot = all.min().y() + ROOT_FOOT * height;
    std::vector<char> is_root(size_t(topology.component_count), 0);
    size_t largest = 0;
    int count = 0;
    for (size_t c = 0; c < boxes.size(); ++c) {
        is_root[c] = boxes[c].min().y() <= foot && boxes[c].sizes().y() >= ROOT_HEIGHT * height && height > 0;
        count += is_root[c];
        if (boxes[c].diagonal().squaredNorm() > boxes[largest].diagonal().squaredNorm()) largest = c;
    }
    if (count == 0) is_root[largest] = 1;
    return is_root;
}

// Ties the roots to each other at their feet, by length alone.
static std::vector<Edge> tie_roots(const Topology& topology, const Forest& grown) {
    Forest feet(topology, 0, 0);
    double lower = INFINITE, upper = -INFINITE;
    for (const Box& box : grown.item_box) {
        lower = std::min(lower, box.min().y());
        upper = std::max(upper, box.max().y());
    }
    for (size_t c = 0; c < grown.is_root.size(); ++c) {
        if (!grown.is_root[c]) continue;
        const double limit = std::max(grown.item_box[c].min().y(), lower + ROOT_FOOT * (upper - lower));
        std::vector<int> triangles;
        for (int t : grown.item_triangles[c])
            if (grown.triangle_box[size_t(t)].min().y() <= limit) triangles.push_back(t);
        feet.item_triangles.push_back(std::move(triangles));
    }
    if (feet.item_triangles.size() < 2) return {};
    feet.is_root.assign(feet.item_triangles.size(), 0);
    feet.is_root[0] = 1;
    return grow_forest(feet);
}

void join_components(Topology& topology) {
    topology.joints.clear();
    if (topology.component_count < 2) return;
    Forest forest(topology, LIKENESS, HEAD);
    forest.item_triangles.resize(size_t(topology.component_count));
    for (size_t t = 0; t < topology.triangles.size(); ++t)
        forest.item_triangles[size_t(topology.triangle_component[t])].push_back(int(t));
    std::vector<Box> boxes(size_t(topology.component_count));
    for (size_t t = 0; t < topology.triangles.size(); ++t)
        for (const Vec3& corner : corners_of(topology, int(t)))
            boxes[size_t(topology.triangle_component[t])].extend(corner);
    forest.is_root = find_roots(topology, boxes);

    std::vector<Edge> edges = grow_forest(forest);
    for (const Edge& edge : tie_roots(topology, forest)) edges.push_back(edge);
    for (const Edge& edge : edges) topology.joints.push_back(edge.joint);
}

}  // namespace frond
