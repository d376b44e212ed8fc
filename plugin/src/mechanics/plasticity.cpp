#include "mechanics/plasticity.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "model/model.hpp"

namespace frond {

// Returns section_limit() of a solid round section; c = 1/k is the radius of the elastic core over the section's.
static double round_limit(double k) {
    if (k <= 1) return k;
    const double c = 1 / k;
    return 2 / (3 * PI) * ((5 - 2 * c * c) * std::sqrt(1 - c * c) + 3 * k * frond::asin(c));
}

double section_limit(const Yield& yield, double k) {
    if (k <= 1) return k;
    if (yield.flat) return 1.5 - 0.5 / (k * k);
    // A tube is a solid rod minus an inner one, whose rim yields later.
    const double cube = yield.hollow * yield.hollow * yield.hollow;
    return (round_limit(k) - cube * round_limit(yield.hollow * k)) / (1 - cube * yield.hollow);
}

double elastic_share(const Yield& yield, double strain, double h, double& hardening) {
    const double trial = strain / yield.strain;
    if (!(trial > 1)) return 1;

    // Bent monotonically from the start, it would now be at k = elastic + plastic strain, both over the yield strain.
    const double limit = section_limit(yield, trial + hardening);
    double elastic = std::min(trial, limit);
    elastic = 1 + (elastic - 1) * frond::exp(-yield.creep * h);
    hardening += trial - elastic;
    return elastic / trial;
}

Yield yield_of(const Model& model, int organ) {
    const Organ& o = model.organs[size_t(std::max(organ, 0))];
    return {o.material.yield_strain, o.material.creep_rate, std::sqrt(hole_share(o)), is_sheet(o)};
}

double firm_strain(double yield_strain, double standing) {
    constexpr double MARGIN = 1.5;  // a coarse cage strains places more than tissue is [-]
    return std::max(yield_strain, MARGIN * standing);
}

}  // namespace frond
