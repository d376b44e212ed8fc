// In: an object and a plant, and how each moves in a step. Out: the pieces of the plant that it meets.
#include "contact/sweep.hpp"

#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>

#include "contact/piece.hpp"
#include "world/convert.hpp"
#include "world/fragments.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

ObjectMotion motion_of(const btCollisionObject& object, double h) {
    ObjectMotion motion;
    motion.from = object.getWorldTransform();
    if (object.isStaticObject() || !object.isActive()) return motion;
    if (const btRigidBody* rigid = btRigidBody::upcast(&object)) {
        motion.way = h * from_bullet(rigid->getLinearVelocity());
        motion.turn = h * from_bullet(rigid->getAngularVelocity());
    } else if (const auto* link = btMultiBodyLinkCollider::upcast(&object)) {
        const btMultiBody& body = *link->m_multiBody;
        // In each link's own frame, the base first.
        std::vector<btVector3> turning(size_t(body.getNumLinks()) + 1), moving(turning.size());
        body.compTreeLinkVelocities(turning.data(), moving.data());
        const size_t number = size_t(link->m_link + 1);
        motion.way = h * from_bullet(motion.from.getBasis() * moving[number]);
        motion.turn = h * from_bullet(motion.from.getBasis() * turning[number]);
    }
    if (!motion.way.allFinite() || !motion.turn.allFinite()) return {object.getWorldTransform()};
    return motion;
}

ObjectMotion backwards(ObjectMotion motion) {
    motion.from = moved(motion.from, -motion.way, -motion.turn, 1);
    return motion;
}

PlantMotion motion_of(const PlantBody& body, double h) {
    const Plant& plant = *body.plant;
    PlantMotion motion;
    motion.ways.assign(plant.view.chain_positions.size(), Vec3::Zero());
    if (body.rest.asleep) return motion;
    for (size_t n = 0; n < motion.ways.size(); n++) {
        const Vec3 velocity = plant.follow ? Vec3(point(plant.state.motion.v, 2 * int(n)))
                                           : attachment_velocity(chain_attachment(plant, int(n)), plant.state.motion.x,
                                                                 plant.state.motion.v);
        motion.ways[n] = h * (plant.rotation * velocity);
        motion.farthest = std::max(motion.farthest, motion.ways[n].norm());
    }
    return motion;
}

PlantMotion motion_in_step(const PlantBody& body) {
    const Plant& plant = *body.plant;
    PlantMotion motion;
    motion.ways.assign(plant.view.chain_positions.size(), Vec3::Zero());
    if (!has_step(body)) return motion;
    for (size_t n = 0; n < motion.ways.size(); n++) {
        const auto place = [&](const VecX& x) {
            return plant.follow ? Vec3(point(x, 2 * int(n))) : attachment_place(chain_attachment(plant, int(n)), x);
        };
        motion.ways[n] = plant.rotation * (place(plant.state.motion.x) - place(plant.step.x_good));
        motion.farthest = std::max(motion.farthest, motion.ways[n].norm());
    }
    return motion;
}

MovingShape moving_piece(const PlantBody& body, const PlantMotion& motion, int child, int capsule) {
    const Plant& plant = *body.plant;
    const auto* compound = static_cast<const btCompoundShape*>(body.getCollisionShape());
    MovingShape piece = {static_cast<const btConvexShape&>(*compound->getChildShape(child)),
                         body.getWorldTransform() * compound->getChildTransform(child)};
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    const Vec3 &first = motion.ways[size_t(begin)], &second = motion.ways[size_t(end)];
    const Vec3 axis =
        plant.rotation * (plant.view.chain_positions[size_t(end)] - plant.view.chain_positions[size_t(begin)]);
    piece.way = 0.5 * (first + second);
    if (axis.squaredNorm() > 0) piece.turn = axis.cross(second - first) / axis.squaredNorm();
    if (motion.is_past) piece.from = moved(piece.from, -piece.way, -piece.turn, 1);
    return piece;
}

void Box::widen(double by) {
    const btVector3 all = to_bullet(Vec3::Constant(by));
    lower -= all;
    upper += all;
}

void Box::add(const Box& other) {
    lower.setMin(other.lower);
    upper.setMax(other.upper);
}

Box box_of(const btCollisionShape& shape, const ObjectMotion& motion) {
    Box box;
    shape.getAabb(motion.from, box.lower, box.upper);
    box.add({box.lower + to_bullet(motion.way), box.upper + to_bullet(motion.way)});
    if (motion.turn.isZero(0)) return box;
    btVector3 centre;
    btScalar radius;
    shape.getBoundingSphere(centre, radius);
    box.widen(std::min(1.0, motion.turn.norm()) * double(centre.length() + radius));
    return box;
}

static Box in_frame(const Box& box, const btTransform& frame) {
    Box local;
    btTransformAabb(btScalar(0.5) * (box.upper - box.lower), 0,
                    frame.inverse() * btTransform(btMatrix3x3::getIdentity(), btScalar(0.5) * (box.lower + box.upper)),
                    local.lower, local.upper);
    return local;
}

void for_each_convex(const btCollisionShape& shape, const ObjectMotion& motion, const Box& box,
                     const std::function<void(const MovingShape&)>& take) {
    if (shape.isCompound()) {
        const auto& compound = static_cast<const btCompoundShape&>(shape);
        for (int i = 0; i < compound.getNumChildShapes(); i++) {
            ObjectMotion of_child = motion;
            of_child.from = motion.from * compound.getChildTransform(i);
            of_child.way += motion.turn.cross(from_bullet(of_child.from.getOrigin() - motion.from.getOrigin()));
            for_each_convex(*compound.getChildShape(i), of_child, box, take);
        }
    } else if (shape.isConvex()) {
        take({static_cast<const btConvexShape&>(shape), motion.from, motion.way, motion.turn});
    } else if (shape.isConcave() && !shape.isInfinite()) {
        struct TakeTriangle : btTriangleCallback {
            const ObjectMotion& motion;
            const std::function<void(const MovingShape&)>& take;
            double margin;
            TakeTriangle(const ObjectMotion& motion, const std::function<void(const MovingShape&)>& take, double margin)
                : motion(motion), take(take), margin(margin) {}
            void processTriangle(btVector3* corners, int, int) override {
                btTriangleShape triangle(corners[0], corners[1], corners[2]);
                triangle.setMargin(btScalar(margin));
                take({triangle, motion.from, motion.way, motion.turn});
            }
        } take_triangle(motion, take, double(shape.getMargin()));
        Box local = in_frame(box, motion.from);
        local.widen(motion.way.norm());
        static_cast<const btConcaveShape&>(shape).processAllTriangles(&take_triangle, local.lower, local.upper);
    }
}

void for_each_child(PlantBody& body, const Box& box, const std::function<void(int child, int capsule)>& take) {
    struct TakeLeaf : btDbvt::ICollide {
        const std::function<void(int)>& take;
        explicit TakeLeaf(const std::function<void(int)>& take) : take(take) {}
        void Process(const btDbvtNode* leaf) override { take(leaf->dataAsInt); }
    };
    const std::function<void(int)> take_child = [&](int child) {
        const int capsule = body.hull->capsule_of(child);
        if (capsule >= 0 && !is_covered(body, child)) take(child, capsule);
    };
    TakeLeaf take_leaf(take_child);
    const Box local = in_frame(box, body.getWorldTransform());
    const btDbvt* tree = body.compound()->getDynamicAabbTree();
    if (tree && tree->m_root) tree->collideTV(tree->m_root, btDbvtVolume::FromMM(local.lower, local.upper), take_leaf);
}

double far_for(const btCollisionObject& object) {
    const bool is_led = object.isKinematicObject() || btMultiBodyLinkCollider::upcast(&object);
    return is_led ? 0.001 : 0.005;
}

// Returns the displacement of a segment of that radius and a shape up to which Bullet's own detection sees them meet
// [m].
static double slow_for(const btCollisionObject& object, double radius) {
    constexpr double SLOW = 0.5;  // over the radius [-]
    return btMultiBodyLinkCollider::upcast(&object) ? far_for(object) : SLOW * radius;
}

// Calls `take` for the pieces of a plant that may come near an object's shapes.
static void for_each_meeting(PlantBody& body, const PlantMotion& of_plant, const btCollisionObject& object,
                             const ObjectMotion& of_object,
                             const std::function<void(int capsule, const MovingShape&, const MovingShape&)>& take) {
    Box plant_box;
    body.compound()->getAabb(body.getWorldTransform(), plant_box.lower, plant_box.upper);
    plant_box.widen(of_plant.farthest);
    for_each_convex(*object.getCollisionShape(), of_object, plant_box, [&](const MovingShape& shape) {
        Box box = box_of(shape.shape, {shape.from, shape.way, shape.turn});
        box.widen(of_plant.farthest);
        for_each_child(body, box, [&](int child, int capsule) {
            if (is_apart(body, capsule, object)) return;
            const MovingShape piece = moving_piece(body, of_plant, child, capsule);
            const double turned = shape.turn.norm() + piece.turn.norm();
            if ((shape.way - piece.way).norm() + turned < slow_for(object, radius_of(body, capsule))) return;
            take(capsule, piece, shape);
        });
    });
}

void find_hits(PlantBody& body, const PlantMotion& of_plant, const btCollisionObject& object,
               const ObjectMotion& of_object, const std::function<void(const Hit&)>& take) {
    for_each_meeting(body, of_plant, object, of_object,
                     [&](int capsule, const MovingShape& piece, const MovingShape& shape) {
                         if (const auto impact = first_impact(shape, piece)) take({capsule, piece, shape, *impact});
                     });
}

void find_foreseen_hits(PlantBody& body, const PlantMotion& of_plant, const btCollisionObject& object,
                        const ObjectMotion& of_object, const std::function<void(const Hit&)>& take) {
    for_each_meeting(body, of_plant, object, of_object,
                     [&](int capsule, const MovingShape& piece, const MovingShape& shape) {
                         const MovingShape still = {piece.shape, piece.from};
                         if (const auto impact = first_impact(shape, piece))
                             take({capsule, piece, shape, *impact});
                         else if (const auto other = first_impact(shape, still))
                             take({capsule, still, shape, *other});
                     });
}

double depth_after(const Hit& hit) {
    const auto end_of = [&](const MovingShape& shape, const Vec3& point) {
        return from_bullet(shape.at(1) * (shape.at(hit.impact.time).inverse() * to_bullet(point)));
    };
    return -hit.impact.normal.dot(end_of(hit.shape, hit.impact.on_a) - end_of(hit.piece, hit.impact.on_b));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
