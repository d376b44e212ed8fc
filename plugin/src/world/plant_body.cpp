#include "world/plant_body.hpp"

#include <algorithm>

#include "collide/cover.hpp"
#include "world/convert.hpp"
#include "world/detection.hpp"
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

// `axes` has the columns axis, thin, wide.
static btTransform plate_frame(const Mat3& axes, const Vec3& middle) {
    const btVector3 x = to_bullet(axes.col(2)), y = to_bullet(axes.col(0)), z = to_bullet(axes.col(1));
    return btTransform(btMatrix3x3(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]), to_bullet(middle));
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

// A child's place in the tree of the compound's boxes is kept as long as it is in the box that it has there, a little wider
// than itself. `lower` and `upper` come to hold it.
void place_child(btCompoundShape& shape, size_t number, const btTransform& frame, const btVector3& half, btVector3& lower,
                 btVector3& upper) {
    constexpr btScalar WIDER = btScalar(0.01);  // [m]
    btCompoundShapeChild& child = shape.getChildList()[number];
    child.m_transform = frame;
    const btVector3 from = frame.getOrigin() - half, to = frame.getOrigin() + half;
    lower.setMin(from);
    upper.setMax(to);
    if (child.m_node->volume.Contain(btDbvtVolume::FromMM(from, to))) return;
    const btVector3 wider(WIDER, WIDER, WIDER);
    btDbvtVolume room = btDbvtVolume::FromMM(from - wider, to + wider);
    shape.getDynamicAabbTree()->update(child.m_node, room);
}

// Each capsule between ends(capsule), its two ends; each plate in its frame, unless that is zero: then it stays as it was.
template <class Ends>
void place_pieces(PlantShape& shape, const Hull& hull, const Ends& ends, const std::vector<Mat3>& frames) {
    btVector3 lower(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT), upper = -lower;
    for (size_t i = 0; i < hull.capsules.size(); i++) {
        const std::array<Vec3, 2> at = ends(i);
        const btCapsuleShape& round = *hull.capsules[i];
        const btTransform frame = capsule_frame(at[0], at[1]);
        const btVector3 half = (round.getHalfHeight() * frame.getBasis().getColumn(1)).absolute() +
                               btVector3(1, 1, 1) * round.getRadius();
        place_child(shape, i, frame, half, lower, upper);
    }
    for (size_t i = 0; i < hull.plates.size(); i++) {
        const size_t capsule = size_t(hull.plate_capsule[i]), child = hull.capsules.size() + i;
        const std::array<Vec3, 2> at = ends(capsule);
        btTransform frame = shape.getChildTransform(int(child));
        if (!frames[i].col(0).isZero(0)) frame = plate_frame(frames[i], 0.5 * (at[0] + at[1]));
        const btMatrix3x3& basis = frame.getBasis();
        const btConvexHullShape& plate = *hull.plates[i];
        const btVector3& corner = plate.getUnscaledPoints()[plate.getNumPoints() - 1];  // of a rectangle: +x, +y
        const btVector3 half = (corner.x() * basis.getColumn(0)).absolute() +
                               (corner.y() * basis.getColumn(1)).absolute() + btVector3(1, 1, 1) * plate.getMargin();
        place_child(shape, child, frame, half, lower, upper);
    }
    shape.set_box(lower, upper);
}

}  // namespace

// How much thicker a plate is than its blade, so that Bullet tells what is about to touch: where boxes have edges it takes
// them for round ones [m].
static constexpr double AHEAD = 0.012;
// Half of a blade's thickness for bodies, at least: they sink by half a millimetre into what they rest on [m].
static constexpr double THINNEST = 0.002;

int Hull::capsule_of(int child) const {
    if (child < 0 || child >= int(capsules.size() + plates.size())) return -1;
    return child < int(capsules.size()) ? child : plate_capsule[size_t(child) - capsules.size()];
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
    auto rest = std::make_unique<PlantShape>(&world);
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    for (const auto& [begin, end] : model.capsules) {
        const double height = (nodes[size_t(end)].position - nodes[size_t(begin)].position).norm();
        hull->capsules.push_back(
            std::make_unique<btCapsuleShape>(btScalar(nodes[size_t(end)].radius), btScalar(height)));
    }
    add_plates(model, *hull);
    fill_shape(*rest, *hull);
    const auto ends = [&](size_t i) {
        const auto& [begin, end] = model.capsules[i];
        return std::array<Vec3, 2>{nodes[size_t(begin)].position, nodes[size_t(end)].position};
    };
    std::vector<Mat3> frames;
    for (const int i : hull->plate_capsule) {
        const std::array<Vec3, 2> at = ends(size_t(i));
        Mat3 axes;
        axes.col(0) = (at[1] - at[0]).normalized();
        axes.col(2) = hull->flats[size_t(i)].wide;
        axes.col(1) = axes.col(2).cross(axes.col(0));
        frames.push_back(axes);
    }
    place_pieces(*rest, *hull, ends, frames);
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
    : btSoftBody(info), plant(std::move(given)), world(world), hull(hull_of(*world, *plant->model)) {
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

bool PlantBody::checkCollideWithOverride(const btCollisionObject* other) const {
    return !(is_plane(*other) && is_for_step(*world->bullet)) && !of(other) && btSoftBody::checkCollideWithOverride(other);
}

// Bullet deletes the shape that it finds.
PlantBody::~PlantBody() {
    if (m_collisionShape == hull->rest.get()) m_collisionShape = nullptr;
}

void move_capsules(PlantBody& body) {
    const Plant& plant = *body.plant;
    const Hull& hull = *body.hull;
    std::vector<Mat3> frames;
    piece_frames(plant, hull.plate_capsule, hull.flats, frames);
    auto& shape = static_cast<PlantShape&>(*body.compound());
    if (plant.fragments.empty())
        return place_pieces(shape, hull, [&](size_t i) {
            const auto& [begin, end] = plant.model->capsules[i];
            return std::array<Vec3, 2>{plant.chain_positions[size_t(begin)], plant.chain_positions[size_t(end)]};
        }, frames);
    place_pieces(shape, hull, [&](size_t i) { return capsule_ends(plant, i); }, frames);
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
        wider = std::max(wider, covers[i].radius - double(body.capsules()[i]->getRadius()));
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
