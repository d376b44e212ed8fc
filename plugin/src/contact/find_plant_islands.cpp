// In: plants in their places, and the pairs of Bullet's broad phase. Out: groups of plants that may touch in the step.
#include <algorithm>

#include "contact/find_plant_contacts.hpp"
#include "core/union_find.hpp"
#include "plant/pins.hpp"
#include "world/convert.hpp"
#include "world/show.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

bool touches_others(const World& world, const PlantBody& body, frond_effects effect) {
    return world.effects & body.plant->input.effects & effect && !body.capsules().empty();
}

namespace {

// Returns how far a plant may go in the step at its speed, or carried by its pins [m].
double reach_of(const Plant& plant, double h) {
    double fastest = 0;
    for (int i = 0; i < plant.state.motion.v.size() / 3; i += plant.follow ? 2 : 1)
        fastest = std::max(fastest, point(plant.state.motion.v, i).squaredNorm());
    return std::max(h * std::sqrt(fastest), way_of_pins(plant));
}

// Adds the plants that fast ones may come to, beyond the boxes that Bullet knows.
void add_far_meetings(World& world, double h, std::vector<std::array<int, 2>>& meet) {
    constexpr double FAR = 0.02;  // [m]
    const std::vector<PlantBody*> awake = world.awake;
    for (PlantBody* body : awake) {
        if (body->plant->state.modal || !body->getBroadphaseHandle() ||
            !touches_others(world, *body, FROND_EFFECT_PLANT_CONTACT))
            continue;
        const double reach = reach_of(*body->plant, h);
        if (!(reach > FAR)) continue;
        const btVector3 around = to_bullet(Vec3::Constant(reach));
        const btBroadphaseProxy& box = *body->getBroadphaseHandle();
        for (PlantBody* other : plants_in(world, box.m_aabbMin - around, box.m_aabbMax + around)) {
            const btBroadphaseProxy& of_other = *other->getBroadphaseHandle();
            if (other == body || !touches_others(world, *other, FROND_EFFECT_PLANT_CONTACT)) continue;
            const int group = other->is_hidden ? other->filter_group : of_other.m_collisionFilterGroup,
                      mask = other->is_hidden ? other->filter_mask : of_other.m_collisionFilterMask;
            if (!(box.m_collisionFilterGroup & mask) || !(group & box.m_collisionFilterMask)) continue;
            meet.push_back({number_of(world, *body), number_of(world, *other)});
        }
    }
}

}  // namespace

std::vector<std::vector<PlantBody*>> find_plant_islands(World& world, double h) {
    btBroadphasePairArray& pairs = world.bullet->getPairCache()->getOverlappingPairArray();
    std::vector<std::array<int, 2>> meet;
    for (int i = 0; i < pairs.size(); i++) {
        PlantBody* first = PlantBody::of(static_cast<btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject));
        if (!first || first->world != &world || !touches_others(world, *first, FROND_EFFECT_PLANT_CONTACT)) continue;
        PlantBody* second = PlantBody::of(static_cast<btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject));
        if (!second || second->world != &world || !touches_others(world, *second, FROND_EFFECT_PLANT_CONTACT)) continue;
        if (first->rest.asleep && second->rest.asleep) continue;
        meet.push_back({number_of(world, *first), number_of(world, *second)});
    }
    add_far_meetings(world, h, meet);
    UnionFind sets(world.taking_part.size());
    std::vector<uint8_t> takes_part(world.taking_part.size(), 0);
    for (size_t i = 0; i < takes_part.size(); i++) {
        const PlantBody& body = *world.taking_part[i];
        takes_part[i] = !body.rest.asleep && touches_others(world, body, FROND_EFFECT_SELF_CONTACT);
    }
    for (const auto& [first, second] : meet) {
        sets.join(first, second);
        takes_part[size_t(first)] = takes_part[size_t(second)] = 1;
    }
    std::vector<std::vector<PlantBody*>> all(takes_part.size()), islands;
    for (size_t i = 0; i < takes_part.size(); i++)
        if (takes_part[i]) all[size_t(sets.find(int(i)))].push_back(world.taking_part[i]);
    for (std::vector<PlantBody*>& island : all)
        if (!island.empty()) islands.push_back(std::move(island));
    for (const std::vector<PlantBody*>& island : islands)
        for (PlantBody* body : island) take_collider(look_at(*body));
    return islands;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
