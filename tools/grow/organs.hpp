// Organs: the parts of which every kind of plant is made. Each adds vertices and triangles to the organ begun last.
#pragma once

#include <functional>

#include "geometry.hpp"
#include "grow.hpp"

namespace frond::grow {

// Declares a material and returns its index.
int add_material(GrownPlant& plant, const std::string& name, Rgb color, const std::string& texture = "");
// Starts an organ, to which everything added from here on belongs.
void begin_organ(GrownPlant& plant, const std::string& name, int material);
int add_vertex(GrownPlant& plant, Vec position, Rgb color, double u = 0, double v = 0);
void add_triangle(GrownPlant& plant, int a, int b, int c);
Vec position_of(const GrownPlant& plant, int vertex);

struct TubeRing {
    Vec center;
    double radius;  // [m]
    Rgb color;
};

// A tube along a curve; ring r, side s is vertex first + r*sides + s. Closed ends add one vertex each, before and
// after.
struct Tube {
    std::vector<TubeRing> rings;
    int sides = 6;
    bool close_start = false, close_end = true;
    double end_reach = 0;  // distance of the closing vertex beyond the last ring [m]
    double start_reach = 0;
    double roll = 0;                                  // angle of the first ring about the curve [radian]
    std::function<double(int ring, int side)> bulge;  // factor on the radius, optional
    std::function<Rgb(int ring, int side)> tint;      // colour, optional
};

struct TubeMesh {
    int first, sides, rings;
    std::vector<Vec> centers;
    int at(int ring, int side) const { return first + ring * sides + (side + sides) % sides; }
};

TubeMesh add_tube(GrownPlant& plant, const Tube& tube);

// A sheet of rows along a curve, the last row shrunk to one vertex if `pointed`. Row r, column c is vertex first +
// r*columns + c.
struct Sheet {
    int rows, columns;
    bool pointed = true;
    std::function<Vec(int row, int column)> place;  // position; row == rows gives the point
    std::function<Rgb(int row, int column)> tint;
    std::function<std::array<double, 2>(int row, int column)> map;  // texture coordinates, optional
};
int add_sheet(GrownPlant& plant, const Sheet& sheet);

// Adds a stiff hair that stands on one vertex of the skin and shares it: two vertices and one triangle, or, if curved,
// three and two.
void add_hair(GrownPlant& plant, int skin_vertex, Vec out, Vec along, double height, double width, bool curved,
              Rgb color);

// Fills in 256 shades from one colour to another, as shares of the latter: a texture is multiplied with vertex colours,
// which are `high`, so that programs that ignore textures still show a green leaf.
void fill_palette(GrownImage& image, Rgb low, Rgb high);

// Returns `count` points of a smooth curve through control points (Catmull-Rom), evenly spaced in the parameter.
std::vector<Vec> curve_through(const std::vector<Vec>& control, int count);

GrownPlant grow_corn(const GrownSettings& value, uint64_t seed);
GrownPlant grow_cucumber(const GrownSettings& value, uint64_t seed);
GrownPlant grow_wheat(const GrownSettings& value, uint64_t seed);
GrownPlant grow_sunflower(const GrownSettings& value, uint64_t seed);
GrownPlant grow_tree(const GrownSettings& value, uint64_t seed);

}  // namespace frond::grow
