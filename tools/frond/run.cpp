// frond run SCENE|FILE: steps a scene, writes pictures, prints what it cost.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "quantile.hpp"
#include "studio/studio.hpp"

namespace frond::tools {
namespace {

struct RunOptions {
    std::string what, shot, frames;
    int steps = -1;  // -1: the scene's own length
    int every = 2;   // steps per frame
    bool json = false;
    std::vector<std::string> assignments;
    View view;
};

// The measurements of a run: kept for every step, reduced at the end.
struct Record {
    std::vector<frond_report> reports;
    std::vector<frond_profile> profiles;
    frond_vec3 tip_at_start = {}, tip = {};
    double farthest = 0;  // largest distance of the tip from its start [m]
    uint32_t trouble = 0;
};

double distance(const frond_vec3& a, const frond_vec3& b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

template <class Field>
double median_of(const Record& record, Field field) {
    std::vector<double> values;
    for (const frond_profile& profile : record.profiles) values.push_back(field(profile));
    return median(values);
}

std::string trouble_text(uint32_t trouble) {
    std::string text;
    if (trouble & FROND_TROUBLE_NOT_CONVERGED) text += " not_converged";
    if (trouble & FROND_TROUBLE_REWOUND) text += " rewound";
    if (trouble & FROND_TROUBLE_INVERTED) text += " inverted";
    if (trouble & FROND_TROUBLE_RETRIED) text += " retried";
    if (trouble & FROND_TROUBLE_HELD_BACK) text += " held_back";
    if (trouble & FROND_TROUBLE_CROWDED) text += " crowded";
    if (trouble & FROND_TROUBLE_PASSED) text += " passed";
    if (trouble & FROND_TROUBLE_BAD_WIND) text += " bad_wind";
    return text.empty() ? "none" : text.substr(1);
}

nlohmann::ordered_json summary(const Play& play, const Record& record) {
    const Stage& stage = play.stage;
    const frond_report& last = record.reports.back();
    nlohmann::ordered_json out;
    out["scene"] = play.casting.scene->name;
    out["mechanics"] = frond_mechanics_name(stage.settings.plant.mechanics);
    out["integrator"] = frond_integrator_name(stage.settings.plant.integrator);
    out["linear_solver"] = frond_linear_solver_name(stage.settings.plant.tuning.linear_solver);
    out["plants"] = last.plant_count;
    out["nodes"] = last.node_count;
    out["tets"] = last.tet_count;
    out["steps"] = record.profiles.size();
    out["time"] = last.time;
    out["tip_at_start"] = {record.tip_at_start.x, record.tip_at_start.y, record.tip_at_start.z};
    out["tip"] = {record.tip.x, record.tip.y, record.tip.z};
    out["tip_farthest"] = record.farthest;
    out["contacts"] = last.contact_count + last.plant_contact_count;
    out["trouble"] = trouble_text(record.trouble);
    for (int bit = 0; bit < FROND_EFFECT_COUNT; bit++) {
        const auto ran = [&](const frond_report& r) { return r.effects_run >> bit & 1; };
        if (std::any_of(record.reports.begin(), record.reports.end(), ran))
            out["effects"][frond_effect_name(1u << bit)] =
                median_of(record, [&](const frond_profile& p) { return p.ms_of_effect[bit]; });
    }
    out["ms_per_step"] = {
        {"all", median_of(record, [](const frond_profile& p) { return p.ms_step; })},
        {"effects", median_of(record, [](const frond_profile& p) { return p.ms_effects; })},
        {"assembly", median_of(record, [](const frond_profile& p) { return p.ms_assembly; })},
        {"solve", median_of(record, [](const frond_profile& p) { return p.ms_solve; })},
        {"contact", median_of(record, [](const frond_profile& p) { return p.ms_collide + p.ms_response; })},
        {"capsules", median_of(record, [](const frond_profile& p) { return p.ms_capsules; })},
        {"surface", median_of(record, [](const frond_profile& p) { return p.ms_surface; })}};
    return out;
}

void print_run(const nlohmann::ordered_json& out) {
    std::printf("%s: %d plants, %d nodes, %d tets, %s, %s, %s\n", out["scene"].get<std::string>().c_str(),
                out["plants"].get<int>(), out["nodes"].get<int>(), out["tets"].get<int>(),
                out["mechanics"].get<std::string>().c_str(), out["integrator"].get<std::string>().c_str(),
                out["linear_solver"].get<std::string>().c_str());
    std::printf(
        "  %d steps, %.2f s; tip from %.3f m to %.3f m high, at most %.3f m from where it began; %d contacts; "
        "trouble: %s\n",
        out["steps"].get<int>(), out["time"].get<double>(), out["tip_at_start"][1].get<double>(),
        out["tip"][1].get<double>(), out["tip_farthest"].get<double>(), out["contacts"].get<int>(),
        out["trouble"].get<std::string>().c_str());
    std::printf("  effects:");
    for (const auto& [name, ms] : out["effects"].items()) {
        std::printf(" %s", name.c_str());
        if (ms.get<double>() > 0) std::printf(" %.4f", ms.get<double>());
    }
    std::printf(" (median ms; without a number: part of what others solve)\n");
    const auto& ms = out["ms_per_step"];
    std::printf(
        "  median step %.3f ms: effects %.3f, assembly %.3f, solve %.3f, contact %.3f, capsules %.3f; "
        "surface %.3f ms\n",
        ms["all"].get<double>(), ms["effects"].get<double>(), ms["assembly"].get<double>(), ms["solve"].get<double>(),
        ms["contact"].get<double>(), ms["capsules"].get<double>(), ms["surface"].get<double>());
}

// Returns the vertex that is highest at the start; it is followed, since another may be highest later.
int tip_vertex(frond_plant plant) {
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    int highest = 0;
    for (int i = 0; i < view.vertex_count; i++)
        if (view.positions[3 * i + 1] > view.positions[3 * highest + 1]) highest = i;
    return highest;
}

frond_vec3 vertex_place(frond_plant plant, int vertex) {
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    const float* p = view.positions + 3 * vertex;
    return {p[0], p[1], p[2]};
}

nlohmann::ordered_json play_once(const RunOptions& options, const Casting& casting) {
    const Settings settings = settings_of(casting, options.assignments);
    const int steps = options.steps >= 0 ? options.steps : int(std::lround(casting.scene->duration / settings.dt));

    Play play(casting, settings);
    std::unique_ptr<Studio> studio;
    std::unique_ptr<Film> film;
    if (!options.shot.empty() || !options.frames.empty()) studio = std::make_unique<Studio>(options.view);
    if (!options.frames.empty())
        film = std::make_unique<Film>(options.frames, options.view, 1 / (settings.dt * options.every));

    Record record;
    const int tip = tip_vertex(play.stage.plants[0]);
    record.tip = record.tip_at_start = vertex_place(play.stage.plants[0], tip);
    record.reports.resize(1);
    must(frond_world_get_report(play.stage.world, &record.reports[0]));
    Progress progress("step", steps);
    for (int i = 0; i < steps; i++) {
        play.step();
        if (film && i % options.every == 0) film->add(*studio, play.stage);

        // Takes the surface of every plant that is drawn, as a game does each frame.
        for (size_t k = 0; k < play.stage.plants.size(); k++) {
            frond_surface_view view;
            if (play.stage.sees(k)) must(frond_plant_get_surface(play.stage.plants[k], &view));
        }
        frond_report report;
        must(frond_world_get_report(play.stage.world, &report));
        if (i == 0) record.reports.clear();
        record.reports.push_back(report);
        frond_profile profile;
        must(frond_world_get_profile(play.stage.world, &profile));
        record.profiles.push_back(profile);
        record.trouble |= report.trouble;
        record.tip = vertex_place(play.stage.plants[0], tip);
        record.farthest = std::max(record.farthest, distance(record.tip, record.tip_at_start));
        progress.at(i + 1);
    }

    if (film) film->finish();
    if (!options.shot.empty()) {
        studio->shoot(play.stage);
        studio->write(options.shot);
    }
    return summary(play, record);
}

// Returns the runs of a scene. One with a setting to compare with runs twice, (a) with it and (b) as is, always
// pictured.
std::vector<RunOptions> takes_of(const RunOptions& options, const Scene& scene) {
    if (!scene.without) return {options};
    RunOptions a = options;
    if (a.shot.empty()) a.shot = std::string(scene.name) + ".png";
    if (a.view.overlays.empty()) a.view.overlays = {"contacts"};
    RunOptions b = a;
    const std::filesystem::path shot = a.shot, stem = shot.parent_path() / shot.stem();
    a.shot = stem.string() + "_a" + shot.extension().string();
    b.shot = stem.string() + "_b" + shot.extension().string();
    a.frames.clear();
    a.assignments.push_back(scene.without);
    return {a, b};
}

void run(const RunOptions& options) {
    const Casting casting = cast(options.what);
    const std::vector<RunOptions> takes = takes_of(options, *casting.scene);
    std::vector<nlohmann::ordered_json> results;
    for (const RunOptions& take : takes) {
        results.push_back(play_once(take, casting));
        if (options.json) continue;
        if (takes.size() > 1) std::printf("%s:\n", take.shot.c_str());
        print_run(results.back());
    }
    const nlohmann::ordered_json all = takes.size() > 1 ? nlohmann::ordered_json(results) : results.front();
    if (options.json) std::printf("%s\n", all.dump(2).c_str());
}

}  // namespace

void add_run(CLI::App& app) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = app.add_subcommand("run", "run a scene, or a plant file that is pulled aside and let go");
    std::string text = "a mesh file, or a scene:", compared;
    for (const Scene& scene : scenes()) {
        if (scene.build) text += std::string(" ") + scene.name + " (" + scene.text + ")";
        if (scene.without) compared += std::string(compared.empty() ? "" : ", ") + scene.name;
    }
    command->add_option("what", options->what, text)->required();
    command->add_option("--steps", options->steps, "default: the scene's own length")->check(CLI::Range(0, 1000000000));
    command
        ->add_option("--shot", options->shot,
                     "write a picture (PNG) of the end; what is played for comparison (" + compared +
                         ") always writes two, NAME_a.png and NAME_b.png, into the current folder by default")
        ->check(file_ending_in(".png"));
    command->add_option("--frames", options->frames,
                        "write frames, a contact sheet and a moving picture to this folder");
    command->add_option("--every", options->every, "steps from frame to frame, default 2")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--overlay", options->view.overlays, "cage, faces, capsules, contacts")->delimiter(',');
    command->add_option("--azimuth", options->view.azimuth, "of the camera [rad]")->check(real_in(-1e3, 1e3));
    command->add_option("--elevation", options->view.elevation, "of the camera [rad]")->check(real_in(-1e3, 1e3));
    command->add_option("--width", options->view.width, "of pictures [pixel]");
    command->add_option("--height", options->view.height, "of pictures [pixel]");
    command->add_flag("--json", options->json, "print JSON");
    command->add_option("--set", options->assignments, "key=value, may be repeated");
    command->footer("Keys of --set:\n" + settings_help());
    command->callback([options] { run(*options); });
}

}  // namespace frond::tools
