#include "world/plant_body.hpp"

#include <algorithm>

#include "collide/cover.hpp"
#include "world/convert.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

btTransform capsule_frame(const Vec3& begin, const Vec3& end) {
    const Vec3 axis = end - begin;
    const Quat turn = axis.squaredNorm() > 0 ? Quat::FromTwoVectors(Vec3::UnitY(), axis) : Quat::Identity();
    const btQuaternion rotation(btScalar(turn.x()), btScalar(turn.y()), btScalar(turn.z()), btScalar(turn.w()));
    return btTransform(rotation, to_bullet(0.5 * (begin + end)));
}

namespace {

// Asked by Bullet for its box once a substep, after gravity was given to bodies and before the solver: the one place there
// for what has to be done between the two.
struct PlantShape : btCompoundShape {
    World* world;
    explicit PlantShape(World* world) : world(world) {}
    void getAabb(const btTransform& frame, btVector3& lower, btVector3& upper) const override {
        if (!world->is_stepping) hold_gravity(world->gravity_ahead, *world->bullet);
        btCompoundShape::getAabb(frame, lower, upper);
    }
};

}  // namespace

PlantBody::PlantBody(btSoftBodyWorldInfo* info, World* world, std::unique_ptr<Plant> given)
    : btSoftBody(info), plant(std::move(given)), world(world) {
    m_softBodySolver = nullptr;  // Bullet's constructor leaves it open

    // One compound in place of the soft body's own shape; btSoftBody deletes it.
    delete m_collisionShape;
    btCompoundShape* shape = new PlantShape(world);
    m_collisionShape = shape;
    const Model& model = *plant->model;
    for (const auto& [begin, end] : model.capsules) {
        const double height =
            (model.chain.nodes[size_t(end)].position - model.chain.nodes[size_t(begin)].position).norm();
        const double radius = model.chain.nodes[size_t(end)].radius;
        capsules.push_back(std::make_unique<btCapsuleShape>(btScalar(radius), btScalar(height)));
        shape->addChildShape(btTransform::getIdentity(), capsules.back().get());
    }

    // Placed once: the capsules move inside the plant's frame.
    const Quat& q = plant->rotation;
    const btQuaternion rotation(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w()));
    setWorldTransform(btTransform(rotation, to_bullet(plant->position)));
    setInterpolationWorldTransform(getWorldTransform());

    // Kinematic, or islands would merge over the whole box of the plant; seen by queries, not yet an obstacle.
    setCollisionFlags(CF_KINEMATIC_OBJECT | CF_NO_CONTACT_RESPONSE);
    setActivationState(DISABLE_DEACTIVATION);
    m_checkCollideWith = true;  // ask checkCollideWithOverride
    move_capsules(*this);
}

PlantBody::~PlantBody() {
    for (int i = compound()->getNumChildShapes() - 1; i >= 0; i--) compound()->removeChildShapeByIndex(i);
}

void move_capsules(PlantBody& body) {
    const Plant& plant = *body.plant;
    for (size_t i = 0; i < body.capsules.size(); i++) {
        const auto [begin, end] = capsule_ends(plant, i);
        const btTransform frame = capsule_frame(begin, end);
        body.compound()->updateChildTransform(int(i), frame, false);
    }
    body.compound()->recalculateLocalAabb();
}

void take_collider(PlantBody& body) {
    if (body.collider) return;
    body.collider = collider_of(*body.plant);
    const Model& model = *body.plant->model;
    std::vector<Axis> axes;
    for (const auto& [begin, end] : model.capsules)
        axes.push_back({model.chain.nodes[size_t(begin)].position, model.chain.nodes[size_t(end)].position});
    const std::vector<Capsule> covers = cover_pieces(*body.collider, model.cage.nodes.data(), axes);
    double wider = 0;
    for (size_t i = 0; i < covers.size(); i++)
        wider = std::max(wider, covers[i].radius - double(body.capsules[i]->getRadius()));
    body.compound()->setMargin(btScalar(wider));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
