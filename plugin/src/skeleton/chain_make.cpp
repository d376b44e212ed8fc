// Chain making. In: a surface with its topology and organs. Out: nodes and capsules.
// 1. Distance along the surface from the root. 2. Bands of one height, cut into connected slabs, sheets apart from
// tubes. 3. A tree over the slabs. 4. A node at the end of each slab, a radius from its moments; slabs too short for a
// capsule become part of their parent. If no height is given, 2 to 4 are repeated until the number of capsules is
// reasonable.
#include <algorithm>
#include <array>
#include <climits>
#include <cmath>

#include "core/assert.hpp"
#include "core/error.hpp"
#include "skeleton/chain.hpp"
#include "skeleton/chain_bind.hpp"
#include "skeleton/chain_ribs.hpp"
#include "skeleton/chain_ties.hpp"
#include "skeleton/chain_tree.hpp"

namespace frond {

namespace {

constexpr double USUAL_COUNT = 25;    // capsules along the longest path
constexpr int FEW = 24, MANY = 400;   // least and most capsules, if the height may be chosen
constexpr double MOST_BANDS = 20000;  // along the longest path
constexpr double MOST_FRAGMENTS = 2e7;
constexpr std::array<double, 3> LOOSE = {0.5, 1, 2};  // in bands: smaller loose parts are dropped; the first is usual
constexpr double SHORT_TIP = 0.2;                     // in bands: a shorter slab at a tip gets no capsule
constexpr double SHORT_PIECE = 0.15;                  // in bands: nor does a shorter one in between
constexpr double SAME_PLACE = 0.01;                   // in bands: roots no farther apart are one

// Returns the group of a kind. Sheets, fruits and supports are cut apart from tubes, so that a leaf does not displace
// the stem's node.
int group_of_kind(const std::string& kind) {
    if (kind == "blade" || kind == "midrib" || kind == "flower" || kind == "crown") return 1;
    if (kind == "fruit") return 2;
    if (kind == "support") return SUPPORT_GROUP;
    return 0;
}

struct Shape {
    const Surface& surface;
    const Topology& topology;
    std::vector<int> group, organ;  // group and organ of each triangle
    std::vector<SharedEdge> edges;
    std::vector<int> roots;        // points
    std::vector<Joint> ties;       // see find_ties()
    std::vector<double> distance;  // distances of points [m]
    double farthest;               // [m]
};

// Area and moments of the surface that a node's capsule represents.
struct Moments {
    double area = 0;
    Vec3 sum = Vec3::Zero();
    Mat3 square = Mat3::Zero();
    void add(const Piece& piece) {
        area += piece.area;
        sum += piece.sum;
        square += piece.square;
    }
    // Returns the root of the mean squared distance from a line [m].
    double distance_from(const Vec3& place, const Vec3& direction) const {
        if (!(area > 0)) return 0;
        const Mat3 second = square / area - place * (sum / area).transpose() - (sum / area) * place.transpose() +
                            place * place.transpose();
        return std::sqrt(std::max(0.0, second.trace() - direction.dot(second * direction)));
    }
};

struct Maker {
    const Shape& shape;
    const Bands& bands;
    const ChainTree& tree;
    Chain chain = {};
    SlabNodes slabs = {};
    std::vector<Moments> moments = {};
    std::vector<char> is_foot = {};

    // Returns the root at a place, a new one unless there is one already.
    int root_at(const Vec3& position, int organ) {
        for (size_t i = 0; i < chain.nodes.size(); i++)
            if (is_foot[i] && (chain.nodes[i].position - position).norm() <= SAME_PLACE * bands.height) return int(i);
        return add_node(position, -1, organ);
    }

    int add_node(const Vec3& position, int parent, int organ) {
        const double distance = parent < 0 ? 0
                                           : chain.nodes[size_t(parent)].distance +
                                                 (position - chain.nodes[size_t(parent)].position).norm();
        chain.nodes.push_back({position, 0, parent, organ, distance, 0});
        moments.emplace_back();
        is_foot.push_back(parent < 0);
        return int(chain.nodes.size()) - 1;
    }
};

// Returns the node that a slab grows from: the end of its parent, or the parent's beginning if the link is nearer to
// that.
int node_below(const Maker& maker, const Shoot& shoot) {
    const int node = maker.slabs.node[size_t(shoot.parent)];
    const SlabLink& link = maker.tree.links[size_t(shoot.link)];
    const int before = maker.chain.nodes[size_t(node)].parent;
    if (link.level || before < 0) return node;
    const double to_end = (maker.chain.nodes[size_t(node)].position - link.middle).squaredNorm();
    const double to_begin = (maker.chain.nodes[size_t(before)].position - link.middle).squaredNorm();
    return to_begin < to_end ? before : node;
}

void make_nodes(Maker& maker) {
    const Bands& bands = maker.bands;
    maker.slabs.node.assign(bands.pieces.size(), -1);
    maker.slabs.owns.assign(bands.pieces.size(), 0);
    for (int number : maker.tree.order) {
        const Shoot& shoot = maker.tree.shoots[size_t(number)];
        const Piece& piece = bands.pieces[size_t(number)];
        const int below =
            shoot.parent < 0 ? maker.root_at(maker.tree.foot[size_t(number)], piece.organ) : node_below(maker, shoot);
        const double step = (shoot.end - maker.chain.nodes[size_t(below)].position).norm();
        const bool tip = shoot.children == 0;
        const bool same = shoot.parent >= 0 && bands.pieces[size_t(shoot.parent)].component == piece.component &&
                          bands.pieces[size_t(shoot.parent)].group == piece.group;
        if (shoot.dropped || step < (tip ? SHORT_TIP : SHORT_PIECE) * bands.height) {
            // The slab joins the capsule below; if nothing else continues from there, that capsule is extended to this
            // end.
            maker.slabs.node[size_t(number)] = below;
            maker.moments[size_t(below)].add(piece);
            if (!shoot.dropped && tip && same && !maker.is_foot[size_t(below)] &&
                maker.tree.shoots[size_t(shoot.parent)].children == 1 &&
                below == maker.slabs.node[size_t(shoot.parent)])
                maker.chain.nodes[size_t(below)].position = shoot.end;
            continue;
        }
        const int node = maker.add_node(shoot.end, below, piece.organ);
        maker.slabs.node[size_t(number)] = node;
        maker.slabs.owns[size_t(number)] = 1;
        maker.moments[size_t(node)].add(piece);
    }
}

// Closes the loops of stems and supports.
void close_loops(Maker& maker) {
    const std::vector<ChainNode>& nodes = maker.chain.nodes;
    for (const SlabLink& link : links_beside_ties(maker.bands, maker.tree)) {
        const int below = maker.slabs.node[size_t(link.low)], above = maker.slabs.node[size_t(link.high)];
        if (nodes[size_t(below)].parent < 0 || below >= above || nodes[size_t(above)].parent == below) continue;
        if ((nodes[size_t(above)].position - nodes[size_t(below)].position).norm() > SHORT_PIECE * maker.bands.height)
            maker.chain.loops.push_back({below, above});
    }
}

// Gives a chain that has only feet, and so cannot bend, one capsule: to the point farthest from the first foot.
void add_last_resort(Maker& maker) {
    for (const ChainNode& node : maker.chain.nodes)
        if (node.parent >= 0) return;
    const Vec3 foot = maker.chain.nodes.front().position;
    Vec3 farthest = foot;
    for (const Vec3& place : maker.shape.topology.points)
        if ((place - foot).squaredNorm() > (farthest - foot).squaredNorm()) farthest = place;
    const Moments all = maker.moments.front();
    const int organ = maker.chain.nodes.front().organ;
    maker.slabs.last_resort = maker.add_node(farthest, 0, organ);
    maker.moments[size_t(maker.slabs.last_resort)] = all;
}

void fit_radii(Maker& maker, const std::vector<Organ>& organs, double given) {
    const double unit = std::min(maker.bands.height, maker.shape.farthest);
    std::vector<ChainNode>& nodes = maker.chain.nodes;
    for (size_t i = 0; i < nodes.size(); i++) {
        ChainNode& node = nodes[i];
        // A tip may have moved after its children's distances were computed.
        if (node.parent >= 0)
            node.distance =
                nodes[size_t(node.parent)].distance + (node.position - nodes[size_t(node.parent)].position).norm();
        if (node.parent < 0) continue;
        const Vec3 begin = nodes[size_t(node.parent)].position;
        const double fitted =
            maker.moments[i].distance_from(begin - maker.bands.origin, (node.position - begin).normalized());
        const bool known = node.organ >= 0 && size_t(node.organ) < organs.size();
        const double least = known ? 0.5 * organs[size_t(node.organ)].material.thickness : 0;
        node.fitted_radius = std::max({fitted, std::min(least, 0.25 * unit), 1e-3 * unit});
    }
    // A foot is as thick as the first capsule that grows from it.
    for (size_t i = nodes.size(); i-- > 0;)
        if (nodes[i].parent >= 0 && nodes[size_t(nodes[i].parent)].parent < 0)
            nodes[size_t(nodes[i].parent)].fitted_radius = nodes[i].fitted_radius;
    for (ChainNode& node : nodes) {
        if (node.fitted_radius <= 0) node.fitted_radius = 0.1 * unit;
        node.radius = given > 0 ? given : node.fitted_radius;
    }
}

bool parents_come_first(const Chain& chain) {
    for (size_t i = 0; i < chain.nodes.size(); i++)
        if (chain.nodes[i].parent < -1 || chain.nodes[i].parent >= int(i)) return false;
    return true;
}

// Makes the chain for one height. Larger loose parts than usual are dropped while there are more than `most` capsules.
Chain make_with_height(const Shape& shape, const std::vector<Organ>& organs, double height, double radius, int most) {
    const Bands bands = cut_bands(shape.topology, shape.edges, shape.distance, shape.group, shape.organ, height);
    const ChainTree grown = grow_tree(shape.topology, bands, shape.roots, shape.ties);
    for (const double loose : LOOSE) {
        ChainTree tree = grown;
        prune_tree(bands, tree, loose);
        Maker maker{shape, bands, tree};
        make_nodes(maker);
        close_loops(maker);
        const int capsules = int(maker.chain.nodes.size()) - maker.chain.root_count();
        if (capsules > most && loose != LOOSE.back()) continue;
        add_last_resort(maker);
        fit_radii(maker, organs, radius);
        bind_vertices(shape.surface, shape.topology, bands, tree, maker.slabs, maker.chain);
        join_ribs(shape.surface, organs, maker.chain);
        FROND_ASSERT(parents_come_first(maker.chain));
        FROND_ASSERT(maker.chain.vertex_capsule.size() == shape.surface.positions.size());
        maker.chain.height = height;
        return std::move(maker.chain);
    }
    return {};
}

Shape measure_shape(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
                    const std::vector<int>& rooted) {
    Shape shape{surface, topology, {}, {}, {}, {}, find_ties(surface, topology, organs), {}, 0};
    shape.group.assign(topology.triangles.size(), 0);
    shape.organ.assign(topology.triangles.size(), -1);
    for (const Part& part : surface.parts) {
        if (part.organ < 0) continue;
        const bool known = size_t(part.organ) < organs.size();
        std::fill_n(shape.organ.begin() + part.first_triangle, part.triangle_count, part.organ);
        std::fill_n(shape.group.begin() + part.first_triangle, part.triangle_count,
                    known ? group_of_kind(organs[size_t(part.organ)].kind) : 0);
    }
    shape.edges = find_shared_edges(topology);
    RootPoints roots = find_root_points(surface, topology, organs, rooted);
    shape.distance = measure_distances(topology, roots.points, roots.heights);
    shape.roots = std::move(roots.points);
    shape.farthest = *std::max_element(shape.distance.begin(), shape.distance.end());
    // All points are roots: a plate on the ground.
    if (!(shape.farthest > 0)) shape.farthest = surface.size();
    return shape;
}

void check_height(const Shape& shape, double height) {
    if (shape.farthest / height <= MOST_BANDS &&
        count_fragments(shape.topology, shape.distance, height) <= MOST_FRAGMENTS)
        return;
    fail(FROND_RESULT_BAD_ARGUMENT,
         "capsule_height %g m is too small for a plant with ways of %g m; give more, or 0 to let Frond choose", height,
         shape.farthest);
}

}  // namespace

Chain make_chain(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
                 const ChainOptions& options) {
    if (topology.triangles.empty() || topology.triangles.size() != surface.triangles.size())
        fail(FROND_RESULT_BAD_GEOMETRY, "the model has no triangles; give at least one with area");
    if (!(options.height >= 0 && options.height < INFINITY))
        fail(FROND_RESULT_BAD_ARGUMENT, "capsule_height is %g; give a length in metres, or 0 to let Frond choose",
             options.height);
    if (!(options.radius >= 0 && options.radius < INFINITY))
        fail(FROND_RESULT_BAD_ARGUMENT, "capsule_radius is %g; give a length in metres, or 0 to fit the shape",
             options.radius);
    const Shape shape = measure_shape(surface, topology, organs, options.rooted);
    if (options.height > 0) {
        check_height(shape, options.height);
        return make_with_height(shape, organs, options.height, options.radius, INT_MAX);
    }

    // Starts from the longest path; capsules get shorter while there are few (twice at most), longer while there are
    // many.
    double height = shape.farthest / USUAL_COUNT;
    bool grew = false;
    for (int attempt = 0;; attempt++) {
        Chain chain = make_with_height(shape, organs, height, options.radius, MANY);
        const int capsules = int(chain.nodes.size()) - chain.root_count();
        if (capsules > MANY && height < shape.farthest / 3 && attempt < 7) {
            height *= std::clamp(capsules / (0.75 * MANY), 1.25, 1.6);
            grew = true;
        } else if (capsules < FEW && !grew && attempt < 2) {
            height *= 0.6;
        } else {
            return chain;
        }
    }
}

Chain make_chain(const Surface& surface, const Topology& topology, const ChainOptions& options) {
    return make_chain(surface, topology, {}, options);
}

}  // namespace frond
