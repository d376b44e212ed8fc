// frond_bond_*: points of plants held to bodies.
#include "api/call.hpp"
#include "api/handles.hpp"
#include "world/is_in.hpp"

using namespace frond;

namespace frond {
inline namespace FROND_BULLET_PRECISION {

frond_bond make_bond(PlantBody& plant, const frond_vec3& point, btCollisionObject& body) {
    check_vec(point, "point [m]");
    World& world = *plant.world;
    Bond& bond = add_bond(world, plant, to_vec(point), body);
    wake(plant);
    const auto handle = handle_for<frond_bond>(&bond, [&] { world.bonds.pop_back(); });
    bond.handle = handle.id;
    return handle;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond

extern "C" {

frond_result frond_bond_create(frond_plant plant, frond_vec3 point, frond_rigid rigid, frond_bond* out) {
    return give(out, [&] {
        PlantBody& body = look_at(get(plant));
        Rigid& held_by = get(rigid);
        if (held_by.world != body.world)
            fail(FROND_RESULT_BAD_ARGUMENT, "the rigid body is of another world than the plant");
        return make_bond(body, point, *held_by.body);
    });
}

frond_result frond_bond_get(frond_bond bond, frond_vec3* held_point, frond_vec3* force) {
    return call([&] {
        for (frond_vec3* out : {held_point, force})
            if (out) *out = {};
        const Bond& found = get(bond);
        if (held_point) *held_point = from_vec(held_place(found));
        if (force) *force = from_vec(found.impulse / found.length);
    });
}

void frond_bond_destroy(frond_bond bond) {
    call([&] {
        Bond* found = slots<frond_bond>().erase(bond.id);
        if (!found) return;
        wake(*found->plant);
        found->plant->world->bonds.remove_if([&](const Bond& other) { return &other == found; });
    });
}

bool frond_bond_is_valid(frond_bond bond) {
    return find(bond) != nullptr;
}

}  // extern "C"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

frond_result bond(frond_plant plant, const btVector3& point, btCollisionObject* object, frond_bond* out) {
    return give(out, [&] {
        PlantBody& body = look_at(get(plant));
        check_pointer(object, "body");
        if (!is_in(*body.world->bullet, object) || PlantBody::of(object))
            fail(FROND_RESULT_BAD_ARGUMENT, "the body is not in the plant's Bullet world, or is a plant; add it first");
        return make_bond(body, {double(point.x()), double(point.y()), double(point.z())}, *object);
    });
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
