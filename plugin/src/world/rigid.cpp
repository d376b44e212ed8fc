#include "world/rigid.hpp"

#include <algorithm>

#include "core/convert.hpp"
#include "world/convert.hpp"
#include "world/show.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

static btTransform frame_of(const frond_rigid_state& state) {
    return btTransform(to_bullet(to_quat(state.rotation).normalized()), to_bullet(to_vec(state.position)));
}

// A row for each name in FROND_SHAPES: how many sizes it has, and Bullet's shape of those.
struct ShapeRow {
    int size_count;
    btCollisionShape* (*make)(const btVector3& size);
};
using Size = const btVector3&;
static const ShapeRow SHAPES[] = {
    {1, [](Size s) -> btCollisionShape* { return new btSphereShape(s.x()); }},
    {3, [](Size s) -> btCollisionShape* { return new btBoxShape(s); }},
    {2, [](Size s) -> btCollisionShape* { return new btCapsuleShape(s.x(), 2 * s.y()); }},
    {2, [](Size s) -> btCollisionShape* { return new btCylinderShape(btVector3(s.x(), s.y(), s.x())); }},
    {2, [](Size s) -> btCollisionShape* { return new btConeShape(s.x(), 2 * s.y()); }},
    {0, [](Size) -> btCollisionShape* { return new btStaticPlaneShape(btVector3(0, 1, 0), btScalar(0)); }},
};
static_assert(sizeof SHAPES / sizeof SHAPES[0] == FROND_SHAPE_COUNT, "every shape needs its row");

int size_count(frond_shape shape) {
    return SHAPES[shape].size_count;
}

Rigid* add_rigid(World& world, const frond_rigid_def& def) {
    auto rigid = std::make_unique<Rigid>();
    rigid->world = &world;
    rigid->is_plane = def.shape == FROND_SHAPE_PLANE;
    rigid->shape.reset(SHAPES[def.shape].make(to_bullet(to_vec(def.size))));
    const btScalar mass = rigid->is_plane ? 0 : btScalar(def.mass);
    btVector3 inertia(0, 0, 0);
    if (mass > 0) rigid->shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, rigid->shape.get(), inertia);
    info.m_startWorldTransform = frame_of(def.state);
    info.m_friction = btScalar(def.friction);
    info.m_restitution = btScalar(def.restitution);
    rigid->body = lend<btRigidBody>(*rigid, info);
    // A kinematic body stays awake, or Bullet would not compute its velocity.
    if (mass == 0 && !rigid->is_plane) {
        rigid->body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
        rigid->body->setActivationState(DISABLE_DEACTIVATION);
    }
    rigid->body->setLinearVelocity(to_bullet(to_vec(def.state.velocity)));
    rigid->body->setAngularVelocity(to_bullet(to_vec(def.state.angular_velocity)));
    world.bullet->addRigidBody(rigid->body.get());
    world.rigids.push_back(std::move(rigid));
    return world.rigids.back().get();
}

void remove_rigid(World& world, Rigid* rigid) {
    wake_neighbours(world, *rigid->body);
    world.bullet->removeRigidBody(rigid->body.get());
    forget_body(world, *rigid->body);
    const auto is_it = [&](const std::unique_ptr<Rigid>& other) { return other.get() == rigid; };
    world.rigids.erase(std::find_if(world.rigids.begin(), world.rigids.end(), is_it));
}

void forget_body(World& world, const btCollisionObject& body) {
    world.contacts.clear();
    for (Bond& bond : world.bonds)
        if (bond.body == &body) bond.body = nullptr;
}

void host_deleted(Rigid& rigid, btRigidBody& body) {
    World& world = *rigid.world;
    leave_to_host(rigid.body);
    forget_body(world, body);
    if (world.release.rigid) world.release.rigid(rigid);
    rigid.handle = {};
    if (rigid.grown_on) {
        const btScalar mass = body.getInvMass() > 0 ? 1 / body.getInvMass() : 0;
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, rigid.shape.get(), body.getLocalInertia());
        info.m_startWorldTransform = body.getWorldTransform();
        rigid.body = lend<btRigidBody>(rigid, info);
        return;
    }
    const auto is_it = [&](const std::unique_ptr<Rigid>& other) { return other.get() == &rigid; };
    world.rigids.erase(std::find_if(world.rigids.begin(), world.rigids.end(), is_it));
}

frond_rigid_state state_of(const Rigid& rigid) {
    const btTransform& frame = rigid.body->getWorldTransform();
    const btQuaternion q = frame.getRotation();
    return {from_vec(from_bullet(frame.getOrigin())),
            {double(q.x()), double(q.y()), double(q.z()), double(q.w())},
            from_vec(from_bullet(rigid.body->getLinearVelocity())),
            from_vec(from_bullet(rigid.body->getAngularVelocity()))};
}

void set_state(Rigid& rigid, const frond_rigid_state& state) {
    btRigidBody& body = *rigid.body;
    const btTransform frame = frame_of(state);
    body.setWorldTransform(frame);
    if (body.isKinematicObject()) return;  // Bullet computes its velocity from its last place
    body.setInterpolationWorldTransform(frame);
    body.setLinearVelocity(to_bullet(to_vec(state.velocity)));
    body.setAngularVelocity(to_bullet(to_vec(state.angular_velocity)));
    body.activate(true);
}

Leader::Leader(const World& world) {
    for (const std::unique_ptr<Rigid>& rigid : world.rigids) {
        btRigidBody& body = *rigid->body;
        // Bullet keeps there where the last step left it.
        const btTransform &from = body.getInterpolationWorldTransform(), &to = body.getWorldTransform();
        if (body.isKinematicObject() && !(from == to)) bodies.push_back({&body, from, to});
    }
}

double Leader::way_past_plants(World& world) const {
    double farthest = 0;
    for (const Led& led : bodies) {
        btVector3 lower, upper, to_lower, to_upper;
        const btCollisionShape& shape = *led.body->getCollisionShape();
        shape.getAabb(led.from, lower, upper);
        shape.getAabb(led.to, to_lower, to_upper);
        const btQuaternion turn = led.from.getRotation().inverse() * led.to.getRotation();
        const double turns = 2 * double(btVector3(turn.x(), turn.y(), turn.z()).length());  // sines of half angles
        const double way = double((led.to.getOrigin() - led.from.getOrigin()).length() +
                                  btScalar(0.5 * turns) * (upper - lower).length());
        lower.setMin(to_lower);
        upper.setMax(to_upper);
        if (way > farthest && !plants_in(world, lower, upper).empty()) farthest = way;
    }
    return farthest;
}

void Leader::lead(double share) const {
    for (const Led& led : bodies) {
        const btQuaternion begin = led.from.getRotation(), end = begin.nearest(led.to.getRotation());
        const btScalar gone = btScalar(share), left = 1 - gone;
        const btTransform between((begin * left + end * gone).safeNormalize(),
                                  led.from.getOrigin() * left + led.to.getOrigin() * gone);
        led.body->setWorldTransform(share < 1 ? between : led.to);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
