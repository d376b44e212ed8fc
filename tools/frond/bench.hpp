// Options of frond bench.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace frond::tools {

struct BenchOptions {
    std::string what = "drag";
    int rounds = 20;
    int most = 17;  // plants, or leaves
    bool csv = false;
    std::string out;  // folder for diagrams; empty: none
    std::vector<std::string> assignments;
};

void bench_solver(const BenchOptions& options);
void bench_versus_bullet(const BenchOptions& options);
void bench_field(const BenchOptions& options);
void bench_kinds();
void bench_effects(const BenchOptions& options);
void bench_guard();
void step_for_guard();  // for valgrind to count
// Takes the steps that the latter counts.
void step_all_effects();

double now();  // [ms]

}  // namespace frond::tools
