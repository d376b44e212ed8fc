// A leaf that its tissue alone does not carry.
#pragma once

#include "surface/surface.hpp"

namespace frond::test {

// A standing leaf, narrow at its base as drawn leaves are, 0.6 m high, with one face: its tissue alone would need to be
// 20 times stiffer.
inline Surface narrow_leaf() {
    Surface surface;
    const double widths[] = {0.004, 0.03, 0.08, 0.1, 0.08, 0.04, 0.005};
    for (int i = 0; i < 7; i++)
        for (double side : {-0.5, 0.5}) surface.positions.push_back({side * widths[i], 0.1 * i, 0.002 * i * i});
    for (int i = 0; i < 6; i++) {
        surface.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
        surface.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
    }
    surface.parts.emplace_back();
    surface.parts[0].name = "leaf";
    surface.parts[0].triangle_count = 12;
    surface.normals.assign(surface.positions.size(), Vec3f::UnitZ());
    return surface;
}

}  // namespace frond::test
