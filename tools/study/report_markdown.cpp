#include <cmath>
#include <sstream>

#include "study/report.hpp"

namespace frond::study {

std::string markdown_cell(const std::string& text) {
    std::string cell;
    for (char c : text) {
        if (c == '|') cell += '\\';
        cell += c == '\n' ? ' ' : c;
    }
    return cell;
}

static std::string figure(double value, const char* format = "%.3g") {
    if (!std::isfinite(value)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

static void add_row(std::ostringstream& out, const std::string& what, const Point& point) {
    const Outcome& o = point.outcome;
    out << "| " << (point.on_front ? "**" + markdown_cell(what) + "**" : markdown_cell(what)) << " | ";
    if (!point.failure.empty()) {
        out << markdown_cell(point.failure) << " | | | |\n";
        return;
    }
    std::string figures;
    for (const Value& value : o.values) {
        figures += (figures.empty() ? "" : "; ") + value.name + " " + figure(value.measured, "%.5g");
        if (std::isfinite(value.known)) figures += " (" + figure(value.known, "%.5g") + ")";
    }
    out << figure(o.error) << " | " << figure(1e3 * o.cpu_per_second) << " | " << o.node_count << " / " << o.tet_count
        << " | " << markdown_cell(figures) << " |\n";
}

std::string markdown_of(const Result& result) {
    const Problem& problem = *result.problem;
    std::ostringstream out;
    const char* HEAD =
        " | error | CPU ms a simulated second | nodes / tets | measured (known) |\n|---|---|---|---|---|\n";
    out << "## " << problem.name << "\n\n"
        << problem.measures << ". Answer: " << problem.answer << ". Error: " << problem.error << ".\n\n";
    for (const std::string& note : result.notes) out << "* " << note << "\n";
    if (!result.notes.empty()) out << "\n";
    const Setup baseline = problem.baseline();
    if (!result.changes.empty()) {
        out << "The baseline (" << frond_mechanics_name(baseline.plant.mechanics) << ", " << resolution_text(baseline)
            << ", " << time_step_text(baseline.dt) << ", " << frond_integrator_name(baseline.plant.integrator) << ", "
            << frond_linear_solver_name(baseline.plant.tuning.linear_solver)
            << "), then one setting changed at a time:\n\n"
            << "| setting" << HEAD;
        for (const Point& point : result.changes) add_row(out, difference(point.setup, baseline), point);
        out << "\n";
    }
    out << "Points of the diagram; bold ones are on the Pareto front:\n\n| series: setting" << HEAD;
    for (const Point& point : result.points)
        add_row(
            out,
            point.series + ": " +
                (problem.axes & (TIME_STEP | EVERYTHING) ? time_step_text(point.setup.dt) + ", " : std::string()) +
                resolution_text(point.setup) +
                (problem.axes & EVERYTHING ? ", " + std::string(frond_integrator_name(point.setup.plant.integrator))
                                           : std::string()) +
                (problem.axes & LINEAR && point.setup.plant.tuning.linear_solver != baseline.plant.tuning.linear_solver
                     ? ", tolerance " + figure(point.setup.plant.tuning.linear_tolerance)
                     : std::string()) +
                (point.setup.plant.tuning.newton_iterations != baseline.plant.tuning.newton_iterations
                     ? ", at most " + std::to_string(point.setup.plant.tuning.newton_iterations) + " solves"
                     : std::string()),
            point);
    return out.str();
}

std::string summary_of(const std::vector<Result>& results, const std::vector<Figure>& figures,
                       const Provenance& provenance, const std::string& command) {
    std::ostringstream out;
    out << "# What accuracy costs in time\n\nMade by `" << command << "` on " << provenance.processor << ", "
        << provenance.compiler << ", frond " << provenance.version << " "
        << (provenance.commit.empty() ? "" : "(" + provenance.commit + ")")
        << ". One core. CPU time is that of whole world steps without the render mesh, least of several repeats.\n\n";
    if (!results.empty())
        out << "| problem | what it measures | baseline error | best error | by | its CPU ms a simulated second |\n"
            << "|---|---|---|---|---|---|\n";
    for (const Result& result : results) {
        const Point* best = nullptr;
        for (const Point& point : result.points)
            if (point.on_front && (!best || point.outcome.error < best->outcome.error)) best = &point;
        const bool has_base = !result.changes.empty() && result.changes[0].failure.empty();
        out << "| [" << result.problem->name << "](#" << result.problem->name << ") | "
            << markdown_cell(result.problem->measures) << " | "
            << (has_base ? figure(result.changes[0].outcome.error) : std::string("-")) << " | ";
        if (best)
            out << figure(best->outcome.error) << " | " << markdown_cell(best->series) << ", "
                << resolution_text(best->setup) << ", " << time_step_text(best->setup.dt) << " | "
                << figure(1e3 * best->outcome.cpu_per_second) << " |\n";
        else
            out << "- | - | - |\n";
    }
    for (const Result& result : results)
        out << "\n<a name=\"" << result.problem->name << "\"></a>\n\n"
            << "![" << result.problem->name << "](" << result.problem->name << ".svg)\n\n"
            << markdown_of(result);
    for (const Figure& figure : figures) out << "\n" << markdown_of(figure);
    return out.str();
}

}  // namespace frond::study
