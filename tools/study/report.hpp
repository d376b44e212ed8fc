// Report: what a study writes into its folder: per problem a CSV, a diagram (SVG, PNG) and a Markdown table, and one
// page that shows all of them.
#pragma once

#include "study/figures.hpp"

namespace frond::study {

// Where and with what it was measured.
struct Provenance {
    std::string processor, compiler, commit, version;
};
std::string processor_name();

// The text of each file.
std::string csv_of(const Result& result, const Provenance& provenance);
std::string markdown_of(const Result& result);
std::string gnuplot_of(const Result& result, const std::string& picture_base);
std::string summary_of(const std::vector<Result>& results, const std::vector<Figure>& figures,
                       const Provenance& provenance, const std::string& command);

// The front of the problem "sway" as the rows of plugin/src/api/recommend_front.inc.
std::string advice_of(const Result& result, const Provenance& provenance);

// A field of a CSV file, quoted where it must be (RFC 4180); a cell of a Markdown table; a text for gnuplot.
std::string csv_field(const std::string& text);
std::string markdown_cell(const std::string& text);
std::string gnuplot_text(const std::string& text);

// Commands that draw a plot as SVG and as PNG.
std::string drawn_twice(const std::string& plot, const std::string& picture_base);

// Throw a SceneError with the remedy: the folder cannot be made or written to; gnuplot is missing or failed.
void prepare_folder(const std::string& folder);
void require_gnuplot();
// Both, before anything is measured; nothing where no folder was asked for.
void prepare_diagrams(const std::string& folder);
void write_file(const std::string& path, const std::string& text);
void run_gnuplot(const std::string& script_path);

}  // namespace frond::study
