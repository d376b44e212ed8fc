// In: plants in their places, and the pairs of Bullet's broad phase. Out: contacts of their cages and sheaths.
#include "contact/find_plant_contacts.hpp"

#include <algorithm>
#include <iterator>

#include "contact/agree_on_sides.hpp"
#include "contact/remember_contacts.hpp"
#include "contact/strip_search.hpp"
#include "core/timer.hpp"
#include "world/fragments.hpp"
#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Computes the places of the cage's or sheath's nodes, now and as they would be at the end of the step [m].
void place_nodes(const PlantBody& body, double h, VecX& now, VecX& then) {
    const Plant& plant = *body.plant;
    if (plant.follow) {
        follow_places(body.sheath->follow, plant.state.motion.x, now);
        follow_places(body.sheath->follow, plant.state.motion.x + h * plant.state.motion.v, then);
        return;
    }
    const VecX &cage = cage_places(plant), cage_then = cage + h * cage_velocities(plant);
    if (!touches_by_sheath(plant)) {
        now = cage;
        then = cage_then;
        return;
    }
    const std::vector<Attachment>& attachments = body.in_cage->attachments;
    now.resize(3 * Eigen::Index(attachments.size()));
    then.resize(now.size());
    for (size_t n = 0; n < attachments.size(); n++) {
        point(now, int(n)) = attachment_place(attachments[n], cage);
        point(then, int(n)) = attachment_place(attachments[n], cage_then);
    }
}

// Places a plant's shape where it will be at the end of the step if nothing touches it, so that contacts are found
// before they overlap; displacements are limited to what a straight path can predict. Plants at exactly the same place
// have no side on which to separate, and rounding would part each leaf in another direction: so each plant is displaced
// by a hair from the one before (Edelsbrunner and Mücke 1990, Simulation of simplicity).
void place_shape(const PlantBody& body, size_t number, double h, PlantSearch::Shape& shape) {
    constexpr double FARTHEST = 0.03, HAIR = 1e-8;  // [m]
    const Vec3 hair = HAIR * double(number) * Vec3(0.8, 0.1, 0.6);
    const Plant& plant = *body.plant;
    shape.axes.clear();
    for (const auto& [begin, end] : plant.model->capsules)
        shape.axes.push_back({plant.to_world(plant.view.chain_positions[size_t(begin)]),
                              plant.to_world(plant.view.chain_positions[size_t(end)])});
    VecX now, then;
    place_nodes(body, h, now, then);
    const Mat3 turn = plant.rotation.toRotationMatrix();
    const Collider& collider = body.touched().collider;
    shape.places.resize(size_t(collider.node_count));
    shape.ways.resize(shape.places.size());
    for (size_t n = 0; n < shape.places.size(); n++) {
        shape.ways[n] = turn * (point(then, int(n)) - point(now, int(n)));
        const double way = shape.ways[n].norm();
        if (way > FARTHEST) shape.ways[n] *= FARTHEST / way;
        shape.ways[n] += hair;
        shape.places[n] = turn * point(now, int(n)) + plant.position + shape.ways[n];
    }
    shape.covers = cover_pieces(collider, shape.places.data(), shape.axes);
    for (size_t i = 0; i < shape.covers.size(); i++)
        if (has_come_off(plant, int(i))) shape.covers[i].radius = NOTHING;
}

double friction_of(const PlantBody& body, int organ) {
    return organ >= 0 ? body.plant->model->organs[size_t(organ)].material.friction : 0;
}

// Returns the displacement of a point in the step [m].
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
        contact.by_sheath[k] = touches_by_sheath(*contact.plants[k]->plant);
        contact.on_chain[k] = contact.plants[k]->plant->follow != nullptr;
        contact.friction *= friction_of(*contact.plants[k], contact.sides[k].organ);
    }
    // Back from the predicted to the present places.
    const Vec3 first = way_of(memory.shapes[size_t(found.a.body)], found.a);
    const Vec3 second = way_of(memory.shapes[size_t(found.b.body)], found.b);
    contact.point = found.point - first;
    contact.normal = found.normal;
    contact.depth = found.depth + found.normal.dot(first - second);
    take_attachments(contact);
    return contact;
}

// Keeps each plant's deepest contacts of an island: they suffice where plants overlap completely, and each contact is
// coupled with all others of its plants, so that cost grows with the square of their number.
void keep_deepest(World& world, std::vector<PlantContact>& contacts) {
    constexpr int MOST = 100;  // contacts per plant
    if (contacts.size() <= MOST) return;
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const PlantContact& a, const PlantContact& b) { return a.depth > b.depth; });
    std::vector<int> count(world.taking_part.size(), 0);
    const auto is_too_many = [&](const PlantContact& contact) {
        bool is_one = false;
        for (PlantBody* body : contact.plants) {
            if (count[size_t(body->number)] < MOST) continue;
            note_trouble(world, *body, FROND_TROUBLE_CROWDED);
            is_one = true;
        }
        if (!is_one)
            for (const PlantBody* body : contact.plants) count[size_t(body->number)]++;
        return is_one;
    };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_too_many), contacts.end());
}

// Contacts of one island, and the time of the search [ms].
struct Found {
    std::vector<PlantContact> contacts;
    double ms_broad = 0, ms_hash = 0, ms_narrow = 0;
};

// Returns the same bodies in their present places, not the predicted ones.
PlacedIsland placed_now(const World& world, const std::vector<PlantBody*>& island,
                        const std::vector<CollisionBody>& bodies, PlantSearch& memory) {
    PlacedIsland placed = {world, island, bodies};
    for (size_t i = 0; i < island.size(); i++) {
        PlantSearch::Shape& shape = memory.shapes[i];
        for (size_t n = 0; n < shape.places.size(); n++) shape.places[n] -= shape.ways[n];
        placed.bodies[i].places = shape.places.data();
    }
    return placed;
}

// Places the corners of an island's strips, now and as they would be at the end of the step. Those of cages have none.
std::vector<StripPath> strip_paths(const World& world, const std::vector<PlantBody*>& island, double h,
                                   PlantSearch& memory) {
    memory.corners.resize(std::max(memory.corners.size(), island.size()));
    memory.placed.resize(memory.corners.size());
    std::vector<StripPath> paths;
    VecX then;
    for (size_t i = 0; i < island.size(); i++) {
        auto& [before, after] = memory.corners[i];
        const Motion& motion = island[i]->plant->state.motion;
        place_corners(*island[i], motion.x, before);
        memory.placed[i] = motion.x;
        then = motion.x + h * motion.v;
        place_corners(*island[i], then, after);
        paths.push_back(
            {island[i], before.data(), after.data(), touches_others(world, *island[i], FROND_EFFECT_SELF_CONTACT)});
    }
    return paths;
}

// Returns whether the search for overlapping tets says how the organs of a contact part.
bool is_of_tets(const CageContact& found, const std::vector<PlantBody*>& island,
                const std::vector<OrganPair>& crossed) {
    for (const ContactSide* side : {&found.a, &found.b})
        if (!touches_by_sheath(*island[size_t(side->body)]->plant)) return true;
    OrganPair organs = {found.a.body, found.a.organ, found.b.body, found.b.organ};
    if (found.b.body < found.a.body || (found.a.body == found.b.body && found.b.organ < found.a.organ))
        organs = {found.b.body, found.b.organ, found.a.body, found.a.organ};
    const auto has_pair = [&](const OrganPair& pair) {
        return std::binary_search(crossed.begin(), crossed.end(), pair);
    };
    return has_pair(organs) || (organs[0] == organs[2] && has_pair({organs[2], organs[3], organs[0], organs[1]}));
}

// Leaves out the regions of sheaths whose organs have crossed nothing, where all touch by sheaths.
void leave_out_parted(const std::vector<PlantBody*>& island, const std::vector<OrganPair>& crossed,
                      std::vector<CollisionBody>& bodies) {
    for (size_t i = 0; i < island.size(); i++)
        if (!touches_by_sheath(*island[i]->plant)) return;
    for (size_t i = 0; i < island.size(); i++) {
        const Model& model = *island[i]->plant->model;
        std::vector<uint8_t>& pieces = bodies[i].pieces;
        bool any = false;
        for (size_t piece = 0; piece < pieces.size(); piece++) {
            const int organ = model.chain.nodes[size_t(model.capsules[piece][1])].organ;
            const auto is_of = [&](const OrganPair& pair) {
                return (pair[0] == int(i) && pair[1] == organ) || (pair[2] == int(i) && pair[3] == organ);
            };
            if (pieces[piece] && std::none_of(crossed.begin(), crossed.end(), is_of)) pieces[piece] = 0;
            any = any || pieces[piece];
        }
        if (!any) pieces.clear();
    }
}

// Finds contacts of cages, and of organs that have crossed each other, by the overlaps of their tets.
void search_tets(const World& world, const std::vector<PlantBody*>& island, const std::vector<OrganPair>& crossed,
                 const std::vector<const PlantContact*>& last, double h, PlantSearch& memory, Found& result) {
    Timer timer;
    memory.shapes.resize(std::max(memory.shapes.size(), island.size()));
    std::vector<CoveredBody> covered;
    std::vector<CollisionBody> bodies;
    for (size_t i = 0; i < island.size(); i++) {
        place_shape(*island[i], i, h, memory.shapes[i]);
        const bool with_itself = touches_others(world, *island[i], FROND_EFFECT_SELF_CONTACT);
        const Collider* collider = &island[i]->touched().collider;
        covered.push_back({collider, &memory.shapes[i].covers, with_itself});
        bodies.push_back(
            {collider, memory.shapes[i].places.data(), {}, with_itself, touches_by_sheath(*island[i]->plant)});
    }
    std::vector<std::vector<uint8_t>> pieces = find_meeting_pieces(covered, 0);
    for (size_t i = 0; i < island.size(); i++) bodies[i].pieces = std::move(pieces[i]);
    leave_out_parted(island, crossed, bodies);
    const bool meet =
        std::any_of(bodies.begin(), bodies.end(), [](const CollisionBody& body) { return !body.pieces.empty(); });
    result.ms_broad += timer.lap();
    std::vector<PlantContact> contacts;
    if (meet) {
        result.ms_hash = find_cage_contacts(*memory.search, bodies, world.hash, memory.found).ms_hash;
        for (const CageContact& found : memory.found)
            if (is_of_tets(found, island, crossed)) contacts.push_back(contact_of(found, memory, island));
    }
    if (!last.empty()) remember_contacts(placed_now(world, island, bodies, memory), last, contacts);
    // Plants held by penalty springs fluctuate too much for their last sides to count.
    if (world.response != FROND_RESPONSE_PENALTY) agree_on_sides(last, contacts);
    result.contacts.insert(result.contacts.end(), contacts.begin(), contacts.end());
    result.ms_narrow += timer.lap() - result.ms_hash;
}

Found search_island(const World& world, const std::vector<PlantBody*>& island,
                    const std::vector<const PlantContact*>& last, double h, PlantSearch& memory) {
    Found result;
    Timer timer;
    const std::vector<StripPath> paths = strip_paths(world, island, h, memory);
    result.ms_broad = timer.lap();
    remember_pairs(paths, memory);
    result.ms_broad += timer.lap();
    StripContacts strips = find_strip_contacts(paths, memory.pairs, last);
    result.contacts = std::move(strips.contacts);
    memory.island = island;
    memory.crossed = strips.crossed;
    memory.normals = std::move(strips.normals);
    result.ms_narrow = timer.lap();
    const bool has_cages = std::any_of(island.begin(), island.end(),
                                       [](const PlantBody* body) { return !touches_by_sheath(*body->plant); });
    if (!has_cages && strips.crossed.empty()) return result;
    std::vector<const PlantContact*> of_tets;
    for (const PlantContact* contact : last)
        if (!contact->by_strips) of_tets.push_back(contact);
    search_tets(world, island, strips.crossed, of_tets, h, memory, result);
    return result;
}

// Sorts contacts by island; those of plants whose boxes no longer overlap are dropped.
std::vector<std::vector<const PlantContact*>> sort_by_island(const World& world,
                                                             const std::vector<std::vector<PlantBody*>>& islands,
                                                             const std::vector<PlantContact>& contacts) {
    std::vector<int> island_of(world.taking_part.size(), -1);
    for (size_t i = 0; i < islands.size(); i++)
        for (const PlantBody* body : islands[i]) island_of[size_t(body->number)] = int(i);
    std::vector<std::vector<const PlantContact*>> sorted(islands.size());
    for (const PlantContact& contact : contacts) {
        const int first = contact.plants[0]->number, second = contact.plants[1]->number;
        if (first < 0 || second < 0 || island_of[size_t(first)] < 0) continue;
        if (island_of[size_t(first)] == island_of[size_t(second)])
            sorted[size_t(island_of[size_t(first)])].push_back(&contact);
    }
    return sorted;
}

}  // namespace

void take_attachments(PlantContact& contact) {
    std::array<Vec3, 2> places;
    for (size_t k = 0; k < 2; k++) {
        const PlantBody& body = *contact.plants[k];
        const Plant& plant = *body.plant;
        const ContactSide& side = contact.sides[k];
        contact.attachments[k] = plant.follow ? sheath_attachment(*body.sheath, side)
                                 : touches_by_sheath(plant)
                                     ? sheath_attachment(*body.in_cage, *plant.model, *plant.nodes, side)
                                     : cage_attachment(side);
        places[k] = plant.to_world(attachment_place(contact.attachments[k], plant.state.motion.x));
    }
    contact.between = places[0] - places[1];
}

bool may_touch(const World& world, const PlantContact& contact) {
    for (size_t k = 0; k < 2; k++)
        if (has_come_off(*contact.plants[k]->plant, contact.sides[k].piece)) return false;
    if (contact.plants[0] == contact.plants[1])
        return touches_others(world, *contact.plants[0], FROND_EFFECT_SELF_CONTACT);
    return touches_others(world, *contact.plants[0], FROND_EFFECT_PLANT_CONTACT) &&
           touches_others(world, *contact.plants[1], FROND_EFFECT_PLANT_CONTACT);
}

std::vector<PlantContact> find_plant_contacts(World& world, double h) {
    std::vector<PlantContact> contacts;
    std::vector<PlantContact> last;  // what a change of mechanics made void is left out
    std::copy_if(world.plant_contacts.begin(), world.plant_contacts.end(), std::back_inserter(last), is_by_the_same);
    world.plant_contacts.clear();
    world.plant_island_count = 0;
    for (PlantBody* body : world.awake) body->plant->step.is_watched = false;
    Timer timer;
    // Awake plants get their colliders in advance: the broad phase sees them as wide as their cages or sheaths.
    bool any = false;
    for (PlantBody* body : world.awake) {
        const bool together = world.bodies.size() > 1 && touches_others(world, *body, FROND_EFFECT_PLANT_CONTACT);
        if (!together && !touches_others(world, *body, FROND_EFFECT_SELF_CONTACT)) continue;
        take_collider(*body);
        any = true;
    }
    if (!any) return contacts;
    const std::vector<std::vector<PlantBody*>> islands = find_plant_islands(world, h);
    while (world.plant_searches.size() < islands.size())
        world.plant_searches.push_back(std::make_unique<PlantSearch>());
    world.profile.ms_broad += timer.lap();
    const std::vector<std::vector<const PlantContact*>> known = sort_by_island(world, islands, last);
    std::vector<Found> found(islands.size());
    run_jobs(world, islands.size(),
             [&](size_t i) { found[i] = search_island(world, islands[i], known[i], h, *world.plant_searches[i]); });
    world.plant_island_count = islands.size();
    // Any of them may go elsewhere than its speed says.
    for (const std::vector<PlantBody*>& island : islands)
        for (PlantBody* body : island) body->plant->step.is_watched = !body->rest.asleep;
    for (Found& of : found) {
        keep_deepest(world, of.contacts);
        contacts.insert(contacts.end(), of.contacts.begin(), of.contacts.end());
        world.profile.ms_broad += of.ms_broad;
        world.profile.ms_hash += of.ms_hash;
        world.profile.ms_narrow += of.ms_narrow;
    }
    return contacts;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
