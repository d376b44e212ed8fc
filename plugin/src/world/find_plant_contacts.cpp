// In: where plants are, and which of them Bullet's broad phase saw together. Out: contacts of their cages and sheaths.
#include <algorithm>
#include <map>
#include <tuple>

#include "core/timer.hpp"
#include "model/union_find.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// The cage of a plant that broke still has the nodes of what came off: it takes no part any more.
bool has(const World& world, const PlantBody& body, frond_effects effect) {
    return world.effects & body.plant->effects & effect && !body.capsules().empty() && body.plant->fragments.empty();
}

// Plants whose boxes meet, and lone ones that touch themselves.
std::vector<std::vector<PlantBody*>> find_islands(World& world) {
    btBroadphasePairArray& pairs = world.bullet->getPairCache()->getOverlappingPairArray();
    std::vector<std::array<int, 2>> meet;
    for (int i = 0; i < pairs.size(); i++) {
        PlantBody* first = PlantBody::of(static_cast<btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject));
        if (!first || first->world != &world || !has(world, *first, FROND_PLANT_CONTACT)) continue;
        PlantBody* second = PlantBody::of(static_cast<btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject));
        if (!second || second->world != &world || !has(world, *second, FROND_PLANT_CONTACT)) continue;
        if (first->rest.asleep && second->rest.asleep) continue;
        meet.push_back({number_of(world, *first), number_of(world, *second)});
    }
    UnionFind sets(world.taking_part.size());
    std::vector<uint8_t> takes_part(world.taking_part.size(), 0);
    for (size_t i = 0; i < takes_part.size(); i++) {
        const PlantBody& body = *world.taking_part[i];
        takes_part[i] = !body.rest.asleep && has(world, body, FROND_SELF_CONTACT);
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

// Where cage or sheath are, and would be at the end of the step.
void place_nodes(const PlantBody& body, double h, VecX& now, VecX& then) {
    const Plant& plant = *body.plant;
    if (plant.follow) {
        follow_places(body.sheath->follow, plant.motion.x, now);
        follow_places(body.sheath->follow, plant.motion.x + h * plant.motion.v, then);
        return;
    }
    now = cage_places(plant);
    then = now + h * cage_velocities(plant);
}

// Where a plant will be at the end of the step if nothing touches it, so that what is about to meet is found before it is
// in each other; no farther than straight ways can tell.
void place_shape(const PlantBody& body, double h, PlantSearch::Shape& shape) {
    constexpr double FARTHEST = 0.03;  // [m]
    const Plant& plant = *body.plant;
    shape.axes.clear();
    for (const auto& [begin, end] : plant.model->capsules)
        shape.axes.push_back({plant.to_world(plant.chain_positions[size_t(begin)]),
                              plant.to_world(plant.chain_positions[size_t(end)])});
    VecX now, then;
    place_nodes(body, h, now, then);
    const Mat3 turn = plant.rotation.toRotationMatrix();
    const Collider& collider = body.touched_collider();
    shape.places.resize(size_t(collider.node_count));
    shape.ways.resize(shape.places.size());
    for (size_t n = 0; n < shape.places.size(); n++) {
        shape.ways[n] = turn * (point(then, int(n)) - point(now, int(n)));
        const double way = shape.ways[n].norm();
        if (way > FARTHEST) shape.ways[n] *= FARTHEST / way;
        shape.places[n] = turn * point(now, int(n)) + plant.position + shape.ways[n];
    }
    shape.covers = cover_pieces(collider, shape.places.data(), shape.axes);
}

double friction_of(const PlantBody& body, int organ) {
    return organ >= 0 ? body.plant->model->organs[size_t(organ)].material.friction : 0;
}

// Takes hold of the points on both sides as they are now.
void take_grips(PlantContact& contact) {
    std::array<Vec3, 2> places;
    for (size_t k = 0; k < 2; k++) {
        const Plant& plant = *contact.plants[k]->plant;
        const ContactSide& side = contact.sides[k];
        contact.grips[k] = plant.follow ? sheath_grip(*contact.plants[k]->sheath, side) : cage_grip(side);
        places[k] = plant.to_world(grip_place(contact.grips[k], plant.motion.x));
    }
    contact.between = places[0] - places[1];
}

// How a point goes on in the step.
Vec3 way_of(const PlantSearch::Shape& shape, const ContactSide& side) {
    Vec3 way = Vec3::Zero();
    for (size_t k = 0; k < size_t(side.node_count); k++) way += side.weights[k] * shape.ways[size_t(side.nodes[k])];
    return way;
}

PlantContact contact_of(const CageContact& found, const PlantSearch& memory, const std::vector<PlantBody*>& island) {
    PlantContact contact;
    contact.sides = {found.a, found.b};
    contact.friction = 1;
    for (size_t k = 0; k < 2; k++) {
        contact.plants[k] = island[size_t(contact.sides[k].body)];
        contact.by_sheath[k] = contact.plants[k]->plant->follow != nullptr;
        contact.friction *= friction_of(*contact.plants[k], contact.sides[k].organ);
    }
    // Back to where they are now.
    const Vec3 first = way_of(memory.shapes[size_t(found.a.body)], found.a);
    const Vec3 second = way_of(memory.shapes[size_t(found.b.body)], found.b);
    contact.point = found.point - first;
    contact.normal = found.normal;
    contact.depth = found.depth + found.normal.dot(first - second);
    take_grips(contact);
    return contact;
}

constexpr double DRIFTED = 0.02;  // farther from where it was, a contact is another one [m]

// The point that touches: its plant, the other one, and its nodes.
std::tuple<int, int, std::array<int, 4>> key_of(const PlantContact& contact) {
    return {contact.plants[0]->number, contact.plants[1]->number, contact.sides[0].nodes};
}

bool may_touch(const World& world, const PlantContact& contact) {
    if (contact.plants[0] == contact.plants[1]) return has(world, *contact.plants[0], FROND_SELF_CONTACT);
    return has(world, *contact.plants[0], FROND_PLANT_CONTACT) && has(world, *contact.plants[1], FROND_PLANT_CONTACT);
}

// A contact of the last substep, by what its points have moved since.
PlantContact as_it_is_now(const PlantContact& before) {
    PlantContact contact = before;
    take_grips(contact);
    contact.depth -= (contact.between - before.between).dot(contact.normal);
    return contact;
}

bool are_one_pair(const PlantContact& a, const PlantContact& b) {
    return a.plants == b.plants || (a.plants[0] == b.plants[1] && a.plants[1] == b.plants[0]);
}

// Nothing gets deeper into each other than it was and has moved since: where a search says so it has taken another way
// out, as where a leaf slides off another one's tip. Then the way of the last substep stands, if there is one.
void doubt_what_is_deeper(const std::vector<PlantContact>& last, std::vector<PlantContact>& contacts) {
    constexpr double NEAR = 0.1, CALM = 0.005, SLACK = 0.002;  // [m]
    std::multimap<std::tuple<int, int, std::array<int, 4>>, const PlantContact*> known;
    for (const PlantContact& before : last)
        if (is_by_the_same(before)) known.emplace(key_of(before), &before);
    for (PlantContact& contact : contacts) {
        if (contact.depth <= SLACK) continue;
        bool is_new = true;
        double deepest = 0;
        for (const PlantContact& before : last) {
            if (!are_one_pair(before, contact)) continue;
            is_new = false;
            if ((before.point - contact.point).norm() < NEAR) deepest = std::max(deepest, before.depth);
        }
        if (is_new || deepest > CALM) continue;
        const auto [first, end] = known.equal_range(key_of(contact));
        const PlantContact* nearest = nullptr;
        for (auto k = first; k != end; ++k)
            if ((k->second->point - contact.point).norm() < DRIFTED &&
                (!nearest || k->second->depth > nearest->depth))
                nearest = k->second;
        if (nearest) {
            const PlantContact now = as_it_is_now(*nearest);
            if (contact.depth <= now.depth + SLACK) continue;
            deepest = std::max(now.depth, 0.0);
            if (now.depth > 0) contact.normal = now.normal;
        }
        contact.depth = std::min(contact.depth, deepest + SLACK);
    }
}

// Contacts of the last substep that were not found again are kept as long as they push and both sides are beside each
// other. Those that were begin with what they had to push.
void keep_contacts(const World& world, const std::vector<PlantContact>& last, std::vector<PlantContact>& contacts) {
    constexpr double APART = 0.01, IN = 0.001;  // [m]
    constexpr int LONG = 12;                    // [substeps]
    std::multimap<std::tuple<int, int, std::array<int, 4>>, size_t> found;
    for (size_t i = 0; i < contacts.size(); i++) found.emplace(key_of(contacts[i]), i);
    // An edge may touch at several places: what is found at another one does not stand for this one.
    const auto find_again = [&](const PlantContact& before) -> PlantContact* {
        PlantContact* nearest = nullptr;
        double least = DRIFTED;
        const auto [first, last] = found.equal_range(key_of(before));
        for (auto k = first; k != last; ++k) {
            PlantContact& contact = contacts[k->second];
            const double away = (contact.point - before.point).norm();
            if (away >= least) continue;
            least = away;
            nearest = &contact;
        }
        return nearest;
    };
    for (const PlantContact& before : last) {
        const bool pushed = before.depth > 0 || !before.impulse.isZero(0);
        if (!pushed || !may_touch(world, before) || !is_by_the_same(before)) continue;
        if (PlantContact* again = find_again(before)) {
            again->impulse += before.impulse;
            continue;
        }
        PlantContact contact = as_it_is_now(before);
        const Vec3 moved = contact.between - before.between;
        // Not in each other any more, whatever the depth was said to be; nor is there anything where it would be in by now.
        if (contact.missed++ == 0) contact.depth = std::min(contact.depth, 0.0);
        if (contact.missed > LONG || contact.depth > IN) continue;
        if (contact.depth < -APART || (moved - moved.dot(contact.normal) * contact.normal).norm() > DRIFTED) continue;
        contacts.push_back(contact);
    }
}

// Where plants stand in each other with all they have, the deepest contacts say enough: each is coupled with all others
// of its plants, so that cost grows with the square of their number.
void keep_deepest(size_t plant_count, std::vector<PlantContact>& contacts) {
    constexpr int MOST = 100;  // a plant
    if (contacts.size() <= MOST) return;
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const PlantContact& a, const PlantContact& b) { return a.depth > b.depth; });
    std::vector<int> count(plant_count, 0);
    const auto is_too_many = [&](const PlantContact& contact) {
        int &first = count[size_t(contact.plants[0]->number)], &second = count[size_t(contact.plants[1]->number)];
        if (first >= MOST || second >= MOST) return true;
        first++;
        second++;
        return false;
    };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_too_many), contacts.end());
}

// Of one island, and the time it took [ms].
struct Found {
    std::vector<PlantContact> contacts;
    double ms_broad = 0, ms_hash = 0, ms_narrow = 0;
};

Found search_island(const World& world, const std::vector<PlantBody*>& island, double h, PlantSearch& memory) {
    Found result;
    Timer timer;
    memory.shapes.resize(std::max(memory.shapes.size(), island.size()));
    std::vector<CoveredBody> covered;
    std::vector<CollisionBody> bodies;
    for (size_t i = 0; i < island.size(); i++) {
        place_shape(*island[i], h, memory.shapes[i]);
        const bool with_itself = has(world, *island[i], FROND_SELF_CONTACT);
        const Collider* collider = &island[i]->touched_collider();
        covered.push_back({collider, &memory.shapes[i].covers, with_itself});
        bodies.push_back({collider, memory.shapes[i].places.data(), {}, with_itself});
    }
    std::vector<std::vector<uint8_t>> pieces = find_meeting_pieces(covered, 0);
    bool meet = false;
    for (size_t i = 0; i < island.size(); i++) {
        meet = meet || !pieces[i].empty();
        bodies[i].pieces = std::move(pieces[i]);
    }
    result.ms_broad = timer.lap();
    if (!meet) return result;
    result.ms_hash = find_cage_contacts(*memory.search, bodies, world.hash, memory.found).ms_hash;
    for (const CageContact& found : memory.found) result.contacts.push_back(contact_of(found, memory, island));
    result.ms_narrow = timer.lap() - result.ms_hash;
    return result;
}

}  // namespace

bool is_by_the_same(const PlantContact& contact) {
    for (size_t k = 0; k < 2; k++)
        if (contact.by_sheath[k] != (contact.plants[k]->plant->follow != nullptr)) return false;
    return true;
}

std::vector<PlantContact> find_plant_contacts(World& world, double h) {
    std::vector<PlantContact> contacts;
    const std::vector<PlantContact> last = std::move(world.plant_contacts);
    world.plant_contacts.clear();
    Timer timer;
    // Those that move are as wide as their cages or sheaths for the broad phase, before they meet any.
    bool any = false;
    for (PlantBody* body : world.awake) {
        const bool together = world.bodies.size() > 1 && has(world, *body, FROND_PLANT_CONTACT);
        if (!together && !has(world, *body, FROND_SELF_CONTACT)) continue;
        take_collider(*body);
        any = true;
    }
    if (!any) return contacts;
    const std::vector<std::vector<PlantBody*>> islands = find_islands(world);
    while (world.plant_searches.size() < islands.size()) world.plant_searches.push_back(std::make_unique<PlantSearch>());
    world.report.ms_broad += timer.lap();
    std::vector<Found> found(islands.size());
    run_jobs(world, islands.size(),
             [&](size_t i) { found[i] = search_island(world, islands[i], h, *world.plant_searches[i]); });
    for (const Found& of : found) {
        contacts.insert(contacts.end(), of.contacts.begin(), of.contacts.end());
        world.report.ms_broad += of.ms_broad;
        world.report.ms_hash += of.ms_hash;
        world.report.ms_narrow += of.ms_narrow;
    }
    doubt_what_is_deeper(last, contacts);
    keep_contacts(world, last, contacts);
    keep_deepest(world.taking_part.size(), contacts);
    return contacts;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
