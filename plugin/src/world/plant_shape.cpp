#include "world/plant_shape.hpp"

#include <algorithm>

#include "core/lanes.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Lists the inner nodes, each after its children.
static void list_inner(btDbvtNode* node, std::vector<btDbvtNode*>& out) {
    if (!node || node->isleaf()) return;
    list_inner(node->childs[0], out);
    list_inner(node->childs[1], out);
    out.push_back(node);
}

PlantShape::PlantShape(World& world, const Hull& hull) : world(world) {
    size_t child = 0;
    const auto add = [&](btCollisionShape& piece) {
        addChildShape(child < hull.modelled.size() ? hull.modelled[child] : btTransform::getIdentity(), &piece);
        child++;
    };
    for (const auto& capsule : hull.capsules) add(*capsule);
    for (const auto& plate : hull.plates) add(*plate);
    setMargin(btScalar(std::max(hull.wider_by_cage, hull.wider_by_sheath)));
    list_inner(getDynamicAabbTree()->m_root, inner);
    // All boxes are empty at first.
    room.assign(ROOM * (child + MOST_LANES), btScalar(BT_LARGE_FLOAT));
    for (size_t i = 0; i < room.size(); i += ROOM) std::fill_n(&room[i + UPPER], UPPER, btScalar(-BT_LARGE_FLOAT));
}

void PlantShape::getAabb(const btTransform& frame, btVector3& lower, btVector3& upper) const {
    if (!world.is_stepping) hold_gravity(world.gravity_ahead, *world.bullet);
    btCompoundShape::getAabb(frame, lower, upper);
}

void PlantShape::set_box(const btVector3& lower, const btVector3& upper) {
    m_localAabbMin = lower;
    m_localAabbMax = upper;
}

PlantShape::~PlantShape() {
    if (world.lacking.shape == this) world.lacking = {};
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
