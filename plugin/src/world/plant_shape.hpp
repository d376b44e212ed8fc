// PlantShape: the compound of a plant's capsules and plates, whose places follow the plant.
#pragma once

#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <array>
#include <vector>

#include "core/types.hpp"
#include "frond/frond_bullet.hpp"

namespace frond {

struct ChainBatch;

inline namespace FROND_BULLET_PRECISION {

struct Hull;
struct World;

// Asked by Bullet for its box once a substep, after gravity was given to bodies and before the solver: the one place
// there for what has to be done between the two.
struct PlantShape : btCompoundShape {
    // As modelled.
    PlantShape(World& world, const Hull& hull);
    void getAabb(const btTransform& frame, btVector3& lower, btVector3& upper) const override;

    World& world;
    // Of the tree of its children's boxes, which keeps its form: nodes with others below them, each after those. They
    // grow with these, and are fitted to them anew after so many growths.
    std::vector<btDbvtNode*> inner;
    int growths = 0;
    // The boxes in that tree, somewhat wider than the children, one after the other: lower x, y, z, no number, and
    // upper.
    std::vector<btScalar> room;

    void set_box(const btVector3& lower, const btVector3& upper);
};

// Where the pieces of a plant are.
struct PiecesNow {
    const Vec3* places;
    const std::vector<std::array<int, 2>>& ends;  // of each capsule, among the places
    const std::vector<Mat3>& frames;  // columns axis, thin and wide of each plate; zero: it stays turned as it was
};
void place_pieces(PlantShape& shape, const Hull& hull, const PiecesNow& now);
// The same of several plants of a hull side by side, to the last bit; `ends` are those of their capsules, among nodes.
void place_pieces(PlantShape* const* shapes, int count, const Hull& hull, const std::vector<std::array<int, 2>>& ends,
                  const ChainBatch& chains);
// The frame of a capsule, whose axis is y, between two points.
btTransform capsule_frame(const Vec3& begin, const Vec3& end);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
