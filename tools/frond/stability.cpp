// frond stability: hard cases, as a table of green and red.
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>

#include "commands.hpp"
#include "scenes/scene.hpp"
#include "stability/stability.hpp"
#include "studio/studio.hpp"

namespace frond::tools {
namespace {

struct StabilityOptions {
    stability::Scope scope;
    stability::Limits limits;
    std::string mechanics, integrator, json, html;
    bool list = false, bullet = false;
};

// The row of a table that has that name.
int row_called(const std::string& name, const char* kind, int count, const std::function<const char*(int)>& name_of) {
    std::string names;
    for (int row = 0; row < count; row++) {
        if (name == name_of(row)) return row;
        names += (row ? ", " : "") + std::string(name_of(row));
    }
    throw SceneError("there is no " + std::string(kind) + " \"" + name + "\"; there are " + names);
}

void write_to(const std::string& file, const std::string& text) {
    if (file.empty()) return;
    std::ofstream stream(file);
    stream << text;
    if (!stream.flush()) throw SceneError(file + " cannot be written; name a file in a folder that exists");
}

void run_stability(StabilityOptions& options) {
    if (options.list) {
        for (const stability::Case& one : stability::cases())
            std::printf("%-20s %s\n%-20s passes: %s\n", one.name, one.does, "", one.passes);
        return;
    }
    if (options.bullet) {
        std::unique_ptr<Progress> progress;
        const std::string table = stability::bullet_table(options.scope.quick, options.limits, [&](int done, int all) {
            if (!progress) progress = std::make_unique<Progress>("cell", all);
            progress->at(done);
        });
        std::printf("%s", table.c_str());
        return;
    }
    if (!options.mechanics.empty())
        options.scope.mechanics = row_called(options.mechanics, "kind of mechanics", FROND_MECHANICS_COUNT,
                                             [](int row) { return frond_mechanics_name(frond_mechanics(row)); });
    if (!options.integrator.empty())
        options.scope.integrator = row_called(options.integrator, "implicit integrator", FROND_SYMPLECTIC_EULER,
                                              [](int row) { return frond_integrator_name(frond_integrator(row)); });
    std::vector<stability::Result> results = stability::cells_of(options.scope);
    Progress progress("cell", int(results.size()));
    stability::run_cells(results, options.limits, [&](int done) { progress.at(done); });
    std::printf("%s", stability::text_of(results).c_str());
    write_to(options.json, stability::json_of(results));
    write_to(options.html, stability::html_of(results));
    const int red = stability::unexplained(results, false), of_default = stability::unexplained(results, true);
    std::printf("%d cells; unexplained red ones: %d with the default integrator, %d in all\n", int(results.size()),
                of_default, red);
    if (of_default > 0) throw SceneError("the table has red cells with the default integrator");
}

}  // namespace

void add_stability(CLI::App& app) {
    auto options = std::make_shared<StabilityOptions>();
    CLI::App* command =
        app.add_subcommand("stability", "hard cases over mechanics, integrators and time steps: what holds");
    command->add_option("--case", options->scope.names, "these cases only");
    command->add_option("--mechanics", options->mechanics, "one mechanics only");
    command->add_option("--integrator", options->integrator, "one integrator only");
    command->add_flag("--quick", options->scope.quick, "the default integrator at 1/60 s only, without the slow cases");
    command->add_flag_callback(
        "--default", [options] { options->integrator = frond_integrator_name(FROND_BDF2); },
        "the default integrator only, at all time steps");
    command->add_flag("--list", options->list, "the cases and their criteria; runs nothing");
    command->add_flag("--bullet", options->bullet,
                      "Bullet's own soft bodies in the cases that they can be put through, beside Frond");
    command->add_option("--json", options->json, "write all cells to this file");
    command->add_option("--html", options->html, "write the table as a page");
    // The soft bodies' table shows what a game could wait for: about as long as what it simulates takes.
    constexpr int WITH_BULLET = 6;
    const CLI::Option* seconds = command
                                     ->add_option("--seconds", options->limits.seconds,
                                                  "CPU time after which a cell is red, default 120, with --bullet 6")
                                     ->check(CLI::Range(1, 100000));
    command->add_option("--processes", options->limits.processes, "at once; default: one a processor")
        ->check(CLI::Range(1, 1024));
    command->callback([options, seconds] {
        if (options->bullet && seconds->count() == 0) options->limits.seconds = WITH_BULLET;
        run_stability(*options);
    });
}

}  // namespace frond::tools
