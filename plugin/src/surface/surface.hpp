// Surface: the render mesh as imported, cleaned, in metres with +y up. A triangle soup: it need not be closed, manifold
// or oriented.
#pragma once

#include <string>
#include <vector>

#include "core/types.hpp"

namespace frond {

// A run of triangles that came from one node and one material of the file. Its appearance is color times texture times
// vertex colors, as far as there are any.
struct Part {
    std::string name, material;
    std::array<float, 4> color = {0.5f, 0.6f, 0.35f, 1.0f};  // linear RGBA
    int texture = -1;
    int first_triangle = 0, triangle_count = 0;
    int organ = -1;  // index into Model::organs, set by find_organs()
};

struct Texture {
    std::string name;
    std::vector<uint8_t> bytes;  // contents of an image file
    // Share of each of GRID x GRID cells that its alpha does not cut out, 0 to 255, rows from the top; empty: nothing
    // is cut out.
    static constexpr int GRID = 64;
    std::vector<uint8_t> opacity;
};

struct Surface {
    std::vector<Vec3> positions;
    std::vector<Vec3f> normals;       // one per vertex, unit length
    std::vector<Vec2f> uvs;           // empty or one per vertex; v = 0 is the texture's top row
    std::vector<Color> colors;        // empty or one per vertex
    std::vector<Triangle> triangles;  // ordered by part
    std::vector<Part> parts;          // cover the triangles without gap
    std::vector<Texture> textures;

    // Numbers of defects that the import repaired.
    int dropped_triangles = 0, repaired_vertices = 0;
    double scale = 1;         // metres per file unit
    Vec3 up = Vec3::UnitY();  // file axis that became +y
    // For place_surface(): the file states its up axis, its unit; scale and up are final, so that placing again changes
    // nothing.
    bool up_declared = false, scale_declared = false, placed = false;

    Vec3 lower() const;
    Vec3 upper() const;
    double size() const { return (upper() - lower()).norm(); }
    double height() const { return upper().y() - lower().y(); }
};

// Drops triangles with bad indices, without area or given twice, and vertices that nothing uses; makes normals where
// they are missing; keeps the order of the rest. Throws BAD_GEOMETRY if nothing is left, if array sizes do not agree or
// if there are more faces than a plant can have.
void clean_surface(Surface& surface);
// Puts back single triangles that a cleaned surface lost within a mesh; returns how many.
int fill_lost_triangles(Surface& surface);
// Sums up, by area, the opacity of triangles: the share that their textures do not cut out.
struct OpacitySum {
    double area = 0, seen = 0;  // [m^2]
    void add(const Surface& surface, const Part& part, const Triangle& triangle);
    double mean() const { return area > 0 ? seen / area : 1; }
};
// Makes normals for the vertices flagged in `missing`: smooth over all triangles at the same position, weighted by
// area.
void make_normals(Surface& surface, const std::vector<char>& missing);

constexpr int MAX_TRIANGLES = 5000000;  // of a file: more is a scan, not a model

}  // namespace frond
