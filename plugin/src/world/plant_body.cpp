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

static void place_capsule(btCompoundShape& shape, size_t capsule, const Vec3& begin, const Vec3& end) {
    shape.updateChildTransform(int(capsule), capsule_frame(begin, end), false);
}

static void fill_shape(btCompoundShape& shape, const Hull& hull) {
    for (const auto& capsule : hull.capsules) shape.addChildShape(btTransform::getIdentity(), capsule.get());
    shape.setMargin(btScalar(hull.wider));
}

static std::shared_ptr<Hull> hull_of(World& world, const Model& model) {
    std::weak_ptr<Hull>& known = world.hulls[&model];
    std::shared_ptr<Hull> hull = known.lock();
    if (hull) return hull;
    hull = std::make_shared<Hull>();
    known = hull;
    hull->rest = std::make_unique<PlantShape>(&world);
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    for (const auto& [begin, end] : model.capsules) {
        const double height = (nodes[size_t(end)].position - nodes[size_t(begin)].position).norm();
        hull->capsules.push_back(
            std::make_unique<btCapsuleShape>(btScalar(nodes[size_t(end)].radius), btScalar(height)));
    }
    fill_shape(*hull->rest, *hull);
    for (size_t i = 0; i < model.capsules.size(); i++)
        place_capsule(*hull->rest, i, nodes[size_t(model.capsules[i][0])].position,
                      nodes[size_t(model.capsules[i][1])].position);
    hull->rest->recalculateLocalAabb();
    return hull;
}

void share_shape(PlantBody& body) {
    btCollisionShape*& shape = body.shape();
    if (shape == body.hull->rest.get()) return;
    delete shape;
    shape = body.hull->rest.get();
}

void take_own_shape(PlantBody& body) {
    btCollisionShape*& shape = body.shape();
    if (shape != body.hull->rest.get()) return;
    auto own = std::make_unique<PlantShape>(body.world);
    fill_shape(*own, *body.hull);
    shape = own.release();
    move_capsules(body);
}

// In the broad phase under another filter, from where it finds its pairs anew.
static void enter_broad_phase(PlantBody& body, int group, int mask) {
    btDynamicsWorld& bullet = *body.world->bullet;
    btBroadphaseInterface& broad = *bullet.getBroadphase();
    btBroadphaseProxy* before = body.getBroadphaseHandle();
    broad.getOverlappingPairCache()->cleanProxyFromPairs(before, bullet.getDispatcher());
    broad.destroyProxy(before, bullet.getDispatcher());
    btVector3 lower, upper;
    body.getCollisionShape()->getAabb(body.getWorldTransform(), lower, upper);
    body.setBroadphaseHandle(broad.createProxy(lower, upper, body.getCollisionShape()->getShapeType(), &body, group,
                                               mask, bullet.getDispatcher()));
}

void hide(PlantBody& body) {
    const btBroadphaseProxy* proxy = body.getBroadphaseHandle();
    if (body.is_hidden || !proxy) return;
    body.filter_group = proxy->m_collisionFilterGroup;
    body.filter_mask = proxy->m_collisionFilterMask;
    body.is_hidden = true;
    enter_broad_phase(body, btBroadphaseProxy::StaticFilter, body.filter_mask & ~btBroadphaseProxy::StaticFilter);
}

void show_again(PlantBody& body) {
    if (!body.is_hidden) return;
    body.is_hidden = false;
    enter_broad_phase(body, body.filter_group, body.filter_mask);
}

PlantBody::PlantBody(btSoftBodyWorldInfo* info, World* world, std::unique_ptr<Plant> given)
    : btSoftBody(info), plant(std::move(given)), world(world), hull(hull_of(*world, *plant->model)),
      capsules(hull->capsules) {
    m_softBodySolver = nullptr;  // Bullet's constructor leaves it open
    level.own = plant->which;

    // One compound in place of the soft body's own shape; btSoftBody deletes it.
    delete m_collisionShape;
    m_collisionShape = hull->rest.get();

    // Placed once: the capsules move inside the plant's frame.
    const Quat& q = plant->rotation;
    const btQuaternion rotation(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w()));
    setWorldTransform(btTransform(rotation, to_bullet(plant->position)));
    setInterpolationWorldTransform(getWorldTransform());

    // Kinematic, or islands would merge over the whole box of the plant; seen by queries, not yet an obstacle.
    setCollisionFlags(CF_KINEMATIC_OBJECT | CF_NO_CONTACT_RESPONSE);
    setActivationState(DISABLE_DEACTIVATION);
    m_checkCollideWith = true;  // ask checkCollideWithOverride
}

// Bullet deletes the shape that it finds.
PlantBody::~PlantBody() {
    if (m_collisionShape == hull->rest.get()) m_collisionShape = nullptr;
}

void move_capsules(PlantBody& body) {
    const Plant& plant = *body.plant;
    for (size_t i = 0; i < body.capsules.size(); i++) {
        const auto [begin, end] = capsule_ends(plant, i);
        place_capsule(*body.compound(), i, begin, end);
    }
    body.compound()->recalculateLocalAabb();
}

void take_collider(PlantBody& body) {
    if (body.collider) return;
    body.collider = collider_of(*body.plant);
    Hull& hull = *body.hull;
    if (hull.wider > 0) {
        body.compound()->setMargin(btScalar(hull.wider));
        return;
    }
    const Model& model = *body.plant->model;
    std::vector<Axis> axes;
    for (const auto& [begin, end] : model.capsules)
        axes.push_back({model.chain.nodes[size_t(begin)].position, model.chain.nodes[size_t(end)].position});
    const std::vector<Capsule> covers = cover_pieces(*body.collider, model.cage.nodes.data(), axes);
    for (size_t i = 0; i < covers.size(); i++)
        hull.wider = std::max(hull.wider, covers[i].radius - double(body.capsules[i]->getRadius()));
    for (btCompoundShape* shape : {body.compound(), hull.rest.get()}) shape->setMargin(btScalar(hull.wider));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
