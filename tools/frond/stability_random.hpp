// Options of frond stability for worlds made at random.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace frond::tools {

struct RandomOptions {
    int count = 0;  // number of worlds; 0: no search
    uint64_t seed = 1;
    double seconds = 0;                // CPU time after which no more begin [s]; 0: any
    double shrinking = 60;             // time for one shrinking [s]
    bool converged = false;            // by implicit Euler to balance
    std::vector<std::string> skipped;  // laws that are not checked
    std::string program;               // file of one that is run instead; empty: none
    bool as_source = false;            // print it as C
    std::string out;                   // folder for what was found; empty: none
};
// Makes worlds and checks the laws; throws a SceneError if one was broken.
void run_random(const RandomOptions& options);
// Prints the worlds' programs.
void list_random(const RandomOptions& options);
// Runs a program from a file, or prints it as source.
void run_program(const RandomOptions& options);
// Adds the options, which exclude `others`; one of these may `list`.
void add_random_options(CLI::App& command, RandomOptions& options, const std::vector<CLI::Option*>& others,
                        CLI::Option* list);

}  // namespace frond::tools
