// In: places of bodies and capsules, and the results of Bullet's broad and narrow phase. Out: contacts.
//
// Bullet keeps contact points of earlier substeps, whose side on the plant is stale since capsules move within their
// compound. So only the point on the other body is used; its distance from the capsule is computed anew.
#include "contact/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "contact/contact_body.hpp"
#include "contact/let_through.hpp"
#include "contact/piece.hpp"
#include "contact/plate.hpp"
#include "contact/sweep.hpp"
#include "world/convert.hpp"
#include "world/fragments.hpp"
#include "world/show.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

bool pushes(const btCollisionObject& object) {
    return object.hasContactResponse() || (object.getCollisionFlags() & btCollisionObject::CF_CHARACTER_OBJECT);
}

bool takes_part(const World& world, const PlantBody* body) {
    return body && body->world == &world && (world.effects & body->plant->input.effects & FROND_EFFECT_RIGID_CONTACT);
}

bool may_collide(const PlantBody& body, const btCollisionObject& object) {
    return !lets_through(body, object) && body.btSoftBody::checkCollideWithOverride(&object) &&
           object.checkCollideWith(&body);
}

bool slides(const btCollisionObject& object) {
    return btRigidBody::upcast(&object) != nullptr;
}

namespace {

// Finds the capsule nearest to p: GImpact meshes do not report which of the compound's children they met.
int nearest_capsule(const PlantBody& body, const Vec3& p) {
    int nearest = -1;
    double least = INFINITY;
    for (size_t capsule = 0; capsule < body.capsules().size(); capsule++) {
        const double distance =
            (nearest_on_core(body, int(capsule), p).point - p).norm() - radius_of(body, int(capsule));
        if (distance >= least) continue;
        least = distance;
        nearest = int(capsule);
    }
    return nearest;
}

// Returns whether a body's point is on the side of a core from which Bullet has the body come. Else it is past the
// core, and the exit direction is Bullet's.
bool is_outside(const Vec3& way, const Vec3& towards) {
    constexpr double SIDEWAYS = 0.2;  // cosine of the angle up to which a point beside the core is still outside
    return way.dot(towards) > SIDEWAYS * way.norm();
}

// Makes the contact of a body's point with a capsule; an infinite gap means none.
Contact contact_at(PlantBody& body, int capsule, btCollisionObject& other, const Vec3& on_other, const Vec3& towards) {
    if (slides(other)) {
        const int under = piece_under(body, capsule, on_other);
        const bool is_beside = is_outside(nearest_on_core(body, under, on_other).point - on_other, towards);
        if (is_beside && !is_apart(body, under, other)) capsule = under;
    }
    const OnCore core = nearest_on_core(body, capsule, on_other);
    const double radius = radius_of(body, capsule);
    const Vec3 way = core.point - on_other;
    const Vec3 normal = is_outside(way, towards) ? Vec3(way.normalized()) : towards;
    Contact contact;
    contact.gap = way.dot(normal) - radius;
    if (is_between_pieces(body, capsule, normal)) contact.gap = INFINITY;
    contact.plant = &body;
    contact.capsule = capsule;
    contact.along = core.along;
    contact.across = core.across;
    contact.other = &other;
    contact.on_plant = core.point - radius * normal;
    contact.on_other = on_other;
    contact.normal = normal;
    set_surface_of(contact);
    return contact;
}

// The gap counts at the start of the step: from there kinematic bodies have moved already.
void add_contact(PlantBody& body, int capsule, btCollisionObject& other, const Vec3& on_other, const Vec3& towards,
                 double h, std::vector<Contact>& contacts) {
    constexpr double FAR = 0.05;  // [m]
    Contact contact = contact_at(body, capsule, other, on_other, towards);
    if (!(contact.gap < FAR)) return;
    if (other.isKinematicObject()) contact.gap += h * contact.normal.dot(velocity_at(other, on_other));
    contacts.push_back(contact);
}

// Returns whether a free body has moved far since Bullet looked: that was with the plant where it is now, but before
// the body moved.
bool has_moved_on(int child, const btCollisionObject& other, double h) {
    constexpr double FAR = 0.005;  // motion from which on they are swept anyhow [m]
    return child >= 0 && other.getCollisionShape()->isConvex() && is_free(other) && motion_of(other, h).is_far(FAR);
}

// The nearest points of a convex body and a plant's child where both are now.
struct ChildGap {
    int child;
    ShapeGap gap;
    bool has_contact;
};
ShapeGap gap_now(const PlantBody& body, int child, const btCollisionObject& other) {
    const auto* compound = static_cast<const btCompoundShape*>(body.getCollisionShape());
    return gap_between(static_cast<const btConvexShape&>(*other.getCollisionShape()), other.getWorldTransform(),
                       static_cast<const btConvexShape&>(*compound->getChildShape(child)),
                       body.getWorldTransform() * compound->getChildTransform(child));
}

// Adds a manifold's contacts. Manifolds of planes are skipped: they were made for queries between steps.
void add_manifold(World& world, const btPersistentManifold& manifold, double h, std::vector<Contact>& contacts) {
    auto* first = const_cast<btCollisionObject*>(manifold.getBody0());
    auto* second = const_cast<btCollisionObject*>(manifold.getBody1());
    PlantBody* body = PlantBody::of(first);
    const bool plant_first = body != nullptr;
    if (!body) body = PlantBody::of(second);
    btCollisionObject* other = plant_first ? second : first;
    if (!takes_part(world, body) || PlantBody::of(other) || !pushes(*other) || is_plane(*other) ||
        lets_through(*body, *other))
        return;
    if (body->rest.asleep && !is_moving(*other)) return;
    // Modal plants are only checked for touch: their last pose is near enough.
    if (!body->plant->state.modal) look_at(*body);
    std::vector<int> plates;  // plates whose corners have been added
    std::vector<ChildGap> gaps;
    for (int i = 0; i < manifold.getNumContacts(); i++) {
        const btManifoldPoint& p = manifold.getContactPoint(i);
        const btVector3 on_other = other->getWorldTransform() * (plant_first ? p.m_localPointB : p.m_localPointA);
        const int child = plant_first ? p.m_index0 : p.m_index1;
        if (is_covered(*body, child)) continue;
        const int capsule = child < 0 ? nearest_capsule(*body, from_bullet(on_other)) : body->hull->capsule_of(child);
        if (capsule < 0 || is_apart(*body, capsule, *other)) continue;
        const Vec3 towards = (plant_first ? 1.0 : -1.0) * from_bullet(p.m_normalWorldOnB);
        if (has_moved_on(child, *other, h)) {
            const auto is_of_child = [&](const ChildGap& now) { return now.child == child; };
            auto now = std::find_if(gaps.begin(), gaps.end(), is_of_child);
            if (now == gaps.end()) now = gaps.insert(now, {child, gap_now(*body, child, *other), false});
            if (now->gap.normal.dot(towards) > 0) continue;  // it has come to the child's other side
            if (!now->has_contact && !now->gap.normal.isZero()) {
                now->has_contact = true;
                add_contact(*body, capsule, *other, now->gap.on_a, -now->gap.normal, h, contacts);
            }
        }
        add_contact(*body, capsule, *other, from_bullet(on_other), towards, h, contacts);
        const bool is_flat = body->hull->flats[size_t(capsule)].half_width > 0;
        if (!is_flat || std::find(plates.begin(), plates.end(), capsule) != plates.end()) continue;
        plates.push_back(capsule);
        for (const Vec3& point : points_over_plate(*body, capsule, *other, towards))
            add_contact(*body, capsule, *other, point, towards, h, contacts);
    }
}

// Adds the contacts of planes, and shows sleepers to kinematic bodies that come near. Returns the other bodies.
std::vector<Sweeper> look_at_objects(World& world, double h, std::vector<Contact>& contacts) {
    std::vector<Sweeper> others;
    const btCollisionObjectArray& objects = world.bullet->getCollisionObjectArray();
    std::vector<const btCollisionObject*>& plants = world.plants_at;
    plants.resize(size_t(objects.size()));
    std::vector<const btCollisionObject*>& before = world.others_before;
    for (int i = 0; i < objects.size(); i++) {
        if (plants[size_t(i)] == objects[i]) continue;
        if (PlantBody::of(objects[i])) {
            plants[size_t(i)] = objects[i];
            continue;
        }
        btCollisionObject& object = *objects[i];
        if (!pushes(object)) continue;
        if (object.isKinematicObject() && is_moving(object)) show_sleepers_to(world, object, h);
        if (is_plane(object)) {
            add_plane_contacts(world, object, h, contacts);
        } else if (object.getBroadphaseHandle()) {
            others.push_back({&object, !std::binary_search(before.begin(), before.end(), &object, std::less<>())});
        }
    }
    before.clear();
    for (const Sweeper& other : others) before.push_back(other.object);
    std::sort(before.begin(), before.end(), std::less<>());
    return others;
}

// Subtracts from overlaps with bodies at rest the depth that they had when the plant was new. Capsules whose axis was
// inside, such as roots in the ground, do not touch the body at all.
void discount_grown_in(std::vector<Contact>& contacts) {
    for (Contact& contact : contacts) {
        std::unique_ptr<GrownIn>& grown_in = contact.plant->grown_in;
        const btBroadphaseProxy* proxy = contact.other->getBroadphaseHandle();
        const GrownIn::key_type key(contact.capsule, contact.other, proxy ? proxy->m_uniqueId : 0);
        const bool stands = contact.other->isStaticOrKinematicObject() && !is_moving(*contact.other);
        if (contact.plant->new_for > 0 && stands && contact.gap < 0) {
            if (!grown_in) grown_in = std::make_unique<GrownIn>();
            (*grown_in)[key] = std::max((*grown_in)[key], -contact.gap);
        }
        if (!grown_in) continue;
        const auto found = grown_in->find(key);
        if (found == grown_in->end()) continue;
        const double radius = radius_of(*contact.plant, contact.capsule);
        contact.gap += found->second > radius ? INFINITY : found->second;
    }
    const auto is_far = [](const Contact& contact) { return !std::isfinite(contact.gap); };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_far), contacts.end());
}

// Marks the chain nodes from one to its root.
std::vector<uint8_t> path_down(const Plant& plant, int chain_node) {
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    std::vector<uint8_t> path(nodes.size(), 0);
    for (int i = chain_node; i >= 0; i = nodes[size_t(i)].parent) path[size_t(i)] = 1;
    return path;
}

// Returns how a body pushes a stem: 1 along it and away from its root, -1 towards the root, 0 across.
int way_along(const Contact& contact) {
    constexpr double ALONG = 0.5;  // cosine
    const Plant& plant = *contact.plant->plant;
    const auto& [begin, end] = plant.model->capsules[size_t(contact.capsule)];
    const Vec3 outward =
        plant.rotation * (plant.view.chain_positions[size_t(end)] - plant.view.chain_positions[size_t(begin)]);
    const double along = contact.normal.dot(outward), least = ALONG * outward.norm();
    return along > least ? 1 : along < -least ? -1 : 0;
}

// Returns whether the begin of a capsule that a body pushes away from it is buried in that body.
bool is_buried(const Contact& contact) {
    const Plant& plant = *contact.plant->plant;
    const int begin = plant.model->capsules[size_t(contact.capsule)][0];
    const Vec3 place = plant.to_world(plant.view.chain_positions[size_t(begin)]);
    return contact.normal.dot(place - contact.on_other) < -radius_of(*contact.plant, contact.capsule);
}

// Returns how pins and supports hold a capsule: 2 at one of its own nodes, 1 farther down towards the root, 0 not at
// all.
int how_held(const Plant& plant, int capsule) {
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    const std::vector<uint8_t> path = path_down(plant, end);
    int held = 0;
    const auto hold = [&, begin = begin, end = end](int node) {
        if (path[size_t(node)]) held = std::max(held, node == begin || node == end ? 2 : 1);
    };
    for (size_t n = 0; n < plant.input.pinned.size(); n++) {
        const int anchor = plant.input.anchor[n];
        if (plant.input.pinned[n] && !support_of(plant, anchor)) hold(anchor);
    }
    for (const Support& support : supports_of(plant))
        if (support.holds_place) hold(support.chain_node);
    return held;
}

}  // namespace

void drop_what_draws_out(std::vector<Contact>& contacts) {
    constexpr double AXIS = 0.9;  // depth from which the axis counts as reached, over the radius [-]
    std::vector<Contact> useless;
    for (const Contact& contact : contacts) {
        if (!contact.other->isStaticOrKinematicObject()) continue;
        const int way = way_along(contact);
        if (way == 0) continue;
        const double radius = radius_of(*contact.plant, contact.capsule);
        const bool goes_through = contact.gap < -AXIS * radius || (way > 0 && is_buried(contact));
        const bool may_lift = way > 0 && contact.other->isKinematicObject();  // static bodies lift nothing
        if (!goes_through && !may_lift) continue;
        if (how_held(*contact.plant->plant, contact.capsule) >= (goes_through ? 1 : 2)) useless.push_back(contact);
    }
    if (useless.empty()) return;
    const auto end_of = [](const Contact& contact) {
        return contact.plant->plant->model->capsules[size_t(contact.capsule)][1];
    };
    const auto draws_out = [&](const Contact& contact) {
        if (way_along(contact) == 0) return false;
        const std::vector<uint8_t> path = path_down(*contact.plant->plant, end_of(contact));
        return std::any_of(useless.begin(), useless.end(), [&](const Contact& below) {
            return below.plant == contact.plant && below.other == contact.other && path[size_t(end_of(below))];
        });
    };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), draws_out), contacts.end());
}

// Drops contacts with round ends within a stem whose next segment the body touches: they would catch what slides along.
static void drop_what_is_inside(std::vector<Contact>& contacts) {
    std::vector<Contact> outside;
    std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(outside),
                 [](const Contact& contact) { return !contact.is_inside; });
    if (outside.size() == contacts.size()) return;
    const auto is_hidden = [&](const Contact& contact) {
        return contact.is_inside && std::any_of(outside.begin(), outside.end(), [&](const Contact& by) {
                   return by.plant == contact.plant && by.other == contact.other &&
                          are_joined(*contact.plant->plant, by.capsule, contact.capsule);
               });
    };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_hidden), contacts.end());
}

std::vector<Contact> find_contacts(World& world, const std::vector<Contact>& last, double h) {
    touch_again(world);
    std::vector<Contact> contacts;
    btDispatcher* dispatcher = world.bullet->getDispatcher();
    for (int i = 0; i < dispatcher->getNumManifolds(); i++) {
        const btPersistentManifold* manifold = dispatcher->getManifoldByIndexInternal(i);
        if (manifold->getNumContacts() > 0) add_manifold(world, *manifold, h, contacts);
    }
    const std::vector<Sweeper> others = look_at_objects(world, h, contacts);
    add_swept_contacts(world, others, last, h, contacts);
    find_plants_among_bodies(world);
    discount_grown_in(contacts);
    drop_what_draws_out(contacts);
    drop_what_is_inside(contacts);
    // The response depends on their order a little, and Bullet's is the dispatcher's.
    const auto key = [](const Contact& c) {
        return std::make_tuple(c.plant->index, c.capsule, c.along, c.across, c.other->getWorldArrayIndex());
    };
    std::stable_sort(contacts.begin(), contacts.end(),
                     [&](const Contact& a, const Contact& b) { return key(a) < key(b); });
    for (PlantBody* body : world.awake) body->new_for = int16_t(std::max(body->new_for - 1, 0));
    return contacts;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
