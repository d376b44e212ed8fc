// In: a rigid body made by Frond. Out: its shape in the picture.
#include <cmath>
#include <vector>

#include "require.hpp"

using namespace picture;

namespace {

frond_vec3 turned(const frond_quat& q, const frond_vec3& p) {
    const frond_vec3 u = {q.x, q.y, q.z};
    const auto cross = [](const frond_vec3& a, const frond_vec3& b) {
        return frond_vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    };
    const frond_vec3 t = cross(u, p), s = cross(u, t);
    return {p.x + 2 * (q.w * t.x + s.x), p.y + 2 * (q.w * t.y + s.y), p.z + 2 * (q.w * t.z + s.z)};
}

frond_vec3 placed(const frond_rigid_state& state, const frond_vec3& p) {
    const frond_vec3 t = turned(state.rotation, p);
    return {state.position.x + t.x, state.position.y + t.y, state.position.z + t.z};
}

// Draws a prism or a pyramid with many sides and flat faces.
bool draw_round(frond_picture* picture, const frond_rigid_state& state, double radius_low, double radius_high,
                double half, frond_color color) {
    constexpr int SIDES = 48;
    std::vector<float> positions;
    const auto add = [&](double r, double y, int side) {
        const double angle = 2 * M_PI * side / SIDES;
        const frond_vec3 p = placed(state, {r * std::cos(angle), y, r * std::sin(angle)});
        for (double value : {p.x, p.y, p.z}) positions.push_back(float(value));
    };
    for (int side = 0; side < SIDES; side++) add(radius_low, -half, side);
    for (int side = 0; side < SIDES; side++) add(radius_high, half, side);
    add(0, -half, 0);
    add(0, half, 0);
    std::vector<int32_t> indices;
    for (int32_t a = 0; a < SIDES; a++) {
        const int32_t b = (a + 1) % SIDES, c = SIDES + a, d = SIDES + b;
        for (int32_t i : {a, c, b, b, c, d, a, b, 2 * SIDES, c, 2 * SIDES + 1, d}) indices.push_back(i);
    }
    const frond_picture_part part = {0, int(indices.size() / 3), color, -1, 0, 0.2f, false};
    frond_picture_mesh mesh{};
    mesh.positions = positions.data();
    mesh.indices = indices.data();
    mesh.vertex_count = int(positions.size() / 3);
    mesh.triangle_count = part.triangle_count;
    mesh.parts = &part;
    mesh.part_count = 1;
    return frond_picture_draw_mesh(picture, &mesh);
}

}  // namespace

bool frond_picture_draw_rigid(frond_picture* picture, const frond_rigid_def* def, frond_rigid rigid,
                              frond_color color) {
    return guarded([&] {
        int width = 0;
        require(frond_picture_get_size(picture, &width, nullptr));
        if (!def) fail("def is null; pass the one that the body was made with");
        frond_rigid_state state;
        require(frond_rigid_get_state(rigid, &state), "the rigid body");
        const frond_vec3& size = def->size;
        const auto end = [&](double y) { return placed(state, {0, y, 0}); };
        switch (def->shape) {
            case FROND_SHAPE_SPHERE:
                require(frond_picture_draw_sphere(picture, state.position, size.x, color));
                break;
            case FROND_SHAPE_BOX:
                require(frond_picture_draw_box(picture, state.position, state.rotation, size, color));
                break;
            case FROND_SHAPE_CAPSULE:
                require(frond_picture_draw_capsule(picture, end(-size.y), end(size.y), size.x, color));
                break;
            case FROND_SHAPE_CYLINDER:
                require(draw_round(picture, state, size.x, size.x, size.y, color));
                break;
            case FROND_SHAPE_CONE:
                require(draw_round(picture, state, size.x, 0, size.y, color));
                break;
            default:
                break;
        }
    });
}
