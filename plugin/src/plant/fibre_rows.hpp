// FibreRow: a fibre that is taut, or that others may draw taut, and what pulls at fibres from beside them.
#pragma once

#include <vector>

#include "mechanics/attachment.hpp"
#include "plant/fibres.hpp"

namespace frond {

struct FibreRow {
    Attachment begin, end;
    double length;     // length from which it pulls [m]
    double stiffness;  // [N/m]
};

// Finds the taut fibres and, if there are any, the nearly taut ones, which others may stretch.
std::vector<FibreRow> find_fibre_rows(const Plant& plant);
// Crossed leaves come apart only by being stretched, so fibres of an entangled plant lengthen, and shorten afterwards
// no faster than contacts can follow.
void let_fibres_give(Plant& plant, double h);

}  // namespace frond
