// In: the bytes of an image file, from any source. Out: RGBA. Decoders: stb_image (PNG, JPEG, BMP, TGA), libwebp.
#include <webp/decode.h>

#include <cstring>

#include "error.hpp"
#include "renderer.hpp"

namespace picture {

static Image decode_webp(const uint8_t* bytes, size_t byte_count) {
    Image image;
    if (!WebPGetInfo(bytes, byte_count, &image.width, &image.height)) fail("the WebP image is damaged; export it anew");
    const std::string wrong = frond::wrong_size(image);
    if (!wrong.empty()) fail("%s", wrong.c_str());
    image.rgba.resize(size_t(image.width) * size_t(image.height) * 4);
    if (!WebPDecodeRGBAInto(bytes, byte_count, image.rgba.data(), image.rgba.size(), image.width * 4))
        fail("the WebP image is damaged; export it anew");
    return image;
}

Image decode_image(const uint8_t* bytes, size_t byte_count) {
    if (byte_count > 12 && !std::memcmp(bytes, "RIFF", 4) && !std::memcmp(bytes + 8, "WEBP", 4))
        return decode_webp(bytes, byte_count);
    Image image;
    const std::string wrong = frond::decode_image(bytes, byte_count, image);
    if (!wrong.empty()) fail("%s", wrong.c_str());
    return image;
}

void fill_transparent(Image& image) {
    // The mean colour of the opaque pixels.
    uint64_t sum[3] = {0, 0, 0}, count = 0;
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        if (image.rgba[i + 3] < 128) continue;
        for (size_t c = 0; c < 3; c++) sum[c] += image.rgba[i + c];
        count++;
    }
    if (count == 0 || count * 4 == image.rgba.size()) return;
    for (size_t i = 0; i < image.rgba.size(); i += 4)
        if (image.rgba[i + 3] < 8)
            for (size_t c = 0; c < 3; c++) image.rgba[i + c] = uint8_t(sum[c] / count);
}

}  // namespace picture
