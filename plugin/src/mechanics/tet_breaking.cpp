// In: tets and their nodes' positions. Out: the strain of the outermost fibre of the stem that runs through them, and
// tets without those of a part that broke off.
//
// Along a capsule cage and stem have the same bending energy: where the stem's outermost fibre, at the distance c from
// its axis, is strained by e, the stem holds E I (e / c)^2 L / 2, and the tets half the sum of their E V times the
// squares of their strains. A capsule under tension holds up to four times that at the same strain of its fibre: it
// breaks at half its strength or more. Green's strain needs no rotation and is the same to first order.
#include <cmath>

#include "mechanics/rows.hpp"
#include "mechanics/sections.hpp"
#include "mechanics/tet_plasticity.hpp"

namespace frond {

namespace {

// Returns the square of a tet's strain times its modulus and volume, summed over its integration points [J].
template <class Element>
double weighted_square(const TetElements& elements, size_t e, const VecX& x) {
    const auto places = Element::places(elements, e, x);
    double sum = 0;
    for (int q = 0; q < Element::POINTS; ++q) {
        const TetShare share = Element::share(elements, e, q);
        const double strain = green_strain(share, Element::gradient(share, places, q));
        sum += (young_of(share.lambda, share.mu) + share.grain * share.mu) * share.volume * strain * strain;
    }
    return sum;
}

}  // namespace

void tet_section_strains(const Elements& body, const VecX& x, std::vector<double>& out) {
    const TetElements& elements = as_tets(body);
    const bool linear = elements.nodes.order == 1;
    out.assign(elements.resistance.size(), 0);
    for (size_t e = 0; e < elements.tets.size(); ++e)
        out[size_t(elements.section[e])] +=
            linear ? weighted_square<LinearTet>(elements, e, x) : weighted_square<QuadraticTetElement>(elements, e, x);
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = elements.resistance[i] > 0 ? std::sqrt(out[i] / elements.resistance[i]) : 0;
}

std::unique_ptr<Elements> without_tets(const Elements& body, const std::vector<uint8_t>& gone) {
    const TetElements& all = as_tets(body);
    auto own = std::make_unique<TetElements>(all);
    const auto is_gone = [&](size_t e) { return gone[size_t(all.section[e])] != 0; };
    const size_t points = all.nodes.order == 1 ? LinearTet::POINTS : QuadraticTetElement::POINTS;
    const auto point_is_gone = [&](size_t p) { return is_gone(p / points); };
    keep_others(own->damping_ratio, is_gone);
    keep_others(own->yields, is_gone);
    keep_others(own->nodes.of_tet, is_gone);
    keep_others(own->tets, is_gone);
    keep_others(own->ordered, is_gone);
    keep_others(own->rest_inverse, point_is_gone);
    keep_others(own->point_volume, point_is_gone);
    keep_others(own->volume, is_gone);
    keep_others(own->lambda, is_gone);
    keep_others(own->mu, is_gone);
    keep_others(own->grain, is_gone);
    keep_others(own->grain_modelled, is_gone);
    keep_others(own->grain_axis, point_is_gone);
    keep_others(own->density, is_gone);
    keep_others(own->slots, is_gone);
    keep_others(own->quadratic_slots, is_gone);
    keep_others(own->plastic, point_is_gone);
    keep_others(own->section, is_gone);
    return own;
}

}  // namespace frond
