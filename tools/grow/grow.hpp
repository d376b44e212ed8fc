// Grow: plants made by rule. In: a kind, its parameters and a seed. Out: a surface in metres, +y up, foot at the
// origin, with named and coloured organs, and a Wavefront OBJ file of it. The same input gives the same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace frond::grow {

struct GrownMaterial {
    std::string name;
    std::array<double, 3> color;  // colour of the organ as a whole, sRGB 0..1
    std::string texture;          // name of an image; empty: none
};

// A run of vertices and triangles; organs do not share vertices.
struct GrownOrgan {
    std::string name;  // "leaf_3"
    int material;
    int first_vertex, vertex_count;
    int first_triangle, triangle_count;
};

// An image of up to 256 colours (sRGB), rows from top to bottom.
struct GrownImage {
    std::string name;  // "blade.png"
    int width, height;
    std::vector<std::array<uint8_t, 3>> palette;
    std::vector<uint8_t> pixels;  // width*height, indices into palette
};

struct GrownPlant {
    std::string kind;
    std::vector<std::array<double, 3>> positions;  // [m]
    std::vector<std::array<double, 3>> colors;     // sRGB 0..1
    std::vector<std::array<double, 2>> uvs;        // used by organs whose material has a texture
    std::vector<std::array<int, 3>> triangles;     // indices into positions
    std::vector<GrownOrgan> organs;
    std::vector<GrownMaterial> materials;
    std::vector<GrownImage> images;
};

// The settings of a kind. Changing a value moves vertices; only `leaves` changes their number.
struct GrownParameter {
    const char* name;
    double value;  // default
    double low, high;
    const char* text;  // with unit
};

struct GrownKind {
    const char* name;
    const char* text;
    std::vector<GrownParameter> parameters;
};

using GrownSettings = std::map<std::string, double>;

const std::vector<GrownKind>& grown_kinds();

// Throws std::invalid_argument for a kind or parameter that does not exist or is out of range; its text names those
// that exist.
GrownPlant grow_plant(const std::string& kind, const GrownSettings& settings = {}, uint64_t seed = 1);

// Return the texts of the OBJ file and of its material library; `library` is the library's name in the OBJ file.
std::string obj_text(const GrownPlant& plant, const std::string& library);
std::string mtl_text(const GrownPlant& plant);
// Returns the bytes of a PNG file.
std::string png_bytes(const GrownImage& image);

// Writes <folder>/<kind>.obj, .mtl and images; makes the folder if need be. Throws a std::runtime_error that names the
// file. Returns the path of the OBJ file.
std::string write_obj(const GrownPlant& plant, const std::string& folder);

}  // namespace frond::grow
