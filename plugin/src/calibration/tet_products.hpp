// Products of the strains of displaced nodes, tet by tet.
#pragma once

#include "mechanics/tet_element.hpp"

namespace frond {

// Matrix of u_i' K_e u_j for displacements u_i, with three numbers per node of the elements, in tet e, by linear
// theory. Summed over the tets it is u_i' K u_j; for u_i = K^-1 f_i, minus it is the derivative of f_i' K^-1 f_j by the
// logarithm of the tet's modulus.
template <int COUNT>
using Products = Eigen::Matrix<double, COUNT, COUNT>;

// Those of a tet's tissue and of its fibres.
template <int COUNT>
struct TetProducts {
    Products<COUNT> tissue = Products<COUNT>::Zero(), grain = Products<COUNT>::Zero();
    Products<COUNT> both() const { return tissue + grain; }
};

template <class Element, int COUNT>
TetProducts<COUNT> products_in_tet(const TetElements& elements, size_t e, const std::array<VecX, COUNT>& moves) {
    std::array<typename Element::Places, COUNT> places;
    for (size_t i = 0; i < COUNT; i++) places[i] = Element::places(elements, e, moves[i]);
    TetProducts<COUNT> sum;
    for (int q = 0; q < Element::POINTS; q++) {
        const TetShare share = Element::share(elements, e, q);
        // Strains as columns: three along the axes, three shear strains times the root of two.
        Eigen::Matrix<double, 6, COUNT> strains;
        Eigen::Matrix<double, 1, COUNT> along;
        for (int i = 0; i < COUNT; i++) {
            const Mat3 F = Element::gradient(share, places[size_t(i)], q);
            strains.col(i) << F(0, 0), F(1, 1), F(2, 2), (F(0, 1) + F(1, 0)) * M_SQRT1_2,
                (F(0, 2) + F(2, 0)) * M_SQRT1_2, (F(1, 2) + F(2, 1)) * M_SQRT1_2;
            along[i] = stretch_along(share, F);
        }
        const Eigen::Matrix<double, 1, COUNT> swelling = strains.template topRows<3>().colwise().sum();
        sum.tissue += share.volume *
                      (2 * share.mu * strains.transpose() * strains + share.lambda * swelling.transpose() * swelling);
        sum.grain += share.volume * share.grain * share.mu * along.transpose() * along;
    }
    return sum;
}

// Returns one per tet.
template <int COUNT>
std::vector<TetProducts<COUNT>> products_of_tets(const TetElements& elements, const std::array<VecX, COUNT>& moves) {
    std::vector<TetProducts<COUNT>> all;
    for (size_t e = 0; e < elements.tets.size(); e++)
        all.push_back(elements.nodes.order == 1 ? products_in_tet<LinearTet, COUNT>(elements, e, moves)
                                                : products_in_tet<QuadraticTetElement, COUNT>(elements, e, moves));
    return all;
}

}  // namespace frond
