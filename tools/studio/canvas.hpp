// Canvas: pixels to draw words, lines and boxes on, over a picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studio/studio.hpp"

namespace frond::tools {

struct Pixel {
    uint8_t r = 0, g = 0, b = 0;
};

// Pixels beyond its edges are left out.
struct Canvas {
    int width = 0, height = 0;
    std::vector<uint8_t> rgb;  // width*height*3, rows from top to bottom

    Canvas(int width, int height, Pixel fill);
    void copy(const uint8_t* from, int from_width, int from_height, int x, int y);
    void box(int x, int y, int box_width, int box_height, Pixel color);
    // Writes a line of text in ASCII, its upper left corner at x, y; size 1 has capitals of seven pixels.
    void text(int x, int y, const std::string& words, Pixel color, int size = 1);
    // Does the same on a rim in another colour, so that it can be read over a picture.
    void rimmed_text(int x, int y, const std::string& words, Pixel color, Pixel rim);
    void write(const std::string& png_path) const;
};
// Returns the width of a line of text in size 1 [pixel].
int text_width(const std::string& words);

// Places of points of the world in a picture that a camera takes.
struct Projection {
    Projection(const frond_picture_camera& camera, int width, int height);
    // Returns whether a point is before the camera, and its pixel.
    bool place(const frond_vec3& point, double& x, double& y) const;
    // Returns pixels per metre at the camera's target.
    double per_metre() const;

private:
    frond_vec3 eye, forward, right, over;
    double scale, distance;  // [pixel], [m]
    int width, height;
};

}  // namespace frond::tools
