// The subcommands of frond, each of which adds itself to the command line and runs when chosen, and validators of their
// options.
#pragma once

#include <CLI/CLI.hpp>

namespace frond::tools {

void add_inspect(CLI::App& app);
void add_cook(CLI::App& app);
void add_gallery(CLI::App& app);
void add_run(CLI::App& app);
void add_view(CLI::App& app);
void add_grow(CLI::App& app);
void add_bench(CLI::App& app);
void add_study(CLI::App& app);
void add_export(CLI::App& app);
void add_stability(CLI::App& app);

// Accepts a finite number from least to most; CLI::Range does not check that it is finite.
CLI::Validator real_in(double least, double most);
// Accepts a file whose name has the ending of the written format, such as ".png".
CLI::Validator file_ending_in(const std::string& ending);

}  // namespace frond::tools
