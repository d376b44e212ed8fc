// frond cook FILE: builds a model and writes it with all that was built, for games to load in milliseconds.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "scenes/scene.hpp"

namespace frond::tools {
namespace {

struct CookOptions {
    std::string file, out;
    std::vector<std::string> assignments, mechanics;
};

// A plant of each mechanics lets the model find their rest shapes.
void make_ready(Stage& stage, frond_model model, const std::vector<std::string>& mechanics) {
    for (const std::string& name : mechanics) {
        Settings settings = stage.settings;
        apply_setting(settings, "mechanics=" + name);
        frond_plant plant = {};
        must(frond_plant_create(stage.world, model, &settings.plant, &plant));
        frond_plant_destroy(plant);
    }
}

void cook(const CookOptions& options) {
    Settings settings;
    for (const std::string& assignment : options.assignments) apply_setting(settings, assignment);
    Stage stage(settings);
    const frond_model model = stage.load(options.file);
    make_ready(stage, model, options.mechanics);
    const std::string out =
        options.out.empty() ? options.file.substr(0, options.file.find_last_of('.')) + ".frond" : options.out;
    must(frond_model_save(model, out.c_str()));

    frond_model_info built, loaded;
    must(frond_model_get_info(model, &built));
    Stage other{Settings()};
    must(frond_model_get_info(other.load(out), &loaded));
    std::printf("%s: %zu bytes, built in %.0f ms, loads in %.1f ms\n", out.c_str(), frond_model_get_saved_size(model),
                built.ms_total, loaded.ms_total);
}

}  // namespace

void add_cook(CLI::App& app) {
    auto options = std::make_shared<CookOptions>();
    CLI::App* command =
        app.add_subcommand("cook", "write a model with all that is built for it, to load in milliseconds");
    command->add_option("file", options->file, "a plant file, see frond inspect --help")->required();
    command->add_option("--out", options->out, "file to write, default: FILE with the ending .frond");
    command
        ->add_option("--mechanics", options->mechanics,
                     "names, made ready beside the default ones; see frond run --help")
        ->delimiter(',');
    command->add_option("--set", options->assignments, "key=value, may be repeated; see frond run --help");
    command->callback([options] { cook(*options); });
}

}  // namespace frond::tools
