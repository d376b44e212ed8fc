// Makes rows of the table of mechanics from a material that is written for lanes. Besides the functions of
// tet_by_tet.hpp such a material ("law") has
//   GOES_AHEAD                                       true if it has the next one, for Mechanics::add_ahead
//   Lanes33<S> stress_of_change(share, strain, dF)   the positive stiffness times a change of F [Pa]
// Four integration points are taken at once: of four T4 tets or of one T10 tet. Results are the same as for each alone,
// and are added up in the order of tets.
#pragma once

#include "mechanics/four_points.hpp"
#include "mechanics/four_tets.hpp"
#include "mechanics/grain.hpp"
#include "mechanics/tet_batch.hpp"
#include "mechanics/tet_by_tet.hpp"

namespace frond {

// Sums of one pass over the tets; those that are null are skipped.
template <class Law, class Group>
struct TetPass {
    const TetElements& elements;
    const VecX& x;
    int& inverted;  // number of inverted tets
    double* energy = nullptr;
    VecX* f = nullptr;
    BlockMatrix* K = nullptr;
    Tangent tangent = Tangent::positive;
    double scale = 1;                              // factor of the stiffness
    const std::vector<double>* damping = nullptr;  // one an element [s]
    BlockMatrix* D = nullptr;                      // gets damping times the stiffness
    const Ahead* ahead = nullptr;                  // K is then A of Mechanics::add_ahead

    // Uses four lanes even if the processor has two.
    template <class>
    FROND_INLINE void run() const {
        using S = FourLanes;
        inverted = 0;
        for (size_t first = 0; first < elements.tets.size(); first += Group::TETS) {
            const Group tets(elements, first);
            const TetShareLanes<S> share = tets.share();
            const auto strain = Law::strain(share, tets.edges(x.data()) * share.rest_inverse);
            inverted += tets.count_tets(Law::inverted(strain));
            if (energy) *energy += tets.sum(share.volume * Law::energy(share, strain));
            if (!f && !K) continue;
            S by = constant<S>(scale), damped = constant<S>(0);
            if (damping) damped = tets.of_tets(*damping);
            if (ahead) {
                damped += ahead->damping;
                by = ahead->step * (ahead->step + damped);
            }
            const auto stress = [&]() FROND_INLINED {
                if constexpr (Law::GOES_AHEAD)
                    if (ahead) return stress_ahead<Law>(tets, share, strain, *ahead, damped);
                return Law::stress(share, strain);
            };
            if (f) tets.add_force(share, stress(), *f);
            if (!K) continue;
            const TetStiffnessLanes<S> stiffness = Law::stiffness(share, strain, tangent, by);
            tets.add_stiffness(stiffness, *K);
            if (D) tets.add_stiffness(damped * stiffness, *D);
        }
    }
};

template <class Law, class Group>
struct TetRowInLanes {
    static double energy(const Elements& body, const VecX& x) {
        double energy = 0;
        int inverted = 0;
        TetPass<Law, Group> pass = {as_tets(body), x, inverted};
        pass.energy = &energy;
        run_in_lanes(pass);
        return energy;
    }
    static int add_force(const Elements& body, const VecX& x, VecX& f) {
        int inverted = 0;
        TetPass<Law, Group> pass = {as_tets(body), x, inverted};
        pass.f = &f;
        run_in_lanes(pass);
        return inverted;
    }
    static void add_stiffness(const Elements& body, const VecX& x, Tangent tangent, double scale, BlockMatrix& K) {
        int inverted = 0;
        TetPass<Law, Group> pass = {as_tets(body), x, inverted};
        pass.K = &K;
        pass.tangent = tangent;
        pass.scale = scale;
        run_in_lanes(pass);
    }
    static int add_both(const Elements& body, const VecX& x, Tangent tangent, VecX& f, BlockMatrix& K) {
        int inverted = 0;
        TetPass<Law, Group> pass = {as_tets(body), x, inverted};
        pass.f = &f;
        pass.K = &K;
        pass.tangent = tangent;
        run_in_lanes(pass);
        return inverted;
    }
    static int add_damped(const Elements& body, const VecX& x, const std::vector<double>& damping, VecX& f,
                          BlockMatrix& K, BlockMatrix& D) {
        int inverted = 0;
        TetPass<Law, Group> pass = {as_tets(body), x, inverted};
        pass.f = &f;
        pass.K = &K;
        pass.damping = &damping;
        pass.D = &D;
        run_in_lanes(pass);
        return inverted;
    }
    static int add_ahead(const Elements& body, const VecX& x, const Ahead& ahead, VecX& f, BlockMatrix& A) {
        int inverted = 0;
        TetPass<Law, Group> pass = {as_tets(body), x, inverted};
        pass.f = &f;
        pass.K = &A;
        pass.damping = ahead.element_damping.empty() ? nullptr : &ahead.element_damping;
        pass.ahead = &ahead;
        run_in_lanes(pass);
        return inverted;
    }
};

template <class Plain>
Mechanics tet_row(const char* name, int order, bool needs_search) {
    using Law = Grained<Plain>;
    Mechanics row;
    row.name = name;
    row.masses = tet_masses;
    row.copy = copy_tets;
    row.get_plastic = plastic_of_tets;
    row.set_plastic = set_plastic_of_tets;
    row.section_strains = tet_section_strains;
    row.without = without_tets;
    row.needs_search = needs_search;
    const auto take = [&](auto element, auto lanes) {
        using Element = decltype(element);
        using Points = PointByPoint<Law>;
        row.energy = lanes.energy;
        row.add_force = lanes.add_force;
        row.add_stiffness = lanes.add_stiffness;
        row.add_force_and_stiffness = lanes.add_both;
        row.add_force_stiffness_and_damping = lanes.add_damped;
        if (Law::GOES_AHEAD) row.add_ahead = lanes.add_ahead;
        row.is_calm = tets_are_calm<Element>;
        row.rest_derivative = rest_derivative<Plain, Element>;
        row.yields = tets_yield<Element>;
        row.flow = TetByTet<Points, Element>::flow;
    };
    row.make = order == 1 ? make_tets<1> : make_tets<2>;
    if (order == 1)
        take(LinearTet(), TetRowInLanes<Law, FourTets>());
    else
        take(QuadraticTetElement(), TetRowInLanes<Law, FourPoints>());
    return row;
}

// Makes a row whose plants are stepped in batches too.
template <class Law>
Mechanics batched_tet_row(const char* name, int order) {
    Mechanics row = tet_row<Law>(name, order, false);
    if (order == 2) return row;
    static const BatchMechanics BATCH = {TetBatch<Grained<Law>>::set_ahead, nullptr, tets_not_calm, tets_may_yield};
    row.batch = &BATCH;
    return row;
}

}  // namespace frond
