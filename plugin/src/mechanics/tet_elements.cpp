// In: a model's cage and the materials of its tets. Out: what the mechanics of tets need at rest, and their masses.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/rows.hpp"
#include "mechanics/tet_element.hpp"
#include "model/tet_geometry.hpp"

namespace frond {

namespace {

// The mechanics trust what they are given, so everything is checked here.
void check_model(const Model& model, const VecX* rest_positions) {
    const size_t node_count = model.cage.nodes.size(), tet_count = model.cage.tets.size();
    if (tet_count == 0) fail(FROND_BAD_GEOMETRY, "the model has no tets; give it a cage first");
    if (model.tet_density.size() != tet_count || model.tet_young.size() != tet_count ||
        model.tet_poisson.size() != tet_count)
        fail(FROND_INTERNAL, "the model has %zu tets but not as many materials", tet_count);
    if (rest_positions && size_t(rest_positions->size()) != 3 * node_count)
        fail(FROND_BAD_ARGUMENT, "%zu rest positions were given for %zu nodes; give three numbers a node",
             size_t(rest_positions->size()), node_count);
    for (size_t e = 0; e < tet_count; ++e) {
        for (int i : model.cage.tets[e])
            if (i < 0 || size_t(i) >= node_count)
                fail(FROND_BAD_GEOMETRY, "tet %zu uses node %d, but there are %zu nodes", e, i, node_count);
        const double density = model.tet_density[e], E = model.tet_young[e], nu = model.tet_poisson[e];
        if (!(density > 0) || !(E > 0) || !(nu >= 0) || !(nu < 0.5) || !std::isfinite(density * E))
            fail(FROND_BAD_ARGUMENT,
                 "tet %zu has density %g kg/m^3, Young's modulus %g Pa and Poisson's ratio %g; the first two must be "
                 "above 0, the last within 0 .. 0.499",
                 e, density, E, nu);
    }
}

}  // namespace

TetElements make_tet_elements(const Model& model, const VecX* rest_positions) {
    check_model(model, rest_positions);
    TetElements out;
    out.node_count = int(model.cage.nodes.size());
    out.tets = out.ordered = model.cage.tets;
    out.density = model.tet_density;
    out.modelled.resize(3 * out.node_count);
    for (int i = 0; i < out.node_count; ++i) point(out.modelled, i) = model.cage.nodes[size_t(i)];
    out.rest_positions = rest_positions ? *rest_positions : out.modelled;

    out.pattern = make_block_pattern(out.node_count, out.tets);
    for (size_t e = 0; e < out.tets.size(); ++e) {
        // Ordering the nodes may mirror the tet; the deformation gradient does not see that.
        Tet& tet = out.ordered[e];
        std::sort(tet.begin(), tet.end());
        Mat3 edges;
        for (int a = 0; a < 3; ++a)
            edges.col(a) = point(out.rest_positions, tet[size_t(a) + 1]) - point(out.rest_positions, tet[0]);

        // A flat tet has no inverse; measure flatness against the tet's own size.
        const double volume = std::abs(tet_volume(out.rest_positions, tet)), length = edges.norm();
        if (!(volume > 1e-12 * length * length * length) || !std::isfinite(volume))
            fail(FROND_BAD_GEOMETRY, "tet %zu has no volume at rest; remove it or move its nodes", e);
        out.rest_inverse.push_back(edges.inverse());
        out.volume.push_back(volume);

        const double E = model.tet_young[e], nu = model.tet_poisson[e];
        out.lambda.push_back(E * nu / ((1 + nu) * (1 - 2 * nu)));
        out.mu.push_back(E / (2 * (1 + nu)));

        std::array<int, 16> slots;
        for (size_t a = 0; a < 4; ++a)
            for (size_t b = 0; b < 4; ++b) slots[4 * a + b] = out.pattern.slot(tet[a], tet[b]);
        out.slots.push_back(slots);
    }
    return out;
}

std::unique_ptr<const Elements> make_tets(const Model& model, frond_mechanics which) {
    const VecX& rest = model.rest_shapes->positions[size_t(which)];
    return std::make_unique<TetElements>(make_tet_elements(model, rest.size() ? &rest : nullptr));
}

// Lumped: a quarter of the tet to each node. Consistent: the shape functions' own products, V rho / 20 (1 + delta).
Masses tet_masses(const Elements& body, frond_mass mass) {
    const TetElements& elements = as_tets(body);
    Masses masses;
    masses.lumped = mass == FROND_LUMPED;
    masses.node = VecX::Zero(elements.node_count);
    masses.slot.assign(elements.pattern.row.size(), 0.0);
    for (size_t e = 0; e < elements.ordered.size(); ++e) {
        const double tet_mass = elements.volume[e] * elements.density[e];
        for (size_t a = 0; a < 4; ++a) {
            masses.node[elements.ordered[e][a]] += tet_mass / 4;
            for (size_t b = 0; b <= a; ++b) {
                const size_t slot = size_t(elements.slots[e][4 * a + b]);
                if (masses.lumped)
                    masses.slot[slot] += a == b ? tet_mass / 4 : 0.0;
                else
                    masses.slot[slot] += tet_mass / (a == b ? 10 : 20);
            }
        }
    }
    return masses;
}

bool tets_are_calm(const Elements& body, const VecX& from, const VecX& to) {
    constexpr double MOST = 0.5;  // change of the deformation gradient [-]; as a turn, about 20 degrees
    const TetElements& elements = as_tets(body);
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const Mat3 change = deformation_gradient(elements, e, to) - deformation_gradient(elements, e, from);
        if (!(change.squaredNorm() < MOST * MOST)) return false;
    }
    return true;
}

}  // namespace frond
