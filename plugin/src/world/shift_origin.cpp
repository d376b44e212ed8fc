// In: a world and a point of it. Out: the same world, whose origin is that point.
//
// All positions in the world's frame change by the same displacement; those in the frames of plants and bodies stay.
#include "world/convert.hpp"
#include "world/robot.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

btTransform shifted(btTransform frame, const Vec3& origin) {
    frame.setOrigin(to_bullet(from_bullet(frame.getOrigin()) - origin));
    return frame;
}

void shift_object(World& world, btCollisionObject& object, const Vec3& origin) {
    object.setWorldTransform(shifted(object.getWorldTransform(), origin));
    object.setInterpolationWorldTransform(shifted(object.getInterpolationWorldTransform(), origin));
    if (object.getBroadphaseHandle()) world.bullet->updateSingleAabb(&object);
}

void shift(Contact& contact, const Vec3& origin) {
    contact.on_plant -= origin;
    contact.on_other -= origin;
}
void shift(PlantContact& contact, const Vec3& origin) {
    contact.point -= origin;
}
void shift_contacts(std::vector<Contact>& with_bodies, std::vector<PlantContact>& with_plants, const Vec3& origin) {
    for (Contact& contact : with_bodies) shift(contact, origin);
    for (PlantContact& contact : with_plants) shift(contact, origin);
}

void shift_floats(std::vector<float>& places, const Vec3& origin) {
    for (size_t i = 0; i < places.size(); i++) places[i] = float(double(places[i]) - origin[Eigen::Index(i % 3)]);
}

void shift_plant(World& world, PlantBody& body, const Vec3& origin) {
    Plant& plant = *body.plant;
    plant.position -= origin;
    for (Fragment& fragment : plant.state.fragments) {
        fragment.centre -= origin;
        fragment.shift -= origin;
    }
    for (Grab& grab : plant.input.grabs) grab.target -= origin;
    shift_floats(plant.view.surface_positions, origin);
    if (plant.view.previous) shift_floats(plant.view.previous->positions, origin);
    plant.view.surface_stale = true;
    if (body.rest.contacts) {
        auto contacts = std::make_shared<LastContacts>(*body.rest.contacts);
        shift_contacts(contacts->with_bodies, contacts->with_plants, origin);
        body.rest.contacts = std::move(contacts);
    }
    shift_object(world, body, origin);
}

bool is_fronds(const World& world, const btCollisionObject* object) {
    if (world.own || PlantBody::of(object)) return true;
    for (const auto& rigid : world.rigids)
        if (rigid->body.get() == object) return true;
    return false;
}

// Moves the contact points of Bullet's last step, which it does not search anew where bodies sleep.
void shift_manifolds(World& world, const Vec3& origin) {
    btDispatcher& dispatcher = *world.bullet->getDispatcher();
    const btVector3 by = to_bullet(origin);
    for (int i = 0; i < dispatcher.getNumManifolds(); i++) {
        btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
        if (!is_fronds(world, manifold.getBody0()) && !is_fronds(world, manifold.getBody1())) continue;
        for (int k = 0; k < manifold.getNumContacts(); k++) {
            manifold.getContactPoint(k).m_positionWorldOnA -= by;
            manifold.getContactPoint(k).m_positionWorldOnB -= by;
        }
    }
}

}  // namespace

void shift_origin(World& world, const Vec3& origin) {
    for (const auto& body : world.bodies) shift_plant(world, *body, origin);
    for (const auto& rigid : world.rigids) shift_object(world, *rigid->body, origin);
    for (const auto& robot : world.robots)
        if (!robot->is_gone) shift_base(*robot, origin);
    shift_contacts(world.contacts, world.plant_contacts, origin);
    shift_manifolds(world, origin);
    if (world.detail) world.detail->viewer -= origin;
    if (world.wind) shift_origin(*world.wind, up_of(gravity_of(world)), origin);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
