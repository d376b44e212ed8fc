// Decodes image files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace frond {

// A decoded image, RGBA, sRGB; rows from the top.
struct Image {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;
};

// Returns an empty text, or that an image of that width and height is too large, or is none.
std::string wrong_size(const Image& image);
// Returns whether a file that decode_image() can decode has an alpha channel, or a palette with transparent colours.
bool has_alpha(const uint8_t* bytes, size_t byte_count);
// Decodes the bytes of a PNG, JPEG, BMP or TGA file. Returns an empty text, or what is wrong with them, for those who
// show images.
std::string decode_image(const uint8_t* bytes, size_t byte_count, Image& out);

}  // namespace frond
