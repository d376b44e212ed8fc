// In: the caller's triangles, whatever they contain. Out: vertices and runs of a frame, without the triangles that
// cannot be drawn.
#include <algorithm>

#include "error.hpp"
#include "frame.hpp"

namespace picture {

namespace {

float clamped(float value, float low, float high) {
    return value >= low ? std::min(value, high) : low;
}

// Makes a vertex relative to the frame's origin; returns false if it cannot be drawn.
bool make_vertex(const Frame& frame, const frond_picture_mesh& mesh, int i, MeshVertex& vertex) {
    const float* p = mesh.positions + 3 * size_t(i);
    const Vec position{p[0], p[1], p[2]};
    if (!drawable(position)) return false;
    const Vec relative = position - frame.origin;
    vertex = {{float(relative.x), float(relative.y), float(relative.z)}, {0, 0, 0}, {0, 0}, {255, 255, 255, 255}};
    if (mesh.normals) {
        const float* n = mesh.normals + 3 * size_t(i);
        const Vec normal = direction({n[0], n[1], n[2]}, {0, 0, 0});
        vertex.normal[0] = float(normal.x), vertex.normal[1] = float(normal.y), vertex.normal[2] = float(normal.z);
    }
    if (mesh.uvs)
        for (int k = 0; k < 2; k++) vertex.uv[k] = clamped(mesh.uvs[2 * size_t(i) + k], -1e4f, 1e4f);
    if (mesh.colors) std::copy_n(mesh.colors + 4 * size_t(i), 4, vertex.color);
    return true;
}

}  // namespace

void append_mesh(Frame& frame, const frond_picture_mesh& mesh, int texture_count) {
    if (frame.vertices.size() + size_t(mesh.vertex_count) > 400000000u)
        fail("the frame holds too many vertices; draw fewer");

    // Vertices keep their order, so that indices need an offset only; bad ones are marked.
    const uint32_t offset = uint32_t(frame.vertices.size());
    std::vector<char> good(size_t(mesh.vertex_count), 0);
    frame.vertices.resize(offset + size_t(mesh.vertex_count));
    for (int i = 0; i < mesh.vertex_count; i++) good[i] = make_vertex(frame, mesh, i, frame.vertices[offset + i]);

    const frond_picture_part everything = {0, mesh.triangle_count, {0.25f, 0.42f, 0.12f, 1}, -1, 0.35f, 0.3f, false};
    const frond_picture_part plain = {0, mesh.triangle_count, {1, 1, 1, 1}, -1, 0.35f, 0.3f, false};
    const frond_picture_part* parts = mesh.parts ? mesh.parts : mesh.colors ? &plain : &everything;
    const int part_count = mesh.parts ? mesh.part_count : 1;
    for (int k = 0; k < part_count; k++) {
        const frond_picture_part& part = parts[k];
        const int64_t last =
            std::min<int64_t>(int64_t(part.first_triangle) + std::max(part.triangle_count, 0), mesh.triangle_count);
        MeshRun run;
        run.first_index = frame.indices.size();
        for (int64_t t = std::max(part.first_triangle, 0); t < last; t++) {
            const int32_t* corner = mesh.indices + 3 * t;
            bool whole = true;
            for (int c = 0; c < 3; c++) whole &= corner[c] >= 0 && corner[c] < mesh.vertex_count && good[corner[c]];
            if (!whole) continue;
            for (int c = 0; c < 3; c++) {
                const float* p = frame.vertices[offset + corner[c]].position;
                frame.indices.push_back(offset + uint32_t(corner[c]));
                (part.is_floor ? frame.box : frame.solid_box).add({p[0], p[1], p[2]});
            }
        }
        run.index_count = frame.indices.size() - run.first_index;
        if (run.index_count == 0) continue;
        run.color = {clamped(part.color.r, 0, 1), clamped(part.color.g, 0, 1), clamped(part.color.b, 0, 1),
                     clamped(part.color.a, 0, 1)};
        run.texture = mesh.uvs && part.texture >= 0 && part.texture < texture_count ? part.texture : -1;
        run.translucency = clamped(part.translucency, 0, 1);
        run.gloss = clamped(part.gloss, 0, 1);
        run.is_floor = part.is_floor;
        run.id = frame.id;
        frame.solid.push_back(run);
    }
    if (!frame.solid_box.empty()) frame.box.add(frame.solid_box.lower), frame.box.add(frame.solid_box.upper);
}

}  // namespace picture
