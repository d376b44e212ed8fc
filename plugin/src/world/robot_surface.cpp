// Makes the surface of a robot: the shapes that collide, as triangles that move with their links.
#include "io/urdf_pieces.hpp"
#include "world/robot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

RobotSurface make_surface(const UrdfTree& tree) {
    RobotSurface out;
    for (size_t i = 0; i < tree.links.size(); i++) {
        std::vector<UrdfPiece> pieces;
        for (const UrdfShape& shape : tree.links[i].collisions) pieces.push_back({int(i), &shape, shape.frame});
        const Surface surface = surface_of_pieces(tree, pieces);
        const int first = int(out.places.size());
        out.places.insert(out.places.end(), surface.positions.begin(), surface.positions.end());
        out.link.resize(out.places.size(), int(i));
        for (const Triangle& t : surface.triangles) out.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return out;
}

void update_surface(Robot& robot) {
    RobotSurface& surface = robot.surface;
    std::vector<UrdfFrame> frames;
    for (size_t i = 0; i < robot.links.size(); i++) frames.push_back(frame_of(robot, i));
    surface.positions.clear();
    for (size_t v = 0; v < surface.places.size(); v++) {
        const Vec3 place = frames[size_t(surface.link[v])] * surface.places[v];
        for (int axis = 0; axis < 3; axis++) surface.positions.push_back(float(place[axis]));
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
