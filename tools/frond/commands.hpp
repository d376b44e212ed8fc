// The subcommands of frond; each adds itself to the command line and runs when it was chosen. What their options may
// be.
#pragma once

#include <CLI/CLI.hpp>

namespace frond::tools {

void add_inspect(CLI::App& app);
void add_run(CLI::App& app);
void add_view(CLI::App& app);
void add_grow(CLI::App& app);
void add_bench(CLI::App& app);
void add_study(CLI::App& app);
void add_export(CLI::App& app);
void add_stability(CLI::App& app);

// A finite number from least to most, which CLI::Range does not ask for.
CLI::Validator real_in(double least, double most);
// A file whose name has the ending of the format that is written, ".png".
CLI::Validator file_ending_in(const std::string& ending);

}  // namespace frond::tools
