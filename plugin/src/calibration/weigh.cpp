#include "calibration/weigh.hpp"

#include <algorithm>
#include <cmath>

#include "cage/shift_centre.hpp"
#include "cage/tet_geometry.hpp"
#include "core/assert.hpp"

namespace frond {

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
            hangs[e] =
                nearest_node(model.chain, model.cage.tet_organ[e], tet_centre(model.cage.nodes, model.cage.tets[e]));
            continue;
        }
        std::nth_element(nodes.begin(), nodes.begin() + long(nodes.size() / 2), nodes.end());
        hangs[e] = nodes[nodes.size() / 2];
    }
    return hangs;
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
        const OnCapsule on =
            go_along(chain, children, model.cage.tet_organ[e], hangs[e], tet_centre(model.cage.nodes, tet));
        masses[size_t(on.from)] += (1 - on.along) * mass;
        masses[size_t(on.to)] += on.along * mass;
    }
    return masses;
}

// Returns what each capsule weighs by its section, and its centre.
static std::vector<CapsuleMass> weigh_sections(const Model& model) {
    std::vector<CapsuleMass> capsules(model.chain.nodes.size());
    for (size_t i = 0; i < capsules.size(); i++) {
        if (model.chain.nodes[i].parent < 0) continue;
        const Section& section = model.sections[i];
        const double mass = section.mass() * section.length;
        capsules[i] = {(1 - section.mass_at_end()) * mass, section.mass_at_end() * mass};
    }
    return capsules;
}

// Returns the mass of the capsules of each organ [kg].
static std::vector<double> sum_by_organ(const Model& model, const std::vector<CapsuleMass>& capsules) {
    std::vector<double> organs(model.organs.size(), 0.0);
    for (size_t i = 0; i < capsules.size(); i++)
        organs[size_t(model.chain.nodes[i].organ)] += capsules[i].at_begin + capsules[i].at_end;
    return organs;
}

namespace {

// The chain by organs, while it is weighed.
struct Weighing {
    const Model& model;
    std::vector<std::vector<int>> capsules;  // of each organ
    std::vector<double> areas;               // of each organ's surface [m^2]
    std::vector<CapsuleMass> own, foreign;   // what each capsule weighs of its organ, and of those without capsules

    void add(int organ, int capsule, const Vec3& place, double mass) {
        const bool is_root = model.chain.nodes[size_t(capsule)].parent < 0;
        const double along = is_root ? 1 : nearest_on(model.chain, capsule, place).along;
        const bool is_own = model.chain.nodes[size_t(capsule)].organ == organ;
        CapsuleMass& at = (is_own ? own : foreign)[size_t(capsule)];
        at.at_begin += (1 - along) * mass;
        at.at_end += along * mass;
    }
    int nearest_of(int organ, const Vec3& place) const {
        const std::vector<int>& list = capsules[size_t(organ)];
        const auto distance = [&](int capsule) { return nearest_on(model.chain, capsule, place).distance; };
        return *std::min_element(list.begin(), list.end(), [&](int a, int b) { return distance(a) < distance(b); });
    }
};

double area_of(const Surface& surface, const Triangle& triangle) {
    const Vec3& at = surface.positions[size_t(triangle[0])];
    return 0.5 *
           (surface.positions[size_t(triangle[1])] - at).cross(surface.positions[size_t(triangle[2])] - at).norm();
}

Weighing begin_weighing(const Model& model) {
    const size_t count = model.chain.nodes.size();
    Weighing weighing = {model, {}, {}, std::vector<CapsuleMass>(count), std::vector<CapsuleMass>(count)};
    weighing.capsules.resize(model.organs.size());
    weighing.areas.assign(model.organs.size(), 0.0);
    for (size_t i = 0; i < count; i++)
        if (model.chain.nodes[i].parent >= 0) weighing.capsules[size_t(model.chain.nodes[i].organ)].push_back(int(i));
    for (const Part& part : model.surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
            weighing.areas[size_t(part.organ)] += area_of(model.surface, model.surface.triangles[size_t(t)]);
    return weighing;
}

// Hangs a triangle on the capsules that its corners are bound to: of its organ's, and of others if it has none.
void hang_triangle(const Triangle& triangle, int organ, double mass, Weighing& weighing) {
    const Model& model = weighing.model;
    const bool has_capsules = !weighing.capsules[size_t(organ)].empty();
    Vec3 centre = Vec3::Zero();
    for (int corner : triangle) centre += model.surface.positions[size_t(corner)] / 3;
    for (int corner : triangle) {
        const Vec3 place = 0.5 * (model.surface.positions[size_t(corner)] + centre);
        int capsule = model.chain.vertex_capsule[size_t(corner)];
        const ChainNode& end = model.chain.nodes[size_t(capsule)];
        if (has_capsules && (end.organ != organ || end.parent < 0)) capsule = weighing.nearest_of(organ, place);
        weighing.add(organ, capsule, place, mass / 3);
    }
}

// Brings the centre of what an organ's capsules weigh to where its tissue's is.
void centre_organ(size_t organ, Weighing& weighing) {
    std::vector<Vec3> places;
    std::vector<double> masses;
    for (int capsule : weighing.capsules[organ]) {
        const ChainNode& node = weighing.model.chain.nodes[size_t(capsule)];
        places.push_back(weighing.model.chain.nodes[size_t(node.parent)].position);
        places.push_back(node.position);
        masses.push_back(weighing.own[size_t(capsule)].at_begin);
        masses.push_back(weighing.own[size_t(capsule)].at_end);
    }
    shift_centre(places, weighing.model.cage.organ_centre[organ], masses);
    for (size_t i = 0; i < weighing.capsules[organ].size(); i++)
        weighing.own[size_t(weighing.capsules[organ][i])] = {masses[2 * i], masses[2 * i + 1]};
}

}  // namespace

std::vector<CapsuleMass> weigh_capsules(const Model& model) {
    const std::vector<CapsuleMass> by_sections = weigh_sections(model);
    if (model.exact_sections) return by_sections;
    Weighing weighing = begin_weighing(model);
    const std::vector<double> organs = sum_by_organ(model, by_sections);
    const auto is_by_surface = [&](size_t organ) {
        return (is_sheet(model.organs[organ]) || weighing.capsules[organ].empty()) && weighing.areas[organ] > 0;
    };
    for (const Part& part : model.surface.parts) {
        const size_t organ = size_t(part.organ);
        if (!is_by_surface(organ)) continue;
        const double per_area = model.organ_mass[organ] / weighing.areas[organ];
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++) {
            const Triangle& triangle = model.surface.triangles[size_t(t)];
            hang_triangle(triangle, part.organ, per_area * area_of(model.surface, triangle), weighing);
        }
    }
    for (size_t o = 0; o < organs.size(); o++) {
        const double factor = organs[o] > 0 ? model.organ_mass[o] / organs[o] : 0;
        for (int i : weighing.capsules[o])
            if (!is_by_surface(o))
                weighing.own[size_t(i)] = {factor * by_sections[size_t(i)].at_begin,
                                           factor * by_sections[size_t(i)].at_end};
        centre_organ(o, weighing);
    }
    for (size_t i = 0; i < weighing.own.size(); i++) {
        weighing.own[i].at_begin += weighing.foreign[i].at_begin;
        weighing.own[i].at_end += weighing.foreign[i].at_end;
    }
    return weighing.own;
}

// Returns what the tets hold of each organ [kg], before it is fitted to sections.
static std::vector<double> weigh_tissue(const Model& model, const std::vector<Tissue>& tissue) {
    std::vector<double> organs(model.organs.size(), 0.0);
    for (const Tissue& part : tissue) {
        const Organ& organ = model.organs[size_t(part.organ)];
        organs[size_t(part.organ)] += organ.material.density * (1 - hole_share(organ)) * part.volume;
    }
    return organs;
}

static std::vector<Tissue> tissue_of(const Cage& cage) {
    if (!cage.tissue.empty()) return cage.tissue;
    std::vector<Tissue> tissue;
    for (size_t e = 0; e < cage.tets.size(); e++)
        tissue.push_back({int(e), cage.tet_organ[e], cage.tet_fill[e] * tet_volume(cage.nodes, cage.tets[e])});
    return tissue;
}

void give_mass(Model& model) {
    const Cage& cage = model.cage;
    FROND_ASSERT(model.sections.size() == model.chain.nodes.size());
    FROND_ASSERT(cage.tet_organ.size() == cage.tets.size() && cage.tet_fill.size() == cage.tets.size());
    const std::vector<Tissue> tissue = tissue_of(cage);
    model.organ_mass = weigh_tissue(model, tissue);
    std::vector<double> density(model.organs.size(), 0.0);
    for (size_t o = 0; o < density.size(); o++)
        density[o] = model.organs[o].material.density * (1 - hole_share(model.organs[o]));
    if (model.exact_sections) {
        const std::vector<double> exact = sum_by_organ(model, weigh_sections(model));
        for (size_t o = 0; o < density.size(); o++) {
            if (!(exact[o] > 0 && model.organ_mass[o] > 0)) continue;
            density[o] *= exact[o] / model.organ_mass[o];
            model.organ_mass[o] = exact[o];
        }
    }
    model.tet_density.assign(cage.tets.size(), 0.0);
    for (const Tissue& part : tissue) model.tet_density[size_t(part.tet)] += density[size_t(part.organ)] * part.volume;
    for (size_t e = 0; e < cage.tets.size(); e++) model.tet_density[e] /= tet_volume(cage.nodes, cage.tets[e]);
    if (model.has_own_tets) {
        model.chain_mass = spread_over_capsules(model);
        return;
    }
    const std::vector<CapsuleMass> capsules = weigh_capsules(model);
    model.chain_mass.assign(capsules.size(), 0.0);
    for (size_t i = 0; i < capsules.size(); i++) {
        const int parent = model.chain.nodes[i].parent;
        model.chain_mass[i] += capsules[i].at_end;
        if (parent >= 0) model.chain_mass[size_t(parent)] += capsules[i].at_begin;
    }
}

}  // namespace frond
