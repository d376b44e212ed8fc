// Options of frond bench.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace frond::tools {

struct BenchOptions {
    std::string what = "drag";
    int rounds = 20;
    int most = 17;  // largest number of plants, leaves or tets
    bool csv = false;
    bool box = false;  // a box goes through the plants
    std::string out;   // folder for diagrams; empty: no diagrams
    std::vector<std::string> assignments;
};

void bench_solver(const BenchOptions& options);
void bench_versus_bullet(const BenchOptions& options);
void bench_field(const BenchOptions& options);
void bench_kinds();
void bench_effects(const BenchOptions& options);
void bench_guard();
void step_for_guard();  // run inside Valgrind, which counts instructions
// Takes the steps whose instructions bench_effects counts.
void step_all_effects();

double now();  // time of a steady clock [ms]

}  // namespace frond::tools
