// In: contacts, root and bond forces after each substep. Out: the last ones, and their means over a call.
#include <algorithm>
#include <cmath>

#include "host.hpp"

namespace frond_host {

namespace {

frond_vec3 cross(const frond_vec3& a, const frond_vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
frond_vec3 scaled(double factor, const frond_vec3& a) {
    return {factor * a.x, factor * a.y, factor * a.z};
}
frond_vec3 scaled(double factor, const double* a) {
    return {factor * a[0], factor * a[1], factor * a[2]};
}
void add(double* sum, double factor, const frond_vec3& a) {
    sum[0] += factor * a.x, sum[1] += factor * a.y, sum[2] += factor * a.z;
}
void add(frond_vec3& sum, double factor, const frond_vec3& a) {
    sum.x += factor * a.x, sum.y += factor * a.y, sum.z += factor * a.z;
}
double length(const frond_vec3& a) {
    return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

frond_force force_of(frond_plant plant, const frond_contact& contact, double h) {
    frond_force force = {};
    force.plant = plant;
    force.other = contact.other;
    force.body = contact.body;
    force.capsule = contact.capsule;
    force.point = contact.point;
    force.normal = contact.normal;
    force.force = scaled(1 / h, contact.impulse);
    force.moment = cross(force.point, force.force);
    force.gap = contact.gap;
    force.body_id = force.link = -1;
    const auto* object = static_cast<const btCollisionObject*>(contact.body);
    if (!object) return force;
    if (const auto* link = btMultiBodyLinkCollider::upcast(object)) {
        force.body_id = link->m_multiBody->getUserIndex2();
        force.link = link->m_link;
    } else {
        force.body_id = object->getUserIndex2();
    }
    return force;
}

}  // namespace

void ForceLog::updateAction(btCollisionWorld*, btScalar step) {
    const double h = double(step);
    if (has_ended) {
        sums.clear();
        for (auto* wrenches : {&roots, &bonds})
            for (auto& wrench : *wrenches) wrench.second = {};
        time = 0;
        has_ended = false;
    }
    time += h;
    last.clear();
    std::vector<frond_plant> plants(size_t(frond_world_get_plant_count(world)));
    if (frond_world_get_plants(world, plants.data(), int(plants.size())) != FROND_OK) return;
    std::vector<frond_contact> contacts;
    for (const frond_plant plant : plants) {
        contacts.resize(size_t(frond_plant_get_contact_count(plant)));
        if (contacts.empty() || frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())) != FROND_OK)
            continue;
        for (const frond_contact& contact : contacts) {
            last.push_back(force_of(plant, contact, h));
            const frond_force& force = last.back();
            Sum& sum = sums[{plant.id, contact.other.id, contact.body, contact.capsule}];
            // Contacts that do not push count a little, so that their points have a mean too.
            constexpr double LITTLE = 1e-12;
            const double weight = h * length(force.force) + LITTLE;
            sum.gap = sum.weight > 0 ? std::min(sum.gap, contact.gap) : contact.gap;
            sum.weight += weight;
            add(sum.impulse, h, force.force);
            add(sum.moment, h, force.moment);
            add(sum.point, weight, force.point);
            add(sum.normal, weight, force.normal);
            sum.last = force;
        }
    }
    for (auto& [plant, root] : roots) {
        frond_vec3 force, moment;
        if (frond_plant_get_root_force({plant}, {0, 0, 0}, &force, &moment) != FROND_OK) continue;
        add(root.force, h, force);
        add(root.moment, h, moment);
        root.time += h;
    }
    for (auto& [bond, held] : bonds) {
        frond_vec3 force;
        if (frond_bond_get({bond}, nullptr, &force) != FROND_OK) continue;
        add(held.force, h, force);
        held.time += h;
    }
}

std::vector<frond_force> ForceLog::mean() const {
    std::vector<frond_force> forces;
    for (const auto& entry : sums) {
        const Sum& sum = entry.second;
        frond_force force = sum.last;
        force.point = scaled(1 / sum.weight, sum.point);
        force.normal = scaled(1 / sum.weight, sum.normal);
        const double size = length(force.normal);
        if (size > 0) force.normal = scaled(1 / size, force.normal);
        force.force = scaled(1 / time, sum.impulse);
        force.moment = scaled(1 / time, sum.moment);
        force.gap = sum.gap;
        forces.push_back(force);
    }
    return forces;
}

}  // namespace frond_host
