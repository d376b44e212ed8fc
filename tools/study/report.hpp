// Report: the files that a study writes into its folder: for each problem a CSV, a diagram (SVG, PNG) and a Markdown
// table, and one page that shows all of them.
#pragma once

#include "study/figures.hpp"

namespace frond::study {

// Machine, compiler and version of a measurement.
struct Provenance {
    std::string processor, compiler, commit, version;
};
std::string processor_name();

// Return the text of each file.
std::string csv_of(const Result& result, const Provenance& provenance);
std::string markdown_of(const Result& result);
std::string gnuplot_of(const Result& result, const std::string& picture_base);
std::string summary_of(const std::vector<Result>& results, const std::vector<Figure>& figures,
                       const Provenance& provenance, const std::string& command);

// Return a field of a CSV file, quoted where necessary (RFC 4180); a cell of a Markdown table; a text for gnuplot.
std::string csv_field(const std::string& text);
std::string markdown_cell(const std::string& text);
std::string gnuplot_text(const std::string& text);

// Returns commands that draw a plot as SVG and as PNG.
std::string drawn_twice(const std::string& plot, const std::string& picture_base);

// Throw a SceneError with the remedy if the folder cannot be made or written to; if gnuplot is missing or failed.
void prepare_folder(const std::string& folder);
void require_gnuplot();
// Does both before anything is measured; nothing if no folder was requested.
void prepare_diagrams(const std::string& folder);
void write_file(const std::string& path, const std::string& text);
void run_gnuplot(const std::string& script_path);

}  // namespace frond::study
