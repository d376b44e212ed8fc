// Reads and writes PNG files by libpng's simplified interface, which returns errors and never uses longjmp.
#include <png.h>

#include <cstdlib>
#include <cstring>
#include <new>

#include "error.hpp"
#include "frond_picture.h"

using namespace picture;

bool frond_picture_write_png(const char* path, const uint8_t* rgb, int width, int height) {
    return guarded([&] {
        if (!path || !*path) fail("the path of the PNG is empty; name a file");
        if (!rgb) fail("the pixels are null");
        if (width < 1 || height < 1 || width > 65535 || height > 65535)
            fail("a PNG of %d x %d pixels cannot be written; use 1..65535", width, height);
        png_image image;
        std::memset(&image, 0, sizeof image);
        image.version = PNG_IMAGE_VERSION;
        image.width = png_uint_32(width), image.height = png_uint_32(height);
        image.format = PNG_FORMAT_RGB;
        if (!png_image_write_to_file(&image, path, 0, rgb, 0, nullptr))
            fail("cannot write %s: %s; check the folder and the space left", path, image.message);
    });
}

bool frond_picture_read_png(const char* path, uint8_t** out, int* width, int* height) {
    if (out) *out = nullptr;
    if (width) *width = 0;
    if (height) *height = 0;
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    uint8_t* pixels = nullptr;
    const bool read = guarded([&] {
        if (!out || !width || !height) fail("where the pixels and their size go is null");
        if (!path || !*path) fail("the path of the PNG is empty; name a file");
        if (!png_image_begin_read_from_file(&image, path)) fail("cannot read %s: %s", path, image.message);
        // The size comes first in the file: an absurd one is rejected before anything is allocated.
        if (image.width > FROND_PICTURE_LARGEST || image.height > FROND_PICTURE_LARGEST)
            fail("%s has %u x %u pixels; at most %d are read", path, unsigned(image.width), unsigned(image.height),
                 FROND_PICTURE_LARGEST);
        image.format = PNG_FORMAT_RGB;
        pixels = static_cast<uint8_t*>(std::malloc(PNG_IMAGE_SIZE(image)));
        if (!pixels) throw std::bad_alloc();
        const png_color black = {0, 0, 0};
        if (!png_image_finish_read(&image, &black, pixels, 0, nullptr)) fail("%s is damaged: %s", path, image.message);
        *out = pixels;
        *width = int(image.width), *height = int(image.height);
    });
    if (!read) std::free(pixels);
    png_image_free(&image);
    return read;
}

void frond_picture_free(uint8_t* pixels) {
    std::free(pixels);
}
