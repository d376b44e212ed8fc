// Camera: looks at a point from a distance, and orbits around it.
#pragma once

#include "picture/frond_picture.h"

namespace frond::tools {

struct Camera {
    frond_vec3 target = {};
    double distance = 1;                // [m]
    double azimuth = 0, elevation = 0;  // [rad], as in frond_picture_frame
    double field_of_view = 0.6;         // vertical [rad]
};

struct Ray {
    frond_vec3 origin, direction;  // the direction is a unit vector
};

// Returns the camera of a picture.
Camera camera_of(const frond_picture_camera& camera);
frond_picture_camera picture_camera(const Camera& camera);
// Returns the ray through a pixel of a picture of that size, counted from its upper left corner.
Ray ray_through(const Camera& camera, double x, double y, int width, int height);
// Orbit or pan by a movement of the mouse [pixel]. height: of the picture.
void orbit(Camera& camera, double dx, double dy);
void pan(Camera& camera, double dx, double dy, int height);
void zoom(Camera& camera, double clicks);
// Returns where a ray meets the plane through a point that faces the camera; the point itself if it never does.
frond_vec3 meet_facing_plane(const Camera& camera, const Ray& ray, const frond_vec3& point);

}  // namespace frond::tools
