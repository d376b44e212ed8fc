// frond stability: runs hard cases and prints a table of green and red.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>

#include "commands.hpp"
#include "export.hpp"
#include "stability/stability.hpp"
#include "stability/sweeps.hpp"
#include "stability_random.hpp"
#include "studio/studio.hpp"

namespace frond::tools {
namespace {

struct StabilityOptions {
    stability::Scope scope;
    stability::Limits limits;
    std::string mechanics, integrator, json, html;
    bool list = false, bullet = false, sweeps = false;
    RandomOptions random;
};

// Returns the row of a table that has that name.
int row_called(const std::string& name, const char* kind, int count, const std::function<const char*(int)>& name_of) {
    std::string names;
    for (int row = 0; row < count; row++) {
        if (name == name_of(row)) return row;
        names += (row ? ", " : "") + std::string(name_of(row));
    }
    throw SceneError("there is no " + std::string(kind) + " \"" + name + "\"; there are " + names);
}

// A requested output file, opened before anything runs.
class Page {
public:
    explicit Page(const std::string& path) : path(path) {
        if (!path.empty()) file = open_to_write(path);
    }
    void write(const std::vector<stability::Result>& results,
               std::string (*text_of)(const std::vector<stability::Result>&)) {
        if (path.empty()) return;
        file << text_of(results);
        close(file, path);
    }

private:
    const std::string path;
    std::ofstream file;
};

void run_sweeps(const StabilityOptions& options) {
    const bool quick = options.scope.quick;
    Progress progress("sweep", int(stability::sweeps(quick).size()));
    const std::vector<stability::SweptCell> cells =
        stability::run_sweeps(quick, options.limits, [&](int done) { progress.at(done); });
    std::printf("%s", stability::text_of(cells).c_str());
    const auto is_red = [](const stability::SweptCell& cell) {
        return cell.verdict.color == stability::Color::RED && !stability::is_known_to_pass(cell.sweep);
    };
    int red = 0;
    for (const stability::SweptCell& cell : cells) {
        if (!is_red(cell)) continue;
        std::printf("%s, %s, 1/%.0f s, %g m/s: %s\n", stability::name_of(cell.sweep.meeting),
                    frond_mechanics_name(cell.sweep.mechanics), 1 / cell.sweep.dt, cell.sweep.speed,
                    cell.verdict.text.c_str());
        red++;
    }
    if (red > 0) throw SceneError(std::to_string(red) + " sweeps failed");
}

void run_stability(StabilityOptions& options) {
    if (options.sweeps) return run_sweeps(options);
    if (!options.random.program.empty()) return run_program(options.random);
    if (options.random.count > 0) return options.list ? list_random(options.random) : run_random(options.random);
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
        options.scope.integrator =
            row_called(options.integrator, "implicit integrator", FROND_INTEGRATOR_SYMPLECTIC_EULER,
                       [](int row) { return frond_integrator_name(frond_integrator(row)); });
    std::vector<stability::Result> results = stability::cells_of(options.scope);
    Page json(options.json), html(options.html);
    Progress progress("cell", int(results.size()));
    stability::run_cells(results, options.limits, [&](int done) { progress.at(done); });
    std::printf("%s", stability::text_of(results).c_str());
    json.write(results, stability::json_of);
    html.write(results, stability::html_of);
    if (std::any_of(results.begin(), results.end(), stability::is_unexplained))
        throw SceneError("the table has red cells that no known limit explains");
}

}  // namespace

void add_stability(CLI::App& app) {
    auto options = std::make_shared<StabilityOptions>();
    CLI::App* command =
        app.add_subcommand("stability", "hard cases over mechanics, integrators and time steps: what holds");
    CLI::Option* names = command->add_option("--case", options->scope.names, "these cases only");
    CLI::Option* mechanics = command->add_option("--mechanics", options->mechanics, "one mechanics only");
    CLI::Option* integrator = command->add_option("--integrator", options->integrator, "one integrator only");
    CLI::Option* quick = command->add_flag("--quick", options->scope.quick,
                                           "the default integrator at 1/60 s only, without the slow cases");
    CLI::Option* of_default = command->add_flag_callback(
        "--default", [options] { options->integrator = frond_integrator_name(FROND_INTEGRATOR_BDF2); },
        "the default integrator only, at all time steps");
    CLI::Option* json = command->add_option("--json", options->json, "write all cells to this file");
    CLI::Option* html = command->add_option("--html", options->html, "write the table as a page");
    CLI::Option* list = command->add_flag("--list", options->list,
                                          "the cases and their criteria, or the worlds of --random; runs nothing");
    CLI::Option* bullet =
        command->add_flag("--bullet", options->bullet,
                          "Bullet's own soft bodies in the cases that they can be put through, beside Frond");
    CLI::Option* sweeps = command->add_flag("--sweeps", options->sweeps,
                                            "what comes at a plant at 0.1 to 100 m/s: a table of what passes; with "
                                            "--quick a sample of it");
    // An option that would have no effect beside another one is an error.
    integrator->excludes(quick, of_default);
    for (CLI::Option* option : {names, mechanics, integrator, of_default, json, html})
        option->excludes(list, bullet, sweeps);
    list->excludes(quick, bullet, sweeps);
    bullet->excludes(sweeps);
    add_random_options(*command, options->random,
                       {names, mechanics, integrator, quick, of_default, json, html, bullet, sweeps}, list);
    // In the soft bodies' table a cell may take about as long as the time that it simulates: what a game could wait
    // for.
    constexpr int WITH_BULLET = 6;
    const CLI::Option* seconds =
        command
            ->add_option("--seconds", options->limits.seconds,
                         "CPU time after which a cell is red, default 120, with --bullet 6; with "
                         "--random, after which no more worlds begin")
            ->check(CLI::Range(1, 100000));
    command->add_option("--processes", options->limits.processes, "at once; default: one a processor")
        ->check(CLI::Range(1, 1024));
    command->callback([options, seconds] {
        if (seconds->count() > 0) options->random.seconds = options->limits.seconds;
        if (options->bullet && seconds->count() == 0) options->limits.seconds = WITH_BULLET;
        run_stability(*options);
    });
}

}  // namespace frond::tools
