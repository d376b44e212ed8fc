// In: rods, positions of their nodes, and damping. Out: rods that resist changes of their strain as well.
//
// Of two springs that act on one strain, to its value at rest and to that at x, the sum is one spring to a value
// between.
#include "mechanics/rod_elements.hpp"
#include "mechanics/rows.hpp"

namespace frond {

std::unique_ptr<const Elements> damped_rods(const Elements& body, const VecX& x, const std::vector<double>& damping,
                                            double step) {
    auto own = std::make_unique<RodElements>(as_rods(body));
    const std::vector<RodStrain> strains = rod_strains(*own, x);
    for (size_t s = 0; s < strains.size(); ++s) {
        RodSegment& rod = own->segments[s];
        const double more = damping[damping.size() == 1 ? 0 : s] / step, share = more / (1 + more);
        rod.rest_strain += share * strains[s].strain;
        rod.rest_curvature += share * strains[s].curvature;
        rod.stretch *= 1 + more;
        rod.bend *= 1 + more;
    }
    return own;
}

}  // namespace frond
