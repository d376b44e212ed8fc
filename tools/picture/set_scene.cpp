// In: camera, light and the boxes of a frame. Out: the uniforms that all shaders share.
#include <algorithm>
#include <cstring>

#include "gl_objects.hpp"

namespace picture {

namespace {

void store(float (&out)[4], Vec v, double w) {
    out[0] = float(v.x), out[1] = float(v.y), out[2] = float(v.z), out[3] = float(w);
}
void store(float (&out)[4], frond_color color, double w) {
    out[0] = color.r, out[1] = color.g, out[2] = color.b, out[3] = float(w);
}

// Returns the transform into a frame of reference at `at` with the given axes as rows.
Mat4 look(Vec right, Vec up, Vec back, Vec at) {
    return {float(right.x),         float(up.x),         float(back.x),         0,
            float(right.y),         float(up.y),         float(back.y),         0,
            float(right.z),         float(up.z),         float(back.z),         0,
            float(-dot(right, at)), float(-dot(up, at)), float(-dot(back, at)), 1};
}

// Maps a box, seen along parallel light, to 0..1 in a square map. Outputs the map's width and depth range [m].
Mat4 light_matrix(const Box& box, Vec from, double& width, double& depth) {
    const Vec side = perpendicular(from), other = cross(from, side);
    Box turned;
    for (int corner = 0; corner < 8; corner++) {
        const Vec p{corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                    corner & 4 ? box.upper.z : box.lower.z};
        turned.add({dot(side, p), dot(other, p), -dot(from, p)});
    }
    const Vec size = turned.upper - turned.lower, middle = turned.middle();
    width = std::max({1.03 * size.x, 1.03 * size.y, 1e-4});
    depth = std::max(1.02 * size.z, 1e-4);
    const double s = 1 / width, d = 1 / depth;
    return {float(s * side.x),         float(s * other.x),        float(-d * from.x),        0,
            float(s * side.y),         float(s * other.y),        float(-d * from.y),        0,
            float(s * side.z),         float(s * other.z),        float(-d * from.z),        0,
            float(0.5 - s * middle.x), float(0.5 - s * middle.y), float(0.5 - d * middle.z), 1};
}

// Returns a direction of a set spread evenly over the upper half sphere by the golden angle.
Vec sky_direction(Vec up, int i, int count) {
    const Vec side = perpendicular(up), other = cross(up, side);
    const double height = 0.04 + 0.96 * (i + 0.5) / count, around = i * 2.39996322972865332;
    const double across = std::sqrt(std::max(0.0, 1 - height * height));
    return height * up + across * (std::cos(around) * side + std::sin(around) * other);
}

}  // namespace

Mat4 map_to_ground(const Frame& frame, Mat4& to_map) {
    // A square under the shadow casters, wide enough for shade that falls obliquely.
    const Vec up = direction(frame.scene.up, {0, 1, 0}), side = perpendicular(up), other = cross(up, side);
    Box casters = frame.solid_box;
    if (casters.empty()) casters.add({0, 0, 0});
    const Vec middle = casters.middle();
    const double height = frame.scene.ground_height - dot(up, frame.origin);
    const double half = std::max(1e-4, 2.2 * casters.radius());
    const Vec corner = middle + (height - dot(middle, up)) * up - half * side - half * other;
    const double s = 0.5 / half;
    to_map = {float(s * side.x),
              float(s * other.x),
              0,
              0,
              float(s * side.y),
              float(s * other.y),
              0,
              0,
              float(s * side.z),
              float(s * other.z),
              0,
              0,
              float(-s * dot(side, corner)),
              float(-s * dot(other, corner)),
              0,
              1};
    const Vec u = 2 * half * side, v = 2 * half * other;
    return {float(u.x), float(u.y), float(u.z), 0, float(v.x),      float(v.y),      float(v.z),      0,
            0,          0,          0,          0, float(corner.x), float(corner.y), float(corner.z), 1};
}

namespace {

// Returns the coefficients of the ground's depth in the sun's map, which is linear there, from three ground points.
Vec ground_plane(const Frame& frame, const Mat4& sun_matrix, double reach) {
    const Vec up = direction(frame.scene.up, {0, 1, 0}), side = perpendicular(up), other = cross(up, side);
    const Vec middle = (frame.scene.ground_height - dot(up, frame.origin)) * up;
    const auto place = [&](Vec p) {
        const auto row = [&](int r) {
            return sun_matrix[size_t(r)] * p.x + sun_matrix[size_t(4 + r)] * p.y + sun_matrix[size_t(8 + r)] * p.z +
                   sun_matrix[size_t(12 + r)];
        };
        return Vec{row(0), row(1), row(2)};
    };
    const Vec a = place(middle), u = place(middle + reach * side) - a, v = place(middle + reach * other) - a;
    // Light parallel to the ground never reaches it.
    const double area = u.x * v.y - u.y * v.x;
    if (!(std::fabs(area) > 1e-9)) return {0, 0, 1};
    const double x = (u.z * v.y - v.z * u.y) / area, y = (u.x * v.z - v.x * u.z) / area;
    return {x, y, a.z - x * a.x - y * a.y};
}

}  // namespace

void set_scene(const Renderer& renderer, const Frame& frame, SceneUniforms& scene, Mat4& inverse_view_projection) {
    const frond_picture_scene& wanted = frame.scene;
    const frond_picture_def& def = renderer.def;
    std::memset(&scene, 0, sizeof scene);

    // Camera. The frame's origin is its target.
    const Vec eye = wanted.camera.eye - frame.origin;
    const double focus = length(eye);
    const Vec back = direction(eye, {0, 0, 1});
    const Vec right = direction(cross(wanted.camera.up, back), perpendicular(back)), up = cross(back, right);
    const Vec ground_up = direction(wanted.up, {0, 1, 0});
    const double fade_begin = 1.6 * focus, fade_end = 7 * focus;

    // Near and far planes enclose everything drawn and the ground until it has faded out.
    double nearest = 1e-2 * focus, farthest = 1.1 * (focus + fade_end);
    if (!frame.box.empty()) {
        const double distance = length(frame.box.middle() - eye), radius = frame.box.radius();
        farthest = std::max(farthest, 1.01 * (distance + radius));
        nearest = std::max(nearest, std::min(0.5 * focus, 0.98 * (distance - radius)));
        if (wanted.ground) nearest = std::min(nearest, 0.2 * focus);
    }
    const double slope = std::tan(0.5 * wanted.camera.field_of_view), aspect = double(def.width) / def.height;
    const double a = (farthest + nearest) / (nearest - farthest), b = 2 * farthest * nearest / (nearest - farthest);
    const Mat4 projection = {
        float(1 / (slope * aspect)), 0, 0, 0, 0, float(1 / slope), 0, 0, 0, 0, float(a), -1, 0, 0, float(b), 0};
    scene.view_projection = multiply(projection, look(right, up, back, eye));

    // Maps a pixel to a far point: the camera's axes scaled by the field of view.
    const Vec x = slope * aspect * right, y = slope * up, z = eye - back;
    inverse_view_projection = {float(x.x), float(x.y), float(x.z), 0, float(y.x), float(y.y), float(y.z), 0,
                               0,          0,          0,          0, float(z.x), float(z.y), float(z.z), 1};

    // Sun: as given, or over the camera's left shoulder and rather high.
    Vec sun = wanted.sun_direction;
    if (length(sun) < 1e-12) {
        const Vec level = direction(back - dot(back, ground_up) * ground_up, back);
        sun = -0.75 * right + 1.05 * ground_up + 0.3 * level;
    }
    sun = direction(sun, ground_up);
    Box casters = frame.solid_box;
    if (casters.empty()) casters.add({0, 0, 0});
    double sun_width = 1, sun_depth = 1, sky_width = 1, sky_depth = 1, sky_texel = 0;
    scene.sun_matrix = light_matrix(casters, sun, sun_width, sun_depth);
    for (int i = 0; i < def.sky_samples; i++) {
        const Vec from = sky_direction(ground_up, i, def.sky_samples);
        scene.sky_matrices[i] = light_matrix(casters, from, sky_width, sky_depth);
        store(scene.sky_directions[i], from, 0);
        sky_texel = std::max(sky_texel, sky_width / renderer.sky_size);
    }

    store(scene.eye, eye, fade_begin);
    store(scene.up, ground_up, fade_end);
    store(scene.sun_direction, sun, sun_width / def.shadow_size);
    store(scene.sun_color, wanted.sun, wanted.exposure);
    store(scene.sky_color, wanted.sky, sky_texel);
    store(scene.ground_color, wanted.ground_color, sun_depth);
    store(scene.ground_plane, ground_plane(frame, scene.sun_matrix, sun_width), 0);
    store(scene.top_color, wanted.background_top, 1);
    store(scene.horizon_color, wanted.background_horizon, 1);
    store(scene.viewport, Vec{double(def.width), double(def.height), sun_width}, focus);
    map_to_ground(frame, scene.ground_matrix);
    scene.counts[0] = def.sky_samples;
    scene.counts[1] = renderer.samples > 1;
    scene.counts[2] = wanted.ground;
}

}  // namespace picture
