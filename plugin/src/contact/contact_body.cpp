#include "contact/contact_body.hpp"

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <algorithm>

#include "mechanics/rotation.hpp"
#include "world/convert.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

void take_present_inertia(btMultiBody& body) {
    btAlignedObjectArray<btScalar> r;
    btAlignedObjectArray<btVector3> v;
    btAlignedObjectArray<btMatrix3x3> m;
    // In a time of zero no velocity changes, but all that follows from positions is made anew. The host's feedback of
    // joints is of its own step.
    std::vector<btMultiBodyJointFeedback*> feedback;
    for (int i = 0; i < body.getNumLinks(); i++) {
        feedback.push_back(body.getLink(i).m_jointFeedback);
        body.getLink(i).m_jointFeedback = nullptr;
    }
    body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, r, v, m, false, false, false);
    for (int i = 0; i < body.getNumLinks(); i++) body.getLink(i).m_jointFeedback = feedback[size_t(i)];
}

// Computes Jacobians and unit responses of joints and base at the point.
static void prepare_link(ContactBody& contact_body) {
    btMultiBody& body = *contact_body.link->m_multiBody;
    const size_t count = size_t(body.getNumDofs()) + 6;
    btAlignedObjectArray<btScalar> r;
    btAlignedObjectArray<btVector3> v;
    btAlignedObjectArray<btMatrix3x3> m;
    r.resize(int(count));
    for (int axis = 0; axis < 3; axis++) {
        std::vector<btScalar>&jacobian = contact_body.jacobian[size_t(axis)],
        &unit_response = contact_body.unit_responses[size_t(axis)];
        jacobian.assign(count, 0);
        unit_response.assign(count, 0);
        btVector3 along(0, 0, 0);
        along[axis] = 1;
        body.fillContactJacobianMultiDof(contact_body.link->m_link, to_bullet(contact_body.point), along,
                                         jacobian.data(), r, v, m);
        body.calcAccelerationDeltasMultiDof(jacobian.data(), unit_response.data(), r, v);
        double velocity = 0;
        for (size_t k = 0; k < count; k++) velocity += double(jacobian[k]) * double(body.getVelocityVector()[k]);
        contact_body.velocity[axis] = velocity;
    }
}

bool is_free(const btCollisionObject& object) {
    return btRigidBody::upcast(&object) && !object.isStaticOrKinematicObject();
}

void wake(btCollisionObject& object, const Vec3& normal, const Vec3& plant_velocity) {
    constexpr double SLOW = 0.02;  // speed of the plant up to which a body that rests on it sleeps on [m/s]
    if (object.isActive() || object.isStaticOrKinematicObject()) return;
    if (plant_velocity.dot(normal) < -SLOW) object.activate();
}

Vec3 velocity_at(const btCollisionObject& object, const Vec3& p) {
    const btRigidBody* rigid = btRigidBody::upcast(&object);
    if (!rigid) return Vec3::Zero();
    return from_bullet(rigid->getVelocityInLocalPoint(to_bullet(p) - rigid->getCenterOfMassPosition()));
}

ContactBody make_contact_body(btCollisionObject& object, const Vec3& point, double h) {
    ContactBody contact_body;
    contact_body.object = &object;
    contact_body.point = point;
    contact_body.velocity.setZero();
    if (btMultiBodyLinkCollider* link = btMultiBodyLinkCollider::upcast(&object)) {
        if (!link->m_multiBody) return contact_body;
        contact_body.link = link;
        prepare_link(contact_body);
        return contact_body;
    }
    btRigidBody* rigid = btRigidBody::upcast(&object);
    if (!rigid) return contact_body;
    contact_body.velocity = velocity_at(object, point);
    // A sleeping body acts as a static one until it is woken.
    if (rigid->isStaticOrKinematicObject() || !rigid->isActive()) return contact_body;
    contact_body.rigid = rigid;
    contact_body.velocity += h * from_bullet(rigid->getGravity());
    return contact_body;
}

Mat3 compliance_between(const ContactBody& at, const ContactBody& by) {
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
                block(r, c) += double(at.jacobian[size_t(r)][k]) * double(by.unit_responses[size_t(c)][k]);
    return block;
}

void take_impulses(const std::vector<BodyPush>& pushes) {
    // Bullet limits each speed of a multi-body whenever one is added, and opposite impulses may pass that limit on the
    // way to a small sum: so each gets the sum of all its changes at once.
    std::vector<std::pair<btMultiBody*, std::vector<double>>> changes;
    for (const BodyPush& push : pushes) {
        const ContactBody& at = *push.body;
        if (at.rigid)
            at.rigid->applyImpulse(to_bullet(push.impulse), to_bullet(at.point) - at.rigid->getCenterOfMassPosition());
        if (!at.link) continue;
        btMultiBody* body = at.link->m_multiBody;
        auto of =
            std::find_if(changes.begin(), changes.end(), [&](const auto& change) { return change.first == body; });
        if (of == changes.end()) of = changes.insert(of, {body, std::vector<double>(at.unit_responses[0].size(), 0)});
        for (size_t axis = 0; axis < 3; axis++)
            for (size_t k = 0; k < of->second.size(); k++)
                of->second[k] += push.impulse[int(axis)] * double(at.unit_responses[axis][k]);
    }
    for (const auto& [body, change] : changes) {
        const std::vector<btScalar> all(change.begin(), change.end());
        body->applyDeltaVeeMultiDof(all.data(), 1);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
