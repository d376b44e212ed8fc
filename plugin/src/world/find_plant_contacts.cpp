// In: where plants are, and which of them Bullet's broad phase saw together. Out: contacts of their cages.
#include <algorithm>

#include "core/timer.hpp"
#include "model/union_find.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

bool has(const World& world, const PlantBody& body, frond_effects effect) {
    return world.effects & body.plant->effects & effect && !body.capsules.empty();
}

// Plants whose boxes meet, and lone ones that touch themselves.
std::vector<std::vector<PlantBody*>> find_islands(World& world) {
    UnionFind sets(world.bodies.size());
    btBroadphasePairArray& pairs = world.bullet->getPairCache()->getOverlappingPairArray();
    std::vector<uint8_t> takes_part(world.bodies.size(), 0);
    for (const auto& body : world.bodies) takes_part[size_t(body->number)] = has(world, *body, FROND_SELF_CONTACT);
    for (int i = 0; i < pairs.size(); i++) {
        const PlantBody* first = PlantBody::of(static_cast<btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject));
        if (!first || first->world != &world || !has(world, *first, FROND_PLANT_CONTACT)) continue;
        const PlantBody* second = PlantBody::of(static_cast<btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject));
        if (!second || second->world != &world || !has(world, *second, FROND_PLANT_CONTACT)) continue;
        sets.join(first->number, second->number);
        takes_part[size_t(first->number)] = takes_part[size_t(second->number)] = 1;
    }
    std::vector<std::vector<PlantBody*>> all(world.bodies.size()), islands;
    for (const auto& body : world.bodies)
        if (takes_part[size_t(body->number)]) all[size_t(sets.find(body->number))].push_back(body.get());
    for (std::vector<PlantBody*>& island : all)
        if (!island.empty()) islands.push_back(std::move(island));
    return islands;
}

void place_shape(const PlantBody& body, PlantSearch::Shape& shape) {
    const Plant& plant = *body.plant;
    const VecX& x = cage_places(plant);
    const Mat3 turn = plant.rotation.toRotationMatrix();
    shape.places.resize(size_t(body.collider->node_count));
    for (size_t n = 0; n < shape.places.size(); n++) shape.places[n] = turn * point(x, int(n)) + plant.position;
    shape.axes.clear();
    for (const auto& [begin, end] : plant.model->capsules)
        shape.axes.push_back({plant.to_world(plant.chain_positions[size_t(begin)]),
                              plant.to_world(plant.chain_positions[size_t(end)])});
    shape.covers = cover_pieces(*body.collider, shape.places.data(), shape.axes);
}

double friction_of(const PlantBody& body, int organ) {
    return organ >= 0 ? body.plant->model->organs[size_t(organ)].material.friction : 0;
}

PlantContact contact_of(const CageContact& found, const std::vector<PlantBody*>& island) {
    PlantContact contact;
    contact.friction = 1;
    const std::array<const ContactSide*, 2> sides = {&found.a, &found.b};
    for (size_t k = 0; k < 2; k++) {
        PlantBody* body = contact.plants[k] = island[size_t(sides[k]->body)];
        contact.capsules[k] = sides[k]->piece;
        contact.grips[k] = cage_grip(*body->plant, *sides[k]);
        contact.friction *= friction_of(*body, sides[k]->organ);
    }
    contact.point = found.point;
    contact.normal = found.normal;
    contact.depth = found.depth;
    return contact;
}

}  // namespace

std::vector<PlantContact> find_plant_contacts(World& world) {
    std::vector<PlantContact> contacts;
    Timer timer;
    const auto count = [&](frond_effects effect) {
        return std::count_if(world.bodies.begin(), world.bodies.end(),
                             [&](const auto& body) { return has(world, *body, effect); });
    };
    const bool together = count(FROND_PLANT_CONTACT) > 1;
    if (!together && count(FROND_SELF_CONTACT) == 0) return contacts;
    for (const auto& body : world.bodies)
        if (has(world, *body, FROND_SELF_CONTACT) || (together && has(world, *body, FROND_PLANT_CONTACT)))
            take_collider(*body);
    const std::vector<std::vector<PlantBody*>> islands = find_islands(world);
    if (!islands.empty() && !world.plant_search) world.plant_search = std::make_unique<PlantSearch>();
    world.report.ms_broad += timer.lap();
    for (const std::vector<PlantBody*>& island : islands) {
        PlantSearch& memory = *world.plant_search;
        memory.shapes.resize(std::max(memory.shapes.size(), island.size()));
        std::vector<CoveredBody> covered;
        for (size_t i = 0; i < island.size(); i++) {
            place_shape(*island[i], memory.shapes[i]);
            covered.push_back({island[i]->collider.get(), &memory.shapes[i].covers,
                               has(world, *island[i], FROND_SELF_CONTACT)});
        }
        std::vector<std::vector<uint8_t>> pieces = find_meeting_pieces(covered, 0);
        std::vector<CollisionBody> bodies;
        bool meet = false;
        for (size_t i = 0; i < island.size(); i++) {
            meet = meet || !pieces[i].empty();
            bodies.push_back({covered[i].collider, memory.shapes[i].places.data(), std::move(pieces[i]),
                              covered[i].with_itself});
        }
        world.report.ms_broad += timer.lap();
        if (!meet) continue;
        const SearchTimes times = find_cage_contacts(*memory.search, bodies, world.hash, memory.found);
        for (const CageContact& found : memory.found) contacts.push_back(contact_of(found, island));
        world.report.ms_hash += times.ms_hash;
        world.report.ms_narrow += timer.lap() - times.ms_hash;
    }
    return contacts;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
