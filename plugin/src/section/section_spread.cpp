// Surface and chain -> spreads. Every triangle is distributed over the capsules nearest to it. The spread of a
// capsule's surface across its axis is measured after the capsule's own bow along the axis is subtracted, so that an
// arching leaf is not mistaken for a thick one.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/decompose.hpp"
#include "section/section_parts.hpp"

namespace frond {
namespace {

// A point with the area around it that belongs to a capsule.
struct Tile {
    Vec3 position;
    double area;
};

// Distributes a triangle over capsules: each point goes to the nearest one. Triangles that are nearest to more than one
// are halved across their longest edge until they are small.
struct Sharer {
    const Chain& chain;
    std::vector<std::vector<Tile>>& patches;
    std::vector<int> capsules = {};  // candidates for this triangle
    double small = 0;                // shortest edge that is still halved [m]

    int nearest(const Vec3& p) const {
        int best = -1;
        double least = INFINITY;
        for (int capsule : capsules) {
            const Vec3& end = chain.nodes[size_t(capsule)].position;
            const Vec3& begin = chain.nodes[size_t(chain.nodes[size_t(capsule)].parent)].position;
            const Vec3 along = end - begin;
            const double length2 = along.squaredNorm();
            const double s = length2 > 0 ? std::clamp((p - begin).dot(along) / length2, 0.0, 1.0) : 0.0;
            const double distance = (p - begin - s * along).squaredNorm();
            if (distance >= least) continue;
            least = distance;
            best = capsule;
        }
        return best;
    }

    // The corners with 1/12 and the middle with 3/4 of the area have the same second moments as the triangle.
    void add(int capsule, const Vec3& a, const Vec3& b, const Vec3& c) {
        const double area = (b - a).cross(c - a).norm() / 2;
        std::vector<Tile>& list = patches[size_t(capsule)];
        for (const Vec3& p : {a, b, c}) list.push_back({p, area / 12});
        list.push_back({(a + b + c) / 3, area * 3 / 4});
    }

    void share(const Vec3& a, const Vec3& b, const Vec3& c) {
        // Renames the corners so that a to b is the longest edge.
        const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
        if (bc > ab && bc >= ca) return share(b, c, a);
        if (ca > ab && ca > bc) return share(c, a, b);
        const int capsule = nearest((a + b + c) / 3);
        const bool one = nearest(a) == capsule && nearest(b) == capsule && nearest(c) == capsule;
        if (one || ab < small * small) return add(capsule, a, b, c);
        const Vec3 middle = (a + b) / 2;
        share(a, middle, c);
        share(middle, b, c);
    }
};

// Distributes each triangle over the capsules of its own organ that begin or end where its corners are assigned.
std::vector<std::vector<Tile>> collect_patches(const Surface& surface, const Chain& chain,
                                               const std::vector<char>& hearts) {
    constexpr double SMALL = 1.0 / 16;  // share of a capsule's length
    // A triangle gives some hundreds of tiles at most, and all together not many millions.
    constexpr double MOST_PIECES = 8e6, FINEST = 24;
    const double fineness = std::clamp(std::sqrt(MOST_PIECES / double(surface.triangles.size())), 1.0, FINEST);
    std::vector<std::vector<Tile>> patches(chain.nodes.size());
    std::vector<std::vector<int>> touching(chain.nodes.size());  // capsules at a node
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        if (chain.nodes[i].parent < 0) continue;
        touching[i].push_back(int(i));
        touching[size_t(chain.nodes[i].parent)].push_back(int(i));
    }
    Sharer sharer{chain, patches};
    std::vector<int> between;
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++) {
            const Triangle& triangle = surface.triangles[size_t(t)];
            sharer.capsules.clear();
            double length = 0;
            const auto touch = [&](int at) {
                for (int capsule : touching[size_t(at)]) {
                    const ChainNode& node = chain.nodes[size_t(capsule)];
                    if (node.organ != part.organ && !hearts[size_t(capsule)]) continue;
                    sharer.capsules.push_back(capsule);
                    length += (node.position - chain.nodes[size_t(node.parent)].position).norm();
                }
            };
            for (int corner : triangle) touch(chain.vertex_node[size_t(corner)]);
            list_nodes_between(chain, triangle, between);
            for (int node : between) touch(node);
            if (sharer.capsules.empty()) continue;
            const Vec3& a = surface.positions[size_t(triangle[0])];
            const Vec3& b = surface.positions[size_t(triangle[1])];
            const Vec3& c = surface.positions[size_t(triangle[2])];
            const double longest =
                std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
            sharer.small = std::max(SMALL * length / double(sharer.capsules.size()), longest / fineness);
            sharer.share(a, b, c);
        }
    return patches;
}

Spread measure_spread(const std::vector<Tile>& patches, const CapsuleFrame& frame) {
    // Fits the offsets across the axis by a parabola along it, by least squares weighted by area.
    Mat3 normal = 1e-12 * Mat3::Identity();
    Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
    double total = 0;
    for (const Tile& patch : patches) {
        const Vec3 offset = patch.position - frame.begin;
        const double s = offset.dot(frame.axis) / frame.length;
        const Vec3 powers(1, s, s * s);
        const Eigen::RowVector2d y(offset.dot(frame.across), offset.dot(frame.other));
        normal += patch.area * powers * powers.transpose();
        right += patch.area * powers * y;
        total += patch.area;
    }
    normal.diagonal().array() += 1e-9 * total;
    const Eigen::Matrix<double, 3, 2> bow = normal.ldlt().solve(right);
    // The remainder is the spread of the section itself.
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    for (const Tile& patch : patches) {
        const Vec3 offset = patch.position - frame.begin;
        const double s = offset.dot(frame.axis) / frame.length;
        const Eigen::RowVector2d y =
            Eigen::RowVector2d(offset.dot(frame.across), offset.dot(frame.other)) - Vec3(1, s, s * s).transpose() * bow;
        covariance += patch.area / total * y.transpose() * y;
    }
    const SymmetricParts2 parts = symmetric_parts_2(covariance);
    const Eigen::Vector2d direction = parts.vectors.col(0);
    return {total, std::max(parts.values[0], 0.0), std::max(parts.values[1], 0.0),
            (direction[0] * frame.across + direction[1] * frame.other).normalized(),
            (bow.row(0) + bow.row(1) / 2 + bow.row(2) / 3).transpose()};
}

}  // namespace

std::vector<char> find_hearts(const Chain& chain) {
    constexpr int SEVERAL = 2;  // organs that begin at one place
    std::vector<int> others(chain.nodes.size(), 0);
    for (const ChainNode& node : chain.nodes)
        if (node.parent >= 0 && node.organ != chain.nodes[size_t(node.parent)].organ) others[size_t(node.parent)]++;
    std::vector<char> hearts(chain.nodes.size(), 0);
    for (size_t i = 0; i < hearts.size(); i++) {
        const int parent = chain.nodes[i].parent;
        hearts[i] = parent >= 0 && chain.nodes[size_t(parent)].parent < 0 && others[i] >= SEVERAL;
    }
    return hearts;
}

void list_nodes_between(const Chain& chain, const Triangle& triangle, std::vector<int>& nodes) {
    nodes.clear();
    std::array<int, 3> ends;
    for (size_t k = 0; k < 3; k++) ends[k] = chain.vertex_node[size_t(triangle[k])];
    const auto add = [&](int node) {
        if (std::find(ends.begin(), ends.end(), node) != ends.end()) return;
        if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
    };
    for (size_t k = 0; k < 3; k++) {
        // Parents have the smaller numbers, so that both walks meet where the ways do, if they do.
        int a = ends[k], b = ends[(k + 1) % 3];
        const size_t before = nodes.size();
        while (a != b && a >= 0 && b >= 0) {
            int& farther = a > b ? a : b;
            farther = chain.nodes[size_t(farther)].parent;
            if (farther >= 0) add(farther);
        }
        if (a < 0 || b < 0) nodes.resize(before);
    }
}

std::vector<Spread> measure_spreads(const Surface& surface, const Chain& chain, const std::vector<CapsuleFrame>& frames,
                                    const std::vector<char>& hearts) {
    const std::vector<std::vector<Tile>> patches = collect_patches(surface, chain, hearts);
    std::vector<Spread> spreads(patches.size(), {0, 0, 0, Vec3::UnitX(), Eigen::Vector2d::Zero()});
    for (size_t i = 0; i < patches.size(); i++)
        if (!patches[i].empty()) spreads[i] = measure_spread(patches[i], frames[i]);
    return spreads;
}

}  // namespace frond
