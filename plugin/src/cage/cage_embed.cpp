// Embeds a surface in given tets: each vertex is attached to the tet that contains it, else to the nearest one, found
// in a box tree.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cage/cage.hpp"
#include "cage/tet_geometry.hpp"
#include "core/error.hpp"
#include "surface/box_tree.hpp"
#include "surface/triangle_distance.hpp"

namespace frond {

namespace {

struct Found {
    double squared = std::numeric_limits<double>::infinity();  // squared distance from the tet [m^2]
    double least = 0;                                          // smallest weight
    int tet = -1;
};

}  // namespace

static double squared_distance(const Cage& cage, int tet, const Vec3& place) {
    static constexpr int FACES[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    const Tet& corner = cage.tets[size_t(tet)];
    double best = std::numeric_limits<double>::infinity();
    for (const auto& face : FACES) {
        const Corners corners = {cage.nodes[size_t(corner[size_t(face[0])])],
                                 cage.nodes[size_t(corner[size_t(face[1])])],
                                 cage.nodes[size_t(corner[size_t(face[2])])]};
        best = std::min(best, (nearest_in_triangle(corners, place) - place).squaredNorm());
    }
    return best;
}

// Keeps the nearer tet; among several that contain the position, that with the largest minimum weight, then the first.
static void try_tet(const Cage& cage, int tet, const Vec3& place, Found& found) {
    const auto weights = tet_weights(cage.nodes, cage.tets[size_t(tet)], place);
    const double least = *std::min_element(weights.begin(), weights.end());
    const bool usable = std::isfinite(least);
    const double squared = usable && least >= 0 ? 0 : squared_distance(cage, tet, place);
    const bool better = squared < found.squared || (squared == found.squared && least > found.least) ||
                        (squared == found.squared && least == found.least && tet < found.tet);
    if (usable && better) found = {squared, least, tet};
}

static void search(const Cage& cage, const BoxTree& tree, int at, const Vec3& place, Found& found) {
    const BoxTree::Node& node = tree.nodes[size_t(at)];
    if (node.right < 0) {
        for (int k = node.first; k < node.first + node.count; ++k) try_tet(cage, tree.items[size_t(k)], place, found);
        return;
    }
    int near = at + 1, far = node.right;
    double near_squared = tree.nodes[size_t(near)].box.squaredExteriorDistance(place);
    double far_squared = tree.nodes[size_t(far)].box.squaredExteriorDistance(place);
    if (far_squared < near_squared) {
        std::swap(near, far);
        std::swap(near_squared, far_squared);
    }
    if (near_squared <= found.squared) search(cage, tree, near, place, found);
    if (far_squared <= found.squared) search(cage, tree, far, place, found);
}

Embedding embed(const Surface& surface, const Cage& cage) {
    if (cage.tets.empty())
        fail(FROND_RESULT_BAD_GEOMETRY, "there are no tets to bind the surface to; bring at least one");
    std::vector<Box> boxes(cage.tets.size());
    for (size_t e = 0; e < cage.tets.size(); ++e)
        for (int corner : cage.tets[e]) boxes[e].extend(cage.nodes[size_t(corner)]);
    const BoxTree tree = make_box_tree(boxes, 4);
    Embedding embedding;
    embedding.tet.reserve(surface.positions.size());
    embedding.weights.reserve(surface.positions.size());
    for (const Vec3& place : surface.positions) {
        Found found;
        search(cage, tree, 0, place, found);
        if (found.tet < 0)
            fail(FROND_RESULT_BAD_GEOMETRY, "all %zu tets are flat; bring tets that have a volume", cage.tets.size());
        embedding.tet.push_back(found.tet);
        embedding.weights.push_back(tet_weights(cage.nodes, cage.tets[size_t(found.tet)], place));
    }
    return embedding;
}

}  // namespace frond
