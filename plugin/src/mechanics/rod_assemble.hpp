// In: rods and their nodes' positions and rotations. Out: force and positive stiffness, at x or extrapolated ahead.
//
// Ahead, rates of strain are differences of strains, which a turn as a whole leaves alone, and not the strain of the
// stage's velocities: bdf2's velocity of a chord that turns by an angle a step is too large by a third of its cube,
// while its ends' rotation vectors turn as they should. At 0.28 rad that sheared a petiole of 22 mm by 0.8 %.
#pragma once

#include "mechanics/rod_groups.hpp"
#include "mechanics/rod_look.hpp"

namespace frond {

// Strain and curvature at the base of a stage, relative to rest.
template <class S>
struct BaseStrain {
    Lanes3<S> strain, curvature;
    LastEnd<S> last, before;

    template <class Pieces>
    FROND_INLINE void find(const Pieces& pieces, const RodPiece<S>& piece, const StageBase& base) {
        const RodBent<S> at_last = bend(pieces, piece, base.last, last),
                         at_before = bend(pieces, piece, base.before, before);
        const S back = constant<S>(base.back);
        strain = at_last.strain + back * (at_last.strain - at_before.strain);
        curvature = at_last.curvature + back * (at_last.curvature - at_before.curvature);
    }

private:
    template <class Pieces>
    FROND_INLINE static RodBent<S> bend(const Pieces& pieces, const RodPiece<S>& piece, const double* x,
                                        LastEnd<S>& last) {
        const RodEnd<S> a = last.begin(pieces, x), b = Placed<S>::end_of(pieces, x, &RodSegment::b);
        last.go_on(pieces, b);
        return bend_between(piece, a, b);
    }
};

// Outputs that are null are skipped.
template <template <class> class Pieces>
struct Assemble {
    const RodElements& elements;
    const double* x;
    double* f = nullptr;
    BlockMatrix* K = nullptr;
    double scale = 1;                              // factor of K
    const std::vector<double>* damping = nullptr;  // one a segment [s]; damping times stiffness is added to D
    BlockMatrix* D = nullptr;
    const Ahead* ahead = nullptr;
    std::vector<uint8_t>* filled = nullptr;  // in batches: blocks of K that are filled already
    double* looks = nullptr;                 // in batches: a RodLook of each segment, for Retract

    template <class S>
    FROND_INLINE Lanes3<S> move(const Pieces<S>& pieces, int RodSegment::*end, int first, const S& c) const {
        const Lanes3<S> way = pieces.point(ahead->way, end, first);
        return damps_by_strains() ? way : way + c * pieces.point(ahead->v, end, first);
    }
    FROND_INLINE bool damps_by_strains() const { return ahead->base.last && (damping || ahead->damping > 0); }
    // Adds the change of the gradient over the displacement ahead, by the stiffness, to the six numbers of each end.
    template <class S>
    FROND_INLINE void look_ahead(const Pieces<S>& pieces, const Placed<S>& at, const RodChange<S>& change, const S& c,
                                 BaseStrain<S>& base, RodGradient<S>& g) const {
        const S length = at.piece.length, per_length = 1.0 / length;
        const Lanes3<S> turn_a = move(pieces, &RodSegment::a, 3, c), turn_b = move(pieces, &RodSegment::b, 3, c);
        const Lanes3<S> chord = move(pieces, &RodSegment::b, 0, c) - move(pieces, &RodSegment::a, 0, c);
        Lanes3<S> strain = change.strain_chord * chord + change.strain_a * turn_a + change.strain_b * turn_b;
        Lanes3<S> curvature = change.bend_b * turn_b - change.bend_a * turn_a;
        if (damps_by_strains()) {
            base.find(pieces, at.piece, ahead->base);
            const S share = c * (1 / ahead->step);
            strain = strain + share * (strain + length * (at.bent.strain - base.strain));
            curvature = curvature + share * (curvature + length * (at.bent.curvature - base.curvature));
        }
        const Lanes3<S> force = per_length * scaled(at.piece.stretch, strain);
        const Lanes3<S> moment = per_length * scaled(at.piece.bend, curvature);
        const Lanes3<S> on_b = transposed_times(change.strain_chord, force);
        g.place_a = g.place_a - on_b;
        g.place_b = g.place_b + on_b;
        g.turn_a = g.turn_a + transposed_times(change.strain_a, force) - transposed_times(change.bend_a, moment);
        g.turn_b = g.turn_b + transposed_times(change.strain_b, force) + transposed_times(change.bend_b, moment);
    }
    template <class S>
    FROND_INLINE void run() const {
        const std::vector<RodSegment>& rods = elements.segments;
        LastEnd<S> last;
        BaseStrain<S> base;
        for (size_t s = 0; s < rods.size(); s += size_t(Pieces<S>::MANY)) {
            const Pieces<S> pieces(rods, s);
            const Placed<S> at = last.place(pieces, x);
            Lanes33<S> rate_a = last.rate;
            if (!pieces.begins_at(last.node)) rate_a = rate_of(at.a);
            const Lanes33<S> rate_b = rate_of(at.b);
            last.go_on(pieces, at.b);
            last.rate = rate_b;
            RodGradient<S> g;
            if (f) g = gradient_of(at.piece, rate_a, rate_b, at.bent);
            if (K) {
                const S c = damping ? pieces.own(*damping) : S{};
                const RodChange<S> change = change_of(at.piece, rate_a, rate_b, at.bent);
                if (looks) RodLook<S>::of(at.piece, at.bent, change).store(looks, s);
                Lanes33<S> blocks[10];
                positive_stiffness(at.piece, change, blocks);
                const double step = ahead ? ahead->step : 1;
                const S alike = c + (ahead ? ahead->damping : 0.0);
                if (ahead) look_ahead(pieces, at, change, alike, base, g);
                pieces.add_blocks(blocks, ahead ? S(step * step + step * alike) : constant<S>(scale), *K, filled);
                if (D) pieces.add_blocks(blocks, c, *D, filled);
            }
            if (f) pieces.take_off(f, g);
        }
    }
};

// Returns the job of Mechanics::add_ahead, for one plant or for a batch.
template <template <class> class Pieces>
Assemble<Pieces> to_add_ahead(const RodElements& elements, const double* x, const Ahead& ahead, double* f,
                              BlockMatrix& A) {
    Assemble<Pieces> job = {elements, x};
    job.f = f;
    job.K = &A;
    job.damping = ahead.element_damping.empty() ? nullptr : &ahead.element_damping;
    job.ahead = &ahead;
    return job;
}

}  // namespace frond
