// Collision shapes of a robot's link: the file's shapes come in, a compound of Bullet's shapes goes out. Meshes
// become their convex hulls.

#include "world/convert.hpp"
#include "world/robot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

static std::unique_ptr<btCollisionShape> make_hull(const UrdfMesh& mesh, const Vec3& scale) {
    constexpr double MARGIN = 0.001;  // Bullet's default would make a finger four centimetres fatter [m]
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& place : mesh.positions) hull->addPoint(to_bullet(place.cwiseProduct(scale)), false);
    hull->recalcLocalAabb();
    hull->optimizeConvexHull();
    hull->setMargin(btScalar(MARGIN));
    return hull;
}

static std::unique_ptr<btCollisionShape> make_shape(const UrdfTree& tree, const UrdfShape& shape) {
    const btScalar radius = btScalar(shape.size[0]), length = btScalar(shape.size[1]);
    switch (shape.kind) {
        case UrdfKind::BOX:
            return std::make_unique<btBoxShape>(to_bullet(0.5 * shape.size));
        case UrdfKind::CYLINDER:
            return std::make_unique<btCylinderShapeZ>(btVector3(radius, radius, length / 2));
        case UrdfKind::CAPSULE:
            return std::make_unique<btCapsuleShapeZ>(radius, length);
        case UrdfKind::MESH:
            return make_hull(tree.meshes[size_t(shape.mesh)], shape.size);
        default:
            return std::make_unique<btSphereShape>(radius);
    }
}

static btTransform to_bullet(const UrdfFrame& frame) {
    return btTransform(to_bullet(frame.turn), to_bullet(frame.origin));
}

bool make_shapes(const UrdfTree& tree, const UrdfLink& link, const UrdfFrame& centre, RobotLink& out) {
    if (link.collisions.empty()) return false;
    const UrdfFrame back = {centre.turn.conjugate() * -centre.origin, centre.turn.conjugate()};
    auto compound = std::make_unique<btCompoundShape>();
    for (const UrdfShape& shape : link.collisions) {
        out.shapes.push_back(make_shape(tree, shape));
        compound->addChildShape(to_bullet(back * shape.frame), out.shapes.back().get());
    }
    out.shapes.push_back(std::move(compound));
    return true;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
