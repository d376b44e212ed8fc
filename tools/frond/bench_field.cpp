// frond bench field: what plants cost that are many: to make, to keep, awake and asleep.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "bench.hpp"
#include "study/report.hpp"

namespace frond::tools {

namespace {

double now() {  // [ms]
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

// What the process keeps in memory [kB].
double memory() {
    std::ifstream file("/proc/self/statm");
    double pages = 0, resident = 0;
    file >> pages >> resident;
    return resident * double(sysconf(_SC_PAGESIZE)) / 1024;
}

struct Figures {
    int plants, capsules;
    double ms_made, kb;               // of one
    double awake, one_awake, asleep;  // steps of the whole Bullet world [ms]
    double frond_asleep;              // of that, Frond's
};

// The median of steps; before each, the first plant is pushed or not.
double median_step(Stage& stage, int steps, double force) {
    std::vector<double> ms;
    for (int i = 0; i < steps; i++) {
        const frond_plant first = stage.plants.front();
        if (force > 0) must(frond_plant_add_force(first, frond_plant_get_node_count(first) - 1, {force, 0, 0}));
        const double start = now();
        must(frond_world_step(stage.world, stage.settings.dt));
        ms.push_back(now() - start);
    }
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 2];
}

frond_report report_of(const Stage& stage) {
    frond_report report;
    must(frond_world_get_report(stage.world, &report));
    return report;
}

Figures measure(int count, const BenchOptions& options) {
    constexpr int AWAKE = 10, SETTLE = 3600, STEPS = 60;
    constexpr double APART = 1.2, FORCE = 0.5;  // [m], [N]
    const Casting casting = cast(options.what);
    Play play(casting, settings_of(casting, options.assignments));
    Stage& stage = play.stage;
    const int side = int(std::ceil(std::sqrt(count)));
    const double before = memory(), start = now();
    for (int i = 1; i < count; i++)
        stage.plant(stage.models.front(), {APART * (i % side), 0, APART * (i / side)}, i);
    Figures figures = {};
    figures.plants = count;
    figures.capsules = frond_plant_get_capsule_count(stage.plants.front());
    figures.ms_made = (now() - start) / std::max(count - 1, 1);
    figures.awake = median_step(stage, AWAKE, 0);
    figures.kb = (memory() - before) / std::max(count - 1, 1);
    for (int i = 0; i < SETTLE && report_of(stage).awake_count > 0; i++)
        must(frond_world_step(stage.world, stage.settings.dt));
    if (report_of(stage).awake_count > 0)
        std::fprintf(stderr, "frond: %d of %d plants do not come to rest\n", report_of(stage).awake_count, count);
    figures.asleep = median_step(stage, STEPS, 0);
    figures.frond_asleep = report_of(stage).ms_step;
    figures.one_awake = median_step(stage, STEPS, FORCE);
    return figures;
}

}  // namespace

void bench_field(const BenchOptions& options) {
    std::printf("%s, %s; steps of the whole world, median [ms], one core\n%s, %s, frond %s %s\n", options.what.c_str(),
                "one after another in rows, 1.2 m apart", study::processor_name().c_str(), FROND_COMPILER,
                frond_version_string(), FROND_COMMIT);
    std::printf("%8s %10s %12s %10s %10s %10s %12s %12s\n", "plants", "capsules", "made [ms]", "each [kB]", "all awake",
                "one awake", "all asleep", "of it Frond");
    for (int count = 100; count <= options.most; count *= 10) {
        const Figures f = measure(count, options);
        std::printf("%8d %10d %12.3f %10.1f %10.3f %10.3f %12.4f %12.4f\n", f.plants, f.capsules, f.ms_made, f.kb, f.awake,
                    f.one_awake, f.asleep, f.frond_asleep);
        std::fflush(stdout);
    }
}

}  // namespace frond::tools
