#include "world/plant_body.hpp"

#include <algorithm>

#include "collide/cover.hpp"
#include "world/convert.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// The shortest turn from y: 1 + [k] + [k]^2 / (1 + cos), k = y x axis.
btTransform capsule_frame(const Vec3& begin, const Vec3& end) {
    constexpr double BACK = -0.99;  // cosine from which on that is not well conditioned
    const Vec3 chord = end - begin, axis = chord.normalized();
    const btVector3 middle = to_bullet(0.5 * (begin + end));
    if (axis == Vec3::Zero()) return btTransform(btQuaternion::getIdentity(), middle);
    if (!(axis.y() > BACK)) {
        const Quat turn = Quat::FromTwoVectors(Vec3::UnitY(), axis);
        return btTransform(
            btQuaternion(btScalar(turn.x()), btScalar(turn.y()), btScalar(turn.z()), btScalar(turn.w())), middle);
    }
    const double over = 1 / (1 + axis.y()), across = -axis.x() * axis.z() * over;
    const btScalar x = btScalar(axis.x()), y = btScalar(axis.y()), z = btScalar(axis.z());
    return btTransform(btMatrix3x3(btScalar(1 - axis.x() * axis.x() * over), x, btScalar(across),  //
                                   -x, y, -z,                                                     //
                                   btScalar(across), z, btScalar(1 - axis.z() * axis.z() * over)),
                       middle);
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
    void set_box(const btVector3& lower, const btVector3& upper) {
        m_localAabbMin = lower;
        m_localAabbMax = upper;
    }
};

// Its place in the tree of the compound's boxes is kept as long as it is in the box that it has there, a little wider than
// itself.
void place_capsule(btCompoundShape& shape, size_t capsule, const Vec3& begin, const Vec3& end, btVector3& lower,
                   btVector3& upper) {
    constexpr btScalar WIDER = btScalar(0.01);  // [m]
    btCompoundShapeChild& child = shape.getChildList()[capsule];
    child.m_transform = capsule_frame(begin, end);
    const auto& round = static_cast<const btCapsuleShape&>(*child.m_childShape);
    const btVector3 half = (round.getHalfHeight() * child.m_transform.getBasis().getColumn(1)).absolute() +
                           btVector3(1, 1, 1) * round.getRadius();
    const btVector3 &middle = child.m_transform.getOrigin(), from = middle - half, to = middle + half;
    lower.setMin(from);
    upper.setMax(to);
    if (child.m_node->volume.Contain(btDbvtVolume::FromMM(from, to))) return;
    const btVector3 wider(WIDER, WIDER, WIDER);
    btDbvtVolume room = btDbvtVolume::FromMM(from - wider, to + wider);
    shape.getDynamicAabbTree()->update(child.m_node, room);
}

// Each capsule between ends(capsule), its two ends.
template <class Ends>
void place_capsules(PlantShape& shape, const Ends& ends) {
    btVector3 lower(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT), upper = -lower;
    for (size_t i = 0; i < size_t(shape.getNumChildShapes()); i++) {
        const std::array<Vec3, 2> at = ends(i);
        place_capsule(shape, i, at[0], at[1], lower, upper);
    }
    shape.set_box(lower, upper);
}

}  // namespace

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
    auto rest = std::make_unique<PlantShape>(&world);
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    for (const auto& [begin, end] : model.capsules) {
        const double height = (nodes[size_t(end)].position - nodes[size_t(begin)].position).norm();
        hull->capsules.push_back(
            std::make_unique<btCapsuleShape>(btScalar(nodes[size_t(end)].radius), btScalar(height)));
    }
    fill_shape(*rest, *hull);
    place_capsules(*rest, [&](size_t i) {
        const auto& [begin, end] = model.capsules[i];
        return std::array<Vec3, 2>{nodes[size_t(begin)].position, nodes[size_t(end)].position};
    });
    hull->rest = std::move(rest);
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
    place_capsules(static_cast<PlantShape&>(*body.compound()), [&](size_t i) { return capsule_ends(*body.plant, i); });
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
