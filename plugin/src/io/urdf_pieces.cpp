// Shapes of a tree of links in the plant's frame, and the stems that they describe.
#include "io/urdf_pieces.hpp"

#include <algorithm>

#include "core/convert.hpp"
#include "core/error.hpp"

namespace frond {

std::vector<UrdfPiece> list_pieces(const UrdfTree& tree, const Quat& turn) {
    const std::vector<UrdfFrame> frames = link_frames(tree);
    const UrdfFrame upright = {Vec3::Zero(), turn};
    std::vector<UrdfPiece> pieces;
    for (size_t i = 0; i < tree.links.size(); ++i) {
        const UrdfLink& link = tree.links[i];
        for (const UrdfShape& shape : link.visuals.empty() ? link.collisions : link.visuals)
            pieces.push_back({int(i), &shape, upright * frames[i] * shape.frame});
    }
    if (pieces.empty())
        fail(FROND_RESULT_BAD_GEOMETRY,
             "none of the %zu links has a <visual> or a <collision>; a plant needs one at least", tree.links.size());
    return pieces;
}

std::vector<int> shown_parents(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces) {
    std::vector<char> is_shown(tree.links.size(), 0);
    for (const UrdfPiece& piece : pieces) is_shown[size_t(piece.link)] = 1;
    std::vector<int> parents;
    for (const UrdfLink& link : tree.links) {
        const bool skips = link.parent >= 0 && !is_shown[size_t(link.parent)];
        parents.push_back(skips ? parents[size_t(link.parent)] : link.parent);
    }
    return parents;
}

bool are_stems(const std::vector<UrdfPiece>& pieces) {
    return std::all_of(pieces.begin(), pieces.end(), [](const UrdfPiece& piece) {
        return piece.shape->kind == UrdfKind::CYLINDER || piece.shape->kind == UrdfKind::CAPSULE;
    });
}

static double distance_to(const frond_stem& stem, const Vec3& point) {
    const Vec3 begin = to_vec(stem.begin), way = to_vec(stem.end) - begin;
    const double along = std::clamp((point - begin).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return (point - begin - along * way).norm();
}

std::vector<frond_stem> stems_of(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces) {
    const std::vector<int> parents = shown_parents(tree, pieces);
    std::vector<std::vector<int>> of_link(tree.links.size());
    std::vector<frond_stem> stems;
    for (const UrdfPiece& piece : pieces) {
        // A stem begins at the end that is nearer to its link's joint.
        const Vec3 half = 0.5 * piece.shape->size[1] * Vec3::UnitZ();
        const bool turned = (piece.shape->frame * half).norm() < (piece.shape->frame * Vec3(-half)).norm();
        const Vec3 begin = piece.frame * Vec3(turned ? half : -half), end = piece.frame * Vec3(turned ? -half : half);
        // It grows on the nearest of the earlier stems of its own link or, for the first one, of the link before.
        std::vector<int>& own = of_link[size_t(piece.link)];
        const int before = parents[size_t(piece.link)];
        const std::vector<int> none;
        const std::vector<int>& others = !own.empty() ? own : before >= 0 ? of_link[size_t(before)] : none;
        int parent = -1;
        for (int other : others)
            if (parent < 0 || distance_to(stems[size_t(other)], begin) < distance_to(stems[size_t(parent)], begin))
                parent = other;
        own.push_back(int(stems.size()));
        const double radius = piece.shape->size[0];
        stems.push_back({parent, {begin.x(), begin.y(), begin.z()}, {end.x(), end.y(), end.z()}, radius, radius});
    }
    return stems;
}

}  // namespace frond
