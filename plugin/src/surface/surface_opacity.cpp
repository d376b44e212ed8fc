// In: a triangle with texture coordinates. Out: how much of it is there, by its texture's alpha.
#include <algorithm>
#include <cmath>

#include "surface/surface.hpp"

namespace frond {

// The texture is looked up in the middles of the 36 triangles into which sixths of the edges cut the whole.
static double opacity_of(const Surface& surface, const Part& part, const Triangle& triangle) {
    constexpr int PIECES = 6;  // of an edge
    if (part.texture < 0 || surface.uvs.empty()) return 1;
    const std::vector<uint8_t>& opacity = surface.textures[size_t(part.texture)].opacity;
    if (opacity.size() != size_t(Texture::GRID * Texture::GRID)) return 1;
    const auto uv = [&](size_t corner) { return surface.uvs[size_t(triangle[corner])]; };
    const Vec2f a = uv(0), b = uv(1) - a, c = uv(2) - a;
    // Textures repeat.
    const auto cell = [](double coordinate) {
        const double within = coordinate - std::floor(coordinate);
        return within >= 0 ? std::min(int(within * Texture::GRID), Texture::GRID - 1) : 0;
    };
    const auto seen = [&](double along_b, double along_c) {
        const Vec2f at = a + float(along_b / PIECES) * b + float(along_c / PIECES) * c;
        return double(opacity[size_t(cell(at.y()) * Texture::GRID + cell(at.x()))]);
    };
    double sum = 0;
    for (int i = 0; i < PIECES; i++)
        for (int j = 0; i + j < PIECES; j++) {
            sum += seen(i + 1.0 / 3, j + 1.0 / 3);
            if (i + j + 1 < PIECES) sum += seen(i + 2.0 / 3, j + 2.0 / 3);
        }
    return sum / (255 * PIECES * PIECES);
}

void OpacitySum::add(const Surface& surface, const Part& part, const Triangle& triangle) {
    const auto corner = [&](size_t k) { return surface.positions[size_t(triangle[k])]; };
    const double own = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    area += own;
    seen += own * opacity_of(surface, part, triangle);
}

}  // namespace frond
