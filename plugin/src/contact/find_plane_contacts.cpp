// In: an infinite plane, and plants in their places. Out: their contacts with it.
//
// Bullet gives a plane an infinite box, so its narrow phase would test every segment of each plant that is awake, and
// keep an algorithm and a manifold for each. Here a segment that is not near the plane costs two products.
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <algorithm>

#include "contact/find_contacts.hpp"
#include "contact/piece.hpp"
#include "world/convert.hpp"
#include "world/fragments.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Height below which a contact is reported: for a node at rest, over a plane that moves, and at most [m].
constexpr double NEAR = 0.004, MOVING = 0.05, FAR = 0.2;

// A plane in a plant's own frame.
struct Plane {
    btCollisionObject& object;
    Vec3 normal_in_world, normal;
    double offset;  // [m]
    bool moves;
    double height(const Vec3& p) const { return normal.dot(p) + offset; }
};

Plane plane_for(const Plant& plant, btCollisionObject& object, bool moves) {
    const auto& shape = static_cast<const btStaticPlaneShape&>(*object.getCollisionShape());
    const btTransform& frame = object.getWorldTransform();
    const Vec3 normal = from_bullet(frame.getBasis() * shape.getPlaneNormal()).normalized();
    const double offset =
        normal.dot(plant.position - from_bullet(frame.getOrigin())) - double(shape.getPlaneConstant());
    return {object, normal, plant.rotation.conjugate() * normal, offset, moves};
}

// Returns whether Bullet's narrow phase would test the pair, apart from PlantBody's own exclusion of planes.
bool may_meet(const World& world, const PlantBody& body, const btCollisionObject& plane) {
    btBroadphaseProxy *of_body = const_cast<btBroadphaseProxy*>(body.getBroadphaseHandle()),
                      *of_plane = const_cast<btBroadphaseProxy*>(plane.getBroadphaseHandle());
    return of_body && of_plane && world.bullet->getPairCache()->findPair(of_body, of_plane) && may_collide(body, plane);
}

// Returns whether a node is held and so cannot be pushed.
bool is_held_node(const Plant& plant, int node) {
    return plant.follow && plant.state.motion.pinned[2 * size_t(node)];
}

// Returns the height below which a chain node is reported: it may reach the plane within two steps [m].
double reach_of(const Plant& plant, const Plane& plane, int node, double h) {
    if (plane.moves || plant.state.modal) return MOVING;
    const Motion& motion = plant.state.motion;
    const Vec3 velocity = plant.follow ? Vec3(point(motion.v, 2 * node))
                                       : attachment_velocity(chain_attachment(plant, node), motion.x, motion.v);
    return std::min(NEAR + 2 * h * std::max(0.0, -plane.normal.dot(velocity)), FAR);
}

// Adds the contact of a segment at one of its nodes, or those of a plate's two corners there.
void add_at_node(PlantBody& body, int capsule, double along, double reach, const Plane& plane,
                 std::vector<Contact>& contacts) {
    const Plant& plant = *body.plant;
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    const Flat& flat = body.hull->flats[size_t(capsule)];
    const double radius = radius_of(body, capsule);
    Mat3 frame;
    const bool is_flat = flat.half_width > 0 && piece_frame(plant, end, flat.wide, flat.spread, frame);
    const double rim = is_flat ? flat.half_width - flat.half_thickness : 0;
    const Vec3 node = plant.view.chain_positions[size_t(along > 0 ? end : begin)];
    for (const double side : {-1.0, 1.0}) {
        if (!is_flat && side > 0) break;
        const double across = is_flat ? side * rim : 0.0;
        const Vec3 there = is_flat ? Vec3(node + across * frame.col(2)) : node;
        const double height = plane.height(there);
        if (!(height - radius < reach)) continue;
        const Vec3 p = plant.to_world(there);
        Contact contact;
        contact.plant = &body;
        contact.capsule = capsule;
        contact.along = along;
        contact.across = across;
        contact.other = &plane.object;
        contact.normal = plane.normal_in_world;
        contact.on_plant = p - radius * contact.normal;
        contact.on_other = p - height * contact.normal;
        contact.gap = height - radius;
        set_surface_of(contact);
        contacts.push_back(contact);
    }
}

// Adds the contacts of each node as the end of its segment, and of roots as the beginning of theirs.
void add_pieces(PlantBody& body, const Plane& plane, double h, std::vector<Contact>& contacts) {
    const Plant& plant = *body.plant;
    for (size_t i = 0; i < plant.model->capsules.size(); i++) {
        const auto& [begin, end] = plant.model->capsules[i];
        const double wide = std::max(body.hull->flats[i].half_width, double(body.capsules()[i]->getRadius()));
        const bool is_root = plant.model->chain.nodes[size_t(begin)].parent < 0;
        for (const double along : {0.0, 1.0}) {
            const int node = along > 0 ? end : begin;
            if (along == 0 && !is_root) continue;
            if (plane.height(plant.view.chain_positions[size_t(node)]) - wide >= FAR || is_held_node(plant, node))
                continue;
            if (is_apart(body, int(i), plane.object) || is_between_pieces(body, int(i), plane.normal_in_world))
                continue;
            add_at_node(body, int(i), along, reach_of(plant, plane, node, h), plane, contacts);
        }
    }
}

}  // namespace

void add_plane_contacts(World& world, btCollisionObject& object, double h, std::vector<Contact>& contacts) {
    const bool moves = is_moving(object);
    const auto add = [&](PlantBody& body) {
        // Modal plants are only checked against planes that move.
        if (!takes_part(world, &body) || (body.plant->state.modal && !moves) || !may_meet(world, body, object)) return;
        if (!body.plant->state.modal) look_at(body);
        add_pieces(body, plane_for(*body.plant, object, moves), h, contacts);
    };
    if (!moves)
        for (PlantBody* body : world.awake) add(*body);
    else
        for (const auto& body : world.bodies) add(*body);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
