// In: a model's cage and the materials of its tets. Out: rest data and masses of the mechanics of tets.
#include <algorithm>
#include <cmath>

#include "core/assert.hpp"
#include "core/error.hpp"
#include "mechanics/rows.hpp"
#include "mechanics/sections.hpp"
#include "mechanics/tet_looks.hpp"
#include "mechanics/tet_plasticity.hpp"

namespace frond {

namespace {

// Checks everything here, since the mechanics trust their input.
void check_model(const Model& model, int order) {
    const size_t node_count = model.cage.nodes.size(), tet_count = model.cage.tets.size();
    const std::vector<double>& young = model.young_of(order);
    if (tet_count == 0) fail(FROND_RESULT_BAD_GEOMETRY, "the model has no tets; give it a cage first");
    if (model.tet_density.size() != tet_count || young.size() != tet_count || model.tet_poisson.size() != tet_count)
        fail(FROND_RESULT_INTERNAL, "the model has %zu tets but not as many materials", tet_count);
    for (size_t e = 0; e < tet_count; ++e) {
        for (int i : model.cage.tets[e])
            if (i < 0 || size_t(i) >= node_count)
                fail(FROND_RESULT_BAD_GEOMETRY, "tet %zu uses node %d, but there are %zu nodes", e, i, node_count);
        const double density = model.tet_density[e], E = young[e], nu = model.tet_poisson[e];
        if (!(density > 0) || !(E > 0) || !(nu >= 0) || !(nu < 0.5) || !std::isfinite(density * E))
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "tet %zu has density %g kg/m^3, Young's modulus %g Pa and Poisson's ratio %g; the first two must be "
                 "above 0, the last within 0 .. 0.499",
                 e, density, E, nu);
    }
}

// Returns the slots of the blocks of nodes a >= b, which ascend.
template <size_t PAIRS, size_t N>
std::array<int, PAIRS> slots_of(const BlockPattern& pattern, const std::array<int, N>& nodes) {
    static_assert(PAIRS == N * (N + 1) / 2);
    std::array<int, PAIRS> slots;
    size_t pair = 0;
    for (size_t a = 0; a < N; ++a)
        for (size_t b = 0; b <= a; ++b) slots[pair++] = pattern.slot(nodes[a], nodes[b]);
    FROND_ASSERT(*std::min_element(slots.begin(), slots.end()) >= 0);
    return slots;
}

}  // namespace

template <class Element>
static void set_rest(TetElements& elements) {
    const size_t tet_count = elements.tets.size();
    elements.rest_inverse.resize(tet_count * Element::POINTS);
    elements.grain_axis.resize(tet_count * Element::POINTS);
    elements.volume.assign(tet_count, 0);
    if (Element::POINTS > 1) elements.point_volume.resize(tet_count * Element::POINTS);
    for (size_t e = 0; e < tet_count; ++e) {
        const auto places = Element::places(elements, e, elements.rest_positions);
        for (int q = 0; q < Element::POINTS; ++q) {
            const Mat3 edges = Element::edges(places, q);
            const size_t at = e * Element::POINTS + size_t(q);

            // A flat tet has no inverse; measure flatness against the tet's own size.
            const double volume = std::abs(edges.determinant()) / 6, length = edges.norm();
            if (!(volume > 1e-12 * length * length * length) || !std::isfinite(volume))
                fail(FROND_RESULT_BAD_GEOMETRY, "tet %zu has no volume at rest; remove it or move its nodes", e);
            elements.rest_inverse[at] = edges.inverse();
            const Mat3 modelled = Element::edges(Element::places(elements, e, elements.modelled), q);
            elements.grain_axis[at] = (edges * (modelled.inverse() * elements.grain_modelled[e])).normalized();
            elements.volume[e] += volume / Element::POINTS;
            if (Element::POINTS > 1) elements.point_volume[at] = volume / Element::POINTS;
        }
    }
}

void set_rest_positions(TetElements& elements, const VecX& rest_positions) {
    if (rest_positions.size() != 3 * Eigen::Index(elements.node_count))
        fail(FROND_RESULT_BAD_ARGUMENT, "%zu rest positions were given for %d nodes; give three numbers a node",
             size_t(rest_positions.size()), elements.node_count);
    elements.rest_positions = rest_positions;
    if (elements.nodes.order == 1)
        set_rest<LinearTet>(elements);
    else
        set_rest<QuadraticTetElement>(elements);
}

template <class Element>
static void add_volume_slopes(const TetElements& elements, size_t e, std::vector<Vec3>& out) {
    out.assign(Element::NODES, Vec3::Zero());
    for (int q = 0; q < Element::POINTS; ++q) {
        const TetShare share = Element::share(elements, e, q);
        const Mat3 slopes = share.volume * share.rest_inverse.transpose();
        Element::add_to_nodes(q, {Vec3(-slopes.rowwise().sum()), slopes.col(0), slopes.col(1), slopes.col(2)}, out);
    }
}

void volume_slopes(const TetElements& elements, size_t e, std::vector<Vec3>& out) {
    if (elements.nodes.order == 1)
        add_volume_slopes<LinearTet>(elements, e, out);
    else
        add_volume_slopes<QuadraticTetElement>(elements, e, out);
}

// Makes the pattern of elements that have these nodes, and of the fibres that may pull along each capsule, between the
// elements in which its ends are. Those cost the corn 3 % of a step.
template <size_t N>
BlockPattern pattern_with_fibres(const Model& model, int node_count, const std::vector<std::array<int, N>>& elements) {
    std::vector<std::array<int, N>> joined = elements;
    const std::vector<int>& of_chain = model.chain_embedding.tet;
    for (size_t i = 0; model.calibrated && i < of_chain.size(); i++) {
        if (model.chain.nodes[i].parent < 0) continue;
        const auto &end = elements[size_t(of_chain[i])],
                   &begin = elements[size_t(of_chain[size_t(model.chain.nodes[i].parent)])];
        for (const size_t half_of_end : {size_t(0), N / 2})
            for (const size_t half_of_begin : {size_t(0), N / 2}) {
                std::array<int, N> both;
                std::copy_n(end.begin() + half_of_end, N / 2, both.begin());
                std::copy_n(begin.begin() + half_of_begin, N / 2, both.begin() + N / 2);
                joined.push_back(both);
            }
    }
    return make_block_pattern(node_count, joined);
}

TetElements make_tet_elements(const Model& model, const VecX* rest_positions, int order) {
    check_model(model, order);
    TetElements out;
    out.tets = out.ordered = model.cage.tets;
    out.density = model.tet_density;
    out.nodes = make_tet_nodes(int(model.cage.nodes.size()), out.tets, order);
    out.node_count = out.nodes.count();
    out.modelled = node_places(out.nodes, [&](int i) { return model.cage.nodes[size_t(i)]; });
    out.grain = model.grain_of(order);
    out.grain_modelled = model.tet_axis;
    out.grain.resize(out.tets.size(), 0);
    out.grain_modelled.resize(out.tets.size(), Vec3::UnitX());
    // Ordering the nodes may mirror the tet, which does not change the deformation gradient.
    for (Tet& tet : out.ordered) std::sort(tet.begin(), tet.end());
    set_rest_positions(out, rest_positions ? *rest_positions : out.modelled);

    out.pattern = order == 1 ? pattern_with_fibres(model, out.node_count, out.tets)
                             : pattern_with_fibres(model, out.node_count, out.nodes.of_tet);
    for (size_t e = 0; e < out.tets.size(); ++e) {
        const double E = model.young_of(order)[e], nu = model.tet_poisson[e];
        out.lambda.push_back(E * nu / ((1 + nu) * (1 - 2 * nu)));
        out.mu.push_back(E / (2 * (1 + nu)));

        if (order == 1)
            out.slots.push_back(slots_of<10>(out.pattern, out.ordered[e]));
        else
            out.quadratic_slots.push_back(slots_of<55>(out.pattern, out.nodes.of_tet[e]));
    }
    return out;
}

// Returns E I length / reach^2 of each capsule's section for bending to its thin side, with its organ's factor.
static std::vector<double> bending_resistance(const Model& model) {
    std::vector<double> resistance(model.chain.nodes.size(), 0);
    for (size_t i = 0; i < resistance.size(); ++i) {
        if (model.chain.nodes[i].parent < 0 || model.sections.size() != resistance.size()) continue;
        const Section& section = model.sections[i];
        const double reach = 0.5 * section.thickness;
        resistance[i] = model.organ_stiffer[size_t(std::max(model.chain.nodes[i].organ, 0))] * section.bending_thin() *
                        section.length / (reach * reach);
    }
    return resistance;
}

template <int ORDER>
std::unique_ptr<const Elements> make_tets(const Model& model, frond_mechanics which) {
    const VecX& rest = model.rest_shapes->positions[ORDER - 1][size_t(which)];
    const std::vector<double>& stiffer = model.rest_shapes->stiffer[ORDER - 1][size_t(which)];
    auto elements = std::make_unique<TetElements>(make_tet_elements(model, rest.size() ? &rest : nullptr, ORDER));
    for (size_t e = 0; e < stiffer.size(); ++e) {
        elements->lambda[e] *= stiffer[e];
        elements->mu[e] *= stiffer[e];
    }
    for (int organ : model.cage.tet_organ)
        elements->damping_ratio.push_back(model.organs[size_t(organ)].material.damping_ratio);
    elements->section = capsules_of_tets(model);
    elements->resistance = bending_resistance(model);
    let_tets_yield(model, *elements);
    let_break(model, mechanics(which, ORDER), *elements);
    return elements;
}
template std::unique_ptr<const Elements> make_tets<1>(const Model&, frond_mechanics);
template std::unique_ptr<const Elements> make_tets<2>(const Model&, frond_mechanics);

// For corners and middles of edges of quadratic tets see quadratic_share().
double lumped_share(int order, size_t node) {
    if (order == 1) return 0.25;
    return node < 4 ? 1.0 / 36 : 4.0 / 27;
}

// Mass matrix of linear tets. Lumped: a quarter to each node. Consistent: shape functions' products, (1 + delta) / 20.
static double linear_share(size_t a, size_t b, bool lumped) {
    if (lumped) return a == b ? lumped_share(1, a) : 0.0;
    return a == b ? 1.0 / 10 : 1.0 / 20;
}

// Mass matrix of quadratic tets, consistent: integrals of the shape functions' products, which depend on the corners
// that the nodes have in common. Lumped: its diagonal, scaled to the tet's mass (Hinton, Rock, Zienkiewicz 1976, "A
// note on mass lumping and related processes"), since row sums are negative at corners.
static double quadratic_share(size_t a, size_t b, bool lumped) {
    if (lumped) return a == b ? lumped_share(2, a) : 0.0;
    const auto touches = [](size_t node, size_t corner) {
        if (node < 4) return node == corner;
        return size_t(TET_EDGES[node - 4][0]) == corner || size_t(TET_EDGES[node - 4][1]) == corner;
    };
    int common = 0;
    for (size_t corner = 0; corner < 4; ++corner) common += touches(a, corner) && touches(b, corner);
    if (a < 4 && b < 4) return (common ? 6.0 : 1.0) / 420;
    if (a < 4 || b < 4) return (common ? -4.0 : -6.0) / 420;
    constexpr double EDGES[] = {8, 16, 32};
    return EDGES[common] / 420;
}

template <size_t N>
static void add_masses(const TetElements& elements, size_t e, const std::array<int, N>& nodes, const int* slots,
                       double (*share)(size_t, size_t, bool), Masses& masses) {
    const double mass = elements.volume[e] * elements.density[e];
    for (size_t a = 0; a < N; ++a)
        for (size_t b = 0; b <= a; ++b) {
            const double m = mass * share(a, b, masses.lumped);
            masses.slot[size_t(*slots++)] += m;
            masses.node[nodes[a]] += m;
            if (a != b) masses.node[nodes[b]] += m;
        }
}

Masses tet_masses(const Elements& body, frond_mass mass) {
    const TetElements& elements = as_tets(body);
    Masses masses;
    masses.lumped = mass == FROND_MASS_LUMPED;
    masses.node = VecX::Zero(elements.node_count);
    masses.slot.assign(elements.pattern.row.size(), 0.0);
    for (size_t e = 0; e < elements.ordered.size(); ++e) {
        if (elements.nodes.order == 1)
            add_masses(elements, e, elements.ordered[e], elements.slots[e].data(), linear_share, masses);
        else
            add_masses(elements, e, elements.nodes.of_tet[e], elements.quadratic_slots[e].data(), quadratic_share,
                       masses);
    }
    return masses;
}

template <class Element>
bool tets_are_calm(const Elements& body, const VecX& from, const VecX& to) {
    if (Element::POINTS == 1 && !any_tet_is_wild(body, from, to)) return true;
    const TetElements& elements = as_tets(body);
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const auto before = Element::places(elements, e, from), after = Element::places(elements, e, to);
        for (int q = 0; q < Element::POINTS; ++q) {
            const TetShare share = Element::share(elements, e, q);
            const Mat3 change = Element::gradient(share, after, q) - Element::gradient(share, before, q);
            if (!(change.squaredNorm() < LARGEST_CHANGE * LARGEST_CHANGE)) return false;
        }
    }
    return true;
}
template bool tets_are_calm<LinearTet>(const Elements&, const VecX&, const VecX&);
template bool tets_are_calm<QuadraticTetElement>(const Elements&, const VecX&, const VecX&);

}  // namespace frond
