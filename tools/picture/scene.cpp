// In: a scene from the caller. Out: the same, checked. Also the default scene and the camera that frames a box.
#include <algorithm>

#include "error.hpp"
#include "frame.hpp"

namespace picture {

namespace {
constexpr uint32_t SCENE_COOKIE = 0x5ce7e01u;
}

frond_color checked_color(frond_color color, const char* what) {
    for (float value : {color.r, color.g, color.b, color.a})
        if (!(value >= 0 && value <= 1000)) fail("%s has a component of %g; use 0..1", what, double(value));
    return color;
}

frond_picture_scene checked_scene(const frond_picture_scene& scene) {
    if (scene.cookie != SCENE_COOKIE) fail("the scene was not made by frond_default_picture_scene; start from that");
    const frond_picture_camera& camera = scene.camera;
    if (!drawable(camera.eye) || !drawable(camera.target))
        fail("the camera's eye or target is not finite or too far away; use coordinates up to %g m",
             FROND_PICTURE_FARTHEST);
    if (!(length(camera.eye - camera.target) > 1e-6))
        fail("the camera's eye and target are the same point; move one of them");
    if (!finite(camera.up) || !(length(camera.up) > 1e-12)) fail("the camera's up is not a direction; use (0, 1, 0)");
    if (!(camera.field_of_view >= 0.01 && camera.field_of_view <= 3))
        fail("the camera's field of view is %g; use 0.01..3 radians", camera.field_of_view);
    if (!finite(scene.sun_direction)) fail("the sun's direction is not finite; use (0, 0, 0) for the default");
    if (!finite(scene.up) || !(length(scene.up) > 1e-12)) fail("the scene's up is not a direction; use (0, 1, 0)");
    if (!(std::fabs(scene.ground_height) <= FROND_PICTURE_FARTHEST))
        fail("the ground's height is %g m; use at most %g", scene.ground_height, FROND_PICTURE_FARTHEST);
    if (!(scene.exposure >= 0 && scene.exposure <= 100)) fail("the exposure is %g; use 0..100", scene.exposure);
    checked_color(scene.sun, "the sun");
    checked_color(scene.sky, "the sky");
    checked_color(scene.background_top, "the background's top");
    checked_color(scene.background_horizon, "the background's horizon");
    checked_color(scene.ground_color, "the ground");
    return scene;
}

}  // namespace picture

using namespace picture;

frond_picture_scene frond_default_picture_scene(void) {
    frond_picture_scene scene{};
    scene.sun = {2.75f, 2.6f, 2.3f, 1};
    scene.sky = {0.78f, 0.86f, 0.98f, 1};
    scene.exposure = 1;
    scene.background_top = {0.42f, 0.53f, 0.64f, 1};
    scene.background_horizon = {0.86f, 0.87f, 0.85f, 1};
    scene.ground = true;
    scene.up = {0, 1, 0};
    scene.ground_color = {0.68f, 0.66f, 0.61f, 1};
    scene.cookie = SCENE_COOKIE;
    scene.camera = frond_picture_frame({-0.5, 0, -0.5}, {0.5, 1, 0.5}, {0, 1, 0}, 0.5, 0.25, 16.0 / 9);
    return scene;
}

frond_picture_camera frond_picture_frame(frond_vec3 lower, frond_vec3 upper, frond_vec3 up, double azimuth,
                                         double elevation, double aspect) {
    // Invalid bounds are replaced by the unit box seen from the default direction.
    const bool sound = drawable(lower) && drawable(upper) && lower.x <= upper.x && lower.y <= upper.y &&
                       lower.z <= upper.z && aspect >= 1e-3 && aspect <= 1e3 && std::isfinite(azimuth) &&
                       std::isfinite(elevation);
    if (!sound) lower = {-0.5, 0, -0.5}, upper = {0.5, 1, 0.5}, azimuth = 0.5, elevation = 0.25, aspect = 16.0 / 9;
    elevation = std::clamp(elevation, -1.57, 1.57);
    up = finite(up) ? direction(up, {0, 1, 0}) : Vec{0, 1, 0};

    // Horizontal directions; azimuth 0 looks from `front`.
    const Vec away = std::fabs(up.z) > 0.9 ? Vec{0, -1, 0} : Vec{0, 0, 1};
    const Vec front = direction(away - dot(away, up) * up, perpendicular(up)), side = cross(up, front);
    const Vec level = std::cos(azimuth) * front + std::sin(azimuth) * side;
    const Vec back = std::cos(elevation) * level + std::sin(elevation) * up;
    const Vec right = direction(cross(up, back), side), over = cross(back, right);

    // Move back until every corner of the box is inside the picture with a margin.
    frond_picture_camera camera{};
    camera.field_of_view = 0.6;
    camera.up = up;
    camera.target = 0.5 * (lower + upper);
    const double slope = std::tan(0.5 * camera.field_of_view) / 1.12;
    double distance = 1e-3;
    for (int corner = 0; corner < 8; corner++) {
        const Vec p =
            Vec{corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y, corner & 4 ? upper.z : lower.z} -
            camera.target;
        const double needed = std::max(std::fabs(dot(p, right)) / aspect, std::fabs(dot(p, over))) / slope;
        distance = std::max(distance, needed + dot(p, back));
    }
    camera.eye = camera.target + distance * back;
    return camera;
}
