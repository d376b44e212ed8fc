// From a surface to a model: topology -> organs -> chain, cage -> calibration.
#include "modelling/build.hpp"

#include <algorithm>

#include "calibration/calibration.hpp"
#include "calibration/weigh.hpp"
#include "core/convert.hpp"
#include "core/decompose.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/timer.hpp"
#include "modelling/attach.hpp"
#include "modelling/build_urdf.hpp"
#include "modelling/cook.hpp"
#include "skeleton/organ_correct.hpp"

namespace frond {

ImportOptions import_options(const frond_model_def& def) {
    return {def.scale, to_vec(def.up), {}, def.corrections_file ? def.corrections_file : "beside"};
}

// Adds the def's corrections to those of a file.
static void add_corrections(const frond_model_def& def, std::vector<OrganCorrection>& corrections) {
    const auto text = [](const char* words) { return words ? std::string(words) : std::string(); };
    for (int i = 0; i < def.correction_count; i++) {
        const frond_organ_correction& one = def.corrections[i];
        corrections.push_back({text(one.organ), text(one.kind), text(one.parent), {}, one.is_root, one.leave_out});
    }
}

// Returns the organs that the plant is said to stand on.
static std::vector<int> find_organs(Model& model, const frond_model_def& def,
                                    const std::vector<OrganCorrection>& corrections) {
    model.topology = make_topology(model.surface);
    model.organs = find_organs(model.surface, model.topology);
    std::vector<int> rooted = correct_organs(corrections, model.surface, model.topology, model.organs);
    override_materials(model.organs, def.organs, def.organ_count);
    model.organ_stiffer.assign(model.organs.size(), 1.0);
    return rooted;
}

// Stems, tets and links have their own structure, which corrections of organs would contradict.
static void refuse_corrections(const frond_model_def& def) {
    if (def.correction_count > 0)
        fail(FROND_RESULT_UNSUPPORTED,
             "def.corrections are for meshes; name the parts of stems, tets and links so that their organs are found");
}

void find_chain(Model& model, const frond_model_def& def, const std::vector<int>& rooted) {
    model.chain =
        make_chain(model.surface, model.topology, model.organs, {def.capsule_height, def.capsule_radius, rooted});
    model.sections = measure_sections(model.surface, model.topology, model.organs, model.chain);
}

static void finish(Model& model) {
    model.root = find_root_nodes(model);
    bind_chain(model);
    give_mass(model);
    model.cage_report = measure_cage(model.surface, model.cage, model.embedding);
}

// Refuses a plant of which an organ is too weak; the cause is rarely the tissue.
static void check_strength(const Model& model, const WeakOrgan& weak, double most) {
    if (weak.factor <= most) return;
    fail(FROND_RESULT_BAD_GEOMETRY,
         "%s, a %s, cannot carry its weight in the shape it was modelled in: it would have to be %.3g times stiffer, "
         "and def.allow_stiffening is %.3g. The plant is %.3g m high, weighs %.3g kg and has %d roots: if that is "
         "wrong, set scale or up; if %s is no %s, set its kind; if it is, set its density, young or thickness; or "
         "allow it",
         weak.name.c_str(), weak.kind.c_str(), weak.factor, most, model.surface.height(), model.mass(),
         model.chain.root_count(), weak.name.c_str(), weak.kind.c_str());
}

// Warns once: about a plant that its materials do not carry, or else one that its cage does not.
static void tell_stiffened(Model& model, const WeakOrgan& weak, const WeakOrgan& in_cage) {
    constexpr double MUCH = 3;          // more than the margin that chosen materials get anyway
    constexpr double MUCH_IN_CAGE = 4;  // cells as coarse as the paper's are not more exact than that
    model.stiffening_factor = std::max(weak.factor, in_cage.factor);
    if (weak.factor >= MUCH)
        warn(
            "%s cannot carry its weight in the shape it was modelled in and was made %.3g times stiffer; check the "
            "scale (the plant is %.3g m high) and the materials",
            weak.name.c_str(), weak.factor, model.surface.height());
    else if (in_cage.factor >= MUCH_IN_CAGE)
        warn("the cage around %s would not stand and was made %.3g times stiffer; a smaller cage_size helps",
             in_cage.name.c_str(), in_cage.factor);
}

void build_body(Model& model, const frond_model_def& def) {
    const Timer timer;
    make_cage(model.surface, model.topology, model.organs, {def.cage_size, def.cage_offset, def.cage_smoothness},
              model.cage, model.embedding);
    model.ms_cage = timer.ms();
    finish(model);
    model.stands_as_modelled = def.rest == FROND_REST_STANDS_AS_MODELLED;
    WeakOrgan weak;
    if (model.stands_as_modelled) {
        weak = strengthen(model);
        check_strength(model, weak, def.allow_stiffening);
    }
    calibrate(model, 1);
    if (!model.stands_as_modelled) return;
    tell_stiffened(model, weak, find_rest_shape(model, 1));
}

std::shared_ptr<const Model> finished(std::shared_ptr<Model> model, const Timer& total) {
    model->ms_total = total.ms();
    refuse_faults(*model);
    return model;
}

static std::shared_ptr<const Model> build(Surface surface, const frond_model_def& def,
                                          const std::vector<OrganCorrection>& corrections, const Timer& total) {
    auto model = std::make_shared<Model>();
    model->surface = std::move(surface);
    model->ms_import = total.ms();
    const Timer timer;
    find_chain(*model, def, find_organs(*model, def, corrections));
    model->ms_chain = timer.ms();
    build_body(*model, def);
    return finished(std::move(model), total);
}

std::shared_ptr<const Model> build_from_surface(Surface surface, const frond_model_def& def) {
    const Timer total;
    place_surface(surface, import_options(def));
    std::vector<OrganCorrection> corrections;
    add_corrections(def, corrections);
    return build(std::move(surface), def, corrections, total);
}

StemPlacement placement_of(const Surface& before, const Surface& after) {
    StemPlacement placed;
    placed.scale = after.scale;
    placed.turn = turn_between(after.up, Vec3::UnitY()).toRotationMatrix();
    placed.shift = after.positions.front() - placed.image(before.positions.front());
    return placed;
}

std::shared_ptr<const Model> build_from_stems(const frond_stem* stems, int stem_count, const frond_model_def& def,
                                              const frond_stem_section* sections) {
    if (sections) check_stem_sections(sections, stem_count);
    const Timer total;
    auto model = std::make_shared<Model>();
    refuse_corrections(def);
    const Surface made = surface_from_stems(stems, stem_count);
    model->surface = made;
    place_surface(model->surface, import_options(def));
    model->ms_import = total.ms();
    const Timer timer;
    find_organs(*model, def, {});
    model->chain =
        make_chain_of_stems(stems, stem_count, model->surface, placement_of(made, model->surface), model->organs,
                            {def.capsule_height, def.capsule_radius, {}}, model->sections, {}, sections);
    model->exact_sections = true;
    model->stem_source.stems.assign(stems, stems + stem_count);
    if (sections) model->stem_source.sections.assign(sections, sections + stem_count);
    model->stem_source.placed = placement_of(made, model->surface);
    model->stem_source.radius = def.capsule_radius;
    model->ms_chain = timer.ms();
    build_body(*model, def);
    return finished(std::move(model), total);
}

std::shared_ptr<const Model> build_from_tets(TetMesh mesh, const frond_model_def& def) {
    const Timer total;
    auto model = std::make_shared<Model>();
    refuse_corrections(def);
    take_tets(std::move(mesh), import_options(def), model->surface, model->cage, model->embedding);
    model->has_own_tets = true;
    model->ms_import = total.ms();
    find_chain(*model, def, find_organs(*model, def, {}));
    finish(*model);
    take_materials(*model);
    return finished(std::move(model), total);
}

std::shared_ptr<const Model> build_from_file(const std::string& path, const frond_model_def& def) {
    if (is_cooked(path)) return load_cooked(path);
    if (is_tet_file(path)) return build_from_tets(import_tets(path), def);
    if (is_urdf(path)) {
        refuse_corrections(def);
        return build_from_urdf(path, def);
    }
    const Timer total;
    Corrections corrections;
    Surface surface = import_surface(path, import_options(def), &corrections);
    frond_model_def allowed = def;
    allowed.allow_stiffening = std::max(def.allow_stiffening, corrections.allow_stiffening);
    add_corrections(def, corrections.organs);
    return build(std::move(surface), allowed, corrections.organs, total);
}

}  // namespace frond
