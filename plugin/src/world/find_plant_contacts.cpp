// In: where plants are, and which of them Bullet's broad phase saw together. Out: contacts of their cages.
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
    return world.effects & body.plant->effects & effect && !body.capsules.empty() && body.plant->fragments.empty();
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

constexpr double NEAR = 0.01;  // capsules that are about to touch [m]

Eigen::AlignedBox3d box_of(const Capsule& capsule) {
    const Vec3 reach = Vec3::Constant(capsule.radius + 0.5 * NEAR);
    return {capsule.begin.cwiseMin(capsule.end) - reach, capsule.begin.cwiseMax(capsule.end) + reach};
}

// Where the cage will be at the end of the step if nothing touches it, so that what is about to meet is found before it is
// in each other; no farther than straight ways can tell.
void place_cage(const PlantBody& body, double h, PlantSearch::Shape& shape) {
    constexpr double FARTHEST = 0.03;  // [m]
    const Plant& plant = *body.plant;
    const VecX& x = cage_places(plant);
    const VecX v = cage_velocities(plant);
    const Mat3 turn = plant.rotation.toRotationMatrix();
    shape.places.resize(size_t(body.collider->node_count));
    shape.ways.resize(shape.places.size());
    for (size_t n = 0; n < shape.places.size(); n++) {
        shape.ways[n] = h * (turn * point(v, int(n)));
        const double way = shape.ways[n].norm();
        if (way > FARTHEST) shape.ways[n] *= FARTHEST / way;
        shape.places[n] = turn * point(x, int(n)) + plant.position + shape.ways[n];
    }
    shape.covers = cover_pieces(*body.collider, shape.places.data(), shape.axes);
}

// Axes and capsules of all plants, as others may meet them by those; cages of those that meet by them.
void place_shape(const PlantBody& body, double h, PlantSearch::Shape& shape) {
    const Plant& plant = *body.plant;
    shape.axes.clear();
    shape.capsules.clear();
    shape.box.setEmpty();
    for (size_t i = 0; i < plant.model->capsules.size(); i++) {
        const auto& [begin, end] = plant.model->capsules[i];
        shape.axes.push_back({plant.to_world(plant.chain_positions[size_t(begin)]),
                              plant.to_world(plant.chain_positions[size_t(end)])});
        shape.capsules.push_back({shape.axes[i][0], shape.axes[i][1], double(body.capsules[i]->getRadius())});
        shape.box.extend(box_of(shape.capsules[i]));
    }
    if (!plant.follow) place_cage(body, h, shape);
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
        contact.grips[k] =
            side.node_count > 0 ? cage_grip(plant, side) : capsule_grip(plant, side.piece, side.weights[0]);
        places[k] = plant.to_world(grip_place(contact.grips[k], plant.motion.x));
    }
    contact.between = places[0] - places[1];
}

// How a point of the cage goes on in the step.
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

// How far along a capsule's axis a point on it is.
double along_of(const Capsule& capsule, const Vec3& p) {
    const Vec3 axis = capsule.end - capsule.begin;
    const double square = axis.squaredNorm();
    return square > 0 ? std::clamp(axis.dot(p - capsule.begin) / square, 0.0, 1.0) : 0;
}

std::vector<size_t> capsules_in(const std::vector<Capsule>& capsules, const Eigen::AlignedBox3d& box) {
    std::vector<size_t> found;
    for (size_t i = 0; i < capsules.size(); i++)
        if (box.intersects(box_of(capsules[i]))) found.push_back(i);
    return found;
}

// Capsules of two bodies, or of one, that touch or are about to.
void add_capsule_contacts(const PlantSearch& memory, const std::vector<PlantBody*>& island, size_t a, size_t b,
                          std::vector<PlantContact>& contacts) {
    const std::vector<Capsule> &first = memory.shapes[a].capsules, &second = memory.shapes[b].capsules;
    const std::vector<size_t> near_a = capsules_in(first, memory.shapes[b].box);
    const std::vector<size_t> near_b = capsules_in(second, memory.shapes[a].box);
    for (const size_t i : near_a)
        for (const size_t j : near_b) {
            if (a == b && j <= i) continue;
            if (a == b && island[a]->collider->are_near(int(i), int(j))) continue;
            // Quick: balls around both.
            const Vec3 apart = first[i].begin + first[i].end - second[j].begin - second[j].end;
            const double reach = (first[i].end - first[i].begin).norm() + (second[j].end - second[j].begin).norm() +
                                 2 * (first[i].radius + second[j].radius + NEAR);
            if (apart.squaredNorm() > reach * reach) continue;
            const Gap gap = gap_between(first[i], second[j]);
            if (gap.distance > NEAR) continue;
            PlantContact contact;
            contact.plants = {island[a], island[b]};
            contact.friction = 1;
            const std::array<size_t, 2> capsules = {i, j};
            const std::array<const Capsule*, 2> shapes = {&first[i], &second[j]};
            const std::array<Vec3, 2> on_axis = {gap.on_a, gap.on_b};
            for (size_t k = 0; k < 2; k++) {
                const Model& model = *contact.plants[k]->plant->model;
                const int organ = model.chain.nodes[size_t(model.capsules[capsules[k]][1])].organ;
                contact.sides[k] = {int(k == 0 ? a : b), organ, int(capsules[k]), 0, {}, {along_of(*shapes[k], on_axis[k])}};
                contact.friction *= friction_of(*contact.plants[k], organ);
            }
            contact.point = gap.on_a - first[i].radius * gap.normal;
            contact.normal = gap.normal;
            contact.depth = -gap.distance;
            take_grips(contact);
            contacts.push_back(contact);
        }
}

// All pairs of an island of which one moves by its chain.
void add_chain_contacts(const World& world, const PlantSearch& memory, const std::vector<PlantBody*>& island,
                        std::vector<PlantContact>& contacts) {
    for (size_t a = 0; a < island.size(); a++)
        for (size_t b = a; b < island.size(); b++) {
            if (!island[a]->plant->follow && !island[b]->plant->follow) continue;
            if (island[a]->rest.asleep && island[b]->rest.asleep) continue;
            if (!memory.shapes[a].box.intersects(memory.shapes[b].box)) continue;
            if (a != b || has(world, *island[a], FROND_SELF_CONTACT))
                add_capsule_contacts(memory, island, a, b, contacts);
        }
}

// The point that touches: its plant, the other one, and its nodes.
std::tuple<int, int, std::array<int, 4>> key_of(const PlantContact& contact) {
    return {contact.plants[0]->number, contact.plants[1]->number, contact.sides[0].nodes};
}

bool may_touch(const World& world, const PlantContact& contact) {
    if (contact.plants[0] == contact.plants[1]) return has(world, *contact.plants[0], FROND_SELF_CONTACT);
    return has(world, *contact.plants[0], FROND_PLANT_CONTACT) && has(world, *contact.plants[1], FROND_PLANT_CONTACT);
}

// Contacts of the last substep that were not found again are kept as long as they push and both sides are beside each
// other. Those that were begin with what they had to push.
void keep_contacts(const World& world, const std::vector<PlantContact>& last, std::vector<PlantContact>& contacts) {
    constexpr double APART = 0.01, DRIFTED = 0.02;  // [m]
    std::multimap<std::tuple<int, int, std::array<int, 4>>, size_t> found;
    for (size_t i = 0; i < contacts.size(); i++) found.emplace(key_of(contacts[i]), i);
    // An edge may touch at several places.
    const auto find_again = [&](const PlantContact& before) -> PlantContact* {
        PlantContact* nearest = nullptr;
        const auto [first, last] = found.equal_range(key_of(before));
        for (auto k = first; k != last; ++k) {
            PlantContact& contact = contacts[k->second];
            if (!nearest || (contact.point - before.point).norm() < (nearest->point - before.point).norm())
                nearest = &contact;
        }
        return nearest;
    };
    for (const PlantContact& before : last) {
        const bool pushed = before.depth > 0 || !before.impulse.isZero(0);
        if (!pushed || before.sides[0].node_count == 0 || !may_touch(world, before)) continue;
        if (PlantContact* again = find_again(before)) {
            again->impulse = before.impulse;
            continue;
        }
        PlantContact contact = before;
        take_grips(contact);
        const Vec3 moved = contact.between - before.between;
        const double away = moved.dot(contact.normal);
        // Not in each other any more, whatever the depth was said to be.
        contact.depth = std::min(contact.depth - away, 0.0);
        if (contact.depth < -APART || (moved - away * contact.normal).norm() > DRIFTED) continue;
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

}  // namespace

std::vector<PlantContact> find_plant_contacts(World& world, double h) {
    std::vector<PlantContact> contacts;
    const std::vector<PlantContact> last = std::move(world.plant_contacts);
    world.plant_contacts.clear();
    Timer timer;
    // Those that move are as wide as their cages for the broad phase, before they meet any.
    bool any = false;
    for (PlantBody* body : world.awake) {
        const bool together = world.bodies.size() > 1 && has(world, *body, FROND_PLANT_CONTACT);
        if (!together && !has(world, *body, FROND_SELF_CONTACT)) continue;
        take_collider(*body);
        any = true;
    }
    if (!any) return contacts;
    std::vector<std::vector<PlantBody*>> islands = find_islands(world);
    if (!islands.empty() && !world.plant_search) world.plant_search = std::make_unique<PlantSearch>();
    world.report.ms_broad += timer.lap();
    for (std::vector<PlantBody*>& island : islands) {
        PlantSearch& memory = *world.plant_search;
        memory.shapes.resize(std::max(memory.shapes.size(), island.size()));
        // Those whose cages move by themselves first: they meet by those, others by their capsules.
        const auto end = std::stable_partition(island.begin(), island.end(),
                                               [](const PlantBody* body) { return !body->plant->follow; });
        const size_t caged = size_t(end - island.begin());
        for (size_t i = 0; i < island.size(); i++) place_shape(*island[i], h, memory.shapes[i]);
        add_chain_contacts(world, memory, island, contacts);
        std::vector<CoveredBody> covered;
        std::vector<CollisionBody> bodies;
        for (size_t i = 0; i < caged; i++) {
            const bool with_itself = has(world, *island[i], FROND_SELF_CONTACT);
            covered.push_back({island[i]->collider.get(), &memory.shapes[i].covers, with_itself});
            bodies.push_back({island[i]->collider.get(), memory.shapes[i].places.data(), {}, with_itself});
        }
        std::vector<std::vector<uint8_t>> pieces = find_meeting_pieces(covered, 0);
        bool meet = false;
        for (size_t i = 0; i < caged; i++) {
            meet = meet || !pieces[i].empty();
            bodies[i].pieces = std::move(pieces[i]);
        }
        world.report.ms_broad += timer.lap();
        if (!meet) continue;
        const SearchTimes times = find_cage_contacts(*memory.search, bodies, world.hash, memory.found);
        for (const CageContact& found : memory.found) contacts.push_back(contact_of(found, memory, island));
        world.report.ms_hash += times.ms_hash;
        world.report.ms_narrow += timer.lap() - times.ms_hash;
    }
    keep_contacts(world, last, contacts);
    keep_deepest(world.taking_part.size(), contacts);
    return contacts;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
