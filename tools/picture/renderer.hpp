// Renderer: draws frames with the current OpenGL 3.3 core context, whoever made it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frame.hpp"
#include "importer/decode_image.hpp"

namespace picture {

using frond::Image;
// Decodes the bytes of an image file, WebP too; fails with a text if they cannot be decoded.
Image decode_image(const uint8_t* bytes, size_t byte_count);
// Gives transparent pixels the colour of opaque ones, so that no fringe appears along cut edges.
void fill_transparent(Image& image);

// What is seen in the middle of each pixel, rows from the top: its number, and its distance along the camera's axis
// [m].
struct Measures {
    std::vector<int32_t> ids;
    std::vector<float> distances;
};

struct Renderer;
// Deletion requires the same context to be current.
struct RendererDeleter {
    void operator()(Renderer* renderer) const noexcept;
};
using RendererPointer = std::unique_ptr<Renderer, RendererDeleter>;

RendererPointer create_renderer(const frond_picture_def& def);
// Returns "OpenGL 4.5 ..., llvmpipe ...".
std::string describe(const Renderer& renderer);
int add_texture(Renderer& renderer, const Image& image);
int texture_count(const Renderer& renderer);
// Draws a frame. rgb: width*height*3 of the def, rows from the top. measures: empty if the frame is not measured.
void draw(Renderer& renderer, const Frame& frame, std::vector<uint8_t>& rgb, Measures& measures);
void present(Renderer& renderer, unsigned framebuffer, int width, int height);

}  // namespace picture
