// Makes a collider: tets and their regions come in; boundary, neighbours and the regions that do not collide with each
// other go out.
#include <algorithm>
#include <map>

#include "collide/capsule.hpp"
#include "collide/collider.hpp"
#include "collide/overlap.hpp"
#include "core/assert.hpp"
#include "core/lists.hpp"
#include "model/model.hpp"
#include "surface/triangle_distance.hpp"

namespace frond {

// Packs lists, each sorted and without duplicates.
static NumberLists lists_of(std::vector<std::vector<int>>& lists) {
    NumberLists packed;
    for (std::vector<int>& list : lists) {
        sort_unique(list);
        packed.numbers.insert(packed.numbers.end(), list.begin(), list.end());
        packed.start.push_back(int(packed.numbers.size()));
    }
    return packed;
}

static void find_boundary(Collider& collider) {
    // Faces of one tet only; each faces away from its tet's fourth node.
    constexpr int OUTWARD[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    struct Side {
        Triangle face;
        int tet, count;
    };
    std::map<Triangle, Side> sides;
    for (size_t t = 0; t < collider.tets.size(); ++t)
        for (const auto& corner : OUTWARD) {
            const Tet& tet = collider.tets[t];
            const Triangle face = {tet[size_t(corner[0])], tet[size_t(corner[1])], tet[size_t(corner[2])]};
            Triangle key = face;
            std::sort(key.begin(), key.end());
            ++sides.insert({key, {face, int(t), 0}}).first->second.count;
        }
    std::vector<std::vector<int>> tet_faces(collider.tets.size());
    for (const auto& [key, side] : sides) {
        if (side.count != 1) continue;
        tet_faces[size_t(side.tet)].push_back(int(collider.faces.size()));
        collider.faces.push_back(side.face);
        collider.face_tet.push_back(side.tet);
    }
    collider.tet_faces = lists_of(tet_faces);

    // The faces' edges.
    std::map<std::array<int, 2>, int> known;
    for (size_t f = 0; f < collider.faces.size(); ++f) {
        collider.face_edges.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(collider.faces[f][k], collider.faces[f][(k + 1) % 3]);
            const auto [entry, is_new] = known.insert({{low, high}, int(collider.edges.size())});
            if (is_new) {
                collider.edges.push_back({low, high});
                collider.edge_faces.push_back({int(f), int(f)});
            } else {
                collider.edge_faces[size_t(entry->second)][1] = int(f);
            }
            collider.face_edges[f][k] = entry->second;
        }
    }
}

static void find_neighbours(Collider& collider) {
    std::vector<std::vector<int>> neighbours(size_t(collider.node_count)), pieces(size_t(collider.node_count)),
        nodes(size_t(collider.piece_count));
    collider.node_tet.assign(size_t(collider.node_count), 0);
    for (size_t t = 0; t < collider.tets.size(); ++t)
        for (const int a : collider.tets[t]) {
            collider.node_tet[size_t(a)] = int(t);
            pieces[size_t(a)].push_back(collider.tet_piece[t]);
            nodes[size_t(collider.tet_piece[t])].push_back(a);
            for (const int b : collider.tets[t])
                if (a != b) neighbours[size_t(a)].push_back(b);
        }
    collider.neighbours = lists_of(neighbours);
    collider.node_pieces = lists_of(pieces);
    collider.piece_nodes = lists_of(nodes);
}

static void find_near_pieces(Collider& collider, const std::vector<Vec3>& nodes) {
    const auto are_near = [&](int a, int b) {
        collider.near_pieces[size_t(a) * size_t(collider.piece_count) + size_t(b)] = true;
        collider.near_pieces[size_t(b) * size_t(collider.piece_count) + size_t(a)] = true;
    };
    collider.near_pieces.assign(size_t(collider.piece_count) * size_t(collider.piece_count), false);
    for (int n = 0; n < collider.node_count; ++n)
        for (const int a : collider.node_pieces[n])
            for (const int b : collider.node_pieces[n]) are_near(a, b);

    // Regions that overlap at rest.
    OverlapSearch search;
    const std::vector<uint8_t> all(size_t(collider.piece_count), 1);
    find_overlaps(search, {{&collider, nodes.data(), all, true}}, HashSettings());
    std::vector<std::array<int, 2>> found;
    const OverlapScene& scene = search.scene;
    for (const NodeOverlap& overlap : search.nodes)
        for (const int piece : collider.node_pieces[scene.node[size_t(overlap.node)]])
            found.push_back({piece, collider.tet_piece[size_t(scene.tet[size_t(overlap.tet)])]});
    for (const EdgeOverlap& overlap : search.edges) {
        const int tet = collider.face_tet[size_t(scene.face[size_t(overlap.face)])];
        for (const int end : collider.edges[size_t(scene.edge[size_t(overlap.edge)])])
            for (const int piece : collider.node_pieces[end]) found.push_back({piece, collider.tet_piece[size_t(tet)]});
    }
    for (const auto& [a, b] : found) are_near(a, b);
}

Collider make_collider(const std::vector<Vec3>& nodes, const std::vector<Tet>& tets, const std::vector<int>& tet_piece,
                       const std::vector<int>& tet_organ, int piece_count) {
    FROND_ASSERT(tet_piece.size() == tets.size() && tet_organ.size() == tets.size());
    FROND_ASSERT(
        std::all_of(tet_piece.begin(), tet_piece.end(), [&](int piece) { return piece >= 0 && piece < piece_count; }));
    Collider collider;
    collider.node_count = int(nodes.size());
    collider.piece_count = piece_count;
    collider.tets = tets;
    collider.tet_piece = tet_piece;
    collider.tet_organ = tet_organ;
    find_boundary(collider);
    find_neighbours(collider);
    for (const auto& [a, b] : collider.edges) collider.mean_edge += (nodes[size_t(a)] - nodes[size_t(b)]).norm();
    collider.mean_edge /= double(std::max(collider.edges.size(), size_t(1)));
    find_near_pieces(collider, nodes);
    return collider;
}

void separate_near_capsules(const Model& model, Collider& collider) {
    FROND_ASSERT(collider.piece_count >= int(model.capsules.size()));
    constexpr double BESIDE = 0.015;  // [m]
    std::vector<Capsule> capsules;
    for (const auto& [begin, end] : model.capsules) {
        const std::vector<ChainNode>& nodes = model.chain.nodes;
        capsules.push_back({nodes[size_t(begin)].position, nodes[size_t(end)].position, nodes[size_t(end)].radius});
    }
    for (size_t a = 0; a < capsules.size(); ++a)
        for (size_t b = 0; b < a; ++b) {
            if (gap_between(capsules[a], capsules[b]).distance > BESIDE) continue;
            collider.near_pieces[a * size_t(collider.piece_count) + b] = true;
            collider.near_pieces[b * size_t(collider.piece_count) + a] = true;
        }
}

Collider make_collider(const Model& model) {
    const Cage& cage = model.cage;
    std::vector<int> tet_piece(cage.tets.size(), 0);
    for (size_t t = 0; t < cage.tets.size(); ++t) {
        Vec3 middle = Vec3::Zero();
        for (const int n : cage.tets[t]) middle += cage.nodes[size_t(n)] / 4;
        // A small organ may have no capsule of its own: then the nearest of any organ.
        double least = INFINITY;
        bool of_organ = false;
        for (size_t c = 0; c < model.capsules.size(); ++c) {
            const ChainNode &begin = model.chain.nodes[size_t(model.capsules[c][0])],
                            &end = model.chain.nodes[size_t(model.capsules[c][1])];
            const bool same = end.organ == cage.tet_organ[t];
            if (of_organ && !same) continue;
            const double away = nearest_of_segments(middle, middle, begin.position, end.position).squared;
            if (away >= least && same == of_organ) continue;
            least = away;
            of_organ = same;
            tet_piece[t] = int(c);
        }
    }
    Collider collider =
        make_collider(cage.nodes, cage.tets, tet_piece, cage.tet_organ, std::max(int(model.capsules.size()), 1));
    separate_near_capsules(model, collider);
    return collider;
}

}  // namespace frond
