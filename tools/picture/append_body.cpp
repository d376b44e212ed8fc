// In: spheres, boxes, capsules. Out: their triangles in a frame, as solid or glass bodies.
#include "frame.hpp"

namespace picture {

namespace {

constexpr int SLICES = 32, RINGS = 8;  // around, and from a pole to the equator
constexpr double PI = 3.14159265358979323846;

// Collects the triangles of one body and then adds them to the frame as a run.
struct Body {
    Frame& frame;
    frond_color color;
    size_t first_index = frame.indices.size();

    uint32_t add(Vec position, Vec normal) {
        const Vec p = position - frame.origin;
        frame.vertices.push_back({{float(p.x), float(p.y), float(p.z)},
                                  {float(normal.x), float(normal.y), float(normal.z)},
                                  {0, 0},
                                  {255, 255, 255, 255}});
        frame.box.add(p);
        if (color.a >= 1) frame.solid_box.add(p);
        return uint32_t(frame.vertices.size() - 1);
    }
    void triangle(uint32_t a, uint32_t b, uint32_t c) { frame.indices.insert(frame.indices.end(), {a, b, c}); }
    void finish() {
        MeshRun run;
        run.first_index = first_index;
        run.index_count = frame.indices.size() - first_index;
        run.color = color;
        run.gloss = 0.25f;
        run.id = frame.id;
        (color.a >= 1 ? frame.solid : frame.glass).push_back(run);
    }
};

Vec rotate(frond_quat q, Vec v) {
    const Vec u{q.x, q.y, q.z};
    return v + 2.0 * cross(u, cross(u, v) + q.w * v);
}

}  // namespace

void append_capsule(Frame& frame, Vec begin, Vec end, double radius, frond_color color) {
    const Vec axis = direction(end - begin, {0, 1, 0}), side = perpendicular(axis), other = cross(axis, side);
    Body body{frame, color};
    // Rings from the pole at the end to the pole at the beginning; the equator occurs twice, once for each half.
    const int ring_count = 2 * (RINGS + 1);
    uint32_t first = 0;
    for (int ring = 0; ring < ring_count; ring++) {
        const bool upper = ring <= RINGS;
        const double polar = 0.5 * PI * (upper ? ring : ring - 1) / RINGS;
        for (int slice = 0; slice <= SLICES; slice++) {
            const double around = 2 * PI * slice / SLICES;
            const Vec normal =
                std::cos(polar) * axis + std::sin(polar) * (std::cos(around) * side + std::sin(around) * other);
            const uint32_t vertex = body.add((upper ? end : begin) + radius * normal, normal);
            if (ring == 0 && slice == 0) first = vertex;
        }
    }
    for (int ring = 0; ring + 1 < ring_count; ring++)
        for (int slice = 0; slice < SLICES; slice++) {
            const uint32_t a = first + uint32_t(ring * (SLICES + 1) + slice), b = a + SLICES + 1;
            body.triangle(a, b, a + 1);
            body.triangle(a + 1, b, b + 1);
        }
    body.finish();
}

void append_sphere(Frame& frame, Vec center, double radius, frond_color color) {
    append_capsule(frame, center, center, radius, color);
}

void append_box(Frame& frame, Vec center, frond_quat rotation, Vec half_extents, frond_color color) {
    const Vec half[3] = {rotate(rotation, {half_extents.x, 0, 0}), rotate(rotation, {0, half_extents.y, 0}),
                         rotate(rotation, {0, 0, half_extents.z})};
    const Vec normals[3] = {rotate(rotation, {1, 0, 0}), rotate(rotation, {0, 1, 0}), rotate(rotation, {0, 0, 1})};
    Body body{frame, color};
    for (int axis = 0; axis < 3; axis++)
        for (int sign = -1; sign <= 1; sign += 2) {
            // u x v = axis, so that corners run counter-clockwise when seen from outside.
            const Vec u = double(sign) * half[(axis + 1) % 3], v = half[(axis + 2) % 3];
            const Vec middle = center + double(sign) * half[axis], normal = double(sign) * normals[axis];
            const uint32_t a = body.add(middle - u - v, normal), b = body.add(middle + u - v, normal);
            const uint32_t c = body.add(middle + u + v, normal), d = body.add(middle - u + v, normal);
            body.triangle(a, b, c);
            body.triangle(a, c, d);
        }
    body.finish();
}

}  // namespace picture
