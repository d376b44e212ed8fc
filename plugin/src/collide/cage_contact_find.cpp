// Finds contacts: cages come in; overlaps, and from them contacts, go out, pair of bodies by pair of bodies.
#include <algorithm>
#include <map>
#include <tuple>

#include "collide/penetration.hpp"
#include "core/assert.hpp"
#include "core/lists.hpp"
#include "core/timer.hpp"

namespace frond {

struct ContactSearch {
    OverlapSearch overlaps;
    NodeMarks inside;
};

ContactSearchPtr make_contact_search() {
    return ContactSearchPtr(new ContactSearch, [](ContactSearch* search) { delete search; });
}

// Sorts overlaps into pairs of bodies. Where copies of cells overlap, a node counts in the tet in which it is deepest.
static std::map<std::array<int, 2>, BodyPair> sort_into_pairs(const OverlapSearch& search) {
    std::map<std::array<int, 2>, BodyPair> pairs;
    const OverlapScene& scene = search.scene;
    const auto pair_of = [&](int a, int b) -> BodyPair& {
        return pairs.insert({{a, b}, BodyPair{a, b, {}, {}}}).first->second;
    };
    const auto least_weight = [&](int k) {
        const auto& weights = search.nodes[size_t(k)].weights;
        return *std::min_element(weights.begin(), weights.end());
    };
    for (size_t k = 0; k < search.nodes.size(); ++k) {
        const NodeOverlap& overlap = search.nodes[k];
        const int a = scene.node_body[size_t(overlap.node)], b = scene.tet_body[size_t(overlap.tet)];
        std::vector<int>& nodes = pair_of(a, b).nodes;
        if (nodes.empty() || search.nodes[size_t(nodes.back())].node != overlap.node)
            nodes.push_back(int(k));
        else if (least_weight(int(k)) > least_weight(nodes.back()))
            nodes.back() = int(k);
    }
    for (size_t k = 0; k < search.edges.size(); ++k)
        pair_of(scene.edge_body[size_t(search.edges[k].edge)], scene.face_body[size_t(search.edges[k].face)])
            .edges.push_back(int(k));
    return pairs;
}

// Drops duplicates: two edges that have passed each other are found from both sides.
static void drop_doubles(std::vector<CageContact>& contacts) {
    const auto key = [](const ContactSide& side) { return std::tuple(side.body, side.nodes[0], side.nodes[1]); };
    std::map<std::tuple<decltype(key(contacts[0].a)), decltype(key(contacts[0].a))>, bool> known;
    const auto is_double = [&](const CageContact& contact) {
        if (contact.kind != CONTACT_EDGE_ON_EDGE) return false;
        auto low = key(contact.a), high = key(contact.b);
        if (high < low) std::swap(low, high);
        return !known.insert({{low, high}, true}).second;
    };
    remove_where(contacts, is_double);
}

SearchTimes find_cage_contacts(ContactSearch& search, const std::vector<CollisionBody>& bodies,
                               const HashSettings& settings, std::vector<CageContact>& out) {
    const Timer timer;
    out.clear();
    find_overlaps(search.overlaps, bodies, settings);
    const OverlapScene& scene = search.overlaps.scene;
    search.inside.assign(scene.places.size(), -1);
    for (const auto& [key, pair] : sort_into_pairs(search.overlaps)) {
        const int base = scene.first_node[size_t(pair.a)];
        const auto place_of = [&](int overlap) -> int& {
            return search.inside[size_t(base + scene.node[size_t(search.overlaps.nodes[size_t(overlap)].node)])];
        };
        for (size_t i = 0; i < pair.nodes.size(); ++i) place_of(pair.nodes[i]) = int(i);
        const std::vector<WayOut> ways = find_node_contacts(search.overlaps, pair, search.inside, out);
        find_edge_contacts(search.overlaps, pair, search.inside, ways, out);
        for (const int overlap : pair.nodes) place_of(overlap) = -1;
    }
    drop_doubles(out);
    FROND_ASSERT(std::all_of(out.begin(), out.end(), [](const CageContact& contact) {
        return std::abs(contact.normal.squaredNorm() - 1) < 1e-6 && contact.depth >= 0;
    }));
    const double ms_hash = search.overlaps.ms_hash;
    return {ms_hash, timer.ms() - ms_hash};
}

}  // namespace frond
