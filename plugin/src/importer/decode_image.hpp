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

// Decodes the bytes of a PNG, JPEG, BMP or TGA file. Returns an empty text, or what is wrong with them.
std::string decode_image(const uint8_t* bytes, size_t byte_count, Image& out);

}  // namespace frond
