// frond_model_*, frond_material_*.
#include <algorithm>
#include <cstring>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "core/platform/files.hpp"
#include "modelling/build.hpp"
#include "modelling/cook.hpp"

using namespace frond;

constexpr int LARGEST_COUNT = 20'000'000;  // largest number of vertices or triangles that a caller may pass

static void check_model_def(const frond_model_def* def) {
    check_def(def, 'M', "model");
    check_vec(def->up, "def.up");
    check_range(def->scale, 0, 1e9, "def.scale [m per unit]");
    check_range(def->capsule_height, 0, 1e6, "def.capsule_height [m]");
    check_range(def->capsule_radius, 0, 1e6, "def.capsule_radius [m]");
    check_range(def->cage_size, 0, 1e6, "def.cage_size [m]");
    check_range(def->cage_offset, 0, 1e6, "def.cage_offset [m]");
    check_range(def->cage_smoothness, 0, 1, "def.cage_smoothness");
    if (!(def->allow_stiffening >= 1))
        fail(FROND_RESULT_BAD_ARGUMENT,
             "def.allow_stiffening is %g; give the largest factor that organs may be made stiffer by, 1 and more",
             def->allow_stiffening);
    check_row(def->rest, FROND_REST_COUNT, "def.rest");
    check_range(def->organ_count, 0, 10000, "def.organ_count");
    if (def->organ_count > 0) check_pointer(def->organs, "def.organs");
    for (int i = 0; i < def->organ_count; i++) check_text(def->organs[i].organ, "def.organs[].organ");
    check_range(def->correction_count, 0, 100000, "def.correction_count");
    if (def->correction_count > 0) check_pointer(def->corrections, "def.corrections");
    for (int i = 0; i < def->correction_count; i++) check_text(def->corrections[i].organ, "def.corrections[].organ");
}

// A model is as it was built, so a def that asks for something else would be of no effect.
static void check_no_wish(const frond_model_def& def) {
    const frond_model_def plain = frond_default_model_def();
    const char* wish = def.scale != plain.scale                                                         ? "scale"
                       : Vec3(def.up.x, def.up.y, def.up.z) != Vec3(plain.up.x, plain.up.y, plain.up.z) ? "up"
                       : def.capsule_height != plain.capsule_height     ? "capsule_height"
                       : def.capsule_radius != plain.capsule_radius     ? "capsule_radius"
                       : def.cage_size != plain.cage_size               ? "cage_size"
                       : def.cage_offset != plain.cage_offset           ? "cage_offset"
                       : def.cage_smoothness != plain.cage_smoothness   ? "cage_smoothness"
                       : def.rest != plain.rest                         ? "rest"
                       : def.organ_count != 0                           ? "organs"
                       : def.allow_stiffening != plain.allow_stiffening ? "allow_stiffening"
                       : def.correction_count != 0                      ? "corrections"
                                                                        : nullptr;
    if (wish)
        fail(FROND_RESULT_BAD_ARGUMENT,
             "def.%s is set, but a cooked model is as it was built; pass frond_default_model_def(), or set it and cook "
             "the plant's own file anew",
             wish);
}

// Runs a build and gives its model a handle.
template <class Build>
static frond_result open_model(const frond_model_def* def, frond_model* out, Build&& build) {
    return give(out, [&] {
        check_model_def(def);
        return handle_for<frond_model>(build());
    });
}

// Fills a view from a model; zero on failure.
template <class View, class Fill>
static frond_result view_model(frond_model model, View* out, Fill&& fill) {
    return give(out, [&] {
        View view = {};
        fill(*get(model), view);
        return view;
    });
}

static void describe(const Model& model, frond_model_info& info) {
    const Surface& surface = model.surface;
    info.vertex_count = int(surface.positions.size());
    info.triangle_count = int(surface.triangles.size());
    info.part_count = int(surface.parts.size());
    info.texture_count = int(surface.textures.size());
    info.organ_count = int(model.organs.size());
    info.component_count = model.topology.component_count;
    info.joint_count = int(model.topology.joints.size());
    info.dropped_triangles = surface.dropped_triangles;
    info.repaired_vertices = surface.repaired_vertices;
    info.scale = surface.scale;
    info.up = from_vec(surface.up);
    info.lower = from_vec(surface.lower());
    info.upper = from_vec(surface.upper());
    info.node_count = int(model.cage.nodes.size());
    info.tet_count = int(model.cage.tets.size());
    info.min_dihedral = model.cage_report.min_dihedral;
    info.max_dihedral = model.cage_report.max_dihedral;
    info.min_volume = model.cage_report.min_volume;
    info.contained = model.cage_report.contained;
    info.attachment_error = model.cage_report.attachment_error;
    info.volume = model.cage_report.volume;
    info.mass = model.mass();
    info.stiffening_factor = model.stiffening_factor;
    info.chain_node_count = int(model.chain.nodes.size());
    info.capsule_count = int(model.capsules.size());
    info.root_count = model.chain.root_count();
    info.fork_count = model.chain.fork_count();
    info.chain_length = model.chain.length();
    info.ms_import = model.ms_import;
    info.ms_cage = model.ms_cage;
    info.ms_chain = model.ms_chain;
    info.ms_total = model.ms_total;
}

static void widen(frond_range& range, double value, bool first) {
    range = first ? frond_range{value, value} : frond_range{std::min(range.lower, value), std::max(range.upper, value)};
}

static void describe_sections(const Model& model, int organ, frond_organ& view) {
    for (size_t i = 0; i < model.sections.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.organ != organ || node.parent < 0) continue;
        const Section& section = model.sections[i];
        const bool first = view.capsule_count++ == 0;
        view.length += section.length;
        widen(view.thickness, section.thickness, first);
        widen(view.width, section.width, first);
        widen(view.area, section.area, first);
        widen(view.bending_thin, section.bending_thin(), first);
        widen(view.bending_wide, section.bending_wide(), first);
        widen(view.torsion, section.twisting(), first);
    }
}

extern "C" {

frond_result frond_material_preset(const char* kind, frond_material* out) {
    return give(out, [&] {
        check_pointer(kind, "kind");
        const Material* material = material_preset(kind);
        if (!material)
            fail(FROND_RESULT_BAD_ARGUMENT, "there is no material \"%.64s\"; there are %s", kind,
                 material_kinds().c_str());
        return *material;
    });
}

frond_result frond_model_load(const char* path, const frond_model_def* def, frond_model* out) {
    return open_model(def, out, [&] {
        check_text(path, "path");
        if (is_cooked(path)) check_no_wish(*def);
        return build_from_file(path, *def);
    });
}

frond_result frond_model_from_triangles(const float* xyz, int vertex_count, const int32_t* indices, int triangle_count,
                                        const frond_model_def* def, frond_model* out) {
    return open_model(def, out, [&] {
        check_pointer(xyz, "xyz");
        check_pointer(indices, "indices");
        check_range(vertex_count, 3, LARGEST_COUNT, "vertex_count");
        check_range(triangle_count, 1, LARGEST_COUNT, "triangle_count");
        return build_from_surface(surface_from_triangles(xyz, vertex_count, indices, triangle_count), *def);
    });
}

frond_result frond_model_from_stems(const frond_stem* stems, int stem_count, const frond_model_def* def,
                                    frond_model* out) {
    return open_model(def, out, [&] {
        check_pointer(stems, "stems");
        check_range(stem_count, 1, 100000, "stem_count");
        return build_from_stems(stems, stem_count, *def);
    });
}

frond_result frond_model_from_stem_sections(const frond_stem* stems, const frond_stem_section* sections, int stem_count,
                                            const frond_model_def* def, frond_model* out) {
    return open_model(def, out, [&] {
        check_pointer(stems, "stems");
        check_pointer(sections, "sections");
        check_range(stem_count, 1, 100000, "stem_count");
        return build_from_stems(stems, stem_count, *def, sections);
    });
}

frond_result frond_model_from_tets(const double* xyz, int node_count, const int32_t* tets, int tet_count,
                                   const frond_model_def* def, frond_model* out) {
    return open_model(def, out, [&] {
        check_pointer(xyz, "xyz");
        check_pointer(tets, "tets");
        check_range(node_count, 4, LARGEST_COUNT, "node_count");
        check_range(tet_count, 1, LARGEST_COUNT, "tet_count");
        TetMesh mesh;
        mesh.nodes.reserve(size_t(node_count));
        for (int i = 0; i < node_count; i++) mesh.nodes.push_back(Vec3(xyz + 3 * size_t(i)));
        mesh.tets.resize(size_t(tet_count));
        std::memcpy(mesh.tets.data(), tets, sizeof(Tet) * size_t(tet_count));
        mesh.tet_region.assign(size_t(tet_count), 0);
        mesh.regions = {"stem"};
        return build_from_tets(std::move(mesh), *def);
    });
}

frond_result frond_model_load_bytes(const void* bytes, size_t size, frond_model* out) {
    return give(out, [&] {
        check_pointer(bytes, "bytes");
        return handle_for<frond_model>(model_from_cooked(static_cast<const uint8_t*>(bytes), size));
    });
}

frond_result frond_model_save(frond_model model, const char* path) {
    return call([&] {
        const std::shared_ptr<const Model> found = get(model);
        check_text(path, "path");
        const std::vector<uint8_t> bytes = cook(*found);
        std::string error;
        if (!write_file(path, std::string(bytes.begin(), bytes.end()), error))
            fail(FROND_RESULT_FILE_NOT_FOUND, "%s cannot be written: %s", path, error.c_str());
    });
}

size_t frond_model_get_saved_size(frond_model model) {
    size_t size = 0;
    call([&] { size = cook(*get(model)).size(); });
    return size;
}

frond_result frond_model_save_bytes(frond_model model, void* bytes, size_t size) {
    return call([&] {
        const std::shared_ptr<const Model> found = get(model);
        check_pointer(bytes, "bytes");
        const std::vector<uint8_t> cooked = cook(*found);
        if (size != cooked.size())
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "size is %zu; this model takes %zu bytes now: ask "
                 "frond_model_get_saved_size after its last plant was made",
                 size, cooked.size());
        std::memcpy(bytes, cooked.data(), size);
    });
}

void frond_model_destroy(frond_model model) {
    call([&] { slots<frond_model>().erase(model.id); });
}

bool frond_model_is_valid(frond_model model) {
    return bool(find(model));
}

frond_result frond_model_get_info(frond_model model, frond_model_info* out) {
    return view_model(model, out, describe);
}

frond_result frond_model_get_part(frond_model model, int part, frond_part* out) {
    return view_model(model, out, [&](const Model& m, frond_part& view) {
        check_range(part, 0, double(m.surface.parts.size()) - 1, "part");
        const Part& p = m.surface.parts[size_t(part)];
        const Organ& organ = m.organs[size_t(p.organ)];
        view.name = p.name.c_str();
        view.material = p.material.c_str();
        view.organ = organ.name.c_str();
        view.kind = organ.kind.c_str();
        view.first_triangle = p.first_triangle;
        view.triangle_count = p.triangle_count;
        std::copy(p.color.begin(), p.color.end(), view.color);
        view.texture = p.texture;
    });
}

frond_result frond_model_get_organ(frond_model model, int organ, frond_organ* out) {
    return view_model(model, out, [&](const Model& m, frond_organ& view) {
        check_range(organ, 0, double(m.organs.size()) - 1, "organ");
        const Organ& o = m.organs[size_t(organ)];
        view.name = o.name.c_str();
        view.kind = o.kind.c_str();
        view.why = o.why.c_str();
        view.certainty = o.certainty;
        view.parent = m.organ_parents[size_t(organ)];
        view.material = o.material;
        view.mass = m.organ_mass[size_t(organ)];
        describe_sections(m, organ, view);
    });
}

frond_result frond_model_get_capsule_organs(frond_model model, int32_t* out, int capsule_count) {
    return call([&] {
        const std::shared_ptr<const Model> found = get(model);
        check_count(capsule_count, int(found->capsules.size()), "capsule_count", "model");
        if (capsule_count > 0) check_pointer(out, "out");
        for (const auto& [begin, end] : found->capsules) *out++ = int32_t(found->chain.nodes[size_t(end)].organ);
    });
}

frond_result frond_model_get_texture(frond_model model, int texture, frond_texture_view* out) {
    return view_model(model, out, [&](const Model& m, frond_texture_view& view) {
        check_range(texture, 0, double(m.surface.textures.size()) - 1, "texture");
        const Texture& t = m.surface.textures[size_t(texture)];
        view = {t.name.c_str(), t.bytes.data(), t.bytes.size()};
    });
}

frond_result frond_model_get_cage(frond_model model, frond_cage_view* out) {
    return view_model(model, out, [&](const Model& m, frond_cage_view& view) {
        view.nodes = m.cage.nodes.front().data();
        view.tets = m.cage.tets.front().data();
        view.node_count = int(m.cage.nodes.size());
        view.tet_count = int(m.cage.tets.size());
    });
}

frond_result frond_model_get_chain(frond_model model, frond_chain_view* out) {
    return view_model(model, out, [&](const Model& m, frond_chain_view& view) {
        view.nodes = m.chain_view.positions.data();
        view.radii = m.chain_view.radii.data();
        view.parents = m.chain_view.parents.data();
        view.node_count = int(m.chain.nodes.size());
    });
}

}  // extern "C"
