// In: rows of links whose impulses and whose plants' ways are known. Out: what the next step of Bullet is to foresee.
#include "contact/foresee.hpp"

#include <map>

#include "contact/find_contacts.hpp"
#include "world/convert.hpp"
#include "world/link_loads.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

void take_back_from_links(World& world) {
    btAlignedObjectArray<btScalar> r;
    btAlignedObjectArray<btVector3> v;
    for (const auto& loads : world.link_loads) {
        btMultiBody& body = *loads->body();
        const std::vector<btScalar> given = loads->take_given();
        loads->taken = {std::vector<btScalar>(given.size(), 0), 0};
        if (given.empty()) continue;
        std::vector<btScalar>& changes = loads->taken.velocities;
        take_present_inertia(body);
        body.calcAccelerationDeltasMultiDof(given.data(), changes.data(), r, v);
        for (size_t k = 0; k < given.size(); k++) {
            loads->taken.energy += double(given[k]) * (0.5 * double(changes[k]) - double(body.getVelocityVector()[k]));
            changes[k] = -changes[k];
        }
        // All of it, beyond Bullet's bound on joints' speeds: plants give most of it again.
        const btScalar bound = body.getMaxCoordinateVelocity();
        body.setMaxCoordinateVelocity(BT_LARGE_FLOAT);
        body.applyDeltaVeeMultiDof(changes.data(), 1);
        body.setMaxCoordinateVelocity(bound);
    }
}

Vec3 velocity_as_moved(const World& world, const ContactBody& at) {
    const LinkLoads* loads = at.link ? find_link_loads(world, *at.link->m_multiBody) : nullptr;
    Vec3 velocity = at.velocity;
    for (size_t k = 0; loads && k < loads->taken.velocities.size(); k++)
        for (int axis = 0; axis < 3; axis++)
            velocity[axis] -= double(at.jacobian[size_t(axis)][k]) * double(loads->taken.velocities[k]);
    return velocity;
}

void foresee(const World& world, const std::vector<ContactRow>& rows, double h) {
    std::map<Plant*, VecX> velocities;  // ahead
    for (const ContactRow& row : rows) {
        if (row.parts.empty() || row.impulse->isZero(0) || !pushes_back(world, *row.plants[0])) continue;
        Plant& of = *row.plants[0]->plant;
        const auto [ahead, is_new] = velocities.insert({&of, {}});
        if (is_new) ahead->second = velocities_ahead(of);
        // How the plant went on in this step, and will in the next one.
        const Vec3 now = way_of_touch(of, row.touches[0]) / h,
                   plant = velocity_of_touch(of, row.touches[0], ahead->second);
        Vec3 on = plant;
        if (row.contact) {
            const Vec3& normal = row.touch.normal;
            if (!(row.impulse->dot(normal) > 0)) continue;
            const double along = normal.dot(plant), now_apart = row.contact->gap + h * normal.dot(now),
                         gap = now_apart < 0 ? row.contact->part_share * now_apart : now_apart;
            on += (way_on_of_link(gap, along, h) - along) * normal;
            row.foreseen->most_friction = row.touch.friction * row.impulse->dot(normal);
        } else {
            on = way_on_of_link(row.touch.wanted, now, plant);
        }
        row.foreseen->parts = row.parts;
        for (Foreseen::Part& part : row.foreseen->parts) part.work = part.impulse.dot(on);
        row.foreseen->place =
            from_bullet(row.contact_body.object->getWorldTransform().inverse() * to_bullet(row.contact_body.point));
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
