#include "world/plant_body.hpp"

#include <algorithm>

#include "batch/flat.hpp"
#include "calibration/weigh.hpp"
#include "collide/cover.hpp"
#include "core/borrowed.hpp"
#include "core/lanes.hpp"
#include "world/convert.hpp"
#include "world/detection.hpp"
#include "world/plant_shape.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Margin by which a plate is thicker than its blade, so that Bullet reports contacts before they touch; it rounds the
// plate's edges [m].
static constexpr double AHEAD = 0.012;
// Least half thickness of a blade for bodies, which sink by half a millimetre into what they rest on [m].
static constexpr double THINNEST = 0.002;

int Hull::capsule_of(int child) const {
    if (child < 0 || child >= int(capsules.size() + plates.size())) return -1;
    return child < int(capsules.size()) ? child : plate_capsule[size_t(child) - capsules.size()];
}

// Adds plates: rectangles with a margin, round at their rims. Boxes would report only overlaps, and other points from
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

// Lists sizes for lanes; the last one is repeated as padding.
static void list_sizes(Hull& hull) {
    const auto fill = [](std::vector<double>& to, size_t count, const auto& of) {
        for (size_t i = 0; count > 0 && i < count + MOST_LANES; i++) to.push_back(double(of(std::min(i, count - 1))));
    };
    // A rectangle's last corner is +x, +y.
    const auto corner = [&](size_t i) {
        return hull.plates[i]->getUnscaledPoints()[hull.plates[i]->getNumPoints() - 1];
    };
    const size_t capsules = hull.capsules.size(), plates = hull.plates.size();
    fill(hull.capsule_halves, capsules, [&](size_t i) { return hull.capsules[i]->getHalfHeight(); });
    fill(hull.capsule_radii, capsules, [&](size_t i) { return hull.capsules[i]->getRadius(); });
    fill(hull.plate_halves[0], plates, [&](size_t i) { return corner(i).x(); });
    fill(hull.plate_halves[1], plates, [&](size_t i) { return corner(i).y(); });
    fill(hull.plate_margins, plates, [&](size_t i) { return hull.plates[i]->getMargin(); });
}

static std::vector<Mat3> modelled_frames(const Hull& hull, const Model& model) {
    std::vector<Mat3> frames;
    for (const int i : hull.plate_capsule) {
        const auto& [begin, end] = model.capsules[size_t(i)];
        Mat3 axes;
        axes.col(0) =
            (model.chain.nodes[size_t(end)].position - model.chain.nodes[size_t(begin)].position).normalized();
        axes.col(2) = hull.flats[size_t(i)].wide;
        axes.col(1) = axes.col(2).cross(axes.col(0));
        frames.push_back(axes);
    }
    return frames;
}

static std::shared_ptr<Hull> hull_of(World& world, const Model& model) {
    std::weak_ptr<Hull>& known = world.hulls[&model];
    std::shared_ptr<Hull> hull = known.lock();
    if (hull) return hull;
    hull = std::make_shared<Hull>();
    known = hull;
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::vector<Vec3> places;
    for (const ChainNode& node : nodes) places.push_back(node.position);
    for (const auto& [begin, end] : model.capsules) {
        const double height = (places[size_t(end)] - places[size_t(begin)]).norm();
        hull->capsules.push_back(
            std::make_unique<btCapsuleShape>(btScalar(nodes[size_t(end)].radius), btScalar(height)));
    }
    hull->organ_borne = borne_masses(model.organ_mass, model.organ_parents);
    add_plates(model, *hull);
    list_sizes(*hull);
    // Filled with all segments in place, the tree of their boxes is a good one.
    const std::vector<Mat3> frames = modelled_frames(*hull, model);
    PlantShape first(world, *hull);
    place_pieces(first, *hull, {places.data(), model.capsules, frames});
    for (int i = 0; i < first.getNumChildShapes(); i++) hull->modelled.push_back(first.getChildTransform(i));
    auto rest = std::make_unique<PlantShape>(world, *hull);
    place_pieces(*rest, *hull, {places.data(), model.capsules, frames});
    hull->rest = std::move(rest);
    return hull;
}

double borne_at(const PlantBody& body, int capsule) {
    const Model& model = *body.plant->model;
    const int organ = model.chain.nodes[size_t(model.capsules[size_t(capsule)][1])].organ;
    return body.hull->organ_borne[size_t(std::max(organ, 0))];
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
    shape = new PlantShape(*body.world, *body.hull);
    move_capsules(body);
}

// Enters the broad phase anew with another filter, so that pairs are found anew.
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

void enter_anew(PlantBody& body) {
    const btBroadphaseProxy* proxy = body.getBroadphaseHandle();
    if (proxy) enter_broad_phase(body, proxy->m_collisionFilterGroup, proxy->m_collisionFilterMask);
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
    m_softBodySolver = nullptr;  // not initialised by Bullet's constructor
    level.own = plant->which;

    // One compound in place of the soft body's own shape; btSoftBody deletes it.
    delete m_collisionShape;
    m_collisionShape = hull->rest.get();

    // Placed once: the capsules move inside the plant's frame.
    setWorldTransform(btTransform(to_bullet(plant->rotation), to_bullet(plant->position)));
    setInterpolationWorldTransform(getWorldTransform());

    // Kinematic, or Bullet's islands would merge over the plant's whole box; no response, but seen by queries.
    setCollisionFlags(CF_KINEMATIC_OBJECT | CF_NO_CONTACT_RESPONSE);
    setActivationState(DISABLE_DEACTIVATION);
    m_checkCollideWith = true;  // call checkCollideWithOverride
}

bool is_plane(const btCollisionObject& object) {
    return object.getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE;
}

bool PlantBody::checkCollideWithOverride(const btCollisionObject* other) const {
    const bool is_step = is_for_step(*world->bullet);
    if ((is_step && is_plane(*other)) || of(other) || !btSoftBody::checkCollideWithOverride(other)) return false;
    if (is_step) leave_near_children(const_cast<PlantBody&>(*this), *other);
    return true;
}

// btSoftBody would delete the shape, but a shared one is the hull's.
PlantBody::~PlantBody() {
    if (!is_taken_back) host_deleted(*this);
    if (m_collisionShape == hull->rest.get()) m_collisionShape = nullptr;
}

void move_capsules(PlantBody& body) {
    const Plant& plant = *body.plant;
    const Hull& hull = *body.hull;
    std::vector<Mat3> frames;
    piece_frames(plant, hull.plate_capsule, hull.flats, frames);
    auto& shape = static_cast<PlantShape&>(*body.compound());
    if (plant.state.fragments.empty())
        return place_pieces(shape, hull, {plant.view.chain_positions.data(), plant.model->capsules, frames});
    std::vector<Vec3> places;
    std::vector<std::array<int, 2>> ends;
    for (size_t i = 0; i < plant.model->capsules.size(); i++) {
        const int count = int(places.size());
        ends.push_back({count, count + 1});
        for (const Vec3& end : capsule_ends(plant, i)) places.push_back(end);
    }
    place_pieces(shape, hull, {places.data(), ends, frames});
}

void move_capsules(PlantBody* const* bodies, int count) {
    std::array<const Plant*, MOST_LANES> plants;
    std::array<PlantShape*, MOST_LANES> shapes;
    int batched = 0;
    const Hull& hull = *bodies[0]->hull;
    for (int i = 0; i < count; i++) {
        PlantBody& body = *bodies[i];
        if (count == 1 || !body.plant->follow || !body.plant->state.fragments.empty() || body.hull.get() != &hull) {
            move_capsules(body);
            continue;
        }
        plants[size_t(batched)] = body.plant.get();
        shapes[size_t(batched++)] = static_cast<PlantShape*>(body.compound());
    }
    if (batched == 0) return;
    Borrowed<ChainBatch> chains;
    look_at_chains(plants.data(), batched, hull.plate_capsule, hull.flats, *chains);
    place_pieces(shapes.data(), batched, hull, plants[0]->model->capsules, *chains);
}

// Returns by how much capsules around the regions of a collider at rest are wider than the chain's, at most [m].
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
    const Plant& plant = *body.plant;
    if (plant.follow ? body.sheath != nullptr : body.in_cage != nullptr) return;
    if (plant.follow)
        body.sheath = sheath_of(plant);
    else
        body.in_cage = sheath_in_cage_of(plant);
    Hull& hull = *body.hull;
    double& wider = touches_by_sheath(plant) ? hull.wider_by_sheath : hull.wider_by_cage;
    if (wider == 0) wider = wider_than_capsules(body, body.touched().collider, body.touched().modelled.data());
    for (btCompoundShape* shape : {body.compound(), hull.rest.get()})
        shape->setMargin(btScalar(std::max(hull.wider_by_cage, hull.wider_by_sheath)));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
