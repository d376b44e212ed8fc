// frond inspect FILE: prints what was read and repaired, the cage and the chain.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "studio/organ_picture.hpp"
#include "write_corrections.hpp"

namespace frond::tools {
namespace {

struct InspectOptions {
    std::string file, shot, picture;
    bool json = false, write = false;
    std::vector<std::string> assignments;
    View view;
};

nlohmann::ordered_json describe_material(const frond_material& material) {
    return {{"density", material.density},
            {"young", material.young},
            {"poisson", material.poisson},
            {"thickness", material.thickness},
            {"hollow", material.hollow},
            {"twist_to_bend", material.twist_to_bend},
            {"damping_ratio", material.damping_ratio},
            {"friction", material.friction},
            {"yield_strain", material.yield_strain},
            {"creep_rate", material.creep_rate},
            {"strength", material.strength},
            {"drag", material.drag},
            {"midrib", material.midrib},
            {"restitution", material.restitution}};
}

nlohmann::ordered_json describe_organ(const frond_organ& organ) {
    const auto range = [](const frond_range& r) { return nlohmann::ordered_json{r.lower, r.upper}; };
    return {{"name", organ.name},
            {"kind", organ.kind},
            {"why", organ.why},
            {"certainty", organ.certainty},
            {"parent", organ.parent},
            {"material", describe_material(organ.material)},
            {"capsules", organ.capsule_count},
            {"length", organ.length},
            {"mass", organ.mass},
            {"thickness", range(organ.thickness)},
            {"width", range(organ.width)},
            {"area", range(organ.area)},
            {"bending_thin", range(organ.bending_thin)},
            {"bending_wide", range(organ.bending_wide)},
            {"torsion", range(organ.torsion)}};
}

nlohmann::ordered_json describe(const std::string& file, frond_model model) {
    frond_model_info info;
    must(frond_model_get_info(model, &info));
    nlohmann::ordered_json out;
    out["file"] = file;
    out["surface"] = {{"vertices", info.vertex_count},
                      {"triangles", info.triangle_count},
                      {"components", info.component_count},
                      {"joints", info.joint_count},
                      {"textures", info.texture_count},
                      {"dropped_triangles", info.dropped_triangles},
                      {"repaired_vertices", info.repaired_vertices},
                      {"scale", info.scale},
                      {"up", {info.up.x, info.up.y, info.up.z}},
                      {"lower", {info.lower.x, info.lower.y, info.lower.z}},
                      {"upper", {info.upper.x, info.upper.y, info.upper.z}}};
    out["parts"] = nlohmann::ordered_json::array();
    for (int i = 0; i < info.part_count; i++) {
        frond_part part;
        must(frond_model_get_part(model, i, &part));
        out["parts"].push_back({{"name", part.name},
                                {"material", part.material},
                                {"organ", part.organ},
                                {"kind", part.kind},
                                {"triangles", part.triangle_count},
                                {"texture", part.texture}});
    }
    out["organs"] = nlohmann::ordered_json::array();
    for (int i = 0; i < info.organ_count; i++) {
        frond_organ organ;
        must(frond_model_get_organ(model, i, &organ));
        out["organs"].push_back(describe_organ(organ));
    }
    out["cage"] = {{"nodes", info.node_count},
                   {"tets", info.tet_count},
                   {"min_dihedral", info.min_dihedral},
                   {"max_dihedral", info.max_dihedral},
                   {"min_volume", info.min_volume},
                   {"volume", info.volume},
                   {"contained", info.contained},
                   {"attachment_error", info.attachment_error},
                   {"mass", info.mass},
                   {"stiffening_factor", info.stiffening_factor}};
    out["chain"] = {{"nodes", info.chain_node_count},
                    {"capsules", info.capsule_count},
                    {"roots", info.root_count},
                    {"forks", info.fork_count},
                    {"length", info.chain_length}};
    out["ms"] = {
        {"import", info.ms_import}, {"chain", info.ms_chain}, {"cage", info.ms_cage}, {"total", info.ms_total}};
    return out;
}

// Organs of one kind and material: their number and the range of each section property.
struct KindLine {
    nlohmann::ordered_json material;
    std::string kind;
    int count = 0;
    std::map<std::string, std::array<double, 2>> ranges;
};

void print_kinds(const nlohmann::ordered_json& organs) {
    std::vector<KindLine> lines;
    for (const auto& organ : organs) {
        auto line = std::find_if(lines.begin(), lines.end(), [&](const KindLine& known) {
            return known.kind == organ["kind"] && known.material == organ["material"];
        });
        if (line == lines.end()) line = lines.insert(line, {organ["material"], organ["kind"], 0, {}});
        line->count++;
        if (organ["capsules"] == 0) continue;
        for (const char* field : {"thickness", "width", "bending_thin", "bending_wide", "torsion"}) {
            const auto range = organ[field].get<std::array<double, 2>>();
            auto& known = line->ranges.emplace(field, range).first->second;
            known = {std::min(known[0], range[0]), std::max(known[1], range[1])};
        }
    }
    for (KindLine& line : lines) {
        const auto number = [&](const char* field) { return line.material[field].get<double>(); };
        std::printf("  %-9s%d organs, %g kg/m^3, %.3g Pa, hollow %g, twist to bend %g, damping %g, strength %.3g Pa\n",
                    line.kind.c_str(), line.count, number("density"), number("young"), number("hollow"),
                    number("twist_to_bend"), number("damping_ratio"), number("strength"));
        if (line.ranges.empty()) continue;
        const auto range = [&](const char* field) { return line.ranges[field]; };
        std::printf("           %.3g .. %.3g by %.3g .. %.3g mm; EI %.3g .. %.3g and %.3g .. %.3g, ",
                    1e3 * range("thickness")[0], 1e3 * range("thickness")[1], 1e3 * range("width")[0],
                    1e3 * range("width")[1], range("bending_thin")[0], range("bending_thin")[1],
                    range("bending_wide")[0], range("bending_wide")[1]);
        std::printf("GJ %.3g .. %.3g N m^2\n", range("torsion")[0], range("torsion")[1]);
    }
}

// Prints why an organ is of its kind, and how sure that is.
void print_reason(const nlohmann::ordered_json& organs, const nlohmann::ordered_json& name) {
    const auto organ = std::find_if(organs.begin(), organs.end(), [&](const auto& one) { return one["name"] == name; });
    if (organ == organs.end() || (*organ)["why"] == "") return;
    std::printf("             %3.0f %% sure: %s\n", 100 * (*organ)["certainty"].get<double>(),
                (*organ)["why"].get<std::string>().c_str());
}

void print_model(const nlohmann::ordered_json& out) {
    const auto number = [&](const char* group, const char* field) { return out[group][field].get<double>(); };
    const auto count = [&](const char* group, const char* field) { return out[group][field].get<int>(); };
    std::printf("%s\n", out["file"].get<std::string>().c_str());
    std::printf("  surface  %d vertices, %d triangles, %zu parts, %d textures\n", count("surface", "vertices"),
                count("surface", "triangles"), out["parts"].size(), count("surface", "textures"));
    const auto lower = out["surface"]["lower"], upper = out["surface"]["upper"], up = out["surface"]["up"];
    std::printf("           %.3f x %.3f x %.3f m, %g m per unit, up %g,%g,%g\n",
                upper[0].get<double>() - lower[0].get<double>(), upper[1].get<double>() - lower[1].get<double>(),
                upper[2].get<double>() - lower[2].get<double>(), number("surface", "scale"), up[0].get<double>(),
                up[1].get<double>(), up[2].get<double>());
    std::printf("  repairs  %d triangles dropped, %d vertices repaired; %d loose parts, joined at %d places\n",
                count("surface", "dropped_triangles"), count("surface", "repaired_vertices"),
                count("surface", "components"), count("surface", "joints"));
    std::printf("  cage     %d nodes, %d tets, dihedral angles %.1f .. %.1f degrees, smallest tet %.3g m^3\n",
                count("cage", "nodes"), count("cage", "tets"), number("cage", "min_dihedral"),
                number("cage", "max_dihedral"), number("cage", "min_volume"));
    std::printf("           %.2f %% of vertices inside, binding error %.2g m, mass %.4g kg\n",
                100 * number("cage", "contained"), number("cage", "attachment_error"), number("cage", "mass"));
    std::printf("  chain    %d nodes, %d capsules, %d roots, %d forks, %.2f m long\n", count("chain", "nodes"),
                count("chain", "capsules"), count("chain", "roots"), count("chain", "forks"),
                number("chain", "length"));
    std::printf("  built in %.1f ms: import %.1f, organs and chain %.1f, cage %.1f\n", number("ms", "total"),
                number("ms", "import"), number("ms", "chain"), number("ms", "cage"));
    print_kinds(out["organs"]);
    constexpr size_t MOST_PARTS = 40;
    for (size_t i = 0; i < std::min(MOST_PARTS, out["parts"].size()); i++) {
        const auto& part = out["parts"][i];
        std::printf("  organ    %-24s %-9s %7d triangles   (%s, %s)\n", part["organ"].get<std::string>().c_str(),
                    part["kind"].get<std::string>().c_str(), part["triangles"].get<int>(),
                    part["name"].get<std::string>().c_str(), part["material"].get<std::string>().c_str());
        print_reason(out["organs"], part["organ"]);
    }
    if (out["parts"].size() > MOST_PARTS)
        std::printf("  ... and %zu more; --json lists all\n", out["parts"].size() - MOST_PARTS);
}

void inspect(const InspectOptions& options) {
    Settings settings;
    settings.model.allow_stiffening = INFINITY;  // what is too weak is to be seen, too
    for (const std::string& assignment : options.assignments) apply_setting(settings, assignment);
    Stage stage(settings);
    const frond_model model = stage.load(options.file);
    const nlohmann::ordered_json out = describe(options.file, model);
    if (options.json)
        std::printf("%s\n", out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    else
        print_model(out);
    if (options.write) std::printf("wrote %s\n", write_corrections(model, options.file).c_str());
    if (options.shot.empty() && options.picture.empty()) return;
    stage.plant(model, {0, 0, 0});
    if (!options.picture.empty()) draw_organs(stage, options.view).write(options.picture);
    if (options.shot.empty()) return;
    Studio studio(options.view);
    studio.shoot(stage);
    studio.write(options.shot);
}

}  // namespace

void add_inspect(CLI::App& app) {
    auto options = std::make_shared<InspectOptions>();
    options->view.overlays = {"cage", "capsules"};
    CLI::App* command = app.add_subcommand("inspect", "what a plant file holds and what Frond makes of it");
    command->add_option("file", options->file, "a plant file: .obj .ply .glb .gltf .fbx .dae .stl .msh .vtk .urdf")
        ->required();
    command->add_flag("--json", options->json, "print JSON");
    command->add_flag("--write", options->write,
                      "write MESH.frond.json beside the file: what was found, to be corrected by hand");
    command->add_option("--shot", options->shot, "write a picture (PNG) with cage and capsules")
        ->check(file_ending_in(".png"));
    command
        ->add_option("--picture", options->picture,
                     "write a picture (PNG) of the organs in colours with their names and weights, chain and roots")
        ->check(file_ending_in(".png"));
    command->add_option("--overlay", options->view.overlays, "cage, faces, capsules")->delimiter(',');
    command->add_option("--width", options->view.width, "of pictures [pixel]")->check(CLI::Range(64, 4096));
    command->add_option("--height", options->view.height, "of pictures [pixel]")->check(CLI::Range(64, 4096));
    command->add_option("--set", options->assignments, "key=value, may be repeated; see frond run --help");
    command->callback([options] { inspect(*options); });
}

}  // namespace frond::tools
