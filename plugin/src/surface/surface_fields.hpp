// The fields of a surface, for archives. Each struct is taken apart into all of its members, so that a new one does not
// compile until it stands here.
#pragma once

#include "core/archive.hpp"
#include "surface/surface.hpp"

namespace frond {

inline void visit(Archive& a, Part& part) {
    auto& [name, material, color, texture, first_triangle, triangle_count, organ] = part;
    a(name, material, color, texture, first_triangle, triangle_count, organ);
}

inline void visit(Archive& a, Texture& texture) {
    auto& [name, bytes, opacity] = texture;
    a(name, bytes, opacity);
}

inline void visit(Archive& a, Surface& surface) {
    auto& [positions, normals, uvs, colors, triangles, parts, textures, dropped_triangles, repaired_vertices, scale, up,
           up_declared, scale_declared, placed] = surface;
    a(positions, normals, uvs, colors, triangles, parts, textures, dropped_triangles, repaired_vertices, scale, up,
      up_declared, scale_declared, placed);
}

}  // namespace frond
