// frond study: what accuracy costs in time.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "studio.hpp"
#include "study/report.hpp"

namespace frond::tools {
namespace {

struct StudyOptions {
    std::vector<std::string> names;
    std::string out = "study";
    bool quick = false;
};

// "swing: run 12 of 40" on a terminal.
class Line : public study::Watcher {
public:
    void at(const std::string& problem, int done, int total) override {
        if (!progress || problem != name) {
            name = problem;
            text = problem + ": run";
            progress.reset();
            progress = std::make_unique<Progress>(text.c_str(), total);
        }
        progress->at(done);
    }
    void end() { progress.reset(); }

private:
    std::string name, text;
    std::unique_ptr<Progress> progress;
};

std::vector<const study::Problem*> chosen(const std::vector<std::string>& names) {
    std::vector<const study::Problem*> list;
    for (const std::string& name : names) {
        if (name == "all")
            for (const study::Problem& problem : study::problems()) list.push_back(&problem);
        else
            list.push_back(&study::find_problem(name));
    }
    return list;
}

std::string command_line(const StudyOptions& options) {
    std::string line = "frond study";
    for (const std::string& name : options.names) line += " " + name;
    return line + (options.quick ? " --quick" : "");
}

void list_problems() {
    for (const study::Problem& problem : study::problems())
        std::printf("%-18s %s\n%-18s answer: %s\n", problem.name, problem.measures, "", problem.answer);
}

void run_study(const StudyOptions& options) {
    if (options.names.empty()) return list_problems();
    const std::vector<const study::Problem*> problems = chosen(options.names);
    study::require_gnuplot();
    const std::string gnuplot_folder = options.out + "/gnuplot";
    study::prepare_folder(options.out);
    study::prepare_folder(gnuplot_folder);
    const study::Provenance provenance = {study::processor_name(), FROND_COMPILER, FROND_COMMIT,
                                          frond_version_string()};
    std::vector<study::Result> results;
    Line line;
    for (const study::Problem* problem : problems) {
        results.push_back(
            study::run_problem(*problem, options.quick ? study::Effort::QUICK : study::Effort::FULL, &line));
        line.end();
        const study::Result& result = results.back();
        const std::string base = options.out + "/" + problem->name, script = gnuplot_folder + "/" + problem->name + ".gp";
        study::write_file(base + ".csv", study::csv_of(result, provenance));
        study::write_file(base + ".md", study::markdown_of(result));
        study::write_file(script, study::gnuplot_of(result, base));
        study::run_gnuplot(script);
        const study::Point& first = result.changes.front();
        if (first.failure.empty())
            std::printf("%-18s baseline error %.3g, %.3g ms a simulated second\n", problem->name, first.outcome.error,
                        1e3 * first.outcome.cpu_per_second);
        else
            std::printf("%-18s baseline failed: %s\n", problem->name, first.failure.c_str());
        std::fflush(stdout);
    }
    study::write_file(options.out + "/README.md", study::summary_of(results, provenance, command_line(options)));
    std::printf("open %s/README.md\n", options.out.c_str());
}

}  // namespace

void add_study(CLI::App& app) {
    auto options = std::make_shared<StudyOptions>();
    CLI::App* command =
        app.add_subcommand("study", "what accuracy costs in time: diagrams and tables over problems with known answers");
    command->add_option("problem", options->names, "names of problems, or all; none: list them");
    command->add_flag("--quick", options->quick, "fewer points: all problems in about a minute");
    command->add_option("--out", options->out, "folder to write to, default study");
    command->callback([options] { run_study(*options); });
}

}  // namespace frond::tools
