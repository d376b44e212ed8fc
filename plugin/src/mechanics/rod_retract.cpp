// In: rods at `from`, and the end of a displacement from there that a linear solve gave. Out: that end with nodes moved
// so that rods have the strain which the solve gave them.
//
// A straight displacement lengthens what it turns: by half the square of the angle. The solve itself knows better: to
// first order it hardly strains a segment. So rotations are taken from the solve, and positions are rebuilt from node
// to node along the tree, each segment with its strain at `from` plus the linear change of strain. That is a retraction
// in the coordinates of articulated bodies (Featherstone 1987; Absil, Mahony, Sepulchre 2008, section 4.1) and differs
// from the straight displacement in second order.
#include "mechanics/batch.hpp"
#include "mechanics/rod_groups.hpp"
#include "mechanics/rows.hpp"

namespace frond {

namespace {

// Returns the chord of segments, from the first to the second end, after the displacement between two states [m].
template <class S>
FROND_INLINE Lanes3<S> chord_after(const Placed<S>& at, const Placed<S>& after) {
    const RodChange<S> change = change_of(at.piece, rate_of(at.a), rate_of(at.b), at.bent);
    const S per_length = 1.0 / at.piece.length;
    const Lanes3<S> by_chord = change.strain_chord * (after.bent.chord - at.bent.chord);
    const Lanes3<S> by_turns =
        change.strain_a * (after.a.turn - at.a.turn) + change.strain_b * (after.b.turn - at.b.turn);
    const Lanes3<S> strain = at.bent.strain + at.piece.rest_strain + per_length * (by_chord + by_turns);
    const Lanes3<S> curvature = after.bent.curvature + at.piece.rest_curvature + at.piece.set_curvature;
    return at.piece.length *
           (after.bent.middle * chord_of_strain(tilt_at_centre(at.piece, strain, curvature, constant<S>(-1))));
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
    template <class S>
    FROND_INLINE void run() const {
        LastEnd<S> last_at, last_after;
        for (size_t s = 0; s < elements.segments.size(); s += size_t(Pieces<S>::MANY)) {
            const Pieces<S> pieces(elements.segments, s);
            const Placed<S> at = last_at.place(pieces, from), after = last_after.place(pieces, end);
            last_at.go_on(pieces, at);
            last_after.go_on(pieces, after);
            pieces.put_second_ends(chord_after(at, after), held, out);
        }
        keep_centres<typename Pieces<S>::Number>(elements, held, end, out);
    }
};

}  // namespace

void retract_rods(const Elements& body, const VecX& from, const VecX& end, const std::vector<uint8_t>& held,
                  VecX& out) {
    out = end;
    run_in_lanes(Retract<PiecesOfOne>{as_rods(body), held, from.data(), end.data(), out.data()});
}

void retract_rods_of_batch(const Elements& body, const NumbersInLines& from, const NumbersInLines& end,
                           const std::vector<uint8_t>& held, NumbersInLines& out) {
    out = end;
    run_in_lanes(lanes_of(body, from),
                 Retract<PieceOfSeveral>{as_rods(body), held, from.data(), end.data(), out.data()});
}

}  // namespace frond
