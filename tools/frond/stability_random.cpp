// frond stability --random: worlds made at random, and the laws that hold in all of them.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "commands.hpp"
#include "export.hpp"
#include "programs/search.hpp"
#include "programs/source.hpp"
#include "stability_random.hpp"

namespace frond::tools {

namespace {

std::string told(const programs::Outcome& outcome) {
    return std::string(programs::name_of(outcome.law)) + ": " + outcome.text;
}

void write(const std::string& path, const std::string& text) {
    std::ofstream file = open_to_write(path);
    file << text;
    close(file, path);
}

// Writes a finding as text, to be run again, and as source.
void keep(const std::string& folder, const programs::Finding& finding) {
    const std::string name = folder + "/" + programs::name_of(finding.outcome.law) + "_" + std::to_string(finding.seed);
    const std::string remark = "Seed " + std::to_string(finding.seed) +
                               " breaks a law: " + programs::text_of(finding.outcome.law) + ". " +
                               finding.outcome.text + ".";
    write(name + ".txt", "# " + remark + "\n" + programs::text_of(finding.program));
    write(name + (programs::needs_cpp(finding.program) ? ".cpp" : ".c"), programs::c_source(finding.program, remark));
}

}  // namespace

void run_random(const RandomOptions& options) {
    programs::SearchSettings settings;
    settings.count = options.count;
    settings.seed = options.seed;
    settings.seconds = options.seconds;
    settings.shrinking = options.shrinking;
    settings.converged = options.converged;
    for (const std::string& name : options.skipped) settings.laws &= ~programs::bit_of(programs::law_called(name));
    if (!options.out.empty()) std::filesystem::create_directories(options.out);
    std::printf("seeds from %llu on\n", static_cast<unsigned long long>(settings.seed));
    std::fflush(stdout);
    const programs::SearchResult result = programs::search(settings, [&](const programs::Finding& finding) {
        std::printf("\nseed %llu: %s\n%s", static_cast<unsigned long long>(finding.seed), told(finding.outcome).c_str(),
                    programs::text_of(finding.program).c_str());
        std::fflush(stdout);
        if (!options.out.empty()) keep(options.out, finding);
    });
    std::printf("\n%d worlds in %.0f s of CPU time, %.0f a minute: %zu broke a law\n", result.worlds, result.seconds,
                60 * result.worlds / std::max(result.seconds, 1e-3), result.findings.size());
    if (!result.findings.empty()) throw SceneError("laws were broken");
}

void list_random(const RandomOptions& options) {
    for (uint64_t seed = options.seed; seed < options.seed + uint64_t(options.count); seed++)
        std::printf("# Seed %llu.\n%s\n", static_cast<unsigned long long>(seed),
                    programs::text_of(programs::random_program(seed)).c_str());
}

void run_program(const RandomOptions& options) {
    const std::string& path = options.program;
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    if (!file) throw SceneError(path + " cannot be read");
    const programs::Program program = programs::program_from(text.str());
    if (options.as_source) {
        std::printf("%s", programs::c_source(program, path).c_str());
        return;
    }
    const programs::Outcome outcome = programs::outcome_apart(program, 300);
    if (!outcome.is_kept)
        throw SceneError(told(outcome) + " (operation " + std::to_string(outcome.operation + 1) + ", step " +
                         std::to_string(outcome.steps) + ")");
    std::printf("all laws hold; hash %016llx\n", static_cast<unsigned long long>(outcome.hash));
}

void add_random_options(CLI::App& command, RandomOptions& options, const std::vector<CLI::Option*>& others,
                        CLI::Option* list) {
    CLI::Option* random =
        command.add_option("--random", options.count, "worlds made at random instead, this many at most")
            ->check(CLI::Range(1, 1000000000));
    CLI::Option* program = command.add_option("--program", options.program, "run a program that --random wrote");
    command.add_flag("--source", options.as_source, "print the program as C, or C++ in a host's world")->needs(program);
    command.add_option("--seed", options.seed, "with --random: seed of the first world, default 1")->needs(random);
    command.add_option("--shrink", options.shrinking, "with --random: time to shorten a program [s], default 60")
        ->needs(random)
        ->check(real_in(0, 1e6));
    command.add_option("--out", options.out, "with --random: write what was found to this folder")->needs(random);
    command.add_option("--skip", options.skipped, "with --random: laws that are not checked")->needs(random);
    command
        .add_flag("--converged", options.converged,
                  "with --random: implicit Euler to balance, to tell the step's errors from others")
        ->needs(random);
    for (CLI::Option* other : others) {
        random->excludes(other);
        program->excludes(other);
    }
    program->excludes(random, list);
}

}  // namespace frond::tools
