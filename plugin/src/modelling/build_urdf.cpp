#include "modelling/build_urdf.hpp"

#include "core/decompose.hpp"
#include "core/error.hpp"
#include "io/urdf_pieces.hpp"
#include "skeleton/organ_correct.hpp"
#include "skeleton/topology_joints.hpp"

namespace frond {

static void find_organs_of_links(const UrdfTree& tree, const std::vector<int>& link_of_part, const frond_model_def& def,
                                 Model& model) {
    name_organs(tree, link_of_part, model.surface, model.organs);
    override_materials(model.organs, def.organs, def.organ_count);
}

// Sets sections as the file gives them, from the link of each organ.
static void take_sections(const UrdfTree& tree, const std::vector<int>& link_of_part, const Quat& turn, Model& model) {
    const std::vector<UrdfFrame> frames = link_frames(tree);
    std::vector<int> link_of_organ(model.organs.size(), -1);
    for (size_t p = 0; p < link_of_part.size(); ++p)
        link_of_organ[size_t(model.surface.parts[p].organ)] = link_of_part[p];
    for (size_t i = 0; i < model.sections.size(); ++i) {
        const int number = link_of_organ[size_t(model.chain.nodes[i].organ)];
        const UrdfLink& link = tree.links[size_t(number)];
        if (link.section_mass == 0) continue;
        Section& section = model.sections[i];
        const Vec3 x = turn * frames[size_t(number)].turn * Vec3::UnitX();
        section.thin = (x - x.dot(section.axis) * section.axis).normalized();
        section.area = link.stretching / section.young;
        section.density = link.section_mass / section.area;
        section.inertia_thin = link.bending_x / section.young;
        section.inertia_wide = link.bending_y / section.young;
        section.torsion = link.twisting / section.shear;
        section.taper = link.taper;
    }
}

// Returns which stems the file describes as one capsule, with its section; none if the caller gives capsules' length.
static std::vector<uint8_t> find_capsules(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces,
                                          const frond_model_def& def) {
    std::vector<uint8_t> are_capsules;
    for (const UrdfPiece& piece : pieces)
        are_capsules.push_back(def.capsule_height <= 0 && tree.links[size_t(piece.link)].section_mass > 0);
    return are_capsules;
}

// Parts are named by the number of their stem until the chain is made of them, and then after their links.
static void build_stems(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces, const Quat& turn,
                        const frond_model_def& def, Model& model) {
    const std::vector<frond_stem> stems = stems_of(tree, pieces);
    const Surface made = surface_from_stems(stems.data(), int(stems.size()));
    model.surface = made;
    place_surface(model.surface, import_options(def));
    const Timer timer;
    model.topology = make_topology(model.surface);
    model.organs = find_organs(model.surface, model.topology);
    std::vector<int> links;
    for (Part& part : model.surface.parts) {
        const UrdfPiece& piece = pieces[size_t(std::stoi(part.name.substr(5)))];
        links.push_back(piece.link);
        part.material = piece.shape->material;
        if (piece.shape->has_color) part.color = piece.shape->color;
    }
    find_organs_of_links(tree, links, def, model);
    model.chain = make_chain_of_stems(stems.data(), int(stems.size()), model.surface, placement_of(made, model.surface),
                                      model.organs, {def.capsule_height, def.capsule_radius, {}}, model.sections,
                                      find_capsules(tree, pieces, def));
    model.exact_sections = true;
    take_sections(tree, links, turn, model);
    merge_organs(tree, links, model.surface, model.chain, model.organs);
    model.organ_stiffer.assign(model.organs.size(), 1.0);
    for (size_t p = 0; p < links.size(); ++p) model.surface.parts[p].name = tree.links[size_t(links[p])].name;
    model.ms_chain = timer.ms();
}

static int part_of_link(const Surface& surface, const std::string& link) {
    for (size_t p = 0; p < surface.parts.size(); ++p)
        if (surface.parts[p].name == link) return int(p);
    return -1;
}

// Finds where links join; `placed` is the surface's placement.
static std::vector<Seam> seams_of(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces, const Quat& turn,
                                  const Surface& surface, const StemPlacement& placed) {
    const std::vector<UrdfFrame> frames = link_frames(tree);
    const std::vector<int> parents = shown_parents(tree, pieces);
    std::vector<Seam> seams;
    for (size_t i = 0; i < tree.links.size(); ++i) {
        if (parents[i] < 0) continue;
        const int child = part_of_link(surface, tree.links[i].name);
        const int parent = part_of_link(surface, tree.links[size_t(parents[i])].name);
        if (child >= 0 && parent >= 0) seams.push_back({child, parent, placed.image(turn * frames[i].origin)});
    }
    return seams;
}

static void build_surface(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces, const Quat& turn,
                          const frond_model_def& def, Model& model) {
    Surface made = surface_of_pieces(tree, pieces);
    clean_surface(made);
    model.surface = made;
    place_surface(model.surface, import_options(def));
    const Timer timer;
    model.topology = make_topology(model.surface);
    join_at(model.surface, seams_of(tree, pieces, turn, model.surface, placement_of(made, model.surface)),
            model.topology);
    model.organs = find_organs(model.surface, model.topology);
    std::vector<int> links;
    for (const Part& part : model.surface.parts)
        for (size_t i = 0; i < tree.links.size(); ++i)
            if (tree.links[i].name == part.name) links.push_back(int(i));
    find_organs_of_links(tree, links, def, model);
    model.organ_stiffer.assign(model.organs.size(), 1.0);
    find_chain(model, def);
    model.ms_chain = timer.ms();
}

static std::shared_ptr<const Model> build(const UrdfTree& tree, const frond_model_def& def, const Timer& total) {
    auto model = std::make_shared<Model>();
    // URDF has +z up.
    const bool is_upright = import_options(def).up.isZero(0);
    const Quat turn = is_upright ? turn_between(Vec3::UnitZ(), Vec3::UnitY()) : Quat::Identity();
    const std::vector<UrdfPiece> pieces = list_pieces(tree, turn);
    model->ms_import = total.ms();
    if (are_stems(pieces))
        build_stems(tree, pieces, turn, def, *model);
    else
        build_surface(tree, pieces, turn, def, *model);
    if (is_upright) model->surface.up = Vec3::UnitZ();
    build_body(*model, def);
    return finished(std::move(model), total);
}

std::shared_ptr<const Model> build_from_urdf(const std::string& path, const frond_model_def& def) {
    const Timer total;
    const UrdfTree tree = import_urdf(path, UrdfUse::SEEN);
    try {
        return build(tree, def, total);
    } catch (const Error& error) {
        throw Error(error.code, path.substr(path.rfind('/') + 1) + ": " + error.what());
    }
}

}  // namespace frond
