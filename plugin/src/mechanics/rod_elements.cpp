// In: a model's chain, sections and organs. Out: rest data and masses of the chain mechanics.
//
// A tree of rods is statically determinate: forces and moments in it follow from the weight alone, summed from the tips
// to the root. So the shape without load, which weight bends to the modelled shape, needs no search: each segment's
// rest strain and curvature are those of the modelled shape minus those by its force and moment. What closes loops
// beside the tree bears nothing as modelled.
#include "mechanics/rod_elements.hpp"

#include <algorithm>
#include <map>

#include "core/assert.hpp"
#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/union_find.hpp"
#include "mechanics/rows.hpp"
#include "mechanics/sections.hpp"

namespace frond {

namespace {

size_t organ_of(const Model& model, size_t node) {
    return size_t(std::max(model.chain.nodes[node].organ, 0));
}

// Set a segment's stiffness (along, thin, wide) and how far its fibres reach: from the tissue of its section, or from a
// full cylinder with a factor on bending alone: a blade's factor, far below one, would let it stretch like rubber.
void take_section(const Model& model, size_t node, RodSegment& rod) {
    const Section& section = model.sections[node];
    const double stiffer = model.organ_stiffer[organ_of(model, node)];
    const double lengths = section.length / rod.length, over = lengths * lengths * section.tilting_per_bending();
    const double thin = stiffer * section.bending_thin(), wide = stiffer * section.bending_wide();
    rod.reach_thin = 0.5 * section.thickness;
    rod.reach_wide = 0.5 * section.width;
    rod.stretch = Vec3(stiffer * section.stretching(), over * thin, over * wide);
    rod.bend = Vec3(stiffer * section.twisting(), wide, thin);
    rod.centre = (section.elastic_centre() - 0.5) * rod.length;
    rod.warping = section.stretching() * frond::pow(section.width, 4) / (720 * section.twisting());
}
void take_cylinder(const Model& model, size_t node, double radius, double stiffer, RodSegment& rod) {
    const size_t organ = organ_of(model, node);
    const Material& material = model.organs[organ].material;
    const double E = material.young * model.organ_stiffer[organ], over = 12 / (rod.length * rod.length);
    const double area = PI * radius * radius, inertia = stiffer * area * radius * radius / 4;
    rod.reach_thin = rod.reach_wide = radius;
    rod.stretch = E * Vec3(area, over * inertia, over * inertia);
    rod.bend = E * Vec3(inertia / (1 + material.poisson), inertia, inertia);
}

// Makes a segment without its stiffness, whose thin side is towards `thin`.
RodSegment make_segment(const Model& model, int a, int b, double length, const Vec3& axis, const Vec3& thin) {
    RodSegment rod = {};
    rod.a = a;
    rod.b = b;
    rod.length = length;
    rod.frame.col(0) = axis;
    rod.frame.col(1) = (thin - axis * axis.dot(thin)).normalized();
    rod.frame.col(2) = rod.frame.col(0).cross(rod.frame.col(1));
    const Vec3 chord = model.chain.nodes[size_t(b)].position - model.chain.nodes[size_t(a)].position;
    rod.rest_strain = rod.frame.transpose() * chord / rod.length;
    rod.rest_curvature.setZero();
    give_set(rod, Vec3::Zero());
    return rod;
}

// Makes a segment from below a tie to what is above, likewise.
RodSegment make_closing_segment(const Model& model, const ChainLoop& loop) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    const Section& section = model.sections[size_t(loop.below)];
    const Vec3 way = nodes[size_t(loop.above)].position - nodes[size_t(loop.below)].position;
    const Vec3 axis = way.normalized();
    const bool is_along = std::abs(axis.dot(section.thin)) > 0.99 * section.thin.norm();
    RodSegment rod =
        make_segment(model, loop.below, loop.above, way.norm(), axis, is_along ? section.axis : section.thin);
    rod.closes_loop = true;
    return rod;
}

// Returns for each root of the chain the first root of the same body, or -1: itself. Where the cage is connected,
// organs are one body although their chains begin apart.
std::vector<int> find_ties(const Model& model) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::vector<int> tie(nodes.size(), -1);
    if (model.chain_embedding.tet.size() != nodes.size()) return tie;
    UnionFind bodies(model.cage.nodes.size());
    for (const Tet& tet : model.cage.tets)
        for (int corner : tet) bodies.join(tet[0], corner);
    std::map<int, int> first;  // by body
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].parent >= 0) continue;
        const int body = bodies.find(model.cage.tets[size_t(model.chain_embedding.tet[i])][0]);
        const auto [known, is_new] = first.insert({body, int(i)});
        if (!is_new) tie[i] = known->second;
    }
    return tie;
}

// Makes a segment between two roots of one body, as stiff as the stiffest one that begins there and without fibres that
// could yield or break. Where the ground holds both it does nothing.
RodSegment make_tie(const Model& model, int root, int other, const std::vector<RodSegment>& segments) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    const Vec3 way = nodes[size_t(other)].position - nodes[size_t(root)].position;
    double stiff = 0, stretch = 0;
    for (const RodSegment& rod : segments) {
        if (rod.a != root && rod.a != other) continue;
        stiff = std::max(stiff, rod.bend.maxCoeff());
        stretch = std::max(stretch, rod.stretch[0]);
    }
    RodSegment tie = {};
    tie.a = root;
    tie.b = other;
    tie.length = way.norm();
    tie.frame.col(0) = way / tie.length;
    tie.frame.col(1) = Vec3(tie.frame.col(0)).unitOrthogonal();
    tie.frame.col(2) = tie.frame.col(0).cross(tie.frame.col(1));
    tie.rest_strain = Vec3::UnitX();
    tie.rest_curvature.setZero();
    give_set(tie, Vec3::Zero());
    const double over = 12 * stiff / (tie.length * tie.length);
    tie.stretch = Vec3(stretch, over, over);
    tie.bend = Vec3::Constant(stiff);
    return tie;
}

void check_segment(const RodSegment& rod) {
    if (!rod.frame.allFinite() || !(rod.stretch.minCoeff() > 0) || !(rod.bend.minCoeff() > 0) ||
        !rod.stretch.allFinite() || !rod.bend.allFinite())
        fail(FROND_RESULT_BAD_GEOMETRY, "capsule %d of the chain has no section; give the model a capsule_height",
             rod.b);
}

// Sets each segment's rest strain and curvature from the weight that it bears. Segments are in the order of their
// second nodes, parents first.
void let_stand(RodElements& elements) {
    const size_t count = elements.mass.size();
    std::vector<Vec3> force(count), moment(count, Vec3::Zero());
    for (size_t i = 0; i < count; ++i) force[i] = Vec3(0, -GRAVITY * elements.mass[i], 0);
    for (size_t s = elements.segments.size(); s-- > 0;) {
        RodSegment& rod = elements.segments[s];
        if (rod.closes_loop) continue;
        const size_t a = size_t(rod.a), b = size_t(rod.b);
        const Vec3 chord = point(elements.modelled, 2 * rod.b) - point(elements.modelled, 2 * rod.a);
        const Vec3 from_end = force[b].cross(chord);
        // Moment by the segment's end on its second node, at the elastic centre.
        const Vec3 couple = (rod.centre / rod.length - 0.5) * from_end - moment[b];
        rod.rest_strain -= (rod.frame.transpose() * force[b]).cwiseQuotient(rod.stretch);
        rod.rest_curvature -= (rod.frame.transpose() * couple).cwiseQuotient(rod.bend);
        force[a] += force[b];
        moment[a] += from_end + moment[b];
    }
}

// Returns whether a segment is a capsule of the chain, neither a tie nor what closes a loop.
bool is_capsule(const Model& model, const RodSegment& rod) {
    return !rod.closes_loop && model.chain.nodes[size_t(rod.b)].parent >= 0;
}

// Adds each segment's rotary inertia, by its section, to its ends; nodes have at least that of a small ball.
void set_inertia(const Model& model, RodElements& elements) {
    const size_t count = elements.mass.size();
    for (size_t i = 0; i < count; ++i) {
        const double r = std::max(model.chain.nodes[i].radius, 1e-4);
        elements.inertia.push_back(0.01 * elements.mass[i] * r * r * Mat3::Identity());
    }
    for (const RodSegment& rod : elements.segments) {
        if (!is_capsule(model, rod)) continue;
        const Section& section = model.sections[size_t(rod.b)];
        const Mat3 whole = rod.frame * Vec3(rod.length * section.rotary_inertia()).asDiagonal() * rod.frame.transpose();
        elements.inertia[size_t(rod.a)] += (1 - section.inertia_at_end()) * whole;
        elements.inertia[size_t(rod.b)] += section.inertia_at_end() * whole;
    }
}

// Sets the mass between the ends of each segment, half of that by linear shape functions. A node's mass is that of its
// segments by their sections; what it carries beyond, by the segment's other end, stays with it.
void share_mass(const Model& model, RodElements& elements) {
    std::vector<double> by_sections(elements.mass.size(), 0.0);
    const auto at_end = [&](const RodSegment& rod) { return model.sections[size_t(rod.b)].mass_at_end(); };
    const auto whole = [&](const RodSegment& rod) { return model.sections[size_t(rod.b)].mass() * rod.length; };
    for (const RodSegment& rod : elements.segments) {
        if (!is_capsule(model, rod)) continue;
        by_sections[size_t(rod.a)] += (1 - at_end(rod)) * whole(rod);
        by_sections[size_t(rod.b)] += at_end(rod) * whole(rod);
    }
    for (RodSegment& rod : elements.segments) {
        if (!is_capsule(model, rod)) continue;
        const size_t a = size_t(rod.a), b = size_t(rod.b);
        const double factor = std::min(elements.mass[a] / by_sections[a], elements.mass[b] / by_sections[b]);
        rod.shared_mass = (1 - at_end(rod)) * at_end(rod) * factor * whole(rod) / 3;
    }
}

// Makes elements from a model with chain, sections and organs; `take` sets each segment's stiffness.
template <class Take>
RodElements make_elements(const Model& model, Take&& take) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    if (nodes.empty()) fail(FROND_RESULT_BAD_GEOMETRY, "the model has no chain");
    if (model.sections.size() != nodes.size() || model.chain_mass.size() != nodes.size() ||
        model.organ_stiffer.size() != model.organs.size() || model.organs.empty())
        fail(FROND_RESULT_INTERNAL, "the model's chain has %zu nodes but not as many sections", nodes.size());
    RodElements out;
    out.node_count = 2 * int(nodes.size());
    out.modelled = VecX::Zero(3 * out.node_count);
    for (size_t i = 0; i < nodes.size(); ++i) point(out.modelled, int(2 * i)) = nodes[i].position;
    out.rest_positions = out.modelled;

    const std::vector<int> ties = find_ties(model);
    std::vector<Tet> pairs;
    const auto add = [&](size_t section, RodSegment rod) {
        take(section, rod);
        check_segment(rod);
        out.segments.push_back(rod);
    };
    for (size_t i = 0; i < nodes.size(); ++i) {
        const int b = int(i);
        if (nodes[i].parent >= 0) {
            const Section& section = model.sections[i];
            add(i, make_segment(model, nodes[i].parent, b, section.length, section.axis, section.thin));
        }
        pairs.push_back({2 * b, 2 * b + 1, 2 * b, 2 * b + 1});
    }
    for (const ChainLoop& loop : model.chain.loops) add(size_t(loop.below), make_closing_segment(model, loop));
    for (size_t i = 0; i < nodes.size(); ++i)
        if (ties[i] >= 0) out.segments.push_back(make_tie(model, ties[i], int(i), out.segments));
    std::stable_sort(out.segments.begin(), out.segments.end(), [](const auto& p, const auto& q) { return p.b < q.b; });
    for (const RodSegment& rod : out.segments) {
        pairs.push_back({2 * rod.a, 2 * rod.a + 1, 2 * rod.b, 2 * rod.b + 1});
        out.section.push_back(rod.closes_loop ? rod.a : rod.b);
        out.damping_ratio.push_back(model.organs[organ_of(model, size_t(out.section.back()))].material.damping_ratio);
    }
    out.pattern = make_block_pattern(out.node_count, pairs);
    for (RodSegment& rod : out.segments) {
        const int ends[4] = {2 * rod.a, 2 * rod.a + 1, 2 * rod.b, 2 * rod.b + 1};
        for (size_t r = 0; r < 4; ++r)
            for (size_t c = 0; c < 4; ++c) rod.slots[4 * r + c] = out.pattern.slot(ends[r], ends[c]);
        FROND_ASSERT(rod.a >= 0 && rod.a < rod.b && 2 * rod.b < out.node_count);
        FROND_ASSERT(*std::min_element(rod.slots.begin(), rod.slots.end()) >= 0);
        FROND_ASSERT((rod.frame.transpose() * rod.frame).isIdentity(1e-6));
    }

    // No node is massless: nothing would resist its acceleration.
    double total = 0;
    for (double m : model.chain_mass) total += m;
    for (double m : model.chain_mass) out.mass.push_back(std::max(m, 1e-6 * total / double(nodes.size())));
    set_inertia(model, out);
    share_mass(model, out);
    find_roots(out);
    FROND_ASSERT(out.section.size() == out.segments.size() && out.damping_ratio.size() == out.segments.size());
    if (model.stands_as_modelled) let_stand(out);
    return out;
}

}  // namespace

void give_set(RodSegment& rod, const Vec3& curvature) {
    rod.set_curvature = curvature;
    const Vec3 turn = rod.frame * curvature * rod.length;
    const double angle = turn.norm();
    rod.set_w = cos(0.25 * angle);
    rod.set_p = angle > 0 ? Vec3(turn * (sin(0.25 * angle) / angle)) : Vec3::Zero();
}

void find_roots(RodElements& elements) {
    elements.root.resize(elements.mass.size());
    for (size_t i = 0; i < elements.root.size(); ++i) elements.root[i] = int(i);
    // Segments go from a parent to a later node, parents first.
    for (const RodSegment& rod : elements.segments) elements.root[size_t(rod.b)] = elements.root[size_t(rod.a)];
}

RodElements make_spring_elements(const Model& model, const std::vector<double>& radii,
                                 const std::vector<double>& stiffer) {
    return make_elements(model, [&](size_t node, RodSegment& rod) {
        take_cylinder(model, node, radii[node], stiffer.empty() ? 1 : stiffer[organ_of(model, node)], rod);
    });
}

RodElements make_rod_elements(const Model& model, frond_mechanics which) {
    if (which == FROND_MECHANICS_ROD)
        return make_elements(model, [&](size_t node, RodSegment& rod) { take_section(model, node, rod); });
    std::vector<double> radii;
    for (const ChainNode& node : model.chain.nodes) radii.push_back(node.radius);
    return make_spring_elements(model, radii, model.rest_shapes->springs);
}

std::unique_ptr<const Elements> make_rods(const Model& model, frond_mechanics which) {
    auto elements = std::make_unique<RodElements>(make_rod_elements(model, which));
    let_rods_yield(model, *elements);
    let_break(model, mechanics(which), *elements);
    return elements;
}

// Lumped: each node's own mass. Consistent: the mean of that and of linear shape functions (Goudreau, Taylor 1972),
// 5/12 of a segment's mass at each end and 1/12 between them, since their errors are opposite: the third mode of ten
// segments is 2.5 % too slow with the one, 3.7 % too fast with the other and 0.4 % too fast with their mean.
Masses rod_masses(const Elements& body, frond_mass mass) {
    const RodElements& elements = as_rods(body);
    Masses masses;
    masses.lumped = mass == FROND_MASS_LUMPED;
    masses.node = VecX::Zero(elements.node_count);
    masses.slot.assign(elements.pattern.row.size(), 0.0);
    for (size_t i = 0; i < elements.mass.size(); ++i) {
        masses.node[Eigen::Index(2 * i)] = elements.mass[i];
        masses.slot[size_t(elements.pattern.slot(int(2 * i), int(2 * i)))] = elements.mass[i];
    }
    if (masses.lumped) return masses;
    for (const RodSegment& rod : elements.segments) {
        masses.slot[size_t(rod.slots[0])] -= rod.shared_mass;
        masses.slot[size_t(rod.slots[10])] -= rod.shared_mass;
        masses.slot[size_t(rod.slots[8])] += rod.shared_mass;
    }
    return masses;
}

}  // namespace frond
