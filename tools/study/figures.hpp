// Figures: the paper's own studies, as pictures and curves, and quantities over time instead of cost.
//   fig6     the cucumber's natural stand under gravity for four heights h of the capsules
//   fig7     the cucumber dragged by its user, for three radii r of the capsules at h = 20 cm
//   contact  how two overlapping corn plants come apart, for every setting of contact
#pragma once

#include "study/study.hpp"

namespace frond::study {

// One of the curves beside the pictures; without points it is not drawn.
struct Curve {
    std::string name;
    std::vector<double> x, y;
};

struct FigurePanel {
    std::string picture;  // file name in the folder; empty: none
    std::string caption;
    Curve curve;
    std::vector<double> row;  // row of the figure's table
};

struct Figure {
    const char* name;
    const char* shows;
    const char* x_label;
    const char* y_label;
    const char* logarithmic;           // axes: "", "y" or "xy"
    std::vector<std::string> columns;  // table headings; one more than a row's numbers: the first is the caption's
    std::vector<FigurePanel> panels;
};

struct FigureRow {
    const char* name;
    const char* shows;
    // Makes the figure and draws its pictures into the folder.
    Figure (*make)(const std::string& folder, Effort effort);
};
const std::vector<FigureRow>& figures();
Figure make_contact(const std::string& folder, Effort effort);

std::string csv_of(const Figure& figure);
std::string markdown_of(const Figure& figure);
std::string gnuplot_of(const Figure& figure, const std::string& picture_base);

}  // namespace frond::study
