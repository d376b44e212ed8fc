// frond study: measures what accuracy costs in time.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "studio/studio.hpp"
#include "study/figures.hpp"
#include "study/report.hpp"

namespace frond::tools {
namespace {

struct StudyOptions {
    std::vector<std::string> names;
    std::string out = "study";
    bool quick = false;
};

// The requested problems, in the order of the tables for "all".
struct Chosen {
    std::vector<const study::Problem*> problems;
    std::vector<const study::FigureRow*> figures;
};

Chosen choose(const std::vector<std::string>& names) {
    Chosen chosen;
    for (const std::string& name : names) {
        bool is_figure = false;
        for (const study::FigureRow& figure : study::figures())
            if (name == "all" || name == figure.name) {
                chosen.figures.push_back(&figure);
                is_figure = name != "all";
            }
        if (is_figure) continue;
        if (name == "all")
            for (const study::Problem& problem : study::problems()) chosen.problems.push_back(&problem);
        else
            chosen.problems.push_back(&study::find_problem(name));
    }
    return chosen;
}

std::string command_line(const StudyOptions& options) {
    std::string line = "frond study";
    for (const std::string& name : options.names) line += " " + name;
    return line + (options.quick ? " --quick" : "");
}

void list_problems() {
    for (const study::Problem& problem : study::problems())
        std::printf("%-18s %s\n%-18s answer: %s\n", problem.name, problem.measures, "", problem.answer);
    for (const study::FigureRow& figure : study::figures()) std::printf("%-18s %s\n", figure.name, figure.shows);
}

// Writes the table and the diagram of one problem or figure.
template <class Subject>
void write_diagram(const Subject& subject, const std::string& folder, const std::string& name) {
    const std::string base = folder + "/" + name, script = folder + "/gnuplot/" + name + ".gp";
    study::write_file(base + ".md", study::markdown_of(subject));
    study::write_file(script, study::gnuplot_of(subject, base));
    study::run_gnuplot(script);
}

void tell(const study::Result& result) {
    const study::Point& first = result.changes.front();
    char text[64];
    std::snprintf(text, sizeof text, "baseline error %.3g, %.3g ms a simulated second", first.outcome.error,
                  1e3 * first.outcome.cpu_per_second);
    std::printf("%-18s %s (CPU time of all: %.1f s)\n", result.problem->name,
                first.failure.empty() ? text : ("baseline failed: " + first.failure).c_str(), result.cpu);
    std::fflush(stdout);
}

// Prints "run 12 of 40" on a terminal; writes a problem's results as soon as it has ended.
class Writer : public study::Watcher {
public:
    Writer(std::string folder, const study::Provenance& provenance)
        : folder(std::move(folder)), provenance(provenance) {}
    void at(int done, int total) override {
        if (!progress) progress = std::make_unique<Progress>("run", total);
        progress->at(done);
    }
    void ended(const study::Result& result) override {
        study::write_file(folder + "/" + result.problem->name + ".csv", study::csv_of(result, provenance));
        write_diagram(result, folder, result.problem->name);
        tell(result);
    }

private:
    std::string folder;
    const study::Provenance& provenance;
    std::unique_ptr<Progress> progress;
};

void run_study(const StudyOptions& options) {
    if (options.names.empty()) return list_problems();
    const Chosen chosen = choose(options.names);
    study::prepare_diagrams(options.out);
    study::prepare_folder(options.out + "/gnuplot");
    const study::Provenance provenance = {study::processor_name(), FROND_COMPILER, FROND_COMMIT,
                                          frond_version_string()};
    const study::Effort effort = options.quick ? study::Effort::QUICK : study::Effort::FULL;
    std::vector<study::Result> results;
    {
        Writer writer(options.out, provenance);
        results = study::run_problems(chosen.problems, effort, &writer);
    }
    std::vector<study::Figure> figures;
    for (const study::FigureRow* row : chosen.figures) {
        figures.push_back(row->make(options.out, effort));
        study::write_file(options.out + "/" + row->name + ".csv", study::csv_of(figures.back()));
        write_diagram(figures.back(), options.out, row->name);
        std::printf("%-18s drawn\n", row->name);
    }
    study::write_file(options.out + "/README.md",
                      study::summary_of(results, figures, provenance, command_line(options)));
    std::printf("open %s/README.md\n", options.out.c_str());
}

}  // namespace

void add_study(CLI::App& app) {
    auto options = std::make_shared<StudyOptions>();
    CLI::App* command = app.add_subcommand(
        "study", "what accuracy costs in time: diagrams and tables over problems with known answers");
    command->add_option("problem", options->names, "names of problems, or all; none: list them");
    command->add_flag("--quick", options->quick, "fewer points: all problems in a minute or two");
    command->add_option("--out", options->out, "folder to write to, default study");
    command->callback([options] { run_study(*options); });
}

}  // namespace frond::tools
