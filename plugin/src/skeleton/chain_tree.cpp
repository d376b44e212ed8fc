// Chain tree. In: bands and root points. Out: a forest over their slabs, with the end of each slab's capsule.
#include "skeleton/chain_tree.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "core/assert.hpp"

namespace frond {

namespace {

constexpr double TINY = 0.5;  // in bands: shorter side twigs are dropped

// Lists of links by slab.
struct Around {
    std::vector<int> first, link;
};

Around links_of_pieces(size_t piece_count, const std::vector<SlabLink>& links) {
    Around around;
    around.first.assign(piece_count + 1, 0);
    for (const SlabLink& c : links) {
        around.first[size_t(c.low) + 1]++;
        around.first[size_t(c.high) + 1]++;
    }
    for (size_t i = 0; i < piece_count; i++) around.first[i + 1] += around.first[i];
    around.link.resize(size_t(around.first[piece_count]));
    std::vector<int> next(around.first.begin(), around.first.end() - 1);
    for (size_t i = 0; i < links.size(); i++)
        for (int piece : {links[i].low, links[i].high}) around.link[size_t(next[size_t(piece)]++)] = int(i);
    return around;
}

// Returns the distance at a point of a triangle, linear between its corners, from the start of its component.
double distance_at(const Topology& topology, const Bands& bands, int triangle, const Vec3& place) {
    const Triangle& t = topology.triangles[size_t(triangle)];
    const Vec3 &a = topology.points[size_t(t[0])], &b = topology.points[size_t(t[1])],
               &c = topology.points[size_t(t[2])];
    const Vec3 normal = (b - a).cross(c - a);
    const double area = normal.squaredNorm();
    double wb = 1.0 / 3, wc = 1.0 / 3;
    if (area > 0) {
        wb = std::clamp((place - a).cross(c - a).dot(normal) / area, 0.0, 1.0);
        wc = std::clamp((b - a).cross(place - a).dot(normal) / area, 0.0, 1.0);
    }
    const double da = bands.distance[size_t(t[0])], db = bands.distance[size_t(t[1])],
                 dc = bands.distance[size_t(t[2])];
    return da + wb * (db - da) + wc * (dc - da) - bands.entry[size_t(topology.triangle_component[size_t(triangle)])];
}

// Adds a link for each joint: of length 0 for a tie, as at a shared corner, and -1 for what only keeps the plant
// together.
void add_joints(const Topology& topology, const Bands& bands, const std::vector<Joint>& joints, double length,
                std::vector<SlabLink>& links) {
    for (const Joint& joint : joints) {
        const int a = bands.piece_at(joint.triangle_a, distance_at(topology, bands, joint.triangle_a, joint.point_a));
        const int b = bands.piece_at(joint.triangle_b, distance_at(topology, bands, joint.triangle_b, joint.point_b));
        links.push_back({a, b, length, 0.5 * (joint.point_a + joint.point_b), false});
    }
}

bool is_tie(const Bands& bands, const SlabLink& link) {
    const bool low = bands.pieces[size_t(link.low)].group == SUPPORT_GROUP,
               high = bands.pieces[size_t(link.high)].group == SUPPORT_GROUP;
    return low != high && link.length >= 0;
}

// Orders links: ties to a support first, then level ones before sides before joints; then the longest.
bool is_better(const Bands& bands, const SlabLink& a, const SlabLink& b) {
    const bool tie_a = is_tie(bands, a), tie_b = is_tie(bands, b);
    if (tie_a != tie_b) return tie_a;
    if (a.level != b.level) return a.level;
    return a.length > b.length;
}

// Finds the slabs that hold root points and have nothing below them, and their feet, under the middle of those points.
std::vector<char> find_feet(const Topology& topology, const Bands& bands, const std::vector<int>& roots,
                            ChainTree& tree) {
    std::vector<char> is_root(topology.points.size(), 0), rooted(bands.pieces.size(), 0), above(bands.pieces.size(), 0);
    for (int root : roots) is_root[size_t(root)] = 1;
    for (const SlabLink& link : bands.links)
        if (link.level && link.length > 0) above[size_t(link.high)] = 1;
    std::vector<double> weight(bands.pieces.size(), 0.0), lowest(bands.pieces.size(), INFINITY);
    tree.foot.assign(bands.pieces.size(), Vec3::Zero());
    for (size_t t = 0; t < topology.triangles.size(); t++)
        for (int p : topology.triangles[t]) {
            if (!is_root[size_t(p)]) continue;
            const double entry = bands.entry[size_t(topology.triangle_component[t])];
            const size_t piece = size_t(bands.piece_at(int(t), bands.distance[size_t(p)] - entry));
            if (above[piece]) continue;
            is_root[size_t(p)] = 0;  // each point counts once
            rooted[piece] = 1;
            weight[piece] += 1;
            tree.foot[piece] += topology.points[size_t(p)];
            lowest[piece] = std::min(lowest[piece], topology.points[size_t(p)].y());
        }
    for (size_t i = 0; i < rooted.size(); i++) {
        if (!rooted[i]) continue;
        tree.foot[i] /= weight[i];
        tree.foot[i].y() = lowest[i];
    }
    return rooted;
}

// Returns the end of a slab's capsule: the middle of the level line where it goes on (where it forks, the widest line
// counts most), or its own end.
Vec3 end_of(const Bands& bands, const ChainTree& tree, const Around& around, int piece) {
    const Shoot& shoot = tree.shoots[size_t(piece)];
    Vec3 sum = Vec3::Zero();
    double weight = 0;
    for (int i = around.first[size_t(piece)]; i < around.first[size_t(piece) + 1]; i++) {
        const SlabLink& link = tree.links[size_t(around.link[size_t(i)])];
        if (!link.level || link.length <= 0 || around.link[size_t(i)] == shoot.link) continue;
        if ((shoot.down ? link.high : link.low) != piece) continue;
        sum += link.length * link.length * link.middle;
        weight += link.length * link.length;
    }
    if (weight > 0) return sum / weight;
    return shoot.down ? bands.pieces[size_t(piece)].near_end : bands.pieces[size_t(piece)].far_end;
}

}  // namespace

ChainTree grow_tree(const Topology& topology, const Bands& bands, const std::vector<int>& roots,
                    const std::vector<Joint>& ties) {
    ChainTree tree;
    const size_t count = bands.pieces.size();
    tree.links = bands.links;
    add_joints(topology, bands, topology.joints, -1, tree.links);
    add_joints(topology, bands, ties, 0, tree.links);
    tree.shoots.resize(count);
    const Around around = links_of_pieces(count, tree.links);
    const std::vector<char> rooted = find_feet(topology, bands, roots, tree);

    std::vector<char> grown(count, 0), waiting(count, 0);
    using Entry = std::tuple<bool, double, int>;  // belongs to the plant, distance [m], slab
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> front;
    const auto wait = [&](int piece) {
        if (waiting[size_t(piece)]) return;
        waiting[size_t(piece)] = 1;
        const Piece& what = bands.pieces[size_t(piece)];
        front.push({what.group != SUPPORT_GROUP, bands.entry[size_t(what.component)] + what.near, piece});
    };
    for (size_t i = 0; i < count; i++)
        if (rooted[i]) wait(int(i));
    for (size_t next_root = 0;;) {
        // Nothing is left to grow from: the next slab that has not grown yet becomes a root.
        if (front.empty()) {
            while (next_root < count && grown[next_root]) next_root++;
            if (next_root == count) break;
            tree.foot[next_root] = bands.pieces[next_root].near_end;
            wait(int(next_root));
        }
        const int piece = std::get<2>(front.top());
        front.pop();
        Shoot& shoot = tree.shoots[size_t(piece)];
        for (int i = around.first[size_t(piece)]; i < around.first[size_t(piece) + 1]; i++) {
            const int number = around.link[size_t(i)];
            const SlabLink& link = tree.links[size_t(number)];
            const int other = link.low == piece ? link.high : link.low;
            if (!grown[size_t(other)]) {
                wait(other);
                continue;
            }
            if (rooted[size_t(piece)] || other == piece) continue;
            if (shoot.link < 0 || is_better(bands, link, tree.links[size_t(shoot.link)])) {
                shoot.link = number;
                shoot.parent = other;
                shoot.down = link.level && link.low == piece;
            }
        }
        if (shoot.parent >= 0) tree.shoots[size_t(shoot.parent)].children++;
        FROND_ASSERT(!grown[size_t(piece)]);
        grown[size_t(piece)] = 1;
        tree.order.push_back(piece);
    }
    FROND_ASSERT(tree.order.size() == count);
    for (size_t i = 0; i < count; i++) tree.shoots[i].end = end_of(bands, tree, around, int(i));
    return tree;
}

std::vector<SlabLink> links_beside_ties(const Bands& bands, const ChainTree& tree) {
    std::vector<SlabLink> beside;
    for (const SlabLink& link : bands.links) {
        const Shoot &low = tree.shoots[size_t(link.low)], &high = tree.shoots[size_t(link.high)];
        const bool is_tied = high.link >= 0 && is_tie(bands, tree.links[size_t(high.link)]) &&
                             bands.pieces[size_t(link.high)].group != SUPPORT_GROUP;
        if (link.level && link.length > 0 && is_tied && !low.down && !low.dropped && !high.dropped)
            beside.push_back(link);
    }
    return beside;
}

void prune_tree(const Bands& bands, ChainTree& tree, double loose) {
    const double tiny = TINY * bands.height;
    // Works from the tips inwards, so that a slab whose children were all dropped can be dropped too.
    const auto size_of = [&](const Piece& piece) {
        if (!(piece.area > 0)) return piece.far - piece.near;
        const Vec3 middle = piece.sum / piece.area;
        const double spread = (piece.square / piece.area - middle * middle.transpose()).trace();
        return std::max(piece.far - piece.near, std::sqrt(std::max(0.0, spread)) * 2);
    };
    std::vector<std::vector<int>> twigs(bands.pieces.size());
    for (auto it = tree.order.rbegin(); it != tree.order.rend(); ++it) {
        Shoot& shoot = tree.shoots[size_t(*it)];
        const Piece& piece = bands.pieces[size_t(*it)];
        // The shortest side twigs of the same kind are dropped; one is kept so that the branch reaches its tip.
        std::vector<int>& own = twigs[size_t(*it)];
        std::sort(own.begin(), own.end(), [&](int a, int b) {
            const Piece &pa = bands.pieces[size_t(a)], &pb = bands.pieces[size_t(b)];
            const double la = pa.far - pa.near, lb = pb.far - pb.near;
            return la != lb ? la < lb : pa.area != pb.area ? pa.area < pb.area : a < b;
        });
        for (int twig : own) {
            const Piece& small = bands.pieces[size_t(twig)];
            if (shoot.children < 2 || small.far - small.near >= tiny) break;
            tree.shoots[size_t(twig)].dropped = true;
            shoot.children--;
        }
        if (shoot.parent < 0 || shoot.children > 0) continue;
        const Piece& parent = bands.pieces[size_t(shoot.parent)];
        if (parent.component == piece.component && parent.group == piece.group) {
            twigs[size_t(shoot.parent)].push_back(*it);
        } else if (size_of(piece) < loose * bands.height) {
            shoot.dropped = true;
            tree.shoots[size_t(shoot.parent)].children--;
        }
    }
}

}  // namespace frond
