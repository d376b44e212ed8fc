// In: a world of Frond's own. Out: the same without Bullet's memory of earlier steps: pairs, their order, contact
// points and the impulses at them.
//
// Bullet's broad phase and each compound are trees that every step changes a little. Pairs and points follow their
// order, on which the solver depends. So all objects leave the broad phase and enter it again in the order in which
// they are in the world, with new compounds.
#include "world/own_bullet.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

struct Filter {
    int group, mask, number;
    bool is_in;  // in the broad phase
};

Filter leave(World& world, btCollisionObject& object) {
    btBroadphaseProxy* proxy = object.getBroadphaseHandle();
    if (!proxy) return {0, 0, 0, false};
    btDbvtBroadphase& broad = world.own->broadphase;
    const Filter filter = {proxy->m_collisionFilterGroup, proxy->m_collisionFilterMask, proxy->m_uniqueId, true};
    broad.getOverlappingPairCache()->cleanProxyFromPairs(proxy, &world.own->dispatcher);
    broad.destroyProxy(proxy, &world.own->dispatcher);
    object.setBroadphaseHandle(nullptr);
    return filter;
}

void come_back(World& world, btCollisionObject& object, const Filter& filter) {
    btVector3 lower, upper;
    object.getCollisionShape()->getAabb(object.getWorldTransform(), lower, upper);
    object.setBroadphaseHandle(world.own->broadphase.createProxy(lower, upper,
                                                                 object.getCollisionShape()->getShapeType(), &object,
                                                                 filter.group, filter.mask, &world.own->dispatcher));
    world.bullet->updateSingleAabb(&object);
}

void renew_shape(PlantBody& body) {
    if (body.getCollisionShape() == body.hull->rest.get()) return;
    look_at(body);
    share_shape(body);
    take_own_shape(body);
}

}  // namespace

void find_contacts_anew(World& world) {
    if (!world.own) return;
    btCollisionObjectArray& objects = world.bullet->getCollisionObjectArray();
    std::vector<Filter> filters;
    std::map<const btCollisionObject*, std::array<int, 2>> numbers;  // in the broad phase, before and after
    const bool was_stepping = world.is_stepping;
    world.is_stepping = true;  // boxes are requested, but no step begins
    for (int i = 0; i < objects.size(); i++) filters.push_back(leave(world, *objects[i]));
    world.own->broadphase.resetPool(&world.own->dispatcher);
    for (const auto& body : world.bodies) renew_shape(*body);
    for (int i = 0; i < objects.size(); i++) {
        const Filter& filter = filters[size_t(i)];
        if (!filter.is_in) continue;
        come_back(world, *objects[i], filter);
        numbers[objects[i]] = {filter.number, objects[i]->getBroadphaseHandle()->m_uniqueId};
    }
    world.is_stepping = was_stepping;
    compress_looked_at(world);
    world.own->solver.reset();

    // Overlaps from when plants were made are stored by those numbers.
    for (const auto& body : world.bodies) {
        if (!body->grown_in) continue;
        GrownIn kept;
        for (const auto& [key, depth] : *body->grown_in) {
            const auto& [capsule, other, number] = key;
            const auto found = numbers.find(other);
            if (found != numbers.end() && found->second[0] == number) kept[{capsule, other, found->second[1]}] = depth;
        }
        *body->grown_in = std::move(kept);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
