#include "calibration/weigh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cage/tet_geometry.hpp"
#include "core/assert.hpp"

namespace frond {

static Vec3 tet_centre(const Cage& cage, const Tet& tet) {
    Vec3 sum = Vec3::Zero();
    for (int corner : tet) sum += cage.nodes[size_t(corner)];
    return sum / 4;
}

// Finds the nearest of an organ's chain nodes to a place, or of all nodes where it has none.
static int nearest_node(const Chain& chain, int organ, const Vec3& place) {
    int nearest = 0;
    double least = INFINITY;
    bool own = false;
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        const double distance = (node.position - place).squaredNorm();
        const bool is_own = node.organ == organ;
        if (is_own < own || (is_own == own && distance >= least)) continue;
        own = is_own;
        least = distance;
        nearest = int(i);
    }
    return nearest;
}

std::vector<int> hang_tets(const Model& model) {
    const size_t tet_count = model.cage.tets.size();
    std::vector<std::vector<int>> votes(tet_count);
    // Where organs meet, a tet of one may hold vertices of another, which does not bear it.
    for (size_t v = 0; v < model.embedding.tet.size(); v++) {
        const size_t tet = size_t(model.embedding.tet[v]);
        const int node = model.chain.vertex_node[v];
        if (model.chain.nodes[size_t(node)].organ == model.cage.tet_organ[tet]) votes[tet].push_back(node);
    }
    std::vector<int> hangs(tet_count);
    for (size_t e = 0; e < tet_count; e++) {
        std::vector<int>& nodes = votes[e];
        if (nodes.empty()) {
            hangs[e] = nearest_node(model.chain, model.cage.tet_organ[e], tet_centre(model.cage, model.cage.tets[e]));
            continue;
        }
        std::nth_element(nodes.begin(), nodes.begin() + long(nodes.size() / 2), nodes.end());
        hangs[e] = nodes[nodes.size() / 2];
    }
    return hangs;
}

Weights weigh(const Model& model, const std::vector<int>& hangs) {
    Weights weights;
    weights.mass.assign(model.chain.nodes.size(), 0);
    weights.moment.assign(model.chain.nodes.size(), Vec3::Zero());
    for (size_t e = 0; e < hangs.size(); e++) {
        const double mass = model.tet_density[e] * tet_volume(model.cage.nodes, model.cage.tets[e]);
        weights.mass[size_t(hangs[e])] += mass;
        weights.moment[size_t(hangs[e])] += mass * tet_centre(model.cage, model.cage.tets[e]);
    }
    return weights;
}

// A place along a capsule of the chain, or at a root that has none of that organ.
struct OnCapsule {
    int from, to;
    double along = 0, distance = INFINITY;  // share of the length [-], of the place from there [m]
};

static OnCapsule nearest_on(const Chain& chain, int to, const Vec3& place) {
    const int from = chain.nodes[size_t(to)].parent;
    const Vec3& begin = chain.nodes[size_t(from)].position;
    const Vec3 axis = chain.nodes[size_t(to)].position - begin;
    const double square = axis.squaredNorm();
    const double along = square > 0 ? std::clamp((place - begin).dot(axis) / square, 0.0, 1.0) : 1;
    return {from, to, along, (begin + along * axis - place).norm()};
}

// Goes along the capsules of an organ from a node to where they are nearest to a place.
static OnCapsule go_along(const Chain& chain, const std::vector<std::vector<int>>& children, int organ, int node,
                          const Vec3& place) {
    OnCapsule best = {node, node};
    for (bool is_nearer = true; is_nearer;) {
        is_nearer = false;
        const auto take_if_nearer = [&](int to) {
            const ChainNode& end = chain.nodes[size_t(to)];
            if (end.parent < 0 || (end.organ != organ && to != node)) return;
            const OnCapsule on = nearest_on(chain, to, place);
            if (!(on.distance < best.distance)) return;
            best = on;
            is_nearer = true;
        };
        for (const int at : {best.from, best.to}) {
            take_if_nearer(at);
            for (const int child : children[size_t(at)]) take_if_nearer(child);
        }
    }
    return best;
}

std::vector<double> spread_over_capsules(const Model& model) {
    const Chain& chain = model.chain;
    std::vector<std::vector<int>> children(chain.nodes.size());
    for (size_t i = 0; i < chain.nodes.size(); i++)
        if (chain.nodes[i].parent >= 0) children[size_t(chain.nodes[i].parent)].push_back(int(i));
    const std::vector<int> hangs = hang_tets(model);
    std::vector<double> masses(chain.nodes.size(), 0.0);
    for (size_t e = 0; e < hangs.size(); e++) {
        const Tet& tet = model.cage.tets[e];
        const double mass = model.tet_density[e] * tet_volume(model.cage.nodes, tet);
        const OnCapsule on = go_along(chain, children, model.cage.tet_organ[e], hangs[e], tet_centre(model.cage, tet));
        masses[size_t(on.from)] += (1 - on.along) * mass;
        masses[size_t(on.to)] += on.along * mass;
    }
    return masses;
}

// Returns the mass of each organ by its sections [kg]; sets that of each chain node, by the capsules' centres of mass.
static std::vector<double> weigh_sections(Model& model) {
    std::vector<double> organs(model.organs.size(), 0.0);
    model.chain_mass.assign(model.chain.nodes.size(), 0.0);
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.parent < 0) continue;
        const double mass = model.sections[i].mass() * model.sections[i].length;
        organs[size_t(node.organ)] += mass;
        const double share = model.sections[i].mass_at_end();
        model.chain_mass[i] += share * mass;
        model.chain_mass[size_t(node.parent)] += (1 - share) * mass;
    }
    return organs;
}

// Returns the share of an organ's outline that weighs: all but its hole and what textures cut out [-].
static double tissue_share(const Organ& organ) {
    return (1 - hole_share(organ)) * seen_share(organ);
}

// Shares the plant's mass among its organs by what is drawn of each: a tet is of one organ, so that what a small one
// weighs would count with what it grows on.
static void share_by_drawing(Model& model) {
    const double mass = std::accumulate(model.organ_mass.begin(), model.organ_mass.end(), 0.0);
    std::vector<double> drawn = model.cage.organ_tissue;
    for (size_t o = 0; o < drawn.size(); o++)
        drawn[o] *= model.organs[o].material.density * tissue_share(model.organs[o]);
    const double sum = std::accumulate(drawn.begin(), drawn.end(), 0.0);
    if (!(sum > 0)) return;
    for (size_t o = 0; o < drawn.size(); o++) model.organ_mass[o] = drawn[o] * mass / sum;
}

void give_mass(Model& model) {
    const Cage& cage = model.cage;
    FROND_ASSERT(model.sections.size() == model.chain.nodes.size());
    FROND_ASSERT(cage.tet_organ.size() == cage.tets.size() && cage.tet_fill.size() == cage.tets.size());
    model.tet_density.resize(cage.tets.size());
    model.organ_mass.assign(model.organs.size(), 0.0);
    for (size_t e = 0; e < cage.tets.size(); e++) {
        const Organ& organ = model.organs[size_t(cage.tet_organ[e])];
        model.tet_density[e] = organ.material.density * cage.tet_fill[e] * tissue_share(organ);
        model.organ_mass[size_t(cage.tet_organ[e])] += model.tet_density[e] * tet_volume(cage.nodes, cage.tets[e]);
    }
    if (!model.exact_sections) {
        share_by_drawing(model);
        model.chain_mass = model.has_own_tets ? spread_over_capsules(model) : weigh(model, hang_tets(model)).mass;
        return;
    }
    const std::vector<double> exact = weigh_sections(model);
    for (size_t e = 0; e < cage.tets.size(); e++) {
        const size_t organ = size_t(cage.tet_organ[e]);
        if (exact[organ] > 0) model.tet_density[e] *= exact[organ] / model.organ_mass[organ];
    }
    for (size_t o = 0; o < exact.size(); o++)
        if (exact[o] > 0) model.organ_mass[o] = exact[o];
}

std::vector<double> borne_masses(const std::vector<double>& own, const std::vector<int>& parents) {
    std::vector<double> borne = own;
    for (size_t o = 0; o < own.size(); o++) {
        size_t steps = 0;
        for (int below = parents[o]; below >= 0 && below != int(o) && steps < own.size();
             below = parents[size_t(below)], steps++)
            borne[size_t(below)] += own[o];
    }
    return borne;
}

}  // namespace frond
