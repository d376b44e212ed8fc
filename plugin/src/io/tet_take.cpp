// Takes tets from another mesher. In: nodes and tets. Out: a cage with the very same nodes and tets, and its boundary
// as surface, with every vertex attached to its own node.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "cage/tet_geometry.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/log.hpp"
#include "io/import.hpp"

namespace frond {

static constexpr size_t MOST_TETS = 5000000;  // beyond any that is stepped
// A tet is flat if six times its volume is less than this share of its longest edge's cube.
static constexpr double SMALLEST_VOLUME = 1e-9;

static void check_tets(const TetMesh& mesh) {
    if (mesh.tets.empty()) fail(FROND_RESULT_BAD_GEOMETRY, "there are no tets");
    if (mesh.tets.size() > MOST_TETS || mesh.nodes.size() > MOST_TETS)
        fail(FROND_RESULT_BAD_GEOMETRY, "there are %zu tets and %zu nodes; at most %zu of each are allowed",
             mesh.tets.size(), mesh.nodes.size(), MOST_TETS);
    if (!mesh.tet_region.empty() && mesh.tet_region.size() != mesh.tets.size())
        fail(FROND_RESULT_BAD_GEOMETRY, "there are %zu regions for %zu tets; give one each, or none",
             mesh.tet_region.size(), mesh.tets.size());
    for (size_t i = 0; i < mesh.nodes.size(); ++i)
        if (!mesh.nodes[i].allFinite() || mesh.nodes[i].cwiseAbs().maxCoeff() > LARGEST_COORDINATE)
            fail(FROND_RESULT_BAD_GEOMETRY, "node %zu is not finite or beyond 1e9", i);
    for (size_t t = 0; t < mesh.tets.size(); ++t) {
        for (int node : mesh.tets[t])
            if (node < 0 || size_t(node) >= mesh.nodes.size())
                fail(FROND_RESULT_BAD_GEOMETRY, "tet %zu refers to node %d; it must be 0..%zu", t, node,
                     mesh.nodes.size() - 1);
        if (!mesh.tet_region.empty() && (mesh.tet_region[t] < 0 || size_t(mesh.tet_region[t]) >= mesh.regions.size()))
            fail(FROND_RESULT_BAD_GEOMETRY, "tet %zu is in region %d, but there are %zu", t, mesh.tet_region[t],
                 mesh.regions.size());
    }
}

static void orient_tets(TetMesh& mesh) {
    for (size_t t = 0; t < mesh.tets.size(); ++t) {
        Tet& tet = mesh.tets[t];
        double longest = 0;
        for (size_t i = 0; i < 4; ++i)
            for (size_t j = 0; j < i; ++j)
                longest = std::max(longest, (mesh.nodes[size_t(tet[i])] - mesh.nodes[size_t(tet[j])]).norm());
        const double volume = tet_volume(mesh.nodes, tet);
        if (!(std::abs(volume) > SMALLEST_VOLUME / 6 * longest * longest * longest))
            fail(FROND_RESULT_BAD_GEOMETRY, "tet %zu (nodes %d %d %d %d) has no volume; remove it or mesh again", t,
                 tet[0], tet[1], tet[2], tet[3]);
        if (volume < 0) std::swap(tet[2], tet[3]);
    }
}

// Drops tets given twice, which would be twice as stiff: meshers write an element once for each group that it is in.
static void drop_repeated(TetMesh& mesh) {
    std::vector<std::pair<Tet, size_t>> sorted(mesh.tets.size());
    for (size_t t = 0; t < mesh.tets.size(); ++t) {
        sorted[t] = {mesh.tets[t], t};
        std::sort(sorted[t].first.begin(), sorted[t].first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<char> repeated(mesh.tets.size(), 0);
    size_t dropped = 0;
    for (size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].first == sorted[i - 1].first) {
            repeated[sorted[i].second] = 1;
            ++dropped;
        }
    if (dropped == 0) return;
    size_t kept = 0;
    for (size_t t = 0; t < mesh.tets.size(); ++t) {
        if (repeated[t]) continue;
        mesh.tets[kept] = mesh.tets[t];
        mesh.tet_region[kept++] = mesh.tet_region[t];
    }
    mesh.tets.resize(kept);
    mesh.tet_region.resize(kept);
    warn("%zu tets are given more than once; the first of each is taken", dropped);
}

static void drop_loose_nodes(TetMesh& mesh) {
    std::vector<int> number(mesh.nodes.size(), -1);
    for (const Tet& tet : mesh.tets)
        for (int node : tet) number[size_t(node)] = 0;
    int used = 0;
    for (size_t i = 0; i < number.size(); ++i)
        if (number[i] == 0) {
            mesh.nodes[size_t(used)] = mesh.nodes[i];
            number[i] = used++;
        }
    if (size_t(used) == mesh.nodes.size()) return;
    warn("%zu nodes belong to no tet and are dropped; the others are numbered anew in the same order",
         mesh.nodes.size() - size_t(used));
    mesh.nodes.resize(size_t(used));
    for (Tet& tet : mesh.tets)
        for (int& node : tet) node = number[size_t(node)];
}

struct Face {
    std::array<int, 3> key;  // sorted nodes
    Triangle triangle;       // oriented outwards
    int tet;
};

// Finds the faces that belong to one tet only, by region, then in the order of the tets.
static std::vector<Face> find_boundary(const TetMesh& mesh) {
    static const int CORNERS[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    std::vector<Face> faces;
    faces.reserve(4 * mesh.tets.size());
    for (size_t t = 0; t < mesh.tets.size(); ++t)
        for (const auto& corners : CORNERS) {
            Face face;
            for (size_t k = 0; k < 3; ++k) face.triangle[k] = mesh.tets[t][size_t(corners[k])];
            face.key = face.triangle;
            std::sort(face.key.begin(), face.key.end());
            face.tet = int(t);
            faces.push_back(face);
        }
    std::sort(faces.begin(), faces.end(),
              [](const Face& a, const Face& b) { return a.key != b.key ? a.key < b.key : a.tet < b.tet; });
    std::vector<Face> boundary;
    for (size_t i = 0; i < faces.size();) {
        size_t end = i + 1;
        while (end < faces.size() && faces[end].key == faces[i].key) ++end;
        if (end - i > 2)
            fail(FROND_RESULT_BAD_GEOMETRY, "%zu tets, the first of them tet %d, share one face; tets must not overlap",
                 end - i, faces[i].tet);
        if (end - i == 1) boundary.push_back(faces[i]);
        i = end;
    }
    std::sort(boundary.begin(), boundary.end(), [&mesh](const Face& a, const Face& b) {
        const int region_a = mesh.tet_region[size_t(a.tet)], region_b = mesh.tet_region[size_t(b.tet)];
        return std::tie(region_a, a.tet, a.key) < std::tie(region_b, b.tet, b.key);
    });
    return boundary;
}

// Makes one part per region; vertices in the order of the nodes, each attached to its node.
static void make_surface(const TetMesh& mesh, Surface& surface, Embedding& embedding) {
    const std::vector<Face> boundary = find_boundary(mesh);
    if (boundary.size() > size_t(MAX_TRIANGLES))
        fail(FROND_RESULT_BAD_GEOMETRY, "the tets have %zu outer faces, more than the %d that are allowed",
             boundary.size(), MAX_TRIANGLES);
    std::vector<int> vertex(mesh.nodes.size(), -1);
    for (const Face& face : boundary)
        for (int node : face.triangle) vertex[size_t(node)] = 0;
    int used = 0;
    for (size_t i = 0; i < vertex.size(); ++i)
        if (vertex[i] == 0) {
            vertex[i] = used++;
            surface.positions.push_back(mesh.nodes[i]);
        }
    int last_region = -1;
    for (const Face& face : boundary) {
        const int region = mesh.tet_region[size_t(face.tet)];
        if (region != last_region) {
            Part part;
            part.name = part.material = mesh.regions[size_t(region)];
            part.first_triangle = int(surface.triangles.size());
            surface.parts.push_back(std::move(part));
            last_region = region;
        }
        surface.triangles.push_back(
            {vertex[size_t(face.triangle[0])], vertex[size_t(face.triangle[1])], vertex[size_t(face.triangle[2])]});
        ++surface.parts.back().triangle_count;
    }

    embedding.tet.assign(surface.positions.size(), -1);
    embedding.weights.assign(surface.positions.size(), {0, 0, 0, 0});
    for (size_t t = 0; t < mesh.tets.size(); ++t)
        for (size_t k = 0; k < 4; ++k) {
            const int v = vertex[size_t(mesh.tets[t][k])];
            if (v < 0 || embedding.tet[size_t(v)] >= 0) continue;
            embedding.tet[size_t(v)] = int(t);
            embedding.weights[size_t(v)][k] = 1;
        }
}

void take_tets(TetMesh mesh, const ImportOptions& options, Surface& surface, Cage& cage, Embedding& embedding) {
    check_tets(mesh);
    if (mesh.tet_region.empty()) {
        mesh.tet_region.assign(mesh.tets.size(), 0);
        if (mesh.regions.empty()) mesh.regions.push_back("plant");
    }
    drop_repeated(mesh);
    drop_loose_nodes(mesh);

    // The nodes are placed as a surface's vertices would be, but neither cleaned nor moved to the origin from afar.
    surface = Surface();
    place_points(mesh.nodes, options, surface);
    orient_tets(mesh);
    make_surface(mesh, surface, embedding);
    std::vector<char> missing(surface.positions.size(), 1);
    make_normals(surface, missing);
    surface.placed = true;
    cage.nodes = std::move(mesh.nodes);
    cage.tets = std::move(mesh.tets);
    cage.tet_organ = std::move(mesh.tet_region);
    cage.tet_fill.assign(cage.tets.size(), 1.0);
}

}  // namespace frond
