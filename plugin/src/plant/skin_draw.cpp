// In: the chain's positions and rotations. Out: the vertices that follow them, and their normals.
//
// With the weight w(s) = s^2 (3 - 2 s), a vertex at c from the axis d of its capsule, at s along that, is at
//   p = (1 - w) (x_a + R_a c) + w (x_b + R_b c) + s (1 - s)^2 R_a d + s^2 (s - 1) R_b d,
// the deformation gradient with c = X - X_a - s d is F = (1 - w) R_a + w R_b + (dp/ds at fixed X) grad s, and its
// normal turns with the cofactor: cof(F) (u x v) = F u x F v for two tangents u, v of the surface.
//
// Vertices of a capsule are drawn together, one a lane.
#include <algorithm>
#include <cmath>

#include "core/lane_vectors.hpp"
#include "mechanics/rotation.hpp"
#include "plant/skin.hpp"

namespace frond {

namespace {

// A chain node in the world.
struct Frame {
    Vec3 place;
    Mat3 turn;
};

std::vector<Frame> frames_in_world(const SkinDrawing& drawing) {
    std::vector<Frame> frames(size_t(drawing.x.size() / 6));
    for (size_t i = 0; i < frames.size(); ++i)
        frames[i] = {drawing.turn * point(drawing.x, int(2 * i)) + drawing.shift,
                     drawing.turn * rotation_of<double>(point(drawing.x, int(2 * i + 1)))};
    return frames;
}

template <class S>
FROND_INLINE Lanes3<S> in_all_lanes(const Vec3& v) {
    return {constant<S>(v[0]), constant<S>(v[1]), constant<S>(v[2])};
}
// Returns of(lane), a vector, in each lane.
template <class S, class Of>
FROND_INLINE Lanes3<S> gather3(const Of& of) {
    return {gather<S>([&](int lane) { return double(of(lane)[0]); }),
            gather<S>([&](int lane) { return double(of(lane)[1]); }),
            gather<S>([&](int lane) { return double(of(lane)[2]); })};
}

// The same frame in all lanes.
template <class S>
struct FrameInLanes {
    Lanes3<S> place, column[3];
    FROND_INLINE explicit FrameInLanes(const Frame& frame) : place(in_all_lanes<S>(frame.place)) {
        for (int c = 0; c < 3; ++c) column[c] = in_all_lanes<S>(frame.turn.col(c));
    }
    FROND_INLINE Lanes3<S> turned(const Lanes3<S>& v) const {
        return v.x * column[0] + v.y * column[1] + v.z * column[2];
    }
};

template <class S>
FROND_INLINE void store_lane(const Lanes3<S>& v, int lane, float* to) {
    to[0] = float(lane_of(v.x, lane)), to[1] = float(lane_of(v.y, lane)), to[2] = float(lane_of(v.z, lane));
}

struct DrawVertices {
    const Skin& skin;
    const SkinDrawing& drawing;
    const std::vector<Frame>& frames;

    template <class S>
    FROND_INLINE void run() const {
        const int count = int(skin.by_capsule.size());
        const auto node_of = [&](int k) { return skin.vertices[size_t(skin.by_capsule[size_t(k)])].node; };
        for (int begin = 0, end; begin < count; begin = end) {
            const int node = node_of(begin);
            for (end = begin + 1; end < count && node_of(end) == node;) ++end;
            draw_capsule<S>(node, begin, end);
        }
    }

    // Draws the vertices of the capsule that ends at a chain node.
    template <class S>
    FROND_INLINE void draw_capsule(int node, int begin, int end) const {
        const FrameInLanes<S> a(frames[size_t(skin.parents[size_t(node)])]), b(frames[size_t(node)]);
        const Lanes3<S> axis = in_all_lanes<S>(skin.axes[size_t(node)]);
        const Lanes3<S> axis_a = a.turned(axis), axis_b = b.turned(axis);
        for (int k = begin; k < end; k += LANES<S>) {
            // The last vertex fills what is left of the lanes.
            int index[LANES<S>];
            for (int lane = 0; lane < LANES<S>; ++lane)
                index[lane] = skin.by_capsule[size_t(std::min(k + lane, end - 1))];
            draw<S>(index, a, b, axis_a, axis_b);
        }
    }

    template <class S>
    FROND_INLINE void draw(const int* index, const FrameInLanes<S>& a, const FrameInLanes<S>& b,
                           const Lanes3<S>& axis_a, const Lanes3<S>& axis_b) const {
        const auto vertex = [&](int lane) -> const SkinVertex& { return skin.vertices[size_t(index[lane])]; };
        const auto is_drawn = [&](int lane) {
            return drawing.part_of_vertex.empty() || drawing.part_of_vertex[size_t(index[lane])] == drawing.part;
        };
        const S s = gather<S>([&](int lane) { return vertex(lane).along; }), w = s * s * (3 - 2 * s);
        const Lanes3<S> across = gather3<S>([&](int lane) -> const Vec3& { return vertex(lane).across; });
        const Lanes3<S> from = a.place + a.turned(across), to = b.place + b.turned(across);
        const Lanes3<S> place = (1 - w) * from + w * to + s * (1 - s) * (1 - s) * axis_a + s * s * (s - 1) * axis_b;
        for (int lane = 0; lane < LANES<S>; ++lane)
            if (is_drawn(lane)) store_lane(place, lane, drawing.positions + 3 * index[lane]);
        if (!drawing.normals) return;

        const Lanes3<S> turned_axis = (1 - w) * axis_a + w * axis_b;
        const Lanes3<S> by_s =
            6 * s * (1 - s) * (to - from) + (1 - s) * (1 - 3 * s) * axis_a + s * (3 * s - 2) * axis_b - turned_axis;
        const Lanes3<S> gradient = gather3<S>([&](int lane) -> const Vec3f& { return vertex(lane).gradient; });
        const Lanes3<S> of_place[3] = {(1 - w) * a.column[0] + w * b.column[0] + gradient.x * by_s,
                                       (1 - w) * a.column[1] + w * b.column[1] + gradient.y * by_s,
                                       (1 - w) * a.column[2] + w * b.column[2] + gradient.z * by_s};
        const auto image = [&](const Lanes3<S>& u) FROND_INLINED {
            return Lanes3<S>(u.x * of_place[0] + u.y * of_place[1] + u.z * of_place[2]);
        };
        // Two tangents of the surface with u x v along the normal (Duff and others 2017, "Building an orthonormal
        // basis, revisited").
        const auto modelled = [&](int lane) -> const Vec3f& { return drawing.modelled_normals[size_t(index[lane])]; };
        const Lanes3<S> n = gather3<S>(modelled);
        const S sign = gather<S>([&](int lane) { return std::copysign(1.0, double(modelled(lane)[2])); });
        const S p = -1 / (sign + n.z), q = n.x * n.y * p;
        const Lanes3<S> normal =
            cross(image({1 + sign * n.x * n.x * p, sign * q, -sign * n.x}), image({q, sign + n.y * n.y * p, -n.y}));
        const S length = sqrt(dot(normal, normal));
        const Lanes3<S> unit = select(length > 0, (1 / length) * normal, b.turned(n));
        for (int lane = 0; lane < LANES<S>; ++lane)
            if (is_drawn(lane)) store_lane(unit, lane, drawing.normals + 3 * index[lane]);
    }
};

}  // namespace

void draw_skin(const Skin& skin, const SkinDrawing& drawing) {
    const std::vector<Frame> frames = frames_in_world(drawing);
    run_in_lanes(most_lanes(), DrawVertices{skin, drawing, frames});
}

}  // namespace frond
