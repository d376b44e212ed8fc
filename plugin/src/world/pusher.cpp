#include "world/pusher.hpp"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include "mechanics/rotation.hpp"
#include "world/convert.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// How joints and base answer to impulses at the point, by the articulated inertia of Bullet's last step.
static void prepare_link(Pusher& pusher) {
    btMultiBody& body = *pusher.link->m_multiBody;
    const size_t count = size_t(body.getNumDofs()) + 6;
    btAlignedObjectArray<btScalar> r;
    btAlignedObjectArray<btVector3> v;
    btAlignedObjectArray<btMatrix3x3> m;
    r.resize(int(count));
    for (int axis = 0; axis < 3; axis++) {
        std::vector<btScalar>&jacobian = pusher.jacobian[size_t(axis)], &answer = pusher.answers[size_t(axis)];
        jacobian.assign(count, 0);
        answer.assign(count, 0);
        btVector3 along(0, 0, 0);
        along[axis] = 1;
        body.fillContactJacobianMultiDof(pusher.link->m_link, to_bullet(pusher.point), along, jacobian.data(), r, v, m);
        body.calcAccelerationDeltasMultiDof(jacobian.data(), answer.data(), r, v);
        double velocity = 0;
        for (size_t k = 0; k < count; k++) velocity += double(jacobian[k]) * double(body.getVelocityVector()[k]);
        pusher.velocity[axis] = velocity;
    }
}

void wake(btCollisionObject& object, const Vec3& normal, const Vec3& plant_velocity) {
    constexpr double SLOW = 0.02;  // what rests on a plant that hardly moves sleeps on [m/s]
    if (object.isActive() || object.isStaticOrKinematicObject()) return;
    if (plant_velocity.dot(normal) < -SLOW) object.activate();
}

Pusher make_pusher(btCollisionObject& object, const Vec3& point, double h) {
    Pusher pusher;
    pusher.object = &object;
    pusher.point = point;
    pusher.velocity.setZero();
    if (btMultiBodyLinkCollider* link = btMultiBodyLinkCollider::upcast(&object)) {
        if (!link->m_multiBody) return pusher;
        pusher.link = link;
        prepare_link(pusher);
        return pusher;
    }
    btRigidBody* rigid = btRigidBody::upcast(&object);
    if (!rigid) return pusher;
    pusher.velocity = from_bullet(rigid->getVelocityInLocalPoint(to_bullet(point) - rigid->getCenterOfMassPosition()));
    // One that sleeps is as good as nailed down until it is woken.
    if (rigid->isStaticOrKinematicObject() || !rigid->isActive()) return pusher;
    pusher.rigid = rigid;
    pusher.velocity += h * from_bullet(rigid->getGravity());
    return pusher;
}

Mat3 answer_between(const Pusher& at, const Pusher& by) {
    if (at.rigid && at.rigid == by.rigid) {
        const btMatrix3x3& inverse = at.rigid->getInvInertiaTensorWorld();
        Mat3 inertia;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) inertia(r, c) = double(inverse[r][c]);
        const Vec3 centre = from_bullet(at.rigid->getCenterOfMassPosition());
        return double(at.rigid->getInvMass()) * Mat3::Identity() -
               cross_matrix<double>(at.point - centre) * inertia * cross_matrix<double>(by.point - centre);
    }
    Mat3 block = Mat3::Zero();
    if (!at.link || !by.link || at.link->m_multiBody != by.link->m_multiBody) return block;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            for (size_t k = 0; k < at.jacobian[0].size(); k++)
                block(r, c) += double(at.jacobian[size_t(r)][k]) * double(by.answers[size_t(c)][k]);
    return block;
}

void take_impulse(Pusher& pusher, const Vec3& impulse) {
    if (pusher.rigid)
        pusher.rigid->applyImpulse(to_bullet(impulse),
                                   to_bullet(pusher.point) - pusher.rigid->getCenterOfMassPosition());
    if (!pusher.link) return;
    for (size_t axis = 0; axis < 3; axis++)
        pusher.link->m_multiBody->applyDeltaVeeMultiDof(pusher.answers[axis].data(), btScalar(impulse[int(axis)]));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
