// In: rods of several plants, one a lane, and their nodes' positions and rotations. Out: what rod.cpp computes for one.
#include "mechanics/batch.hpp"
#include "mechanics/rod_assemble.hpp"
#include "mechanics/rows.hpp"

namespace frond {

namespace {

struct FindInertiaOfBatch {
    const RodElements& elements;
    const NumbersInLines& x;
    NumbersInLines& out;
    template <class S>
    FROND_INLINE void run() const {
        for (int i = 0; i < int(elements.inertia.size()); ++i) {
            const Mat3& own = elements.inertia[size_t(i)];
            Lanes33<S> inertia;
            for (int r = 0; r < 3; ++r)
                inertia.r[r] = {constant<S>(own(r, 0)), constant<S>(own(r, 1)), constant<S>(own(r, 2))};
            const Lanes33<S> seen = inertia_by_rate(load3<S>(x.data(), 6 * i + 3), inertia);
            for (int r = 0; r < 3; ++r) store3(seen.r[r], out.data(), 9 * i + 3 * r);
        }
    }
};

struct FindWild {
    const RodElements& elements;
    const NumbersInLines &from, &to;
    double part;  // share of the displacement [-]
    unsigned& wild;
    template <class S>
    FROND_INLINE Lanes3<S> way(int i) const {
        return constant<S>(part) * (load3<S>(to.data(), i) - load3<S>(from.data(), i));
    }
    template <class S>
    FROND_INLINE void run() const {
        S calm = constant<S>(1);
        const auto look = [&](const Lanes3<S>& change, double most)
                              FROND_INLINED { calm = select(dot(change, change) < most * most * NEARLY, calm, S{}); };
        for (int i = 3; i < 3 * elements.node_count; i += 6) look(way<S>(i), LARGEST_TURN);
        for (const RodSegment& rod : elements.segments)
            look(way<S>(6 * rod.b) - way<S>(6 * rod.a), LARGEST_STRETCH * rod.length);
        wild = bits_of(calm == 0.0);
    }
};

void set_ahead(const Elements& body, const NumbersInLines& x, const Ahead& ahead, NumbersInLines& f, BlockMatrix& A,
               std::vector<uint8_t>& filled, NumbersInLines& seen, int* inverted) {
    const int lanes = lanes_of(body, x);
    make_room(seen, RodLook<double>::NUMBERS * size_t(lanes) * as_rods(body).segments.size());
    filled.assign(size_t(body.pattern.block_count()), 0);
    f.assign(x.size(), 0);
    Assemble<PieceOfSeveral> job = to_add_ahead<PieceOfSeveral>(as_rods(body), x.data(), ahead, f.data(), A);
    job.filled = &filled;
    job.looks = seen.data();
    run_in_lanes(lanes, job);
    leave_no_gaps(lanes, filled, A);
    std::fill_n(inverted, lanes, 0);
}

void rotary_inertia(const Elements& body, const NumbersInLines& x, NumbersInLines& out) {
    make_room(out, x.size() / 6 * 9);
    run_in_lanes(lanes_of(body, x), FindInertiaOfBatch{as_rods(body), x, out});
}

unsigned not_calm(const Elements& body, const NumbersInLines& from, const NumbersInLines& to, double part) {
    unsigned wild = 0;
    run_in_lanes(lanes_of(body, from), FindWild{as_rods(body), from, to, part, wild});
    return wild;
}

}  // namespace

const BatchMechanics& rod_batch() {
    static const BatchMechanics ROW = {set_ahead, rotary_inertia, not_calm, nullptr, retract_rods_of_batch};
    return ROW;
}

}  // namespace frond
