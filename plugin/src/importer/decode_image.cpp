// In: the bytes of an image file, from any source. Out: RGBA, by stb_image.
#include "importer/decode_image.hpp"

#include <climits>
#include <memory>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace frond {

// Reads the header alone. Returns an empty text, or what is wrong with it.
static std::string read_header(const uint8_t* bytes, size_t byte_count, Image& image, int& channels) {
    if (byte_count > size_t(INT_MAX)) return "the image file is larger than 2 GB; make it smaller";
    if (stbi_info_from_memory(bytes, int(byte_count), &image.width, &image.height, &channels)) return wrong_size(image);
    return "the image cannot be read (" + std::string(stbi_failure_reason()) + "); use PNG, JPEG, BMP, TGA or WebP";
}

std::string wrong_size(const Image& image) {
    constexpr int64_t MAX_PIXELS = int64_t(1) << 26;
    if (image.width >= 1 && image.height >= 1 && int64_t(image.width) * image.height <= MAX_PIXELS) return "";
    return "the image is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
           " pixels; make it smaller than 8192 x 8192";
}

bool has_alpha(const uint8_t* bytes, size_t byte_count) {
    Image image;
    int channels = 0;
    return read_header(bytes, byte_count, image, channels).empty() && channels % 2 == 0;
}

std::string decode_image(const uint8_t* bytes, size_t byte_count, Image& image) {
    image = {};
    int channels = 0;
    // The size comes first in the file: an absurd one is rejected before anything is allocated.
    const std::string wrong = read_header(bytes, byte_count, image, channels);
    if (!wrong.empty()) return wrong;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes, int(byte_count), &image.width, &image.height, &channels, 4), stbi_image_free);
    if (!pixels) return "the image is damaged (" + std::string(stbi_failure_reason()) + "); export it anew";
    image.rgba.assign(pixels.get(), pixels.get() + size_t(image.width) * size_t(image.height) * 4);
    return "";
}

}  // namespace frond
