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

namespace {

constexpr int64_t MAX_PIXELS = int64_t(1) << 26;

bool is_absurd(const Image& image) {
    return image.width < 1 || image.height < 1 || int64_t(image.width) * image.height > MAX_PIXELS;
}

std::string too_large(const Image& image) {
    return "the image is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
           " pixels; make it smaller than 8192 x 8192";
}

}  // namespace

std::string decode_image(const uint8_t* bytes, size_t byte_count, Image& image) {
    image = {};
    if (byte_count > size_t(INT_MAX)) return "the image file is larger than 2 GB; make it smaller";
    const auto reason = [] { return " (" + std::string(stbi_failure_reason()) + ")"; };
    // The size comes first in the file: an absurd one is rejected before anything is allocated.
    int channels = 0;
    if (!stbi_info_from_memory(bytes, int(byte_count), &image.width, &image.height, &channels))
        return "the image cannot be read" + reason() + "; use PNG, JPEG, BMP or TGA";
    if (is_absurd(image)) return too_large(image);
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes, int(byte_count), &image.width, &image.height, &channels, 4), stbi_image_free);
    if (!pixels) return "the image is damaged" + reason() + "; export it anew";
    image.rgba.assign(pixels.get(), pixels.get() + size_t(image.width) * size_t(image.height) * 4);
    return "";
}

}  // namespace frond
