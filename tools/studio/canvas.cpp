#include "studio/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_easy_font.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace frond::tools {

Canvas::Canvas(int wide, int high, Pixel fill) : width(wide), height(high), rgb(size_t(wide) * size_t(high) * 3) {
    box(0, 0, wide, high, fill);
}

void Canvas::copy(const uint8_t* from, int from_width, int from_height, int x, int y) {
    const int begin = std::max(0, -x), end = std::min(from_width, width - x);
    for (int row = std::max(0, -y); row < std::min(from_height, height - y) && end > begin; row++)
        std::memcpy(&rgb[3 * (size_t(y + row) * size_t(width) + size_t(x + begin))],
                    from + 3 * (size_t(row) * size_t(from_width) + size_t(begin)), 3 * size_t(end - begin));
}

void Canvas::box(int x, int y, int box_width, int box_height, Pixel color) {
    for (int row = std::max(0, y); row < std::min(height, y + box_height); row++)
        for (int column = std::max(0, x); column < std::min(width, x + box_width); column++) {
            uint8_t* pixel = &rgb[3 * (size_t(row) * size_t(width) + size_t(column))];
            pixel[0] = color.r, pixel[1] = color.g, pixel[2] = color.b;
        }
}

namespace {

// Copies words with all that is not printable ASCII replaced, as the font takes nothing else.
std::string printable(const std::string& words) {
    std::string out = words;
    for (char& letter : out)
        if (letter < ' ' || letter > '~') letter = '?';
    return out;
}

struct Corner {
    float x, y, z;
    uint8_t color[4];
};

}  // namespace

void Canvas::text(int x, int y, const std::string& words, Pixel color, int size) {
    std::string line = printable(words);
    std::vector<Corner> corners(100 * (line.size() + 1));
    const int quads =
        stb_easy_font_print(0, 0, line.data(), nullptr, corners.data(), int(corners.size() * sizeof(Corner)));
    for (int q = 0; q < quads; q++) {
        const Corner &from = corners[4 * size_t(q)], &to = corners[4 * size_t(q) + 2];
        const int left = int(std::lround(from.x)), top = int(std::lround(from.y));
        box(x + size * left, y + size * top, size * (int(std::lround(to.x)) - left),
            size * (int(std::lround(to.y)) - top), color);
    }
}

void Canvas::rimmed_text(int x, int y, const std::string& words, Pixel color, Pixel rim) {
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) text(x + dx, y + dy, words, rim);
    text(x, y, words, color);
}

void Canvas::write(const std::string& png_path) const {
    must(frond_picture_write_png(png_path.c_str(), rgb.data(), width, height));
}

int text_width(const std::string& words) {
    std::string line = printable(words);
    return stb_easy_font_width(line.data());
}

namespace {

frond_vec3 minus(const frond_vec3& a, const frond_vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
double dot(const frond_vec3& a, const frond_vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
frond_vec3 unit_cross(const frond_vec3& a, const frond_vec3& b) {
    const frond_vec3 c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    const double size = std::sqrt(dot(c, c));
    return {c.x / size, c.y / size, c.z / size};
}

}  // namespace

Projection::Projection(const frond_picture_camera& camera, int wide, int high)
    : eye(camera.eye),
      forward(minus(camera.target, camera.eye)),
      scale(0.5 * high / std::tan(0.5 * camera.field_of_view)),
      distance(std::sqrt(dot(forward, forward))),
      width(wide),
      height(high) {
    forward = {forward.x / distance, forward.y / distance, forward.z / distance};
    right = unit_cross(forward, camera.up);
    over = unit_cross(right, forward);
}

bool Projection::place(const frond_vec3& point, double& x, double& y) const {
    const frond_vec3 from = minus(point, eye);
    const double depth = dot(from, forward);
    if (!(depth > 1e-6 * distance)) return false;
    x = 0.5 * width + scale * dot(from, right) / depth;
    y = 0.5 * height - scale * dot(from, over) / depth;
    return true;
}

double Projection::per_metre() const {
    return scale / distance;
}

}  // namespace frond::tools
