// Casts rays against the capsules, by Bullet's own ray test.
#include "world/convert.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Keeps the nearest hit of a plant of this world and ignores everything else.
struct NearestPlant : btCollisionWorld::RayResultCallback {
    World* world = nullptr;
    const PlantBody* body = nullptr;
    int capsule = -1;

    bool needsCollision(btBroadphaseProxy* proxy) const override {
        const PlantBody* candidate = PlantBody::of(static_cast<btCollisionObject*>(proxy->m_clientObject));
        return candidate && candidate->world == world;
    }
    btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool) override {
        m_closestHitFraction = result.m_hitFraction;
        m_collisionObject = result.m_collisionObject;
        body = PlantBody::of(result.m_collisionObject);
        capsule = body->hull->capsule_of(result.m_localShapeInfo ? result.m_localShapeInfo->m_triangleIndex : 0);
        return result.m_hitFraction;
    }
};

RayHit cast_ray(World& world, const Vec3& from, const Vec3& to) {
    NearestPlant nearest;
    nearest.world = &world;
    world.bullet->rayTest(to_bullet(from), to_bullet(to), nearest);
    RayHit hit;
    if (!nearest.body) return hit;
    hit.body = const_cast<PlantBody*>(nearest.body);
    hit.capsule = nearest.capsule;
    hit.point = from + double(nearest.m_closestHitFraction) * (to - from);
    return hit;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
