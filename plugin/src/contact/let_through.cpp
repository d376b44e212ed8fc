// In: plants that let bodies through, and Bullet's overlapping pairs. Out: which of those they still ignore.
#include "contact/let_through.hpp"

#include <algorithm>
#include <cmath>

#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

GrownIn::key_type key_of(const btCollisionObject& object) {
    const btBroadphaseProxy* proxy = object.getBroadphaseHandle();
    return {WHOLE_PLANT, &object, proxy ? proxy->m_uniqueId : 0};
}

bool lets_any_through(const PlantBody& body) {
    // Entries are ordered by capsule.
    return body.grown_in && !body.grown_in->empty() && std::get<0>(body.grown_in->begin()->first) == WHOLE_PLANT;
}

}  // namespace

void let_through(PlantBody& body, const btCollisionObject& object) {
    if (!body.grown_in) body.grown_in = std::make_unique<GrownIn>();
    (*body.grown_in)[key_of(object)] = INFINITY;
}

bool lets_through(const PlantBody& body, const btCollisionObject& object) {
    return lets_any_through(body) && body.grown_in->count(key_of(object)) > 0;
}

void touch_again(World& world) {
    std::vector<PlantBody*> bodies;
    for (PlantBody* body : world.awake)
        if (lets_any_through(*body)) bodies.push_back(body);
    if (bodies.empty()) return;
    std::vector<GrownIn> near(bodies.size());
    const btBroadphasePairArray& pairs = world.bullet->getPairCache()->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); i++) {
        auto* first = static_cast<btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject);
        auto* second = static_cast<btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject);
        for (const auto& [plant, object] : {std::make_pair(first, second), std::make_pair(second, first)}) {
            const auto at = std::find(bodies.begin(), bodies.end(), PlantBody::of(plant));
            if (at != bodies.end() && lets_through(**at, *object))
                near[size_t(at - bodies.begin())][key_of(*object)] = INFINITY;
        }
    }
    for (size_t i = 0; i < bodies.size(); i++) {
        GrownIn& all = *bodies[i]->grown_in;
        all.erase(all.begin(), all.lower_bound({WHOLE_PLANT + 1, nullptr, 0}));
        if (!near[i].empty()) note_trouble(world, *bodies[i], FROND_TROUBLE_PASSED);
        all.merge(near[i]);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
