// In: rods at `from`, and the end of a displacement from there that a linear solve gave. Out: that end with nodes moved
// so that rods have the strain which the solve gave them.
//
// A straight displacement lengthens what it turns: by half the square of the angle. The solve itself knows better: to
// first order it hardly strains a segment. So rotations are taken from the solve, and positions are rebuilt from node
// to node along the tree, each segment with its strain at `from` plus the linear change of strain. That is a retraction
// in the coordinates of articulated bodies (Featherstone 1987; Absil, Mahony, Sepulchre 2008, section 4.1) and differs
// from the straight displacement in second order.
#include "mechanics/batch.hpp"
#include "mechanics/rod_look.hpp"
#include "mechanics/rows.hpp"

namespace frond {

namespace {

// Returns the chord of segments, from the first to the second end, after the displacement from where they were looked
// at [m].
template <class Pieces, class S>
FROND_INLINE Lanes3<S> chord_after(const Pieces& pieces, const double* from, const RodLook<S>& look,
                                   const Placed<S>& after) {
    const RodPiece<S>& piece = after.piece;
    const Lanes3<S> chord = pieces.point(from, &RodSegment::b, 0) - pieces.point(from, &RodSegment::a, 0);
    const S per_length = 1.0 / piece.length;
    const Lanes3<S> by_chord = look.by_chord * (after.bent.chord - chord);
    const Lanes3<S> by_turns = look.by_a * (after.a.turn - pieces.point(from, &RodSegment::a, 3)) +
                               look.by_b * (after.b.turn - pieces.point(from, &RodSegment::b, 3));
    const Lanes3<S> strain = look.strain + per_length * (by_chord + by_turns);
    const Lanes3<S> curvature = after.bent.curvature + piece.rest_curvature + piece.set_curvature;
    const Lanes3<S> of_chord =
        tilt_at_centre(piece, chord_strain(piece, strain, curvature), curvature, constant<S>(-1));
    return piece.length * (after.bent.middle * chord_of_strain(of_chord));
}

// A component of the tree that nothing holds keeps the centre of mass that the solve gave it.
template <class S>
FROND_INLINE void keep_centres(const RodElements& elements, const std::vector<uint8_t>& held, const double* end,
                               double* out) {
    const int count = int(elements.mass.size());
    for (int root = 0; root < count; ++root) {
        if (elements.root[size_t(root)] != root) continue;
        double mass = 0;
        bool is_held = false;
        Lanes3<S> moment = {};
        for (int i = root; i < count; ++i) {
            if (elements.root[size_t(i)] != root) continue;
            is_held |= held[size_t(2 * i)] != 0;
            mass += elements.mass[size_t(i)];
            moment = moment + constant<S>(elements.mass[size_t(i)]) * (load3<S>(out, 6 * i) - load3<S>(end, 6 * i));
        }
        if (is_held || !(mass > 0)) continue;
        for (int i = root; i < count; ++i)
            if (elements.root[size_t(i)] == root)
                store3(load3<S>(out, 6 * i) - constant<S>(1 / mass) * moment, out, 6 * i);
    }
}

template <template <class> class Pieces>
struct Retract {
    const RodElements& elements;
    const std::vector<uint8_t>& held;
    const double *from, *end;
    double* out;
    const double* looks = nullptr;  // of a batch
    unsigned* yielding = nullptr;   // of a batch: lanes in which a segment may yield

    template <class S>
    FROND_INLINE RodLook<S> look_at(const PieceOfSeveral<S>& piece) const {
        return RodLook<S>::load(looks, piece.first);
    }
    template <class S>
    FROND_INLINE RodLook<S> look_at(const PiecesOfOne<S>& pieces) const {
        const Placed<S> at(pieces, from);
        return RodLook<S>::of(at.piece, at.bent, change_of(at.piece, rate_of(at.a), rate_of(at.b), at.bent));
    }
    // Takes out lanes in which the outermost fibres of a segment are strained up to their limit. Turns alone bend.
    template <class S>
    FROND_INLINE void take_out_yielding(const PieceOfSeveral<S>& piece, const RodBent<S>& bent, S& within) const {
        if (elements.yields.empty() || !(elements.yields[piece.first].strain > 0)) return;
        const S wide = piece.rod.reach_wide * bent.curvature.y, thin = piece.rod.reach_thin * bent.curvature.z;
        const S most = sqrt(S(wide * wide + thin * thin));
        within = select(most < elements.yields[piece.first].strain * NEARLY, within, S{});
    }
    template <class S>
    FROND_INLINE void run() const {
        LastEnd<S> last;
        [[maybe_unused]] S within = constant<S>(1);
        for (size_t s = 0; s < elements.segments.size(); s += size_t(Pieces<S>::MANY)) {
            const Pieces<S> pieces(elements.segments, s);
            const Placed<S> after = last.place(pieces, end);
            last.go_on(pieces, after.b);
            pieces.put_second_ends(chord_after(pieces, from, look_at(pieces), after), held, out);
            if constexpr (IS_BATCH<S>) take_out_yielding(pieces, after.bent, within);
        }
        keep_centres<typename Pieces<S>::Number>(elements, held, end, out);
        if constexpr (IS_BATCH<S>) *yielding = bits_of(within == 0.0);
    }

private:
    template <class S>
    static constexpr bool IS_BATCH = std::is_same_v<Pieces<S>, PieceOfSeveral<S>>;
};

}  // namespace

void retract_rods(const Elements& body, const VecX& from, const VecX& end, const std::vector<uint8_t>& held,
                  VecX& out) {
    out = end;
    run_in_lanes(Retract<PiecesOfOne>{as_rods(body), held, from.data(), end.data(), out.data()});
}

unsigned retract_rods_of_batch(const Elements& body, const NumbersInLines& from, const NumbersInLines& end,
                               const std::vector<uint8_t>& held, const NumbersInLines& seen, NumbersInLines& out) {
    unsigned yielding = 0;
    out = end;
    run_in_lanes(lanes_of(body, from), Retract<PieceOfSeveral>{as_rods(body), held, from.data(), end.data(), out.data(),
                                                               seen.data(), &yielding});
    return yielding;
}

}  // namespace frond
