// Makes normals. In: triangles and positions. Out: a unit normal for each vertex that has none. Area-weighted over all
// triangles at the vertex's position, so that a seam between two parts or two texture islands does not show; a vertex
// whose position has another side (a leaf drawn twice, back to back) takes its own triangles only.
#include "surface/place_index.hpp"
#include "surface/surface.hpp"

namespace frond {

void make_normals(Surface& surface, const std::vector<char>& missing) {
    const size_t vertex_count = surface.positions.size();
    surface.normals.resize(vertex_count, Vec3f::Zero());
    const PlaceIndex index = index_places(surface.positions);

    // Twice the area vectors of the triangles, by vertex and by position.
    std::vector<Vec3> own(vertex_count, Vec3::Zero()), first(vertex_count, Vec3::Zero());
    std::vector<Vec3> shared(size_t(index.count), Vec3::Zero());
    for (const Triangle& triangle : surface.triangles) {
        const Vec3 a = surface.positions[size_t(triangle[0])];
        const Vec3 area =
            (surface.positions[size_t(triangle[1])] - a).cross(surface.positions[size_t(triangle[2])] - a);
        for (int corner : triangle) {
            own[size_t(corner)] += area;
            shared[size_t(index.place[size_t(corner)])] += area;
            if (first[size_t(corner)].isZero(0)) first[size_t(corner)] = area;
        }
    }

    // Takes the position's normal where it agrees with the vertex's own, else the vertex's, else that of its first
    // triangle.
    for (size_t i = 0; i < vertex_count; ++i) {
        if (!missing[i]) continue;
        const Vec3& place = shared[size_t(index.place[i])];
        Vec3 normal = own[i].norm() > 1e-6 * first[i].norm() ? own[i] : first[i];
        if (place.dot(normal) > 0.2 * place.norm() * normal.norm()) normal = place;
        const double length = normal.norm();
        surface.normals[i] = length > 0 ? Vec3f((normal / length).cast<float>()) : Vec3f(0, 1, 0);
    }
}

}  // namespace frond
