// In: the elastic stretch of tets. Out: its plastic part, as a change F_p of the rest shape that keeps the volume:
// F = F_e F_p (Lee 1969, "Elastic-plastic deformation at finite strains"; return to the yield strain after Irving,
// Teran, Fedkiw 2004, "Invertible finite elements"). The material then sees F F_p^-1, so the inverse of the rest edges
// is replaced by its product with F_p^-1.
//
// A cage is thicker than the stem in it, so its tets' strains are not those of a fibre. Along each capsule of the chain
// cage and rod have the same bending energy, by calibration: when the rim of the rod yields, the tets have a mean
// square strain of EI k^2 L over the sum of their E V, k being the rod's curvature then.
#include "mechanics/tet_plasticity.hpp"

#include <algorithm>
#include <cmath>

#include "cage/tet_geometry.hpp"
#include "core/decompose.hpp"
#include "core/elementary.hpp"
#include "core/error.hpp"
#include "mechanics/polar.hpp"
#include "mechanics/tet_looks.hpp"

namespace frond {

namespace {

constexpr double FLATTEST = 0.05;        // smallest stretch that still flows [-]
constexpr double LOG_OVER_GREEN = 2.2;   // bound of logarithmic over Green's strain, down to a stretch of 0.4 [-]
constexpr size_t NUMBERS_OF_POINT = 10;  // F_p^-1 by columns, hardening

// Returns the equivalent strain after von Mises: a bar pulled by e has the deviator (1 + nu) e (2/3, -1/3, -1/3).
double as_pulled(const TetShare& share, double deviator_norm) {
    const double poisson = share.lambda / (2 * (share.lambda + share.mu));
    return std::sqrt(1.5) * deviator_norm / (1 + poisson);
}

// Tets are strained unevenly: at the root mean square strain the first ones would yield long before the rod's rim. At
// this multiple of it cages keep their shape at half of the rod's yield load, and at one and a half times that load
// their plastic deflection is within half of the rod's (tests/plant/plasticity.cpp).
constexpr double RIM = 1.4;

// Returns the strain at which tets of a calibrated cage, with their moduli in these mechanics, yield over that of their
// organ's outermost fibre, one a tet [-]. In a capsule all tets bear the same energy a volume, whatever their moduli.
std::vector<double> strain_in_cage(const Model& model, const TetElements& elements) {
    const std::vector<int>& capsule = elements.section;
    std::vector<double> volume(model.chain.nodes.size(), 0);
    for (size_t e = 0; e < capsule.size(); ++e)
        volume[size_t(capsule[e])] += std::abs(tet_volume(model.cage.nodes, model.cage.tets[e]));
    std::vector<double> share(capsule.size(), 1);
    for (size_t e = 0; e < share.size(); ++e) {
        const size_t i = size_t(capsule[e]);
        const Section& section = model.sections[i];
        const double stiffer = model.organ_stiffer[size_t(std::max(model.chain.nodes[i].organ, 0))];
        if (model.chain.nodes[i].parent < 0) continue;
        const double young = young_of(elements.lambda[e], elements.mu[e]) + elements.grain[e] * elements.mu[e];
        share[e] = RIM * std::sqrt(stiffer * section.bending_thin() * section.length / (volume[i] * young)) /
                   (0.5 * section.thickness);
    }
    return share;
}

}  // namespace

Strained strained_at(const TetShare& share, const Mat3& F) {
    const Mat3 S = polar_decomposition(F).rotation.transpose() * F;
    Strained out = {0.5 * (S + S.transpose()), 0};
    const Vec3 stretch = symmetric_values(out.S);
    if (!(stretch[0] > FLATTEST)) return out;
    const Eigen::Array3d strain = stretch.array().unaryExpr(&frond::log);
    out.strain = as_pulled(share, (strain - strain.mean()).matrix().norm());
    return out;
}

double green_strain(const TetShare& share, const Mat3& F) {
    Mat3 E = 0.5 * (F.transpose() * F);
    E.diagonal().array() -= E.trace() / 3;
    return as_pulled(share, E.norm());
}

bool exceeds(const TetShare& share, const Mat3& F, double most, Strained& out) {
    if (most == 0) return false;
    // Green's strain needs no rotation.
    if (!(LOG_OVER_GREEN * green_strain(share, F) > most)) return false;
    out = strained_at(share, F);
    return out.strain > most;
}

Mat3 flow_of(const Mat3& S, double elastic) {
    const SymmetricParts parts = symmetric_parts(S);
    const Eigen::Array3d strain = parts.values.array().unaryExpr(&frond::log);
    const Eigen::Array3d change = ((elastic - 1) * (strain - strain.mean())).unaryExpr(&frond::exp);
    return parts.vectors * change.matrix().asDiagonal() * parts.vectors.transpose();
}

// Returns the largest strain of a tet in the standing plant.
template <class Element>
static double standing_strain(const TetElements& elements, size_t e) {
    const auto places = Element::places(elements, e, elements.modelled);
    double largest = 0;
    for (int q = 0; q < Element::POINTS; ++q) {
        const TetShare share = Element::share(elements, e, q);
        largest = std::max(largest, strained_at(share, Element::gradient(share, places, q)).strain);
    }
    return largest;
}

void let_tets_yield(const Model& model, TetElements& elements) {
    std::vector<Yield> yields;
    for (int organ : model.cage.tet_organ) yields.push_back(yield_of(model, organ));
    if (std::all_of(yields.begin(), yields.end(), [](const Yield& y) { return y.strain == 0; })) return;
    if (model.calibrated) {
        const std::vector<double> share = strain_in_cage(model, elements);
        for (size_t e = 0; e < yields.size(); ++e) yields[e].strain *= share[e];
    }
    for (size_t e = 0; e < yields.size(); ++e) {
        const double standing = elements.nodes.order == 1 ? standing_strain<LinearTet>(elements, e)
                                                          : standing_strain<QuadraticTetElement>(elements, e);
        if (yields[e].strain > 0) yields[e].strain = firm_strain(yields[e].strain, standing);
    }
    elements.yields = std::move(yields);
}

// Inverts as_pulled().
double green_square_allowed(const TetElements& elements, size_t e) {
    const double sum = elements.lambda[e] + elements.mu[e];
    const double most = elements.yields[e].strain / LOG_OVER_GREEN * (1 + elements.lambda[e] / (2 * sum));
    return most > 0 ? most * most / 1.5 : INFINITY;
}

template <class Element>
bool tets_yield(const Elements& body, const VecX& x) {
    const TetElements& elements = as_tets(body);
    if (Element::POINTS == 1 && !any_tet_may_yield(body, x)) return false;
    Strained strained;
    for (size_t e = 0; e < elements.tets.size(); ++e) {
        const auto places = Element::places(elements, e, x);
        for (int q = 0; q < Element::POINTS; ++q) {
            const TetShare share = Element::share(elements, e, q);
            if (exceeds(share, Element::gradient(share, places, q), elements.yields[e].strain, strained)) return true;
        }
    }
    return false;
}
template bool tets_yield<LinearTet>(const Elements&, const VecX&);
template bool tets_yield<QuadraticTetElement>(const Elements&, const VecX&);

std::unique_ptr<Elements> copy_tets(const Elements& body) {
    auto own = std::make_unique<TetElements>(as_tets(body));
    for (const Mat3& rest_inverse : own->rest_inverse) own->plastic.push_back({rest_inverse, Mat3::Identity(), 0});
    return own;
}

std::vector<double> plastic_of_tets(const Elements& body) {
    std::vector<double> values;
    for (const TetPlastic& plastic : as_tets(body).plastic) {
        values.insert(values.end(), plastic.inverse.data(), plastic.inverse.data() + 9);
        values.push_back(plastic.hardening);
    }
    return values;
}

void set_plastic_of_tets(Elements& body, const std::vector<double>& values) {
    constexpr double TOLERANCE = 1e-3;  // relative change of volume [-]
    TetElements& elements = static_cast<TetElements&>(body);
    std::vector<TetPlastic> plastic = elements.plastic;
    if (values.size() != NUMBERS_OF_POINT * plastic.size())
        fail(FROND_RESULT_BAD_ARGUMENT, "%zu numbers of a plastic state were given, but a plant of these tets has %zu",
             values.size(), NUMBERS_OF_POINT * plastic.size());
    const size_t points = elements.nodes.order == 1 ? LinearTet::POINTS : QuadraticTetElement::POINTS;
    for (size_t p = 0; p < plastic.size(); ++p) {
        TetPlastic& l = plastic[p];
        l.inverse = Eigen::Map<const Mat3>(values.data() + NUMBERS_OF_POINT * p);
        l.hardening = values[NUMBERS_OF_POINT * p + 9];
        if (!(std::abs(l.inverse.determinant() - 1) < TOLERANCE) || !(l.hardening >= 0))
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "the plastic state changes the volume of tet %zu or its hardening is below 0; give numbers that "
                 "frond_plant_get_plastic wrote",
                 p / points);
        l.rest_inverse = elements.rest_inverse[p] * l.inverse;
    }
    elements.plastic = std::move(plastic);
}

}  // namespace frond
