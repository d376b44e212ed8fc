#include "world/bond.hpp"

#include "world/convert.hpp"
#include "world/is_in.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

Bond& add_bond(World& world, PlantBody& plant, const Vec3& point, btCollisionObject& body) {
    Bond bond = {};
    bond.plant = &plant;
    bond.vertex = nearest_vertex(*plant.plant, point);
    bond.body = &body;
    bond.length = 1;
    const Vec3 place = pulled_place(*plant.plant, bond.vertex);
    bond.on_body = from_bullet(body.getWorldTransform().invXform(to_bullet(place)));
    world.bonds.push_back(bond);
    return world.bonds.back();
}

Vec3 held_place(const Bond& bond) {
    return pulled_place(*look_at(*bond.plant).plant, bond.vertex);
}

Vec3 place_on_body(const Bond& bond) {
    return from_bullet(bond.body->getWorldTransform() * to_bullet(bond.on_body));
}

void let_go_of_gone(World& world) {
    for (Bond& bond : world.bonds)
        if (bond.body &&
            (!is_in(*world.bullet, bond.body) || fragment_of_vertex(*bond.plant->plant, size_t(bond.vertex))))
            bond.body = nullptr;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
