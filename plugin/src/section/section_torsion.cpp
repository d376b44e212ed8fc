// Area and second moments of an outline -> its torsion constant. Saint-Venant 1855 ("De la torsion des prismes"): A^4 /
// (4 pi^2 I_p) is exact for every ellipse and close for every compact outline; for rectangles his series is exact. How
// much an outline resembles one or the other follows from A^2 / sqrt(I_thin I_wide), which is 4 pi for every ellipse
// and 12 for every rectangle; in between, the two are mixed. A polygon of eight sides or more counts as an ellipse,
// whose constant is then taken from its second moments alone: 4 I_thin I_wide / I_p, also exact.
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "section/section_parts.hpp"

namespace frond {

static double saint_venant(double area, double polar) {
    return frond::pow(area, 4) / (4 * PI * PI * polar);
}

double squareness(double area, double inertia_thin, double inertia_wide) {
    // Area squared over the root of the product of its second moments; an ellipse has 4 pi.
    constexpr double OCTAGON = 12.53, RECTANGLE = 12;
    const double compactness = area * area / std::sqrt(inertia_thin * inertia_wide);
    return std::clamp((OCTAGON - compactness) / (OCTAGON - RECTANGLE), 0.0, 1.0);
}

double strip_torsion_constant(double width, double thickness) {
    const double t = std::min(width, thickness), w = std::max(width, thickness);
    double sum = 0;
    for (int n = 1; n <= 7; n += 2) sum += frond::tanh(n * PI * w / (2 * t)) / frond::pow(n, 5);
    return w * t * t * t * (1.0 / 3 - 64 / frond::pow(PI, 5) * t / w * sum);
}

double torsion_constant(double area, double inertia_thin, double inertia_wide) {
    const double square = squareness(area, inertia_thin, inertia_wide), polar = inertia_thin + inertia_wide;
    const double round = 4 * inertia_thin * inertia_wide / polar;
    const double aspect = std::sqrt(inertia_wide / inertia_thin);
    const double correction =
        strip_torsion_constant(aspect, 1) / saint_venant(aspect, aspect * (1 + aspect * aspect) / 12);
    return std::min((1 - square) * round + square * correction * saint_venant(area, polar), polar);
}

}  // namespace frond
