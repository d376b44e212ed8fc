#include "view/camera.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/vector.hpp"

namespace frond::tools {

namespace {

struct Axes {
    frond_vec3 right, up, back;
};

Axes axes_of(const Camera& camera) {
    const double ca = std::cos(camera.azimuth), sa = std::sin(camera.azimuth);
    const double ce = std::cos(camera.elevation), se = std::sin(camera.elevation);
    Axes axes;
    axes.back = {ce * sa, se, ce * ca};
    axes.right = {ca, 0, -sa};
    axes.up = cross(axes.back, axes.right);
    return axes;
}

}  // namespace

Camera camera_of(const frond_picture_camera& given) {
    Camera camera;
    const frond_vec3 back = given.eye - given.target;
    camera.target = given.target;
    camera.distance = length(back);
    camera.azimuth = std::atan2(back.x, back.z);
    camera.elevation = std::asin(back.y / camera.distance);
    camera.field_of_view = given.field_of_view;
    return camera;
}

frond_picture_camera picture_camera(const Camera& camera) {
    return {camera.target + camera.distance * axes_of(camera).back, camera.target, {0, 1, 0}, camera.field_of_view};
}

Ray ray_through(const Camera& camera, double x, double y, int width, int height) {
    const Axes axes = axes_of(camera);
    const double slope = std::tan(0.5 * camera.field_of_view), aspect = double(width) / height;
    const frond_vec3 direction =
        (2 * x / width - 1) * slope * aspect * axes.right + (1 - 2 * y / height) * slope * axes.up + -1.0 * axes.back;
    return {camera.target + camera.distance * axes.back, (1 / length(direction)) * direction};
}

void orbit(Camera& camera, double dx, double dy) {
    constexpr double TURN = 0.008, LOWEST = -0.3, HIGHEST = 1.55;  // [rad/pixel], [rad]
    camera.azimuth -= TURN * dx;
    camera.elevation = std::clamp(camera.elevation + TURN * dy, LOWEST, HIGHEST);
}

void pan(Camera& camera, double dx, double dy, int height) {
    const Axes axes = axes_of(camera);
    const double pixel = 2 * camera.distance * std::tan(0.5 * camera.field_of_view) / height;  // [m]
    camera.target = camera.target + -dx * pixel * axes.right + dy * pixel * axes.up;
}

void zoom(Camera& camera, double clicks) {
    constexpr double NEARER = 0.9, NEAREST = 0.01, FARTHEST = 1e4;  // [m]
    camera.distance = std::clamp(camera.distance * std::pow(NEARER, clicks), NEAREST, FARTHEST);
}

frond_vec3 meet_facing_plane(const Camera& camera, const Ray& ray, const frond_vec3& point) {
    const frond_vec3 back = axes_of(camera).back;
    const double towards = dot(ray.direction, back), away = dot(point - ray.origin, back);
    if (!(away / towards > 0)) return point;
    return ray.origin + (away / towards) * ray.direction;
}

}  // namespace frond::tools
