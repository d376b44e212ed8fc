// frond bench step: time of a step by stage.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "studio.hpp"
#include "study/report.hpp"

namespace frond::tools {
namespace {

struct BenchOptions {
    std::string what = "drag";
    int rounds = 20;
    bool csv = false;
    std::vector<std::string> assignments;
};

struct Stages {
    static constexpr const char* NAMES[] = {"effects", "assembly", "solve", "contact", "capsules", "surface", "all"};
    static constexpr int COUNT = 7;
    std::vector<double> ms[COUNT];
    void add(const frond_report& report) {
        const double values[COUNT] = {report.ms_effects,
                                      report.ms_assembly,
                                      report.ms_solve,
                                      report.ms_collide + report.ms_response,
                                      report.ms_capsules,
                                      report.ms_surface,
                                      report.ms_step + report.ms_surface};
        for (int i = 0; i < COUNT; i++) ms[i].push_back(values[i]);
    }
};

// Warms up, then times steps of the moving plant from the same state again and again; minimum and median over all.
void bench_step(const BenchOptions& options) {
    constexpr int WARM_UP = 60, STEPS = 30;
    const Casting casting = cast(options.what);
    Play play(casting, settings_of(casting, options.assignments));
    for (int i = 0; i < WARM_UP; i++) play.step();
    const frond_plant plant = play.stage.plants[0];
    const int nodes = frond_plant_get_node_count(plant);
    std::vector<double> x(size_t(3 * nodes)), v(size_t(3 * nodes));
    must(frond_plant_get_state(plant, x.data(), v.data(), nodes));

    Stages stages;
    Progress progress("round", options.rounds);
    for (int round = 0; round < options.rounds; round++) {
        must(frond_plant_set_state(plant, x.data(), v.data(), nodes));
        for (int i = 0; i < STEPS; i++) {
            must(frond_world_step(play.stage.world, play.stage.settings.dt));
            frond_surface_view view;
            must(frond_plant_get_surface(plant, &view));
            frond_report report;
            must(frond_world_get_report(play.stage.world, &report));
            stages.add(report);
        }
        progress.at(round + 1);
    }

    frond_report report;
    must(frond_world_get_report(play.stage.world, &report));
    if (!options.csv)
        std::printf("%s: %d nodes, %d tets, %s, %s, %s; %d steps, one core\n%s, %s, frond %s %s\n%-10s %10s %10s\n",
                    options.what.c_str(), report.node_count, report.tet_count,
                    frond_mechanics_name(play.stage.settings.plant.mechanics),
                    frond_integrator_name(play.stage.settings.plant.integrator),
                    frond_linear_solver_name(play.stage.settings.plant.linear_solver), options.rounds * STEPS,
                    study::processor_name().c_str(), FROND_COMPILER, frond_version_string(), FROND_COMMIT, "stage", "min ms",
                    "median ms");
    else
        std::printf("scene,nodes,tets,stage,min_ms,median_ms,processor,compiler,version,commit\n");
    for (int i = 0; i < Stages::COUNT; i++) {
        std::vector<double>& ms = stages.ms[i];
        std::sort(ms.begin(), ms.end());
        if (options.csv)
            std::printf("%s,%d,%d,%s,%.6f,%.6f,\"%s\",\"%s\",%s,%s\n", options.what.c_str(), report.node_count,
                        report.tet_count, Stages::NAMES[i], ms.front(), ms[ms.size() / 2], study::processor_name().c_str(),
                        FROND_COMPILER, frond_version_string(), FROND_COMMIT);
        else
            std::printf("%-10s %10.4f %10.4f\n", Stages::NAMES[i], ms.front(), ms[ms.size() / 2]);
    }
}

}  // namespace

void add_bench(CLI::App& app) {
    CLI::App* bench = app.add_subcommand("bench", "measure");
    bench->require_subcommand(1);
    auto options = std::make_shared<BenchOptions>();
    CLI::App* step = bench->add_subcommand("step", "time of a step by stage");
    step->add_option("what", options->what, "a scene or a mesh file, default drag (the corn)");
    step->add_option("--rounds", options->rounds, "of 30 steps, default 20")->check(CLI::Range(1, 100000));
    step->add_flag("--csv", options->csv, "print CSV");
    step->add_option("--set", options->assignments, "key=value, may be repeated; see frond run --help");
    step->callback([options] { bench_step(*options); });
}

}  // namespace frond::tools
