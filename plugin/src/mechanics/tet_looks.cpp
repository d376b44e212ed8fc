// In: T4 tets and their nodes' positions. Out: whether any of them needs an exact check.
#include "mechanics/tet_looks.hpp"

#include "mechanics/batch.hpp"
#include "mechanics/four_tets.hpp"
#include "mechanics/rows.hpp"
#include "mechanics/tet_of_several.hpp"
#include "mechanics/tet_plasticity.hpp"

namespace frond {

namespace {

struct OfOne {
    template <class>
    using Tets = FourTets;
};
struct OfSeveral {
    template <class S>
    using Tets = TetOfSeveral<S>;
};

template <class Of>
struct LookForWild {
    const TetElements& elements;
    const double *from, *to;
    double part;  // share of the displacement [-]
    unsigned& found;
    template <class Width>
    FROND_INLINE void run() const {
        using Tets = typename Of::template Tets<Width>;
        using S = typename Tets::S;
        constexpr double MOST = LARGEST_CHANGE * LARGEST_CHANGE * NEARLY;  // [-]
        S calm = constant<S>(1);
        for (size_t first = 0; first < elements.tets.size(); first += Tets::TETS) {
            const Tets tets(elements, first);
            const Lanes33<S> change = constant<S>(part) * (tets.edges(to) - tets.edges(from)) * tets.at_rest();
            calm = select(dot(change, change) < MOST, calm, S{});
        }
        found = bits_of(calm == 0.0);
    }
};

// Checks by Green's strain.
template <class Of>
struct LookForStrained {
    const TetElements& elements;
    const double* x;
    unsigned& found;
    template <class Width>
    FROND_INLINE void run() const {
        using Tets = typename Of::template Tets<Width>;
        using S = typename Tets::S;
        S within = constant<S>(1);
        for (size_t first = 0; first < elements.tets.size(); first += Tets::TETS) {
            const Tets tets(elements, first);
            const Lanes33<S> F = tets.edges(x) * tets.at_rest(), C = transposed_times(F, F);
            const auto green = [&](const S& c) FROND_INLINED { return S(0.5 * c); };
            const S xx = green(C.r[0].x), yy = green(C.r[1].y), zz = green(C.r[2].z), xy = green(C.r[0].y),
                    yz = green(C.r[1].z), zx = green(C.r[2].x);
            const S mean = (xx + yy + zz) * (1.0 / 3), a = xx - mean, b = yy - mean, c = zz - mean;
            const S square = a * a + b * b + c * c + 2.0 * (xy * xy + yz * yz + zx * zx);
            within = select(square <= tets.of_each([&](size_t e) { return green_square_allowed(elements, e); }), within,
                            S{});
        }
        found = bits_of(within == 0.0);
    }
};

}  // namespace

bool any_tet_is_wild(const Elements& body, const VecX& from, const VecX& to) {
    unsigned found = 0;
    run_in_lanes(LookForWild<OfOne>{as_tets(body), from.data(), to.data(), 1, found});
    return found != 0;
}

bool any_tet_may_yield(const Elements& body, const VecX& x) {
    unsigned found = 0;
    run_in_lanes(LookForStrained<OfOne>{as_tets(body), x.data(), found});
    return found != 0;
}

unsigned tets_not_calm(const Elements& body, const NumbersInLines& from, const NumbersInLines& to, double part) {
    unsigned found = 0;
    run_in_lanes(lanes_of(body, from), LookForWild<OfSeveral>{as_tets(body), from.data(), to.data(), part, found});
    return found;
}

unsigned tets_may_yield(const Elements& body, const NumbersInLines& x) {
    unsigned found = 0;
    run_in_lanes(lanes_of(body, x), LookForStrained<OfSeveral>{as_tets(body), x.data(), found});
    return found;
}

}  // namespace frond
