// In: the chain's positions and rotations. Out: the vertices that follow them, and their normals.
//
// With the weight w(s) = s^2 (3 - 2 s), a vertex at c from the axis d of its capsule, at s along that, is at
//   p = (1 - w) (x_a + R_a c) + w (x_b + R_b c) + s (1 - s)^2 R_a d + s^2 (s - 1) R_b d,
// the deformation gradient with c = X - X_a - s d is F = (1 - w) R_a + w R_b + (dp/ds at fixed X) grad s, and its
// normal turns with the cofactor: cof(F) (u x v) = F u x F v for two tangents u, v of the surface.
#include <cmath>

#include "core/lanes.hpp"
#include "mechanics/rotation.hpp"
#include "plant/skin.hpp"

namespace frond {

namespace {

// A chain node in the world, its rotation by columns.
struct Frame {
    Quad place, column[3];
};

FROND_INLINE FourLanes lanes_of(const Vec3& v) {
    return FourLanes{v[0], v[1], v[2], 0};
}

std::vector<Frame> frames_in_world(const SkinDrawing& drawing) {
    std::vector<Frame> frames(size_t(drawing.x.size() / 6));
    for (size_t i = 0; i < frames.size(); ++i) {
        const Mat3 turn = drawing.turn * rotation_of<double>(point(drawing.x, int(2 * i + 1)));
        store(lanes_of(drawing.turn * point(drawing.x, int(2 * i)) + drawing.shift), frames[i].place);
        for (int c = 0; c < 3; ++c) store(lanes_of(turn.col(c)), frames[i].column[c]);
    }
    return frames;
}

FROND_INLINE FourLanes turned(const Frame& frame, const Vec3& v) {
    return load(frame.column[0]) * v[0] + load(frame.column[1]) * v[1] + load(frame.column[2]) * v[2];
}

FROND_INLINE FourLanes cross_of(const FourLanes& a, const FourLanes& b) {
    const FourLanes c = a * choose<1, 2, 0, 3>(b, b) - b * choose<1, 2, 0, 3>(a, a);
    return choose<1, 2, 0, 3>(c, c);
}

struct DrawVertices {
    const Skin& skin;
    const SkinDrawing& drawing;
    const std::vector<Frame>& frames;

    template <class>
    FROND_INLINE void run() const {
        for (size_t v = 0; v < skin.vertices.size(); ++v)
            if (drawing.part_of_vertex.empty() || drawing.part_of_vertex[v] == drawing.part) draw(v);
    }

    FROND_INLINE void draw(size_t v) const {
        const SkinVertex& vertex = skin.vertices[v];
        const Vec3 &axis = skin.axes[size_t(vertex.node)], &across = vertex.across;
        const Frame &a = frames[size_t(skin.parents[size_t(vertex.node)])], &b = frames[size_t(vertex.node)];
        const double s = vertex.along, w = s * s * (3 - 2 * s);
        const FourLanes from = load(a.place), to = load(b.place);
        const FourLanes axis_a = turned(a, axis), axis_b = turned(b, axis), across_a = turned(a, across),
                        across_b = turned(b, across);
        store_three((1 - w) * (from + across_a) + w * (to + across_b) + s * (1 - s) * (1 - s) * axis_a +
                        s * s * (s - 1) * axis_b,
                    drawing.positions + 3 * v);
        if (!drawing.normals) return;

        const FourLanes turned_axis = (1 - w) * axis_a + w * axis_b;
        const FourLanes by_s = 6 * s * (1 - s) * (to + across_b - from - across_a) + (1 - s) * (1 - 3 * s) * axis_a +
                               s * (3 * s - 2) * axis_b - turned_axis;
        const Vec3 gradient = vertex.gradient.cast<double>();
        FourLanes gradient_of_place[3];
        for (int c = 0; c < 3; ++c)
            gradient_of_place[c] = (1 - w) * load(a.column[c]) + w * load(b.column[c]) + gradient[c] * by_s;
        const auto image = [&](const Vec3& u) FROND_INLINED {
            return FourLanes(gradient_of_place[0] * u[0] + gradient_of_place[1] * u[1] + gradient_of_place[2] * u[2]);
        };
        // Two tangents of the surface with u x v along the normal (Duff and others 2017, "Building an orthonormal
        // basis, revisited").
        const Vec3 n = drawing.modelled_normals[v].cast<double>();
        const double sign = std::copysign(1.0, n[2]), p = -1 / (sign + n[2]), q = n[0] * n[1] * p;
        FourLanes normal = cross_of(image({1 + sign * n[0] * n[0] * p, sign * q, -sign * n[0]}),
                                    image({q, sign + n[1] * n[1] * p, -n[1]}));
        const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        normal = length > 0 ? normal * (1 / length) : turned(b, n);
        store_three(normal, drawing.normals + 3 * v);
    }
};

}  // namespace

void draw_skin(const Skin& skin, const SkinDrawing& drawing) {
    const std::vector<Frame> frames = frames_in_world(drawing);
    run_in_lanes(DrawVertices{skin, drawing, frames});
}

}  // namespace frond
