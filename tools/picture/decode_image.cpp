// In: the bytes of an image file, from any source. Out: RGBA. Decoders: stb_image (PNG, JPEG, BMP, TGA), libwebp.
#include <webp/decode.h>

#include <climits>
#include <cstring>
#include <memory>

#include "error.hpp"
#include "renderer.hpp"

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
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace picture {

namespace {

constexpr int64_t MAX_PIXELS = int64_t(1) << 26;

void check_size(int width, int height) {
    if (width < 1 || height < 1 || int64_t(width) * height > MAX_PIXELS)
        fail("the image is %d x %d pixels; make it smaller than 8192 x 8192", width, height);
}

}  // namespace

Image decode_image(const uint8_t* bytes, size_t byte_count) {
    if (byte_count > size_t(INT_MAX)) fail("the image file is larger than 2 GB; make it smaller");
    Image image;
    const bool webp = byte_count > 12 && !std::memcmp(bytes, "RIFF", 4) && !std::memcmp(bytes + 8, "WEBP", 4);
    if (webp) {
        if (!WebPGetInfo(bytes, byte_count, &image.width, &image.height))
            fail("the WebP image is damaged; export it anew");
        check_size(image.width, image.height);
        image.rgba.resize(size_t(image.width) * image.height * 4);
        if (!WebPDecodeRGBAInto(bytes, byte_count, image.rgba.data(), image.rgba.size(), image.width * 4))
            fail("the WebP image is damaged; export it anew");
        return image;
    }
    // The size comes first in the file: an absurd one is rejected before anything is allocated.
    int channels = 0;
    if (!stbi_info_from_memory(bytes, int(byte_count), &image.width, &image.height, &channels))
        fail("the image cannot be read (%s); use PNG, JPEG, BMP, TGA or WebP", stbi_failure_reason());
    check_size(image.width, image.height);
    std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes, int(byte_count), &image.width, &image.height, &channels, 4), stbi_image_free);
    if (!pixels) fail("the image is damaged (%s); export it anew", stbi_failure_reason());
    image.rgba.assign(pixels.get(), pixels.get() + size_t(image.width) * image.height * 4);
    return image;
}

void fill_transparent(Image& image) {
    // The mean colour of the opaque pixels.
    uint64_t sum[3] = {0, 0, 0}, count = 0;
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        if (image.rgba[i + 3] < 128) continue;
        for (int c = 0; c < 3; c++) sum[c] += image.rgba[i + c];
        count++;
    }
    if (count == 0 || count * 4 == image.rgba.size()) return;
    for (size_t i = 0; i < image.rgba.size(); i += 4)
        if (image.rgba[i + 3] < 8)
            for (int c = 0; c < 3; c++) image.rgba[i + c] = uint8_t(sum[c] / count);
}

}  // namespace picture
