// Surface of a tree of links. In: spheres, boxes, cylinders, capsules and meshes. Out: triangles, fine enough along
// each shape to show how it bends.
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "io/urdf_pieces.hpp"

namespace frond {

// Corners of a ring, rings of a half sphere and at most of a cylinder, cells along the edge of a box.
static constexpr int URDF_SIDES = 12, URDF_CAP_RINGS = 4, MOST_URDF_RINGS = 48, MOST_CELLS = 16;

// A circle around the z axis.
struct UrdfRing {
    double along, radius;  // [m]
};

// Lists rings from the lower pole to the upper one, without the poles.
static std::vector<UrdfRing> rings_of(const UrdfShape& shape) {
    const bool is_sphere = shape.kind == UrdfKind::SPHERE, is_flat = shape.kind == UrdfKind::CYLINDER;
    const double radius = shape.size[0], half = is_sphere ? 0 : 0.5 * shape.size[1];
    std::vector<UrdfRing> rings;
    if (!is_flat)
        for (int k = URDF_CAP_RINGS - 1; k > 0; --k) {
            const double angle = 0.5 * PI * k / URDF_CAP_RINGS;
            rings.push_back({-half - radius * frond::sin(angle), radius * frond::cos(angle)});
        }
    const int pieces = is_sphere ? 0 : std::clamp(int(std::ceil(half / radius)), 1, MOST_URDF_RINGS);
    for (int k = 0; k <= pieces; ++k) rings.push_back({pieces ? half * (2.0 * k / pieces - 1) : 0, radius});
    if (!is_flat)
        for (int k = 1; k < URDF_CAP_RINGS; ++k) {
            const double angle = 0.5 * PI * k / URDF_CAP_RINGS;
            rings.push_back({half + radius * frond::sin(angle), radius * frond::cos(angle)});
        }
    return rings;
}

static void add_round(Surface& surface, const UrdfPiece& piece) {
    const UrdfShape& shape = *piece.shape;
    const std::vector<UrdfRing> rings = rings_of(shape);
    const double reach = shape.kind == UrdfKind::CYLINDER ? 0.5 * shape.size[1]
                         : shape.kind == UrdfKind::SPHERE ? shape.size[0]
                                                          : 0.5 * shape.size[1] + shape.size[0];
    const int first = int(surface.positions.size()), last = first + 1 + URDF_SIDES * int(rings.size());
    surface.positions.push_back(piece.frame * Vec3(0, 0, -reach));
    for (const UrdfRing& ring : rings)
        for (int k = 0; k < URDF_SIDES; ++k) {
            const double angle = 2 * PI * k / URDF_SIDES;
            surface.positions.push_back(
                piece.frame * Vec3(ring.radius * frond::cos(angle), ring.radius * frond::sin(angle), ring.along));
        }
    surface.positions.push_back(piece.frame * Vec3(0, 0, reach));
    const auto at = [first](int ring, int k) { return first + 1 + ring * URDF_SIDES + k % URDF_SIDES; };
    const int top = int(rings.size()) - 1;
    for (int k = 0; k < URDF_SIDES; ++k) {
        surface.triangles.push_back({first, at(0, k + 1), at(0, k)});
        for (int ring = 0; ring < top; ++ring) {
            surface.triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)});
            surface.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)});
        }
        surface.triangles.push_back({last, at(top, k), at(top, k + 1)});
    }
}

// Makes each side a grid whose cells are as long as a share of the longest edge, or as the edge if that is shorter.
static void add_box(Surface& surface, const UrdfPiece& piece) {
    const Vec3 half = 0.5 * piece.shape->size;
    const double cell = 2 * half.maxCoeff() / MOST_CELLS;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const int count_u = std::max(1, int(std::lround(2 * half[u] / cell)));
            const int count_v = std::max(1, int(std::lround(2 * half[v] / cell)));
            const int first = int(surface.positions.size());
            for (int i = 0; i <= count_u; ++i)
                for (int k = 0; k <= count_v; ++k) {
                    Vec3 place;
                    place[axis] = sign * half[axis];
                    place[u] = half[u] * (2.0 * i / count_u - 1);
                    place[v] = half[v] * (2.0 * k / count_v - 1);
                    surface.positions.push_back(piece.frame * place);
                }
            for (int i = 0; i < count_u; ++i)
                for (int k = 0; k < count_v; ++k) {
                    const int a = first + i * (count_v + 1) + k, b = a + count_v + 1;
                    const Triangle one = {a, b, b + 1}, two = {a, b + 1, a + 1};
                    for (const Triangle& t : {one, two})
                        surface.triangles.push_back(sign > 0 ? t : Triangle{t[0], t[2], t[1]});
                }
        }
}

static void add_mesh(Surface& surface, const UrdfPiece& piece, const UrdfMesh& mesh) {
    const int first = int(surface.positions.size());
    for (const Vec3& place : mesh.positions)
        surface.positions.push_back(piece.frame * Vec3(place.cwiseProduct(piece.shape->size)));
    const bool is_mirrored = piece.shape->size.prod() < 0;
    for (Triangle triangle : mesh.triangles) {
        if (is_mirrored) std::swap(triangle[1], triangle[2]);
        surface.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
    }
}

Surface surface_of_pieces(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces) {
    Surface surface;
    surface.up_declared = true;
    for (size_t i = 0; i < pieces.size(); ++i) {
        const UrdfPiece& piece = pieces[i];
        const UrdfLink& link = tree.links[size_t(piece.link)];
        if (i == 0 || pieces[i - 1].link != piece.link) {
            Part part;
            part.name = link.name;
            part.material = piece.shape->material;
            part.first_triangle = int(surface.triangles.size());
            if (piece.shape->has_color) part.color = piece.shape->color;
            surface.parts.push_back(std::move(part));
        }
        if (piece.shape->kind == UrdfKind::BOX)
            add_box(surface, piece);
        else if (piece.shape->kind == UrdfKind::MESH)
            add_mesh(surface, piece, tree.meshes[size_t(piece.shape->mesh)]);
        else
            add_round(surface, piece);
        surface.parts.back().triangle_count = int(surface.triangles.size()) - surface.parts.back().first_triangle;
        if (surface.triangles.size() > size_t(MAX_TRIANGLES))
            fail(FROND_RESULT_BAD_GEOMETRY,
                 "its shapes have more than the %d triangles that are allowed; use simpler meshes", MAX_TRIANGLES);
    }
    return surface;
}

}  // namespace frond
