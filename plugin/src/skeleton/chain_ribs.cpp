// Ribs. In: a chain in which a rib drawn as a tube of its own runs along its blade, as a second branch. Out: one
// branch, the blade's, which carries the rib's surface; its sections are the sum of both.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "skeleton/chain_ribs.hpp"

namespace frond {

namespace {

constexpr double ALONG = 0.9;       // least cosine between a rib's and its blade's capsules
constexpr double WITHIN = 1;        // farthest from the blade's axis, in radii of its capsule: 0.29 of its width
constexpr double THINNER = 0.5;     // largest radius of a rib over that of the blade's capsule
constexpr double MOST_OF_IT = 0.5;  // least share of rib and blade that run along each other

struct Capsule {
    int organ;
    double length, radius;
    Vec3 begin, axis;
};

std::vector<Capsule> list_capsules(const Chain& chain) {
    std::vector<Capsule> capsules(chain.nodes.size());
    for (size_t i = 0; i < capsules.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        if (node.parent < 0) continue;
        const Vec3& begin = chain.nodes[size_t(node.parent)].position;
        const double length = (node.position - begin).norm();
        capsules[i] = {node.organ, length, node.fitted_radius, begin, (node.position - begin) / length};
    }
    return capsules;
}

bool runs_along(const Capsule& rib, const Capsule& blade) {
    const Vec3 from = rib.begin + 0.5 * rib.length * rib.axis - blade.begin;
    const double way = from.dot(blade.axis);
    return std::abs(rib.axis.dot(blade.axis)) > ALONG && way > -0.1 * blade.length && way < 1.1 * blade.length &&
           (from - way * blade.axis).norm() < WITHIN * blade.radius && rib.radius < THINNER * blade.radius;
}

// The capsules of an organ.
struct Branch {
    std::vector<size_t> capsules;
    double length = 0;
    Eigen::AlignedBox3d box;
};

std::vector<Branch> list_branches(const std::vector<Capsule>& capsules, size_t organ_count) {
    std::vector<Branch> branches(organ_count);
    for (size_t i = 0; i < capsules.size(); i++) {
        const Capsule& capsule = capsules[i];
        if (!(capsule.length > 0) || capsule.organ < 0) continue;
        Branch& branch = branches[size_t(capsule.organ)];
        branch.capsules.push_back(i);
        branch.length += capsule.length;
        branch.box.extend(capsule.begin).extend(Vec3(capsule.begin + capsule.length * capsule.axis));
    }
    return branches;
}

// Finds for each organ the sheet that it is a rib of, or -1, and for each capsule whether it runs along that.
std::vector<int> find_ribs(const std::vector<Organ>& organs, const std::vector<Capsule>& capsules,
                           std::vector<char>& along) {
    const std::vector<Branch> branches = list_branches(capsules, organs.size());
    std::vector<int> blades(organs.size(), -1);
    along.assign(capsules.size(), 0);
    for (size_t r = 0; r < organs.size(); r++) {
        const Branch& rib = branches[r];
        if (is_sheet(organs[r]) || organs[r].kind == "support" || rib.capsules.empty()) continue;
        double most = 0;
        std::vector<size_t> members;
        for (size_t b = 0; b < organs.size(); b++) {
            const Branch& blade = branches[b];
            const double least = MOST_OF_IT * std::max(rib.length, blade.length);
            if (!is_sheet(organs[b]) || blade.capsules.empty() || std::min(rib.length, blade.length) < least) continue;
            if (rib.box.exteriorDistance(blade.box) > blade.length) continue;
            std::vector<size_t> shared;
            double length = 0;
            for (size_t i : rib.capsules) {
                const auto meets = [&](size_t other) { return runs_along(capsules[i], capsules[other]); };
                if (std::none_of(blade.capsules.begin(), blade.capsules.end(), meets)) continue;
                shared.push_back(i);
                length += capsules[i].length;
            }
            if (length < least || length <= most) continue;
            most = length;
            members = std::move(shared);
            blades[r] = int(b);
        }
        for (size_t i : members) along[i] = 1;
    }
    return blades;
}

// Finds the ribs whose mesh is one with their blade's, so that they have no capsules of their own.
void find_ribs_without_capsules(const Surface& surface, const std::vector<Organ>& organs, Chain& chain) {
    std::vector<int> count(organs.size(), 0);
    for (const ChainNode& node : chain.nodes)
        if (node.parent >= 0 && node.organ >= 0) count[size_t(node.organ)]++;
    const auto may_be = [&](int r) {
        return r >= 0 && !is_sheet(organs[size_t(r)]) && organs[size_t(r)].kind != "support" && count[size_t(r)] == 0;
    };
    std::map<int, std::set<int>> carried;  // by organ, the capsules that carry its vertices
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count && may_be(part.organ); t++)
            for (int vertex : surface.triangles[size_t(t)])
                carried[part.organ].insert(chain.vertex_capsule[size_t(vertex)]);
    for (const auto& [rib, on] : carried) {
        std::map<int, int> shared;  // by organ
        for (int capsule : on) shared[chain.nodes[size_t(capsule)].organ]++;
        for (const auto& [blade, many] : shared)
            if (blade >= 0 && is_sheet(organs[size_t(blade)]) &&
                many > MOST_OF_IT * std::max(count[size_t(blade)], int(on.size())))
                chain.rib_of[size_t(rib)] = blade;
    }
}

// Returns the organ's capsule nearest to a place, and the share of the way along it.
std::pair<int, double> nearest_capsule(const std::vector<Capsule>& capsules, int organ, const Vec3& place) {
    std::pair<int, double> nearest = {-1, 0};
    double least = INFINITY;
    for (size_t i = 0; i < capsules.size(); i++) {
        const Capsule& capsule = capsules[i];
        if (!(capsule.length > 0) || capsule.organ != organ) continue;
        const double way = std::clamp((place - capsule.begin).dot(capsule.axis), 0.0, capsule.length);
        const double distance = (place - capsule.begin - way * capsule.axis).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        nearest = {int(i), way / capsule.length};
    }
    return nearest;
}

bool grows_from(const std::vector<ChainNode>& nodes, int node, int ancestor) {
    while (node >= 0 && node != ancestor) node = nodes[size_t(node)].parent;
    return node >= 0;
}

// Keeps some of the nodes, parents first.
void renumber(Chain& chain, const std::vector<char>& gone) {
    const size_t count = chain.nodes.size();
    std::vector<std::vector<int>> children(count);
    std::vector<int> order, number(count, -1);
    for (size_t i = 0; i < count; i++) {
        if (gone[i]) continue;
        const int parent = chain.nodes[i].parent;
        (parent < 0 ? order : children[size_t(parent)]).push_back(int(i));
    }
    for (size_t k = 0; k < order.size(); k++) {
        number[size_t(order[k])] = int(k);
        const std::vector<int>& next = children[size_t(order[k])];
        order.insert(order.end(), next.begin(), next.end());
    }
    std::vector<ChainNode> nodes;
    for (int i : order) {
        ChainNode node = chain.nodes[size_t(i)];
        if (node.parent >= 0) {
            node.parent = number[size_t(node.parent)];
            const ChainNode& parent = nodes[size_t(node.parent)];
            node.distance = parent.distance + (node.position - parent.position).norm();
        }
        nodes.push_back(node);
    }
    chain.nodes = std::move(nodes);
    for (int& node : chain.vertex_node) node = number[size_t(node)];
    for (int& node : chain.vertex_capsule) node = number[size_t(node)];
}

}  // namespace

void join_ribs(const Surface& surface, const std::vector<Organ>& organs, Chain& chain) {
    std::vector<Capsule> capsules = list_capsules(chain);
    std::vector<char> along;
    chain.rib_of = find_ribs(organs, capsules, along);
    find_ribs_without_capsules(surface, organs, chain);
    std::vector<ChainNode>& nodes = chain.nodes;
    std::vector<char> gone(nodes.size(), 0);
    for (size_t i = 0; i < nodes.size(); i++) {
        // What of the rib grows beyond its end along the blade goes with it.
        const bool follows = nodes[i].parent >= 0 && gone[size_t(nodes[i].parent)] &&
                             nodes[i].organ == nodes[size_t(nodes[i].parent)].organ;
        gone[i] = along[i] || follows;
    }
    if (std::none_of(gone.begin(), gone.end(), [](char one) { return one != 0; })) return;
    const auto blade_of = [&](size_t node) {
        return nodes[node].organ < 0 ? -1 : chain.rib_of[size_t(nodes[node].organ)];
    };
    // Hangs what grew out of a rib on its blade, and the blade where the rib began.
    for (size_t i = 0; i < nodes.size(); i++) {
        const int from = nodes[i].parent;
        if (gone[i] || from < 0 || !gone[size_t(from)]) continue;
        const int blade = blade_of(size_t(from));
        int parent = from;
        while (gone[size_t(parent)]) parent = nodes[size_t(parent)].parent;
        const int nearest = nearest_capsule(capsules, blade, nodes[i].position).first;
        if (nodes[i].organ != blade && !grows_from(nodes, nearest, int(i))) parent = nearest;
        nodes[i].parent = parent;
    }
    // A root from which nothing grows any more goes too.
    std::vector<char> bears(nodes.size(), 0), lost(nodes.size(), 0);
    for (size_t i = 0; i < nodes.size(); i++)
        if (nodes[i].parent >= 0) (gone[i] ? lost : bears)[size_t(nodes[i].parent)] = 1;
    for (size_t i = 0; i < nodes.size(); i++)
        if (nodes[i].parent < 0 && lost[i] && !bears[i] && blade_of(i) >= 0) gone[i] = 1;
    for (size_t v = 0; v < chain.vertex_node.size(); v++) {
        const size_t capsule = size_t(chain.vertex_capsule[v]);
        if (!gone[capsule] && !gone[size_t(chain.vertex_node[v])]) continue;
        const size_t rib = gone[capsule] ? capsule : size_t(chain.vertex_node[v]);
        const auto [nearest, way] = nearest_capsule(capsules, blade_of(rib), surface.positions[v]);
        chain.vertex_capsule[v] = nearest;
        chain.vertex_along[v] = way;
        chain.vertex_node[v] = way < 0.5 ? nodes[size_t(nearest)].parent : nearest;
    }
    renumber(chain, gone);
}

}  // namespace frond
