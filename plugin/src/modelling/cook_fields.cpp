// The fields of a cooked model. Each struct is taken apart into all of its members, so that a new one does not compile
// until it stands here.
#include "modelling/cook.hpp"
#include "surface/surface_fields.hpp"

namespace frond {

static void visit(Archive& a, Joint& joint) {
    auto& [triangle_a, triangle_b, point_a, point_b] = joint;
    a(triangle_a, triangle_b, point_a, point_b);
}

static void visit(Archive& a, Topology& topology) {
    auto& [points, vertex_point, triangles, triangle_component, turned, component_count, joints] = topology;
    a(points, vertex_point, triangles, triangle_component, turned, component_count, joints);
}

static void visit(Archive& a, Material& material) {
    auto& [density, young, poisson, thickness, hollow, twist_to_bend, damping_ratio, friction, yield_strain, creep_rate,
           strength, drag, midrib, restitution] = material;
    a(density, young, poisson, thickness, hollow, twist_to_bend, damping_ratio, friction, yield_strain, creep_rate,
      strength, drag, midrib, restitution);
}

static void visit(Archive& a, Organ& organ) {
    auto& [name, kind, material, young_given, midrib_given, why, certainty, opacity] = organ;
    a(name, kind, material, young_given, midrib_given, why, certainty, opacity);
}

static void visit(Archive& a, ChainNode& node) {
    auto& [position, radius, parent, organ, distance, fitted_radius] = node;
    a(position, radius, parent, organ, distance, fitted_radius);
}

static void visit(Archive& a, ChainLoop& loop) {
    auto& [below, above] = loop;
    a(below, above);
}

static void visit(Archive& a, Chain& chain) {
    auto& [nodes, loops, vertex_node, vertex_capsule, vertex_along, rib_of, height] = chain;
    a(nodes, loops, vertex_node, vertex_capsule, vertex_along, rib_of, height);
}

static void visit(Archive& a, Section& section) {
    auto& [axis, thin, length, area, inertia_thin, inertia_wide, torsion, thickness, width, density, young, shear,
           taper] = section;
    a(axis, thin, length, area, inertia_thin, inertia_wide, torsion, thickness, width, density, young, shear, taper);
}

static void visit(Archive& a, Cage& cage) {
    auto& [nodes, tets, tet_organ, tet_fill, organ_tissue] = cage;
    a(nodes, tets, tet_organ, tet_fill, organ_tissue);
}

static void visit(Archive& a, Embedding& embedding) {
    auto& [tet, weights] = embedding;
    a(tet, weights);
}

static void visit(Archive& a, RestShapes& shapes) {
    auto& [mutex, known, positions, stiffer, quadratic_young, springs] = shapes;
    a(known, positions, stiffer, quadratic_young, springs);
}

static void visit(Archive& a, CageReport& report) {
    auto& [min_dihedral, max_dihedral, min_volume, volume, contained, attachment_error] = report;
    a(min_dihedral, max_dihedral, min_volume, volume, contained, attachment_error);
}

static void visit(Archive& a, frond_vec3& v) {
    auto& [x, y, z] = v;
    a(x, y, z);
}

static void visit(Archive& a, frond_stem& stem) {
    auto& [parent, begin, end, radius_begin, radius_end] = stem;
    a(parent, begin, end, radius_begin, radius_end);
}

static void visit(Archive& a, frond_stem_section& section) {
    auto& [outline, width, thickness, thin, twist, hollow, young_begin, young_end] = section;
    a.one_of(outline, FROND_OUTLINE_COUNT);
    a(width, thickness, thin, twist, hollow, young_begin, young_end);
}

static void visit(Archive& a, StemSource& source) {
    auto& [stems, sections, placed, radius] = source;
    auto& [turn, scale, shift] = placed;
    a(stems, sections, turn, scale, shift, radius);
}

// Capsules, parents of organs and the view of the chain follow from the chain; what it took to build the model is of no
// use to one that is loaded.
void visit(Archive& a, Model& model) {
    auto& [surface, topology, organs, chain, chain_view, sections, exact_sections, stem_source, chain_mass, organ_mass,
           organ_stiffer, calibrated, stands_as_modelled, capsules, organ_parents, cage, has_own_tets, embedding,
           chain_embedding, tet_density, tet_young, tet_poisson, root, rest_shapes, stiffening_factor, cage_report,
           ms_import, ms_cage, ms_chain, ms_total] = model;
    a(surface, topology, organs, chain, sections, exact_sections, stem_source, chain_mass, organ_mass, organ_stiffer,
      calibrated, stands_as_modelled, cage, has_own_tets, embedding, chain_embedding, tet_density, tet_young,
      tet_poisson, root, *rest_shapes, stiffening_factor, cage_report);
}

}  // namespace frond
