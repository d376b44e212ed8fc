// frond bench guard: cost of the checks for failed steps in a step that succeeds.
//
// Valgrind's callgrind counts the instructions of steps of a plant that was just let go and of one that sways, and
// those of the checking functions within them.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "bench.hpp"
#include "callgrind/count_self.hpp"
#include "callgrind/requests.hpp"

namespace frond::tools {

namespace {

constexpr int PULLED = 20, STEPS = 10;

// Ten steps are counted after the plant was let go, and ten while it sways, a second later.
struct CountWindow {
    const char* name;
    int begin;  // first counted step
};
constexpr CountWindow WINDOWS[] = {{"let go", PULLED}, {"swaying", PULLED + 60}};

// Pulls a corn plant by a leaf and lets it go, with one mechanics.
void sway_in_callgrind(frond_model model, frond_mechanics mechanics) {
    const frond_world_def world_def = frond_default_world_def();
    frond_world world = {};
    must(frond_world_create(&world_def, &world));
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = mechanics;
    frond_plant plant = {};
    must(frond_plant_create(world, model, &def, &plant));
    const int node = frond_plant_get_node_count(plant) - 1;
    std::string part;  // outlives the loop, as callgrind reads it a little after the request
    int i = 0;
    const auto step = [&] {
        if (i++ < PULLED) must(frond_plant_add_force(plant, node, {0.5, 0, 0}));
        must(frond_world_step(world, 1.0 / 60));
    };
    for (const CountWindow& window : WINDOWS) {
        while (i < window.begin) step();
        CALLGRIND_TOGGLE_COLLECT;
        while (i < window.begin + STEPS) step();
        CALLGRIND_TOGGLE_COLLECT;
        part = std::string(frond_mechanics_name(mechanics)) + ", " + window.name;
        CALLGRIND_DUMP_STATS_AT(part.c_str());
    }
    frond_world_destroy(world);
}

struct GuardCount {
    double all = 0, guard = 0;  // instructions
};

// "cfn=(12) name" names a called function, later given only by its number; the line after "calls=" has the call's cost.
GuardCount read_guard_part(const std::vector<std::string>& lines) {
    static const char* const GUARD[] = {"ends_off_course", "has_run_away",    "is_far_out",
                                        "is_plausible",    "are_finite",      "look_at_energy",
                                        "watch_recovery",  "damp_recovering", "jump_with_pins"};
    GuardCount counted;
    std::map<std::string, bool> is_guard;
    bool counts = false, is_call = false, in_guard = false;
    for (const std::string& line : lines) {
        if (begins_with(line, "totals: ")) counted.all = std::strtod(line.c_str() + 8, nullptr);
        const bool names_called = begins_with(line, "cfn=");
        if (names_called || begins_with(line, "fn=")) {
            const size_t open = line.find('('), close = line.find(')');
            const std::string number = line.substr(open, close - open);
            if (close + 1 < line.size())
                for (const char* word : GUARD) is_guard[number] |= line.find(word, close) != std::string::npos;
            // The cost of a checking function includes the functions that it calls.
            if (names_called)
                counts = is_guard[number] && !in_guard;
            else
                in_guard = is_guard[number];
        } else if (begins_with(line, "calls=")) {
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
    const auto parts = count_self("bench guard --inside", "--collect-atstart=no");
    if (parts.empty())
        throw SceneError("valgrind did not count; install it with tools/install-packages and build again");
    std::printf("instructions of a step of a corn plant, by callgrind\n%-26s %12s %12s %8s\n", "mechanics", "all",
                "guard", "share");
    for (const auto& [name, lines] : parts) {
        const GuardCount counted = read_guard_part(lines);
        std::printf("%-26s %12.0f %12.0f %7.2f%%\n", name.c_str(), counted.all / STEPS, counted.guard / STEPS,
                    100 * counted.guard / counted.all);
    }
}

}  // namespace frond::tools
