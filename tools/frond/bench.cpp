// frond bench step: time of a step by stage. frond bench contact: time of contact by the number of plants that touch.
// Nothing sleeps meanwhile.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "bench.hpp"
#include "commands.hpp"
#include "quantile.hpp"
#include "studio/studio.hpp"
#include "study/report.hpp"

namespace frond::tools {
namespace {

struct Stages {
    static constexpr const char* NAMES[] = {"effects",  "assembly", "solve",   "contact",
                                            "capsules", "step",     "surface", "all"};
    static constexpr int COUNT = 8;
    std::vector<double> ms[COUNT];
    void add(const frond_profile& profile) {
        const double values[COUNT] = {
            profile.ms_effects,  profile.ms_assembly, profile.ms_solve,   profile.ms_collide + profile.ms_response,
            profile.ms_capsules, profile.ms_step,     profile.ms_surface, profile.ms_step + profile.ms_surface};
        for (int i = 0; i < COUNT; i++) ms[i].push_back(values[i]);
    }
};

// Warms up, then times steps of the moving plant from the same state repeatedly; prints minimum and median of all.
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
            frond_profile profile;
            must(frond_world_get_profile(play.stage.world, &profile));
            stages.add(profile);
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
                    frond_linear_solver_name(play.stage.settings.plant.tuning.linear_solver), options.rounds * STEPS,
                    study::processor_name().c_str(), FROND_COMPILER, frond_version_string(), FROND_COMMIT, "stage",
                    "min ms", "median ms");
    else
        std::printf("scene,nodes,tets,stage,min_ms,median_ms,processor,compiler,version,commit\n");
    for (int i = 0; i < Stages::COUNT; i++) {
        std::vector<double>& ms = stages.ms[i];
        std::sort(ms.begin(), ms.end());
        if (options.csv)
            std::printf("%s,%d,%d,%s,%.6f,%.6f,\"%s\",\"%s\",%s,%s\n", options.what.c_str(), report.node_count,
                        report.tet_count, Stages::NAMES[i], ms.front(), ms[ms.size() / 2],
                        study::processor_name().c_str(), FROND_COMPILER, frond_version_string(), FROND_COMMIT);
        else
            std::printf("%-10s %10.4f %10.4f\n", Stages::NAMES[i], ms.front(), ms[ms.size() / 2]);
    }
}

// Stages of steps in which plants touch, in the order in which they run.
struct ContactStage {
    const char* name;
    double (*ms)(const frond_profile& profile);
};
constexpr ContactStage CONTACT_STAGES[] = {
    {"broad", [](const frond_profile& p) { return p.ms_broad; }},
    {"hash", [](const frond_profile& p) { return p.ms_hash; }},
    {"narrow", [](const frond_profile& p) { return p.ms_narrow; }},
    {"response", [](const frond_profile& p) { return p.ms_response; }},
    {"solve", [](const frond_profile& p) { return p.ms_assembly + p.ms_solve; }},
    {"all", [](const frond_profile& p) { return p.ms_step; }},
};
constexpr size_t CONTACT_STAGE_COUNT = sizeof CONTACT_STAGES / sizeof CONTACT_STAGES[0];

// Plants of a field that have settled against each other, and the median of each stage.
struct ContactFigures {
    int plants = 0, tets = 0, contacts = 0;
    double ms[CONTACT_STAGE_COUNT] = {};
};

ContactFigures measure_field(int plants, const BenchOptions& options) {
    constexpr int WARM_UP = 90;
    std::vector<std::string> assignments = options.assignments;
    assignments.insert(assignments.end(), {"plants=" + std::to_string(plants), "sleep_distance=0"});
    const Casting casting = cast("corn_field");
    Play play(casting, settings_of(casting, assignments));
    for (int i = 0; i < WARM_UP; i++) play.step();
    std::vector<double> ms[CONTACT_STAGE_COUNT], contacts;
    ContactFigures figures;
    for (int i = 0; i < options.rounds; i++) {
        play.step();
        frond_report report;
        must(frond_world_get_report(play.stage.world, &report));
        frond_profile profile;
        must(frond_world_get_profile(play.stage.world, &profile));
        for (size_t k = 0; k < CONTACT_STAGE_COUNT; k++) ms[k].push_back(CONTACT_STAGES[k].ms(profile));
        contacts.push_back(report.plant_contact_count);
        figures.plants = report.plant_count;
        figures.tets = report.tet_count;
    }
    for (size_t k = 0; k < CONTACT_STAGE_COUNT; k++) figures.ms[k] = median(ms[k]);
    figures.contacts = int(median(contacts));
    return figures;
}

// Steps of a field of eight plants: settled, and while a kinematic box as large as a car goes through it.
struct BoxFigures {
    std::vector<double> settled, driven;  // [ms]
    uint32_t trouble = 0;
};

BoxFigures measure_box(const BenchOptions& options) {
    constexpr int WARM_UP = 30, SETTLED = 20;
    constexpr double SPEED = 20, FROM = -5, TO = 5;  // [m/s], [m]
    std::vector<std::string> assignments = options.assignments;
    assignments.insert(assignments.end(), {"plants=8", "sleep_distance=0"});
    const Casting casting = cast("corn_field");
    Play play(casting, settings_of(casting, assignments));
    BoxFigures figures;
    const auto time_step = [&](std::vector<double>& ms) {
        play.step();
        frond_profile profile;
        must(frond_world_get_profile(play.stage.world, &profile));
        ms.push_back(profile.ms_step);
    };
    for (int i = 0; i < WARM_UP; i++) play.step();
    for (int i = 0; i < SETTLED; i++) time_step(figures.settled);
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_BOX;
    def.size = {2.25, 0.75, 0.9};
    def.mass = 0;
    def.state.position = {FROM, 0.9, 0};
    frond_rigid box = {};
    must(frond_rigid_create(play.stage.world, &def, &box));
    const double way = SPEED * play.stage.settings.dt;
    for (frond_rigid_state state = def.state; state.position.x < TO; state.position.x += way) {
        must(frond_rigid_set_state(box, &state));
        time_step(figures.driven);
        frond_report report;
        must(frond_world_get_report(play.stage.world, &report));
        figures.trouble |= report.trouble;
    }
    return figures;
}

void print_box(const BenchOptions& options) {
    const BoxFigures box = measure_box(options);
    const double settled = median(box.settled), driven = median(box.driven), worst = quantile(box.driven, 1);
    std::printf(
        "a box of 20 m/s through eight: settled %.2f, median %.2f (%.1f times), worst %.2f (%.1f times) ms; "
        "trouble 0x%x\n",
        settled, driven, driven / settled, worst, worst / settled, box.trouble);
}

void bench_contact(const BenchOptions& options) {
    if (options.box) return print_box(options);
    constexpr int COUNTS[] = {1, 2, 4, 8, 17};
    std::vector<ContactFigures> all;
    for (const int plants : COUNTS)
        if (plants <= options.most) all.push_back(measure_field(plants, options));
    if (options.csv) {
        std::printf("plants,tets,contacts,stage,median_ms,processor,compiler,version,commit\n");
        for (const ContactFigures& f : all)
            for (size_t k = 0; k < CONTACT_STAGE_COUNT; k++)
                std::printf("%d,%d,%d,%s,%.6f,\"%s\",\"%s\",%s,%s\n", f.plants, f.tets, f.contacts,
                            CONTACT_STAGES[k].name, f.ms[k], study::processor_name().c_str(), FROND_COMPILER,
                            frond_version_string(), FROND_COMMIT);
        return;
    }
    std::printf("corn_field, settled; median of %d steps [ms], one core\n%s, %s, frond %s %s\n%-8s %8s %8s",
                options.rounds, study::processor_name().c_str(), FROND_COMPILER, frond_version_string(), FROND_COMMIT,
                "plants", "tets", "contacts");
    for (const ContactStage& stage : CONTACT_STAGES) std::printf(" %9s", stage.name);
    for (const ContactFigures& f : all) {
        std::printf("\n%-8d %8d %8d", f.plants, f.tets, f.contacts);
        for (const double ms : f.ms) std::printf(" %9.3f", ms);
    }
    // Time grows as the number of plants to this power, between two plants and all.
    const ContactFigures &few = all[1], &many = all.back();
    const double ratio = std::log(double(many.plants) / few.plants);
    std::printf("\n%-8s %8s %8.2f", "growth", "",
                std::log(std::max(many.contacts, 1) / std::max(double(few.contacts), 1.0)) / ratio);
    for (size_t k = 0; k < CONTACT_STAGE_COUNT; k++)
        std::printf(" %9.2f", few.ms[k] > 0 ? std::log(many.ms[k] / few.ms[k]) / ratio : 0.0);
    std::printf("\n");
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
    auto contact_options = std::make_shared<BenchOptions>();
    CLI::App* contact = bench->add_subcommand("contact", "time of plants that touch, by stage and number of plants");
    contact->add_option("--rounds", contact_options->rounds, "steps, default 20")->check(CLI::Range(1, 100000));
    contact->add_option("--most", contact_options->most, "plants, default 17")->check(CLI::Range(4, 17));
    contact->add_flag("--csv", contact_options->csv, "print CSV");
    contact->add_flag("--box", contact_options->box, "a kinematic box as large as a car through eight plants instead")
        ->excludes("--csv");
    contact->add_option("--set", contact_options->assignments, "key=value, may be repeated; see frond run --help");
    auto solver_options = std::make_shared<BenchOptions>();
    solver_options->most = 20000;
    CLI::App* solver = bench->add_subcommand("solver", "a step by linear solver, of plants from small to very large");
    solver->add_option("--rounds", solver_options->rounds, "steps, default 20")->check(CLI::Range(1, 100000));
    solver->add_option("--most", solver_options->most, "leaves of the trees, default 20000")
        ->check(CLI::Range(0, 20000));
    solver->add_flag("--csv", solver_options->csv, "print CSV");
    solver->add_option("--out", solver_options->out, "folder for CSV and a diagram");
    solver->callback([solver_options] { bench_solver(*solver_options); });
    auto bullet_options = std::make_shared<BenchOptions>();
    bullet_options->most = 30000;
    CLI::App* bullet =
        bench->add_subcommand("versus-bullet", "Bullet's own soft bodies beside Frond, of the same tets");
    bullet->add_option("--most", bullet_options->most, "tets, default 30000")->check(CLI::Range(200, 30000));
    bullet->add_flag("--csv", bullet_options->csv, "print CSV");
    bullet->callback([bullet_options] { bench_versus_bullet(*bullet_options); });
    auto field_options = std::make_shared<BenchOptions>();
    field_options->most = 10000;
    CLI::App* field = bench->add_subcommand("field", "a field: asleep but a path, in wind, with a crowd in it");
    field->add_option("--most", field_options->most, "plants, default 10000")->check(CLI::Range(100, 100000));
    field->add_option("--out", field_options->out, "folder for a diagram");
    field->add_option("--set", field_options->assignments, "key=value, may be repeated; see frond run --help");
    field->callback([field_options] { bench_field(*field_options); });
    auto effects_options = std::make_shared<BenchOptions>();
    auto inside = std::make_shared<bool>(false);
    CLI::App* effects = bench->add_subcommand("effects", "instructions that each effect costs, counted by valgrind");
    effects->add_flag("--csv", effects_options->csv, "print CSV");
    effects->add_flag("--inside", *inside, "steps all cases, for valgrind to count")->group("");
    auto inside_guard = std::make_shared<bool>(false);
    CLI::App* guard =
        bench->add_subcommand("guard", "instructions of the looks for steps gone wrong, counted by valgrind");
    guard->add_flag("--inside", *inside_guard, "steps all cases, for valgrind to count")->group("");
    guard->callback([inside_guard] { *inside_guard ? step_for_guard() : bench_guard(); });
    effects->callback([effects_options, inside] { *inside ? step_all_effects() : bench_effects(*effects_options); });
    contact->callback([contact_options] { bench_contact(*contact_options); });
}

}  // namespace frond::tools
