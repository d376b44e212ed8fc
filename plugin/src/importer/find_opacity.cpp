// In: a texture. Out: what its alpha cuts out. Leaves are often drawn as cards on which a picture shows the leaf, so
// that most of a card is air.
#include <algorithm>

#include "importer/decode_image.hpp"
#include "importer/importer.hpp"

namespace frond {

static std::vector<uint8_t> coarse_opacity(const Image& image) {
    constexpr uint8_t HALF = 128;  // alpha from which a pixel is drawn, glTF's default for masks
    constexpr size_t GRID = size_t(Texture::GRID);
    const size_t width = size_t(image.width), height = size_t(image.height);
    std::vector<uint8_t> opacity;
    for (size_t row = 0; row < GRID; row++)
        for (size_t column = 0; column < GRID; column++) {
            const size_t top = row * height / GRID, left = column * width / GRID;
            const size_t bottom = std::max(top + 1, (row + 1) * height / GRID),
                         right = std::max(left + 1, (column + 1) * width / GRID);
            size_t seen = 0;
            for (size_t y = top; y < bottom; y++)
                for (size_t x = left; x < right; x++) seen += image.rgba[4 * (y * width + x) + 3] >= HALF;
            opacity.push_back(uint8_t(255 * seen / ((bottom - top) * (right - left))));
        }
    return opacity;
}

// Returns whether alpha says what is there: it is nearly all or nothing. Some programs keep gloss in it.
static bool is_mask(const Image& image) {
    constexpr size_t FEW = 4;  // pixels, at least, for each one that is half transparent
    size_t half = 0;
    for (size_t i = 3; i < image.rgba.size(); i += 4) half += image.rgba[i] >= 64 && image.rgba[i] < 192;
    return half * FEW <= image.rgba.size() / 4;
}

void find_opacity(Texture& texture) {
    Image image;
    if (!has_alpha(texture.bytes.data(), texture.bytes.size())) return;
    if (!decode_image(texture.bytes.data(), texture.bytes.size(), image).empty() || !is_mask(image)) return;
    std::vector<uint8_t> opacity = coarse_opacity(image);
    if (std::any_of(opacity.begin(), opacity.end(), [](uint8_t share) { return share < 255; }))
        texture.opacity = std::move(opacity);
}

}  // namespace frond
