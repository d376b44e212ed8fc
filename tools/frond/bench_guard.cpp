// frond bench guard: what the looks for steps gone wrong cost in a step that has not.
//
// Valgrind's callgrind counts the instructions of steps of a plant that sways, and of those functions in them.
#include <unistd.h>
#include <valgrind/callgrind.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "bench.hpp"

namespace frond::tools {

namespace {

constexpr int PULL = 20, STEPS = 10;

// A corn plant pulled by a leaf and let go, in one mechanics.
void sway_in_callgrind(frond_model model, frond_mechanics mechanics) {
    const frond_world_def world_def = frond_default_world_def();
    frond_world world = {};
    must(frond_world_create(&world_def, &world));
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = mechanics;
    frond_plant plant = {};
    must(frond_plant_create(world, model, &def, &plant));
    const int node = frond_plant_get_node_count(plant) - 1;
    for (int i = 0; i < PULL + STEPS; i++) {
        if (i < PULL) must(frond_plant_add_force(plant, node, {0.5, 0, 0}));
        if (i == PULL) CALLGRIND_TOGGLE_COLLECT;
        must(frond_world_step(world, 1.0 / 60));
    }
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_DUMP_STATS_AT(frond_mechanics_name(mechanics));
    frond_world_destroy(world);
}

struct Counted {
    std::string name;
    double all = 0, guard = 0;  // instructions
};

// "cfn=(12) name" names a function that is called, later only by its number; the line after "calls=" has what it took.
Counted read_part(const std::filesystem::path& path) {
    static const char* const GUARD[] = {"farthest_way", "ends_off_course", "reach_at_start",  "look_at_energy",
                                        "are_near",     "watch_recovery",  "damp_recovering", "jump_with_pins"};
    const std::string trigger = "desc: Trigger: Client Request: ";
    Counted counted;
    std::map<std::string, bool> is_guard;
    bool counts = false, is_call = false, in_guard = false;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.rfind(trigger, 0) == 0) counted.name = line.substr(trigger.size());
        if (line.rfind("totals: ", 0) == 0) counted.all = std::strtod(line.c_str() + 8, nullptr);
        const bool names_called = line.rfind("cfn=", 0) == 0;
        if (names_called || line.rfind("fn=", 0) == 0) {
            const size_t open = line.find('('), close = line.find(')');
            const std::string number = line.substr(open, close - open);
            if (close + 1 < line.size())
                for (const char* word : GUARD) is_guard[number] |= line.find(word, close) != std::string::npos;
            // What one of them calls is in what it took.
            if (names_called)
                counts = is_guard[number] && !in_guard;
            else
                in_guard = is_guard[number];
        } else if (line.rfind("calls=", 0) == 0) {
            is_call = true;
        } else if (is_call) {
            is_call = false;
            if (counts) counted.guard += std::strtod(line.c_str() + line.find(' ') + 1, nullptr);
        }
    }
    return counted;
}

}  // namespace

void step_for_guard() {
    frond_model model = {};
    const frond_model_def def = frond_default_model_def();
    must(frond_model_load(model_path("corn/corn.obj").c_str(), &def, &model));
    for (int m = 0; m < FROND_MECHANICS_COUNT; m++) sway_in_callgrind(model, frond_mechanics(m));
    frond_model_destroy(model);
}

void bench_guard() {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("frond_guard_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command = "valgrind --tool=callgrind --collect-atstart=no -q --callgrind-out-file='" +
                                (folder / "part").string() + "' '" + self + "' bench guard --inside > /dev/null";
    const int status = std::system(command.c_str());
    std::printf("instructions of a step of a swaying corn plant, by callgrind\n%-18s %12s %12s %8s\n", "mechanics",
                "all", "guard", "share");
    int parts = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const Counted counted = read_part(entry.path());
        if (counted.name.empty() || counted.all == 0) continue;
        parts++;
        std::printf("%-18s %12.0f %12.0f %7.2f%%\n", counted.name.c_str(), counted.all / STEPS, counted.guard / STEPS,
                    100 * counted.guard / counted.all);
    }
    std::filesystem::remove_all(folder);
    if (status != 0 || parts == 0) throw SceneError("valgrind did not count; install it with tools/install-packages");
}

}  // namespace frond::tools
