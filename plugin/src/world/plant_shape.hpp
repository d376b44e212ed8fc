// PlantShape: the compound of a plant's capsules and plates, which follow the plant.
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

// Bullet requests its box once a substep, after it has applied gravity to bodies and before its solver: the only hook
// between the two.
struct PlantShape : btCompoundShape {
    // Places the children as modelled.
    PlantShape(World& world, const Hull& hull);
    void getAabb(const btTransform& frame, btVector3& lower, btVector3& upper) const override;

    World& world;
    // Inner nodes of the tree of its children's boxes, which keeps its form; each after its children. Their boxes grow
    // with the children's, and are refitted after a number of growths.
    std::vector<btDbvtNode*> inner;
    int growths = 0;
    // Boxes of the children in that tree, somewhat wider than they are: lower x, y, z and padding, then upper likewise.
    static constexpr size_t ROOM = 8, UPPER = 4;  // numbers of a child's box; where its upper corner begins
    std::vector<btScalar> room;

    ~PlantShape() override;
    void set_box(const btVector3& lower, const btVector3& upper);
};

// Present places of a plant's segments.
struct PiecesNow {
    const Vec3* places;
    const std::vector<std::array<int, 2>>& ends;  // ends of each capsule, indices into places
    const std::vector<Mat3>& frames;              // columns axis, thin and wide of each plate; zero: its rotation stays
};
void place_pieces(PlantShape& shape, const Hull& hull, const PiecesNow& now);
// Does the same for a batch of plants of a hull, to the last bit; `ends`: the chain nodes of each capsule.
void place_pieces(PlantShape* const* shapes, int count, const Hull& hull, const std::vector<std::array<int, 2>>& ends,
                  const ChainBatch& chains);
// Returns the frame of a capsule, whose axis is y, between two points.
btTransform capsule_frame(const Vec3& begin, const Vec3& end);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
