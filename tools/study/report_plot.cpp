// Work-precision diagrams, drawn by gnuplot: error over CPU time, log-log, one line per series, and the Pareto front
// below them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "study/report.hpp"

namespace frond::study {

std::string gnuplot_text(const std::string& text) {
    std::string quoted = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        if (c != '\n') quoted += c;
    }
    return quoted + "\"";
}

std::string drawn_twice(const std::string& plot, const std::string& picture_base) {
    std::string out;
    for (const auto& [terminal, extension] :
         {std::make_pair("svg size 900,520 dynamic background rgb 'white' font 'Helvetica,13'", ".svg"),
          std::make_pair("pngcairo size 1350,780 background rgb 'white' font 'Helvetica,13' fontscale 1.2", ".png")})
        out += std::string("set terminal ") + terminal + "\nset output " + gnuplot_text(picture_base + extension) +
               "\n" + plot + "\n";
    return out + "set output\n";
}

namespace {

// Errors below this are drawn at this value: single precision cannot tell them from zero.
constexpr double LEAST_ERROR = 1e-7;
constexpr double MARGIN = 1.5;  // factor around all points [-]

bool is_drawn(const Point& point) {
    return point.failure.empty() && std::isfinite(point.outcome.error) && point.outcome.cpu_per_second > 0;
}
double milliseconds(const Point& point) {
    return 1e3 * point.outcome.cpu_per_second;
}
double shown_error(const Point& point) {
    return std::max(point.outcome.error, LEAST_ERROR);
}

// Returns the series in their order, without those that have nothing to draw.
std::vector<std::vector<const Point*>> series_of(const Result& result) {
    std::vector<std::vector<const Point*>> list;
    for (const Point& point : result.points) {
        if (!is_drawn(point)) continue;
        if (list.empty() || list.back().front()->series != point.series) list.push_back({});
        list.back().push_back(&point);
    }
    return list;
}

// Returns ticks at powers of ten, and if these are few at 2 and 5 as well, all with their numbers.
std::string ticks(const char* axis, double low, double high) {
    constexpr double FEW = 1.7;  // [decades]
    std::string out = std::string("set format ") + axis;
    if (std::log10(high / low) > FEW) return out + " '10^{%T}'\n";
    out += std::string(" '%g'\nset ") + axis + "tics (";
    bool first = true;
    for (int decade = int(std::floor(std::log10(low))); decade <= int(std::ceil(std::log10(high))); decade++)
        for (int digit : {1, 2, 5}) {
            char text[32];
            std::snprintf(text, sizeof text, "%s%.3g", first ? "" : ", ", digit * std::pow(10, decade));
            out += text;
            first = false;
        }
    return out + ")\n";
}

// Okabe and Ito's colours, which colour-blind readers can distinguish; when they repeat, marks and dashes differ.
const char* const COLOURS[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
const int MARKS[] = {7, 5, 9, 13, 11, 6, 4, 8, 12, 10};

}  // namespace

std::string gnuplot_of(const Result& result, const std::string& picture_base) {
    const std::vector<std::vector<const Point*>> series = series_of(result);
    std::ostringstream out;
    out.precision(8);
    out << "set encoding utf8\nset logscale xy\n"
        << "set xlabel \"CPU time per simulated second [ms]\"\nset ylabel " << gnuplot_text(result.problem->error)
        << "\nset title " << gnuplot_text(std::string(result.problem->name) + ": " + result.problem->measures)
        << " noenhanced\nset grid xtics ytics lc rgb '#dddddd' lw 0.5\nset tics nomirror\nset border 3\n"
        << "set mxtics 10\nset mytics 10\n"
        << "set key outside right top vertical Left reverse noenhanced spacing 1.15 samplen 2.5\n"
        << "set pointsize 0.8\n";
    // The points, one block per series, then the front.
    std::vector<const Point*> front;
    for (size_t i = 0; i < series.size(); i++) {
        out << "$s" << i << " << EOD\n";
        for (const Point* point : series[i]) {
            out << milliseconds(*point) << ' ' << shown_error(*point) << '\n';
            if (point->on_front) front.push_back(point);
        }
        out << "EOD\n";
    }
    std::sort(front.begin(), front.end(),
              [](const Point* a, const Point* b) { return milliseconds(*a) < milliseconds(*b); });
    double low[2] = {INFINITY, INFINITY}, high[2] = {0, 0};
    for (const auto& line : series)
        for (const Point* point : line) {
            const double at[2] = {milliseconds(*point), shown_error(*point)};
            for (int k = 0; k < 2; k++) {
                low[k] = std::min(low[k], at[k]);
                high[k] = std::max(high[k], at[k]);
            }
        }
    for (int k = 0; k < 2 && !series.empty(); k++) out << ticks(k ? "y" : "x", low[k] / MARGIN, high[k] * MARGIN);
    if (!series.empty())
        out << "set xrange [" << low[0] / MARGIN << ':' << high[0] * MARGIN << "]\nset yrange [" << low[1] / MARGIN
            << ':' << high[1] * MARGIN << "]\n";
    out << "$front << EOD\n";
    for (const Point* point : front) out << milliseconds(*point) << ' ' << shown_error(*point) << '\n';
    out << "EOD\n";
    std::ostringstream plot;
    plot << "plot $front using 1:2 with steps lw 7 lc rgb '#dddddd' title 'Pareto front'";
    for (size_t i = 0; i < series.size(); i++)
        plot << ", $s" << i << " using 1:2 with " << (series[i].front()->scattered ? "points" : "linespoints")
             << " lw 1.5 dt " << 1 + i / 7 << " pt " << MARKS[i % 10] << " lc rgb '" << COLOURS[i % 7] << "' title "
             << gnuplot_text(series[i].front()->series);
    if (series.empty())
        plot.str("set label 'nothing could be measured' at graph 0.5, 0.5 center; plot [1:10][1:10] NaN notitle");
    out << drawn_twice(plot.str(), picture_base);
    return out.str();
}

}  // namespace frond::study
