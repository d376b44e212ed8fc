// In: a ray through the mouse. Out: a spring that holds the plant at the first hit of the ray and follows the mouse in
// the plane that faces the camera there.
#include <algorithm>
#include <cmath>

#include "scenes/vector.hpp"
#include "view/viewer.hpp"

namespace frond::tools {

namespace {

// Returns the distance along the ray to a two-sided triangle; infinite if it misses (Moeller and Trumbore 1997).
double meet_triangle(const Ray& ray, const frond_vec3& a, const frond_vec3& b, const frond_vec3& c) {
    const frond_vec3 ab = b - a, ac = c - a, p = cross(ray.direction, ac);
    const double det = dot(ab, p);
    if (std::abs(det) < 1e-30) return INFINITY;
    const frond_vec3 to = ray.origin - a, q = cross(to, ab);
    const double u = dot(to, p) / det, v = dot(ray.direction, q) / det, t = dot(ac, q) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : INFINITY;
}

Ray mouse_ray(const Viewer& viewer) {
    return ray_through(viewer.camera, viewer.mouse_x, viewer.mouse_y, viewer.width, viewer.height);
}

// Returns the scene's stiffness, or one that carries thrice the plant's weight when stretched by its height.
double stiffness_of(const Viewer& viewer, frond_plant plant) {
    constexpr double WEIGHTS = 3;
    const Stage& stage = viewer.play->stage;
    if (viewer.settings.grab_stiffness > 0) return viewer.settings.grab_stiffness;
    const size_t i = size_t(std::find_if(stage.plants.begin(), stage.plants.end(),
                                         [&](frond_plant other) { return other.id == plant.id; }) -
                            stage.plants.begin());
    frond_model_info info;
    must(frond_model_get_info(stage.plant_models[i], &info));
    return std::max(WEIGHTS * 9.81 * info.mass / std::max(info.upper.y - info.lower.y, 1e-6), 1e-6);
}

}  // namespace

Pick pick(const Stage& stage, const Ray& ray) {
    Pick best = {{}, {}, INFINITY};
    for (size_t i = 0; i < stage.plants.size(); i++) {
        if (!stage.sees(i)) continue;
        frond_surface_view view;
        must(frond_plant_get_surface(stage.plants[i], &view));
        const auto corner = [&](int32_t vertex) {
            const float* p = view.positions + 3 * size_t(vertex);
            return frond_vec3{double(p[0]), double(p[1]), double(p[2])};
        };
        for (int t = 0; t < view.triangle_count; t++) {
            const int32_t* v = view.indices + 3 * size_t(t);
            const double distance = meet_triangle(ray, corner(v[0]), corner(v[1]), corner(v[2]));
            if (distance < best.distance) best = {stage.plants[i], {}, distance};
        }
    }
    if (best.plant.id) best.point = ray.origin + best.distance * ray.direction;
    return best;
}

bool take_hold(Viewer& viewer) {
    const Pick hit = pick(viewer.play->stage, mouse_ray(viewer));
    if (!hit.plant.id) return false;
    let_go(viewer);
    must(frond_grab_create(hit.plant, hit.point, stiffness_of(viewer, hit.plant), &viewer.hand.grab));
    must(frond_grab_get(viewer.hand.grab, nullptr, &viewer.hand.start, nullptr));
    viewer.hand.hold = hit.point;
    viewer.hand.target = viewer.hand.wanted = viewer.hand.start;
    return true;
}

void move_hand(Viewer& viewer) {
    if (!frond_grab_is_valid(viewer.hand.grab)) return;
    const frond_vec3 to = meet_facing_plane(viewer.camera, mouse_ray(viewer), viewer.hand.hold);
    viewer.hand.wanted = viewer.hand.start + (to - viewer.hand.hold);
}

void follow_mouse(Viewer& viewer) {
    constexpr double SPEED = 0.7;  // speed in picture heights [1/s]
    Hand& hand = viewer.hand;
    if (!frond_grab_is_valid(hand.grab)) return;
    const double high = 2 * viewer.camera.distance * std::tan(0.5 * viewer.camera.field_of_view);
    const double most = SPEED * high * viewer.settings.dt;
    const frond_vec3 way = hand.wanted - hand.target;
    hand.target = hand.target + std::min(1.0, most / std::max(length(way), 1e-30)) * way;
    must(frond_grab_move(hand.grab, hand.target));
}

void let_go(Viewer& viewer) {
    frond_grab_destroy(viewer.hand.grab);
    viewer.hand = {};
}

}  // namespace frond::tools
