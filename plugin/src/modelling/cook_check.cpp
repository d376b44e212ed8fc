// Checks of a model: whatever it was made of, plants that are made of it index within its arrays and divide by
// nothing that is zero.
#include <cmath>
#include <cstdlib>

#include "cage/tet_geometry.hpp"
#include "core/convert.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "mechanics/tet_element.hpp"
#include "mechanics/tet_nodes.hpp"
#include "modelling/cook.hpp"

namespace frond {
namespace {

constexpr double LARGEST_NUMBER = 1e18;  // of moduli, densities and the like, in their units
constexpr double LARGEST_MOMENT =
    LARGEST_COORDINATE * LARGEST_COORDINATE * LARGEST_COORDINATE * LARGEST_COORDINATE;  // [m^4]

struct Fault {
    std::string text;
};

void need(bool holds, const char* what) {
    if (!holds) throw Fault{what};
}
bool is_index(int value, size_t count) {
    return value >= 0 && size_t(value) < count;
}
template <class List>
void need_indices(const List& list, size_t count, const char* what) {
    for (int value : list) need(is_index(value, count), what);
}
template <class List>
void need_corners(const List& list, size_t count, const char* what) {
    for (const auto& corners : list) need_indices(corners, count, what);
}
bool is_place(const Vec3& place) {
    return place.allFinite() && place.cwiseAbs().maxCoeff() <= LARGEST_COORDINATE;
}
void need_places(const std::vector<Vec3>& list, const char* what) {
    for (const Vec3& place : list) need(is_place(place), what);
}
bool is_in(double value, double least, double most) {
    return value >= least && value <= most;
}
bool is_positive(double value) {
    return value > 0 && value <= LARGEST_NUMBER;
}
void need_positive(const std::vector<double>& list, const char* what) {
    for (double value : list) need(is_positive(value), what);
}

void check_parts(const Model& model) {
    const Surface& surface = model.surface;
    int64_t next = 0;
    for (const Part& part : surface.parts) {
        need(part.first_triangle == next && part.triangle_count >= 0, "its parts leave triangles out");
        next += part.triangle_count;
        need(is_index(part.organ, model.organs.size()), "a part is of no organ");
        need(part.texture >= -1 && part.texture < int(surface.textures.size()), "a part has no such texture");
        for (float channel : part.color) need(std::isfinite(channel), "a part has no colour");
    }
    need(next == int64_t(surface.triangles.size()), "its parts leave triangles out");
}

void check_surface(const Model& model) {
    const Surface& surface = model.surface;
    const size_t count = surface.positions.size(), most = size_t(MAX_TRIANGLES);
    need(count >= 3 && !surface.triangles.empty(), "it has no surface");
    need(count <= 3 * most && surface.triangles.size() <= most, "it has too many triangles");
    need(surface.normals.size() == count, "vertices have no normals");
    need(surface.uvs.empty() || surface.uvs.size() == count, "some vertices have texture coordinates");
    need(surface.colors.empty() || surface.colors.size() == count, "some vertices have colours");
    need_places(surface.positions, "a vertex is nowhere");
    for (const Vec3f& normal : surface.normals) need(normal.allFinite(), "a normal is not finite");
    for (const Vec2f& uv : surface.uvs) need(uv.allFinite(), "a texture coordinate is not finite");
    need_corners(surface.triangles, count, "a triangle has no such vertex");
    need(is_positive(surface.scale) && is_place(surface.up), "its scale or up axis are no such");
    check_parts(model);
}

void check_topology(const Model& model) {
    const Topology& topology = model.topology;
    const size_t triangles = model.surface.triangles.size();
    need(topology.triangles.size() == triangles && topology.triangle_component.size() == triangles &&
             topology.turned.size() == triangles && topology.vertex_point.size() == model.surface.positions.size(),
         "its topology is of another surface");
    need(is_in(topology.component_count, 1, double(triangles)), "it has no components");
    need_places(topology.points, "a point is nowhere");
    need_indices(topology.vertex_point, topology.points.size(), "a vertex has no point");
    need_corners(topology.triangles, topology.points.size(), "a triangle has no such point");
    need_indices(topology.triangle_component, size_t(topology.component_count), "a triangle has no component");
    for (const Joint& joint : topology.joints)
        need(is_index(joint.triangle_a, triangles) && is_index(joint.triangle_b, triangles) &&
                 is_place(joint.point_a) && is_place(joint.point_b),
             "a joint has no such triangle");
}

void check_organs(const Model& model) {
    need(!model.organs.empty() && model.organ_stiffer.size() == model.organs.size(), "it has no organs");
    need_positive(model.organ_stiffer, "an organ's stiffness is out of range");
    for (const Organ& organ : model.organs) {
        need(material_preset(organ.kind) != nullptr, "an organ is of no known kind");
        need(organ.opacity > 0 && organ.opacity <= 1, "an organ's opacity is out of range");
        try {
            check_material(organ.material, organ.kind);
        } catch (const Error& error) {
            throw Fault{error.what()};
        }
    }
}

void check_section(const Section& section) {
    need(is_in(section.axis.norm(), 1 - 1e-6, 1 + 1e-6) && is_in(section.thin.norm(), 1 - 1e-6, 1 + 1e-6) &&
             std::abs(section.axis.dot(section.thin)) < 1e-6,
         "a section has no axes");
    for (double value : {section.length, section.area, section.thickness, section.width, section.density, section.young,
                         section.shear})
        need(is_positive(value), "a section's number is out of range");
    for (double moment : {section.inertia_thin, section.inertia_wide, section.torsion})
        need(moment > 0 && moment <= LARGEST_MOMENT, "a section's moment of area is out of range");
    need(std::abs(section.taper) <= LARGEST_TAPER, "a section tapers too much");
}

void check_chain(const Model& model) {
    const Chain& chain = model.chain;
    const size_t count = chain.nodes.size(), vertices = model.surface.positions.size();
    need(count > 0 && model.sections.size() == count && model.chain_mass.size() == count, "it has no chain");
    for (size_t i = 0; i < count; i++) {
        const ChainNode& node = chain.nodes[i];
        need(node.parent >= -1 && node.parent < int(i), "a node of the chain comes before its parent");
        need(is_index(node.organ, model.organs.size()), "a node of the chain is of no organ");
        need(is_place(node.position) && is_positive(node.radius) && is_in(node.distance, 0, LARGEST_NUMBER) &&
                 is_in(node.fitted_radius, 0, LARGEST_NUMBER),
             "a node of the chain has a number out of range");
        need(is_in(model.chain_mass[i], 0, LARGEST_NUMBER), "a node of the chain has no mass");
        if (node.parent < 0) continue;
        need((node.position - chain.nodes[size_t(node.parent)].position).norm() > 0, "a capsule has no length");
        check_section(model.sections[i]);
    }
    for (const auto& [below, above] : chain.loops)
        need(is_index(above, count) && below >= 0 && below < above && chain.nodes[size_t(below)].parent >= 0 &&
                 chain.nodes[size_t(below)].position != chain.nodes[size_t(above)].position,
             "a loop of the chain has no ends");
    need(chain.vertex_node.size() == vertices && chain.vertex_capsule.size() == vertices &&
             chain.vertex_along.size() == vertices,
         "its chain is of another surface");
    need_indices(chain.vertex_node, count, "a vertex has no node of the chain");
    need_indices(chain.vertex_capsule, count, "a vertex has no capsule");
    for (double along : chain.vertex_along) need(is_in(along, 0, 1), "a vertex is off its capsule");
    need(chain.rib_of.empty() || chain.rib_of.size() == model.organs.size(), "its ribs are of other organs");
    for (int blade : chain.rib_of) need(blade == -1 || is_index(blade, model.organs.size()), "a rib has no blade");
    need(is_in(chain.height, 0, LARGEST_COORDINATE), "the chain has no height");
}

// Returns whether a part is named by the number of a stem, as surface_from_stems() names it.
bool is_named_by_stem(const std::string& name, size_t count) {
    constexpr size_t BEFORE = 5;  // length of "stem_"
    if (name.size() <= BEFORE) return false;
    const long number = std::strtol(name.c_str() + BEFORE, nullptr, 10);
    return number >= 0 && size_t(number) < count && name == "stem_" + std::to_string(number);
}

void check_stems(const Model& model) {
    const StemSource& source = model.stem_source;
    const size_t count = source.stems.size();
    need(source.sections.empty() || source.sections.size() == count, "some stems have sections");
    need(is_in(source.radius, 0, LARGEST_COORDINATE) && is_positive(source.placed.scale) &&
             is_place(source.placed.shift) && source.placed.turn.isUnitary(1e-6),
         "its stems stand nowhere");
    for (size_t i = 0; i < count; i++) {
        const frond_stem& stem = source.stems[i];
        const Vec3 begin = to_vec(stem.begin), end = to_vec(stem.end);
        need(stem.parent >= -1 && stem.parent < int(i), "a stem comes before its parent");
        need(is_place(begin) && is_place(end) && begin != end && is_positive(stem.radius_begin) &&
                 is_positive(stem.radius_end),
             "a stem has a number out of range");
    }
    try {
        if (!source.sections.empty()) check_stem_sections(source.sections.data(), int(count));
    } catch (const Error& error) {
        throw Fault{error.what()};
    }
    for (const Part& part : model.surface.parts)
        need(count == 0 || is_named_by_stem(part.name, count), "a part is of no stem");
}

void check_embedding(const Embedding& embedding, size_t points, size_t tets) {
    need(embedding.tet.size() == points && embedding.weights.size() == points, "something is not in the cage");
    need_indices(embedding.tet, tets, "something is in no tet");
    for (const auto& weights : embedding.weights) {
        const double sum = weights[0] + weights[1] + weights[2] + weights[3];
        need(is_in(sum, 1 - 1e-6, 1 + 1e-6), "weights in a tet do not add up");
        for (double weight : weights) need(std::abs(weight) <= 1e6, "a weight in a tet is out of range");
    }
}

void check_cage(const Model& model) {
    const Cage& cage = model.cage;
    const size_t tets = cage.tets.size();
    need(tets > 0 && cage.tet_organ.size() == tets && cage.tet_fill.size() == tets &&
             model.tet_density.size() == tets && model.tet_young.size() == tets && model.tet_poisson.size() == tets &&
             model.root.size() == cage.nodes.size(),
         "its cage is not complete");
    need_places(cage.nodes, "a node of the cage is nowhere");
    need_corners(cage.tets, cage.nodes.size(), "a tet has no such node");
    for (const Tet& tet : cage.tets) need(tet_volume(cage.nodes, tet) > 0, "a tet has no volume");
    need_indices(cage.tet_organ, model.organs.size(), "a tet is of no organ");
    need_positive(cage.tet_fill, "a tet is empty");
    need(cage.organ_tissue.empty() || cage.organ_tissue.size() == model.organs.size(), "an organ has no volume");
    need(model.organ_mass.size() == model.organs.size(), "an organ has no mass");
    for (double mass : model.organ_mass) need(is_in(mass, 0, LARGEST_NUMBER), "an organ's mass is out of range");
    for (double tissue : cage.organ_tissue) need(is_in(tissue, 0, LARGEST_NUMBER), "an organ's volume is out of range");
    need_positive(model.tet_density, "a tet's density is out of range");
    need_positive(model.tet_young, "a tet's modulus is out of range");
    for (double poisson : model.tet_poisson) need(is_in(poisson, 0, 0.499), "a tet's Poisson ratio is out of range");
    check_embedding(model.embedding, model.surface.positions.size(), tets);
    check_embedding(model.chain_embedding, model.chain.nodes.size(), tets);
    need(is_positive(model.stiffening_factor), "its stiffening factor is out of range");
}

// Every point of every element has a volume at rest.
template <class Element>
void need_volumes(const TetElements& elements, const VecX& rest) {
    for (size_t e = 0; e < elements.tets.size(); e++) {
        const auto places = Element::places(elements, e, rest);
        for (int q = 0; q < Element::POINTS; q++)
            need(Element::edges(places, q).determinant() *
                         Element::edges(Element::places(elements, e, elements.modelled), q).determinant() >
                     0,
                 "a tet has no volume at rest");
    }
}

void check_rest_shapes(const Model& model) {
    const RestShapes& shapes = *model.rest_shapes;
    const size_t tets = model.cage.tets.size();
    need(shapes.quadratic_young.empty() || shapes.quadratic_young.size() == tets, "moduli are of another cage");
    need_positive(shapes.quadratic_young, "a modulus is out of range");
    need(shapes.springs.empty() || shapes.springs.size() == model.organs.size(), "springs are of other organs");
    need_positive(shapes.springs, "a spring's stiffness is out of range");
    for (int order = 1; order <= HIGHEST_ORDER; order++)
        for (int which = 0; which < FROND_MECHANICS_COUNT; which++) {
            const VecX& rest = shapes.positions[size_t(order - 1)][size_t(which)];
            const std::vector<double>& stiffer = shapes.stiffer[size_t(order - 1)][size_t(which)];
            need(stiffer.empty() || stiffer.size() == tets, "stiffnesses are of another cage");
            need_positive(stiffer, "a stiffness is out of range");
            if (rest.size() == 0) continue;
            const TetElements elements = make_tet_elements(model, nullptr, order);
            need(rest.size() == elements.modelled.size(), "a rest shape is of another cage");
            for (double value : rest) need(std::abs(value) <= LARGEST_COORDINATE, "a rest shape is nowhere");
            order == 1 ? need_volumes<LinearTet>(elements, rest) : need_volumes<QuadraticTetElement>(elements, rest);
        }
}

}  // namespace

std::string find_fault(const Model& model) {
    try {
        check_organs(model);
        check_surface(model);
        check_topology(model);
        check_chain(model);
        check_stems(model);
        check_cage(model);
        check_rest_shapes(model);
        return {};
    } catch (const Fault& fault) {
        return fault.text;
    }
}

void refuse_faults(const Model& model) {
    const std::string fault = find_fault(model);
    if (!fault.empty())
        fail(FROND_RESULT_BAD_GEOMETRY,
             "no plant can be made of this: %s. The plant is %.3g m high and weighs %.3g kg: if that is wrong, set "
             "scale or the materials",
             fault.c_str(), model.surface.height(), model.mass());
}

}  // namespace frond
