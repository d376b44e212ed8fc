// The subcommands of frond; each adds itself to the command line and runs when it was chosen.
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

}  // namespace frond::tools
