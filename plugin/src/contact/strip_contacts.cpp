// In: strips on their way through a step, as far as is known before it. Out: contacts of those that would meet.
//
// Cores that are apart show on which side of each other two strips are, so contacts need no memory. Cores of plants
// that were made in each other cross; then what is beyond the other may be on the wrong side, and the search for
// overlapping tets, which looks at whole organs, says where they leave.
#include <algorithm>
#include <map>

#include "collide/strip_cull.hpp"
#include "contact/find_plant_contacts.hpp"
#include "contact/strip_search.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

void place_corners(const PlantBody& body, const VecX& x, std::vector<Vec3>& out) {
    const Plant& plant = *body.plant;
    const Sheath& sheath = body.touched();
    attachment_places(plant.follow ? sheath.corner_holds : body.in_cage->corners, x, plant.rotation.toRotationMatrix(),
                      plant.position, out);
}

static StripCore core_of(const Strip& strip, const Vec3* places) {
    StripCore core;
    core.is_line = strip.is_line;
    for (size_t k = 0; k < 4; k++) core.at[k] = places[strip.corners[k]];
    return core;
}
StripCore StripPath::core_before(int number) const {
    return core_of(strip(number), before);
}
StripCore StripPath::core_after(int number) const {
    return core_of(strip(number), after);
}

static int organ_of(const StripPath& path, int strip) {
    const Model& model = *path.body->plant->model;
    return model.chain.nodes[size_t(model.capsules[size_t(path.strip(strip).piece)][1])].organ;
}

OrganPair organs_of(const std::vector<StripPath>& paths, const StripPair& pair) {
    return {pair.a, organ_of(paths[size_t(pair.a)], pair.strip_a), pair.b,
            organ_of(paths[size_t(pair.b)], pair.strip_b)};
}

static ContactSide side_of(const StripPath& path, int body, int number, const std::array<double, 4>& weights) {
    const Strip& strip = path.strip(number);
    ContactSide side = {body, organ_of(path, number), strip.piece, 4, {}, weights};
    for (size_t k = 0; k < 4; k++) side.nodes[k] = path.body->touched().corners[size_t(strip.corners[k])];
    return side;
}

PlantContact contact_of(const std::vector<StripPath>& paths, const StripPair& pair, double time, const StripGap& gap) {
    const StripPath &a = paths[size_t(pair.a)], &b = paths[size_t(pair.b)];
    PlantContact contact;
    contact.plants = {a.body, b.body};
    contact.sides = {side_of(a, pair.a, pair.strip_a, gap.on_a), side_of(b, pair.b, pair.strip_b, gap.on_b)};
    contact.by_strips = true;
    contact.by_sheath = {true, true};
    contact.friction = 1;
    for (size_t k = 0; k < 2; k++) {
        const Plant& plant = *contact.plants[k]->plant;
        contact.on_chain[k] = plant.follow != nullptr;
        const int organ = contact.sides[k].organ;
        contact.friction *= organ >= 0 ? plant.model->organs[size_t(organ)].material.friction : 0;
    }
    const Strip &of_a = a.strip(pair.strip_a), &of_b = b.strip(pair.strip_b);
    const Vec3 on_a = point_on(a.core_before(pair.strip_a).at, gap.on_a),
               on_b = point_on(b.core_before(pair.strip_b).at, gap.on_b);
    contact.normal = gap.normal;
    contact.point = on_a - of_a.radius * gap.normal;
    contact.depth = of_a.radius + of_b.radius - gap.normal.dot(on_a - on_b);
    if (time > 0) contact.depth = std::min(contact.depth, 0.0);  // they do not touch yet
    take_attachments(contact);
    return contact;
}

namespace {

// Both strips of a contact, by their corners.
using StripKey = std::tuple<const PlantBody*, const PlantBody*, std::array<int, 4>, std::array<int, 4>>;
StripKey strips_of(const PlantContact& contact) {
    return {contact.plants[0], contact.plants[1], contact.sides[0].nodes, contact.sides[1].nodes};
}

// Has contacts begin with the impulses that they had.
void take_over_impulses(const std::vector<const PlantContact*>& last, std::vector<PlantContact>& contacts) {
    constexpr double ALIKE = 0.8;  // cosine
    std::map<StripKey, const PlantContact*> known;
    for (const PlantContact* before : last)
        if (before->by_strips && !before->impulse.isZero(0)) known.emplace(strips_of(*before), before);
    if (known.empty()) return;
    for (PlantContact& contact : contacts) {
        const auto found = known.find(strips_of(contact));
        if (found != known.end() && found->second->normal.dot(contact.normal) > ALIKE)
            contact.impulse = found->second->impulse;
    }
}

}  // namespace

StripContacts find_strip_contacts(const std::vector<StripPath>& paths, const std::vector<StripPair>& pairs,
                                  const std::vector<const PlantContact*>& last) {
    constexpr double MARGIN = 0.001, CROSSED = 1e-6;  // [m]
    StripContacts result;
    result.normals.assign(pairs.size(), Vec3::Zero());
    std::vector<OrganPair> organs;  // of each contact
    for (size_t i = 0; i < pairs.size(); i++) {
        const StripPair& pair = pairs[i];
        const StripPath &a = paths[size_t(pair.a)], &b = paths[size_t(pair.b)];
        const StripCore core_a = a.core_before(pair.strip_a), core_b = b.core_before(pair.strip_b);
        const StripCore a_after = a.core_after(pair.strip_a), b_after = b.core_after(pair.strip_b);
        const double thick = a.strip(pair.strip_a).radius + b.strip(pair.strip_b).radius;
        if (stay_apart(core_a, a_after, core_b, b_after, thick + MARGIN)) continue;
        const StripGap now = gap_between(core_a, core_b);
        if (now.distance < CROSSED) {
            result.crossed.push_back(organs_of(paths, pair));
            continue;
        }
        result.normals[i] = now.normal;
        if (now.distance < thick + MARGIN) {
            result.contacts.push_back(contact_of(paths, pair, 0, now));
        } else if (const auto impact = first_impact(core_a, a_after, core_b, b_after, thick + MARGIN, now)) {
            result.contacts.push_back(contact_of(paths, pair, impact->time, impact->gap));
        } else {
            continue;
        }
        organs.push_back(organs_of(paths, pair));
    }
    std::vector<OrganPair>& crossed = result.crossed;
    std::sort(crossed.begin(), crossed.end());
    crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
    size_t kept = 0;
    for (size_t i = 0; i < organs.size(); i++)
        if (!std::binary_search(crossed.begin(), crossed.end(), organs[i]))
            result.contacts[kept++] = result.contacts[i];
    result.contacts.erase(result.contacts.begin() + std::ptrdiff_t(kept), result.contacts.end());
    take_over_impulses(last, result.contacts);
    return result;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
