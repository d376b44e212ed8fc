// In: rods where a step is linearised. Out: by how much a displacement from there strains them, to first order.
#pragma once

#include "mechanics/rod_groups.hpp"

namespace frond {

// A batch looks when it assembles and keeps what it saw until the system is solved: looking takes longer than the
// solve.
template <class S>
struct RodLook {
    static constexpr int NUMBERS = 30;  // of the members below, in each lane
    Lanes3<S> strain;                   // not relative to rest
    Lanes33<S> by_chord, by_a, by_b;    // derivatives by chord and turns, times the length at rest

    FROND_INLINE static RodLook of(const RodPiece<S>& rod, const RodBent<S>& bent, const RodChange<S>& change) {
        return {bent.strain + rod.rest_strain, change.strain_chord, change.strain_a, change.strain_b};
    }
    // Numbers of all segments of a batch: those of segment s begin at [s * NUMBERS * LANES].
    FROND_INLINE static RodLook load(const double* looks, size_t s) {
        const auto matrix = [&](int at) FROND_INLINED {
            return Lanes33<S>{{load3<S>(looks, at), load3<S>(looks, at + 3), load3<S>(looks, at + 6)}};
        };
        const int at = NUMBERS * int(s);
        return {load3<S>(looks, at), matrix(at + 3), matrix(at + 12), matrix(at + 21)};
    }
    FROND_INLINE void store(double* looks, size_t s) const {
        int at = NUMBERS * int(s);
        store3(strain, looks, at);
        for (const Lanes33<S>* matrix : {&by_chord, &by_a, &by_b})
            for (int r = 0; r < 3; ++r) store3(matrix->r[r], looks, at += 3);
    }
};

}  // namespace frond
