// frond bench solver: cost of a step of plants from small to very large in a light wind, by linear solver and size.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "bench.hpp"
#include "grow/grow.hpp"
#include "quantile.hpp"
#include "scenes/scene.hpp"
#include "study/report.hpp"

namespace frond::tools {

namespace {

struct SolverCase {
    const char* name;
    frond_mechanics mechanics;
    int order, plants;
    int leaves;          // leaves of a grown tree; 0: the corn plant
    double cage, chain;  // sizes of cells and capsules [m], 0: Frond's choice
};
// Trees of tets grow by their number of leaves; their cells keep one size.
constexpr SolverCase CASES[] = {
    {"corn", FROND_MECHANICS_TET_COROTATIONAL, 1, 1, 0, 0, 0},
    {"17 corn plants", FROND_MECHANICS_TET_COROTATIONAL, 1, 17, 0, 0, 0},
    {"corn, 10-node tets", FROND_MECHANICS_TET_COROTATIONAL, 2, 1, 0, 0, 0},
    {"corn, 10-node tets", FROND_MECHANICS_TET_COROTATIONAL, 2, 1, 0, 0.25, 0},
    {"corn, 10-node tets", FROND_MECHANICS_TET_COROTATIONAL, 2, 1, 0, 0.36, 0},
    {"tree", FROND_MECHANICS_TET_COROTATIONAL, 1, 1, 400, 0.1, 0},
    {"tree", FROND_MECHANICS_TET_COROTATIONAL, 1, 1, 1600, 0.1, 0},
    {"tree", FROND_MECHANICS_TET_COROTATIONAL, 1, 1, 6400, 0.1, 0},
    {"tree", FROND_MECHANICS_TET_COROTATIONAL, 1, 1, 12000, 0.1, 0},
    {"tree, rods", FROND_MECHANICS_ROD, 1, 1, 18000, 0, 0.2},
};

frond_model load(const SolverCase& one) {
    frond_model_def def = frond_default_model_def();
    def.cage_size = one.cage;
    def.capsule_height = one.chain;
    std::string path = model_path("corn/corn.obj");
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "frond_bench_tree";
    if (one.leaves > 0) path = grow::write_obj(grow::grow_plant("tree", {{"leaves", one.leaves}}), folder.string());
    frond_model model = {};
    const frond_result loaded = frond_model_load(path.c_str(), &def, &model);
    std::filesystem::remove_all(folder);
    must(loaded);
    return model;
}

struct SolverFigures {
    frond_report report;                    // report of the last step
    int pieces;                             // tets or rods
    double assembly, solve, step, surface;  // medians [ms]
};

SolverFigures measure(const SolverCase& one, frond_model model, frond_linear_solver solver, int steps) {
    constexpr int WARM_UP = 5;
    constexpr double APART = 50;  // distance at which none touch [m]
    frond_world_def world_def = frond_default_world_def();
    world_def.sleep_distance = 0;
    frond_world world = {};
    must(frond_world_create(&world_def, &world));
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity.x = 2;
    must(frond_world_set_wind(world, &wind));
    std::vector<frond_plant> plants(size_t(one.plants));
    for (size_t i = 0; i < plants.size(); i++) {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = one.mechanics;
        def.element_order = one.order;
        def.tuning.linear_solver = solver;
        def.position.x = APART * double(i);
        must(frond_plant_create(world, model, &def, &plants[i]));
    }
    SolverFigures figures = {};
    std::vector<double> assembly, solve, step, surface;
    for (int i = 0; i < WARM_UP + steps; i++) {
        must(frond_world_step(world, 1.0 / 60));
        frond_surface_view view;
        for (const frond_plant plant : plants) must(frond_plant_get_surface(plant, &view));
        must(frond_world_get_report(world, &figures.report));
        frond_profile profile;
        must(frond_world_get_profile(world, &profile));
        if (i < WARM_UP) continue;
        assembly.push_back(profile.ms_assembly);
        solve.push_back(profile.ms_solve);
        step.push_back(profile.ms_step);
        surface.push_back(profile.ms_surface);
    }
    const int capsules = frond_plant_get_capsule_count(plants.front()) * one.plants;
    figures.pieces = one.mechanics == FROND_MECHANICS_ROD ? capsules : figures.report.tet_count;
    frond_world_destroy(world);
    figures.assembly = median(assembly);
    figures.solve = median(solve);
    figures.step = median(step);
    figures.surface = median(surface);
    return figures;
}

// Conjugate gradients take minutes for large plants.
bool is_worth_it(frond_linear_solver solver, int pieces) {
    constexpr int LARGE = 2000;
    return solver <= FROND_LINEAR_SOLVER_DIRECT || pieces < LARGE;
}

struct SolverRow {
    const SolverCase* of;
    frond_linear_solver solver;
    SolverFigures figures;
};

std::string csv_of(const std::vector<SolverRow>& rows) {
    std::string out =
        "plant,mechanics,order,pieces,solver,assembly_ms,solve_ms,step_ms,surface_ms,residual,processor,compiler,"
        "version,commit\n";
    for (const auto& [of, solver, f] : rows) {
        char numbers[200];
        std::snprintf(numbers, sizeof numbers, "%d,%d,%s,%.4f,%.4f,%.4f,%.4f,%.2e", of->order, f.pieces,
                      frond_linear_solver_name(solver), f.assembly, f.solve, f.step, f.surface, f.report.residual);
        out += std::string(of->name) + "," + frond_mechanics_name(of->mechanics) + "," + numbers + "," +
               study::csv_field(study::processor_name()) + "," + study::csv_field(FROND_COMPILER) + "," +
               frond_version_string() + "," + FROND_COMMIT + "\n";
    }
    return out;
}

void print_row(const SolverRow& row) {
    const SolverFigures& f = row.figures;
    std::printf("%-20s %8d %-24s %9.3f %9.3f %9.3f %9.3f %9.1e\n", row.of->name, f.pieces,
                frond_linear_solver_name(row.solver), f.assembly, f.solve, f.step, f.surface, f.report.residual);
    std::fflush(stdout);
}

// Plots a step of single plants of linear tets over their number of tets, with a line for each solver that can solve
// them all.
std::string plot_of(const std::vector<SolverRow>& rows, const std::string& base) {
    std::string data, lines;
    for (const frond_linear_solver solver : {FROND_LINEAR_SOLVER_BLOCK, FROND_LINEAR_SOLVER_DIRECT}) {
        const std::string name = frond_linear_solver_name(solver);
        data += "$" + name + " << EOD\n";
        for (const SolverRow& row : rows)
            if (row.solver == solver && row.of->mechanics == FROND_MECHANICS_TET_COROTATIONAL && row.of->order == 1 &&
                row.of->plants == 1)
                data += std::to_string(row.figures.pieces) + " " + std::to_string(row.figures.solve) + " " +
                        std::to_string(row.figures.step) + "\n";
        data += "EOD\n";
        lines += "$" + name + " using 1:3 with linespoints lw 2 title 'a step, " + name + "', $" + name +
                 " using 1:2 with linespoints lw 2 dt 2 title 'of it the solve', ";
    }
    return study::drawn_twice(
        "set xlabel 'tets of a plant'\nset ylabel 'ms'\nset logscale xy\nset grid\nset key left top\n" + data +
            "plot " + lines + "x * 4e-4 with lines dt 3 lc 'gray' title '0.4 microseconds a tet'\n",
        base);
}

}  // namespace

void bench_solver(const BenchOptions& options) {
    study::prepare_diagrams(options.out);
    if (!options.csv)
        std::printf(
            "plants in light air (2 m/s), median of %d steps [ms], one core; pieces are tets or rods\n%s, %s, frond %s "
            "%s\n%-20s %8s %-24s %9s %9s %9s %9s %9s\n",
            options.rounds, study::processor_name().c_str(), FROND_COMPILER, frond_version_string(), FROND_COMMIT,
            "plant", "pieces", "solver", "assembly", "solve", "step", "surface", "residual");
    std::vector<SolverRow> rows;
    for (const SolverCase& one : CASES) {
        if (one.leaves > options.most) continue;
        const frond_model model = load(one);
        int pieces = 0;
        for (int s = 0; s < FROND_LINEAR_SOLVER_COUNT; s++) {
            const frond_linear_solver solver = frond_linear_solver(s);
            if (s > 0 && !is_worth_it(solver, pieces)) continue;
            rows.push_back({&one, solver, measure(one, model, solver, options.rounds)});
            pieces = rows.back().figures.pieces;
            if (!options.csv) print_row(rows.back());
        }
        frond_model_destroy(model);
    }
    if (options.csv) std::printf("%s", csv_of(rows).c_str());
    if (options.out.empty()) return;
    study::write_file(options.out + "/solver.csv", csv_of(rows));
    study::write_file(options.out + "/solver.gp", plot_of(rows, options.out + "/solver"));
    study::run_gnuplot(options.out + "/solver.gp");
}

}  // namespace frond::tools
