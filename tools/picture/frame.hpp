// Frame: everything drawn since begin, ready for the GPU. Positions are relative to the camera's target, so that floats
// suffice far from the origin.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vector.hpp"

namespace picture {

struct MeshVertex {
    float position[3];  // [m]
    float normal[3];    // zero: the face's is used
    float uv[2];
    uint8_t color[4];  // sRGB and alpha
};

// Triangles with one appearance.
struct MeshRun {
    size_t first_index = 0, index_count = 0;
    frond_color color{1, 1, 1, 1};
    int texture = -1;
    float translucency = 0, gloss = 0;
    bool is_floor = false;  // casts no shadow
    int32_t id = 0;
};

// A straight line on the screen that tapers from one width to another.
struct LineVertex {
    float begin[3], begin_width;  // [m], [pixel]
    float end[3], end_width;
    float offset[2];  // offsets of begin and end along the line on the screen [pixel]
    float color[4];
};

struct PointVertex {
    float position[3], size;  // [m], [pixel]
    float color[4];
};

struct Frame {
    frond_picture_scene scene;
    Vec origin{0, 0, 0};  // origin of all positions here
    int32_t id = 0;       // number of what is drawn next
    bool is_measured = false;
    std::vector<MeshVertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<MeshRun> solid;  // opaque; cast shadows
    std::vector<MeshRun> glass;  // blended over the background
    std::vector<LineVertex> lines;
    std::vector<PointVertex> points;
    Box solid_box, box;  // boxes of the shadow casters and of everything, relative to origin
};

// Each appends to the frame; its caller has checked the input only as far as the C types go.
void append_mesh(Frame& frame, const frond_picture_mesh& mesh, int texture_count);
void append_sphere(Frame& frame, Vec center, double radius, frond_color color);
void append_box(Frame& frame, Vec center, frond_quat rotation, Vec half_extents, frond_color color);
void append_capsule(Frame& frame, Vec begin, Vec end, double radius, frond_color color);
void append_line(Frame& frame, Vec begin, Vec end, double width, frond_color color);
void append_arrow(Frame& frame, Vec begin, Vec end, double width, frond_color color);
void append_point(Frame& frame, Vec point, double size, frond_color color);
void append_tets(Frame& frame, const double* nodes, int node_count, const int32_t* tets, int tet_count, double width,
                 frond_color line, frond_color fill);

// Returns the scene with defaults in place of zeros; fails with a text if it makes no sense.
frond_picture_scene checked_scene(const frond_picture_scene& scene);
frond_color checked_color(frond_color color, const char* what);

}  // namespace picture
