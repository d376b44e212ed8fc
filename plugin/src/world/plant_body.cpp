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

// How much thicker a plate is than its blade, so that Bullet tells what is about to touch: where boxes have edges it takes
// them for round ones [m].
static constexpr double AHEAD = 0.005;
// Half of a blade's thickness for bodies, at least: they sink by half a millimetre into what they rest on [m].
static constexpr double THINNEST = 0.002;

int Hull::capsule_of(int child) const {
    if (child < 0 || child >= int(capsules.size() + plates.size())) return -1;
    return child < int(capsules.size()) ? child : plate_capsule[size_t(child) - capsules.size()];
}

static void place_capsule(btCompoundShape& shape, size_t capsule, const Vec3& begin, const Vec3& end) {
    shape.updateChildTransform(int(capsule), capsule_frame(begin, end), false);
}

// `frame` has the columns axis, thin, wide.
static void place_plate(btCompoundShape& shape, int child, const Mat3& frame, const Vec3& middle) {
    const btVector3 x = to_bullet(frame.col(2)), y = to_bullet(frame.col(0)), z = to_bullet(frame.col(1));
    const btMatrix3x3 basis = btMatrix3x3(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]);
    shape.updateChildTransform(child, btTransform(basis, to_bullet(middle)), false);
}

static void fill_shape(btCompoundShape& shape, const Hull& hull) {
    for (const auto& capsule : hull.capsules) shape.addChildShape(btTransform::getIdentity(), capsule.get());
    for (const auto& plate : hull.plates) shape.addChildShape(btTransform::getIdentity(), plate.get());
    shape.setMargin(btScalar(std::max(hull.wider_by_cage, hull.wider_by_sheath)));
}

// Rectangles with a margin, round at their rims. Boxes tell only of what is in each other already, and of other points from
// step to step where edges are touched.
static void add_plates(const Model& model, Hull& hull) {
    hull.flats = make_flats(model);
    for (size_t i = 0; i < hull.flats.size(); i++) {
        Flat& flat = hull.flats[i];
        if (flat.half_width == 0) continue;
        flat.half_thickness = std::max(flat.half_thickness, THINNEST);
        const auto& [begin, end] = model.capsules[i];
        const Vec3 chord = model.chain.nodes[size_t(end)].position - model.chain.nodes[size_t(begin)].position;
        const btScalar x = btScalar(flat.half_width - flat.half_thickness), y = btScalar(0.5 * chord.norm());
        auto plate = std::make_unique<btConvexHullShape>();
        for (const btScalar side : {-x, x})
            for (const btScalar end : {-y, y}) plate->addPoint(btVector3(side, end, 0), false);
        plate->setMargin(btScalar(flat.half_thickness + AHEAD));
        plate->recalcLocalAabb();
        hull.plates.push_back(std::move(plate));
        hull.plate_capsule.push_back(int(i));
    }
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
    add_plates(model, *hull);
    fill_shape(*hull->rest, *hull);
    for (size_t i = 0; i < model.capsules.size(); i++)
        place_capsule(*hull->rest, i, nodes[size_t(model.capsules[i][0])].position,
                      nodes[size_t(model.capsules[i][1])].position);
    for (size_t i = 0; i < hull->plates.size(); i++) {
        const size_t capsule = size_t(hull->plate_capsule[i]);
        const auto& [begin, end] = model.capsules[capsule];
        const Vec3 &a = nodes[size_t(begin)].position, &b = nodes[size_t(end)].position;
        Mat3 frame;
        frame.col(0) = (b - a).normalized();
        frame.col(2) = hull->flats[capsule].wide;
        frame.col(1) = frame.col(2).cross(frame.col(0));
        place_plate(*hull->rest, int(hull->capsules.size() + i), frame, 0.5 * (a + b));
    }
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
    const Hull& hull = *body.hull;
    for (size_t i = 0; i < hull.plates.size(); i++) {
        const size_t capsule = size_t(hull.plate_capsule[i]);
        const Flat& flat = hull.flats[capsule];
        const auto [begin, end] = capsule_ends(plant, capsule);
        Mat3 frame;
        // One that lost its shape stays as it was.
        if (piece_frame(plant, plant.model->capsules[capsule][1], flat.wide, flat.spread, frame))
            place_plate(*body.compound(), int(hull.capsules.size() + i), frame, 0.5 * (begin + end));
    }
    body.compound()->recalculateLocalAabb();
}

// By how much capsules around the pieces of a collider at rest are wider than those of the chain, at most [m].
static double wider_than_capsules(const PlantBody& body, const Collider& collider, const Vec3* places) {
    const Model& model = *body.plant->model;
    std::vector<Axis> axes;
    for (const auto& [begin, end] : model.capsules)
        axes.push_back({model.chain.nodes[size_t(begin)].position, model.chain.nodes[size_t(end)].position});
    const std::vector<Capsule> covers = cover_pieces(collider, places, axes);
    double wider = 0;
    for (size_t i = 0; i < covers.size(); i++)
        wider = std::max(wider, covers[i].radius - double(body.capsules[i]->getRadius()));
    return wider;
}

void take_collider(PlantBody& body) {
    const bool by_sheath = body.plant->follow != nullptr;
    if (by_sheath ? body.sheath != nullptr : body.collider != nullptr) return;
    Hull& hull = *body.hull;
    double& wider = by_sheath ? hull.wider_by_sheath : hull.wider_by_cage;
    if (by_sheath)
        body.sheath = sheath_of(*body.plant);
    else
        body.collider = collider_of(*body.plant);
    const std::vector<Vec3>& modelled = by_sheath ? body.sheath->modelled : body.plant->model->cage.nodes;
    if (wider == 0) wider = wider_than_capsules(body, body.touched_collider(), modelled.data());
    for (btCompoundShape* shape : {body.compound(), hull.rest.get()})
        shape->setMargin(btScalar(std::max(hull.wider_by_cage, hull.wider_by_sheath)));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
