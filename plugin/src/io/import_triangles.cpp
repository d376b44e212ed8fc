// Takes the caller's triangles. In: arrays. Out: a surface of one part, neither placed nor clean.
#include "core/error.hpp"
#include "io/import.hpp"

namespace frond {

Surface surface_from_triangles(const float* xyz, int vertex_count, const int32_t* indices, int triangle_count) {
    if (!xyz || !indices) fail(FROND_RESULT_BAD_ARGUMENT, "xyz and indices must not be null");
    if (vertex_count < 3 || vertex_count > 3 * MAX_TRIANGLES)
        fail(FROND_RESULT_BAD_ARGUMENT, "vertex_count is %d; it must be 3..%d", vertex_count, 3 * MAX_TRIANGLES);
    if (triangle_count < 1 || triangle_count > MAX_TRIANGLES)
        fail(FROND_RESULT_BAD_ARGUMENT, "triangle_count is %d; it must be 1..%d", triangle_count, MAX_TRIANGLES);

    Surface surface;
    surface.positions.reserve(size_t(vertex_count));
    for (size_t i = 0; i < size_t(vertex_count); ++i)
        surface.positions.push_back(Vec3(double(xyz[3 * i]), double(xyz[3 * i + 1]), double(xyz[3 * i + 2])));
    surface.triangles.reserve(size_t(triangle_count));
    for (size_t t = 0; t < size_t(triangle_count); ++t) {
        for (size_t k = 0; k < 3; ++k)
            if (indices[3 * t + k] < 0 || indices[3 * t + k] >= vertex_count)
                fail(FROND_RESULT_BAD_ARGUMENT, "triangle %zu has index %d; it must be 0..%d", t,
                     int(indices[3 * t + k]), vertex_count - 1);
        surface.triangles.push_back({indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]});
    }
    Part part;
    part.name = "plant";
    part.triangle_count = triangle_count;
    surface.parts.push_back(part);
    return surface;
}

}  // namespace frond
