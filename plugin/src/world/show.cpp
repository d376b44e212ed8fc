#include "world/show.hpp"

#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

struct FindPlants : btBroadphaseAabbCallback {
    const World& world;
    std::vector<PlantBody*> found;
    explicit FindPlants(const World& world) : world(world) {}
    bool process(const btBroadphaseProxy* proxy) override {
        PlantBody* body = PlantBody::of(static_cast<btCollisionObject*>(proxy->m_clientObject));
        if (body && body->world == &world) found.push_back(body);
        return true;
    }
};

}  // namespace

std::vector<PlantBody*> plants_in(World& world, const btVector3& lower, const btVector3& upper) {
    FindPlants plants(world);
    world.bullet->getBroadphase()->aabbTest(lower, upper, plants);
    return std::move(plants.found);
}

void show_sleepers_to(World& world, const btCollisionObject& mover, double h) {
    constexpr btScalar STEPS = 3,
                       NEAR = btScalar(0.02);  // pairs are made a substep later, contacts in the next; [m]
    const btBroadphaseProxy* proxy = mover.getBroadphaseHandle();
    const btRigidBody* rigid = btRigidBody::upcast(&mover);
    if (!proxy) return;
    const btVector3 way = rigid ? rigid->getLinearVelocity() * (STEPS * btScalar(h)) : btVector3(0, 0, 0);
    const btVector3 near(NEAR, NEAR, NEAR);
    btVector3 lower = proxy->m_aabbMin, upper = proxy->m_aabbMax;
    lower.setMin(proxy->m_aabbMin + way);
    upper.setMax(proxy->m_aabbMax + way);
    for (PlantBody* body : plants_in(world, lower - near, upper + near))
        if (body->rest.asleep) show_again(*body);
}

void hide_sleepers_again(World& world) {
    constexpr size_t TURNS = 64;  // substeps in which each plant is checked once
    for (size_t i = size_t(world.substep % TURNS); i < world.bodies.size(); i += TURNS) {
        PlantBody& body = *world.bodies[i];
        if (body.rest.asleep && !body.rest.contacts) hide(body);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
