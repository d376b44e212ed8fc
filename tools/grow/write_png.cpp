// Grow, images. In: an image with its palette. Out: the bytes of a PNG file, by libpng. Stored without compression, so
// that no version of zlib can change a byte.
#include <png.h>

#include <stdexcept>

#include "grow.hpp"

namespace frond::grow {

std::string png_bytes(const GrownImage& image) {
    std::string bytes;
    std::vector<png_color> palette;
    for (const auto& c : image.palette) palette.push_back({c[0], c[1], c[2]});
    std::vector<png_const_bytep> rows;
    for (int r = 0; r < image.height; r++) rows.push_back(image.pixels.data() + static_cast<size_t>(r) * image.width);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (!info) {
        png_destroy_write_struct(&png, nullptr);
        throw std::runtime_error("cannot write " + image.name + ": out of memory");
    }

    // libpng reports errors by longjmp, so nothing below may own memory.
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        throw std::runtime_error("cannot write " + image.name + ": libpng refused the image");
    }
    png_set_write_fn(
        png, &bytes,
        [](png_structp p, png_bytep data, size_t size) {
            static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(data), size);
        },
        nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                 PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    png_set_compression_level(png, 0);
    png_set_filter(png, 0, PNG_FILTER_NONE);
    png_write_info(png, info);
    for (png_const_bytep row : rows) png_write_row(png, row);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

}  // namespace frond::grow
