// In: bodies and plants, and how far each moves in the step. Out: contacts of those that would pass through each other.
//
// Kinematic bodies have come to their places within this step, and plants are to meet them there. Free bodies have
// moved as well, but their motion still answers to impulses, so that the step ahead of them counts.
#include <algorithm>
#include <cmath>

#include "contact/find_contacts.hpp"
#include "contact/keep_apart.hpp"
#include "contact/piece.hpp"
#include "contact/sweep.hpp"
#include "plant/plant_step.hpp"
#include "world/convert.hpp"
#include "world/fragments.hpp"
#include "world/show.hpp"
#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Returns the greatest speed of a node [m/s].
double fastest_node(const Plant& plant) {
    double most = 0;
    for (int i = 0; i < plant.state.motion.v.size() / 3; i += plant.follow ? 2 : 1)
        most = std::max(most, point(plant.state.motion.v, i).squaredNorm());
    return std::sqrt(most);
}

Contact contact_of(PlantBody& body, btCollisionObject& other, const Hit& hit) {
    const ShapeImpact& impact = hit.impact;
    const btVector3 on_plant = hit.piece.at(impact.time).inverse() * to_bullet(impact.on_b),
                    on_other = hit.shape.at(impact.time).inverse() * to_bullet(impact.on_a);
    Contact contact;
    contact.plant = &body;
    contact.capsule = hit.capsule;
    contact.other = &other;
    contact.normal = -impact.normal;
    contact.on_plant = from_bullet(hit.piece.from * on_plant);
    contact.gap = contact.normal.dot(contact.on_plant - from_bullet(hit.shape.from * on_other));
    contact.on_other = from_bullet((other.isKinematicObject() ? hit.shape.at(1) : hit.shape.from) * on_other);
    const OnCore core = nearest_on_core(body, hit.capsule, contact.on_plant);
    contact.along = core.along;
    contact.across = core.across;
    set_surface_of(contact);
    return contact;
}

// Returns whether one of two capsules continues the other, or they are one: a body that pushes both pushes them to one
// side. It may be caught in the fork of others.
bool are_in_line(const Plant& plant, int capsule, int other) {
    constexpr double STRAIGHT = 0.8;  // cosine
    const auto &a = plant.model->capsules[size_t(capsule)], &b = plant.model->capsules[size_t(other)];
    if (capsule == other) return true;
    if (a[1] != b[0] && a[0] != b[1]) return false;
    const auto axis = [&](const std::array<int, 2>& ends) {
        return Vec3(
            (plant.view.chain_positions[size_t(ends[1])] - plant.view.chain_positions[size_t(ends[0])]).normalized());
    };
    return axis(a).dot(axis(b)) > STRAIGHT;
}

// Adds a contact unless one like it is known. A kinematic body's contacts that push a piece in line the other way go:
// they were found when one had passed the other. Free bodies are put back instead.
// Returns whether it was added.
bool add(const Contact& contact, std::vector<Contact>& contacts) {
    constexpr double LIKE = 0.5;  // cosine
    const auto is_of_both = [&](const Contact& c) {
        return c.plant == contact.plant && c.capsule == contact.capsule && c.other == contact.other;
    };
    const bool pushes_on = contact.other->isKinematicObject();
    const auto is_like = [&](const Contact& c) {
        return is_of_both(c) && (!pushes_on || c.normal.dot(contact.normal) > LIKE);
    };
    const auto is_against = [&](const Contact& c) {
        return c.plant == contact.plant && c.other == contact.other && c.normal.dot(contact.normal) < 0 &&
               are_in_line(*contact.plant->plant, contact.capsule, c.capsule);
    };
    if (pushes_on) contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_against), contacts.end());
    if (std::any_of(contacts.begin(), contacts.end(), is_like)) return false;
    contacts.push_back(contact);
    contacts.back().is_inside =
        slides(*contact.other) && is_in_joint(*contact.plant, contact.capsule, contact.on_plant);
    return true;
}

// Returns whether Bullet's filters let the two meet; sleepers count with the filter that they had before they hid.
bool may_meet(const PlantBody& body, const btCollisionObject& object) {
    const btBroadphaseProxy *of_body = body.getBroadphaseHandle(), *of_object = object.getBroadphaseHandle();
    const int group = body.is_hidden ? body.filter_group : of_body->m_collisionFilterGroup,
              mask = body.is_hidden ? body.filter_mask : of_body->m_collisionFilterMask;
    return (group & of_object->m_collisionFilterMask) && (of_object->m_collisionFilterGroup & mask) &&
           may_collide(body, object);
}

// Contacts that are to be found, and what is known for that.
struct Search {
    World& world;
    double h;                          // [s]
    const std::vector<Contact>& last;  // of the last step
    std::vector<Contact>& contacts;
    double fastest = 0;                                      // displacement of the fastest plant [m]
    std::vector<std::unique_ptr<PlantMotion>> motions = {};  // by plant, once they are needed
};

const PlantMotion& motion_in(Search& search, const PlantBody& body) {
    search.motions.resize(search.world.bodies.size());
    std::unique_ptr<PlantMotion>& motion = search.motions[size_t(body.index)];
    if (!motion) motion = std::make_unique<PlantMotion>(motion_of(body, search.h));
    return *motion;
}

// Returns the plants that an object may meet within its step and the one before.
std::vector<PlantBody*> plants_near(Search& search, const btCollisionObject& object, const ObjectMotion& motion,
                                    const ObjectMotion& past) {
    const double far = far_for(object);
    const bool moves = motion.is_far(far);
    Box box = box_of(*object.getCollisionShape(), motion);
    box.add(box_of(*object.getCollisionShape(), past));
    box.widen(search.fastest);
    std::vector<PlantBody*> plants;
    for (PlantBody* body : plants_in(search.world, box.lower, box.upper)) {
        if (!takes_part(search.world, body) || body->plant->state.modal || !may_meet(*body, object)) continue;
        if (!moves && (body->rest.asleep || motion_in(search, *body).farthest < far)) continue;
        plants.push_back(&look_at(*body));
        body->met_in = search.world.substep;
    }
    std::sort(plants.begin(), plants.end(), [](const PlantBody* a, const PlantBody* b) { return a->index < b->index; });
    return plants;
}

constexpr double PASSED = 0.005;  // depth from which on a body has passed [m]

// Returns the share of a motion within which a body goes through no plant as these stand.
double way_among(Search& search, const std::vector<PlantBody*>& plants, const btRigidBody& rigid,
                 const ObjectMotion& motion) {
    double share = 1;
    for (PlantBody* body : plants) {
        if (!(search.world.effects & body->plant->input.effects & FROND_EFFECT_TWO_WAY)) continue;
        PlantMotion stands;
        stands.ways.assign(body->plant->view.chain_positions.size(), Vec3::Zero());
        find_hits(*body, stands, rigid, motion, [&](const Hit& hit) {
            if (hit.impact.time > 0 && depth_after(hit) > PASSED) share = std::min(share, hit.impact.time);
        });
    }
    return share;
}

// Puts a free body back to where it met a plant that it has passed since, as Bullet's own continuous detection does,
// and on from there as the plant went. That happens to new bodies, and to those that something else turned aside.
void put_back_if_passed(Search& search, const std::vector<PlantBody*>& plants, btRigidBody& rigid,
                        const ObjectMotion& past) {
    double met = 1;
    Vec3 carried = Vec3::Zero();  // from there [m]
    for (PlantBody* body : plants) {
        if (!(search.world.effects & body->plant->input.effects & FROND_EFFECT_TWO_WAY)) continue;
        PlantMotion motion = motion_in(search, *body);
        motion.is_past = true;
        find_hits(*body, motion, rigid, past, [&](const Hit& hit) {
            // A body that was there when the step began has not come through.
            if (depth_after(hit) < PASSED || hit.impact.time == 0 || hit.impact.time > met) return;
            met = hit.impact.time;
            const btVector3 on_piece = hit.piece.at(met).inverse() * to_bullet(hit.impact.on_b);
            carried = from_bullet(hit.piece.at(1) * on_piece) - hit.impact.on_b;
        });
    }
    if (met == 1) return;
    const btTransform place = moved(past.from, past.way, past.turn, met);
    const double share = way_among(search, plants, rigid, {place, carried});
    rigid.proceedToTransform(moved(place, carried, Vec3::Zero(), share));
    search.world.bullet->updateSingleAabb(&rigid);
}

// Adds contacts of pieces that lag behind a kinematic body which pushed them in the last step: they stay on the side on
// which it pushed, as long as they would meet it from there.
void keep_sides(Search& search, PlantBody& body, btCollisionObject& object, const ObjectMotion& motion) {
    constexpr double MARGIN = 0.02;  // [m]
    std::vector<const Contact*> pushed;
    double reach = 0;
    for (const Contact& contact : search.last)
        if (contact.plant == &body && contact.other == &object && !contact.impulse.isZero(0)) {
            pushed.push_back(&contact);
            reach = std::max(reach, motion.way.norm() + MARGIN - std::min(contact.gap, 0.0));
        }
    // A single triangle of a mesh is met from both of its sides.
    if (pushed.empty() || object.getCollisionShape()->isConcave()) return;
    Box around;
    body.compound()->getAabb(body.getWorldTransform(), around.lower, around.upper);
    around.widen(reach);
    const ObjectMotion rests = {motion.from};
    for_each_convex(*object.getCollisionShape(), rests, around, [&](const MovingShape& shape) {
        Box box = box_of(shape.shape, {shape.from});
        box.widen(reach);
        for_each_child(body, box, [&](int child, int capsule) {
            const Contact* by = nullptr;  // that which pushed it hardest
            for (const Contact* c : pushed)
                if ((c->capsule == capsule || are_joined(*body.plant, c->capsule, capsule)) &&
                    (!by || c->impulse.squaredNorm() > by->impulse.squaredNorm()))
                    by = c;
            if (!by || is_apart(body, capsule, object)) return;
            MovingShape piece = moving_piece(body, motion_in(search, body), child, capsule);
            const btVector3 away = to_bullet(reach * by->normal);
            piece.from.setOrigin(piece.from.getOrigin() + away);
            piece.way = -from_bullet(away);
            piece.turn.setZero();
            const auto impact = first_impact(shape, piece);
            if (!impact || impact->time == 0) return;
            Contact contact = contact_of(body, object, {capsule, piece, shape, *impact});
            contact.on_plant -= from_bullet(away);
            contact.gap = -(1 - impact->time) * reach * contact.normal.dot(by->normal);
            if (contact.gap < 0) add(contact, search.contacts);
        });
    });
}

void sweep(Search& search, btCollisionObject& object, bool is_new) {
    ObjectMotion motion = motion_of(object, search.h);
    // Bullet takes a new kinematic body for one that has come from the world's origin.
    if (is_new && object.isKinematicObject()) motion = {motion.from};
    const bool moves = motion.is_far(far_for(object));
    if (!moves && search.fastest < far_for(object)) return;
    const ObjectMotion past = backwards(motion);
    if (object.isKinematicObject()) motion = past;
    const std::vector<PlantBody*> plants = plants_near(search, object, motion, past);
    btRigidBody* rigid = btRigidBody::upcast(&object);
    if (rigid && moves && !object.isStaticOrKinematicObject()) {
        put_back_if_passed(search, plants, *rigid, past);
        motion.from = object.getWorldTransform();
    }
    const SweptBody swept = {&object, motion, plants};
    for (PlantBody* body : plants) {
        find_foreseen_hits(*body, motion_in(search, *body), object, motion,
                           [&](const Hit& hit) { add_hit(search.world, *body, swept, hit, search.contacts); });
        if (object.isKinematicObject()) keep_sides(search, *body, object, motion);
    }
    if (!plants.empty()) search.world.swept.push_back(swept);
}

}  // namespace

bool add_hit(World& world, PlantBody& body, const SweptBody& swept, const Hit& hit, std::vector<Contact>& contacts) {
    constexpr double LIMIT = 0.5;  // displacement that no step can give a plant, over its size [-]
    Contact contact = contact_of(body, *swept.object, hit);
    const bool is_led = swept.object->isKinematicObject();
    if (is_led && contact.normal.dot(swept.motion.way) > LIMIT * double(body.plant->size)) {
        note_trouble(world, body, FROND_TROUBLE_PASSED);
        return false;
    }
    // Overlaps with free bodies are for Bullet's own contacts to end.
    if (!is_led) contact.gap = std::max(0.0, contact.gap);
    return add(contact, contacts);
}

// Calls `take` for the pairs of Bullet's broad phase of plants that are awake, and bodies that push them.
static void for_each_near(World& world, const std::function<void(PlantBody&, btCollisionObject&)>& take) {
    const btBroadphasePairArray& pairs = world.bullet->getPairCache()->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); i++) {
        auto* first = static_cast<btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject);
        auto* second = static_cast<btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject);
        PlantBody* body = PlantBody::of(first);
        btCollisionObject& object = body ? *second : *first;
        if (!body) body = PlantBody::of(second);
        if (!takes_part(world, body) || body->rest.asleep || body->plant->state.modal || PlantBody::of(&object))
            continue;
        if (pushes(object) && !is_plane(object) && may_collide(*body, object)) take(*body, object);
    }
}

void find_plants_among_bodies(World& world) {
    if (world.awake.empty()) return;
    for_each_near(world, [](PlantBody& body, btCollisionObject&) { body.plant->step.is_among_bodies = true; });
}

void sweep_what_whipped(World& world, double h) {
    const auto whips = [](const PlantBody* body) { return has_step(*body) && whips_among_bodies(*body->plant); };
    if (std::none_of(world.awake.begin(), world.awake.end(), whips)) return;
    for_each_near(world, [&](PlantBody& body, btCollisionObject& object) {
        if (!whips(&body)) return;
        // What moves far is swept against all plants near it; of a kinematic body that is new Bullet knows no speed.
        const ObjectMotion motion =
            object.isKinematicObject() ? ObjectMotion{object.getWorldTransform()} : motion_of(object, h);
        const auto is_of_it = [&](const SweptBody& swept) { return swept.object == &object; };
        const auto known = std::find_if(world.swept.begin(), world.swept.end(), is_of_it);
        if (known == world.swept.end())
            world.swept.push_back({&object, motion, {&body}});
        else if (std::find(known->plants.begin(), known->plants.end(), &body) == known->plants.end())
            known->plants.push_back(&body);
    });
}

void add_swept_contacts(World& world, const std::vector<Sweeper>& bodies, const std::vector<Contact>& last, double h,
                        std::vector<Contact>& contacts) {
    if (bodies.empty()) return;
    Search search = {world, h, last, contacts};
    for (const PlantBody* body : world.awake)
        if (!body->plant->state.modal) search.fastest = std::max(search.fastest, h * fastest_node(*body->plant));
    for (const Sweeper& body : bodies) sweep(search, *body.object, body.is_new);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
