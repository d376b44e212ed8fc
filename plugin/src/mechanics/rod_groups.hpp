// Rod segments that are computed at once, one a lane: several of one plant, or the same one of several plants. In
// batched data, number i of all plants begins at [i * LANES].
#pragma once

#include <algorithm>

#include "mechanics/rod_elements.hpp"
#include "mechanics/rod_piece.hpp"

namespace frond {

// As many segments of one plant as there are lanes; the last one is repeated past the end.
template <class S>
struct PiecesOfOne {
    static constexpr int MANY = LANES<S>;  // segments
    using Number = double;                 // number of a node in x
    const RodSegment* rod[LANES<S>];
    size_t first;
    int count;
    FROND_INLINE PiecesOfOne(const std::vector<RodSegment>& rods, size_t first)
        : first(first), count(int(std::min(size_t(MANY), rods.size() - first))) {
        for (int lane = 0; lane < MANY; ++lane) rod[lane] = &rods[first + size_t(std::min(lane, count - 1))];
    }
    // Returns whether all segments begin at that node.
    FROND_INLINE static bool begins_at(int) { return false; }
    FROND_INLINE static int last_node() { return -1; }
    FROND_INLINE Lanes3<S> vector(Vec3 RodSegment::*of) const {
        return {gather<S>([&](int l) { return (rod[l]->*of)[0]; }), gather<S>([&](int l) { return (rod[l]->*of)[1]; }),
                gather<S>([&](int l) { return (rod[l]->*of)[2]; })};
    }
    FROND_INLINE S element(int row, int column) const {
        return gather<S>([&](int l) { return rod[l]->frame.data()[row + 3 * column]; });
    }
    FROND_INLINE S number(double RodSegment::*of) const {
        return gather<S>([&](int l) { return rod[l]->*of; });
    }
    // Gathers a number of each segment.
    FROND_INLINE S own(const std::vector<double>& of) const {
        return gather<S>([&](int lane) { return of[first + size_t(std::min(lane, count - 1))]; });
    }
    // Gathers three of the six numbers of one end.
    FROND_INLINE Lanes3<S> point(const double* x, int RodSegment::*end, int from) const {
        const auto at = [&](int l, int c) { return x[6 * (rod[l]->*end) + from + c]; };
        return {gather<S>([&](int l) { return at(l, 0); }), gather<S>([&](int l) { return at(l, 1); }),
                gather<S>([&](int l) { return at(l, 2); })};
    }
    // Subtracts lane by lane, since segments share their ends.
    FROND_INLINE void take_off(double* f, const RodGradient<S>& g) const {
        for (int lane = 0; lane < count; ++lane) {
            double *a = f + 6 * rod[lane]->a, *b = f + 6 * rod[lane]->b;
            const Lanes3<S>* parts[4] = {&g.place_a, &g.turn_a, &g.place_b, &g.turn_b};
            for (int k = 0; k < 4; ++k) {
                double* to = (k < 2 ? a : b) + 3 * (k % 2);
                to[0] -= parts[k]->x[lane];
                to[1] -= parts[k]->y[lane];
                to[2] -= parts[k]->z[lane];
            }
        }
    }
    // Places second ends by chords from the first ones, lane by lane, but where a loop closes; held nodes, one flag a
    // node, stay.
    FROND_INLINE void put_second_ends(const Lanes3<S>& chord, const std::vector<uint8_t>& held, double* x) const {
        for (int lane = 0; lane < count; ++lane) {
            if (rod[lane]->closes_loop || held[size_t(2 * rod[lane]->b)]) continue;
            const double *a = x + 6 * rod[lane]->a, by[] = {chord.x[lane], chord.y[lane], chord.z[lane]};
            for (int k = 0; k < 3; ++k) x[6 * rod[lane]->b + k] = a[k] + by[k];
        }
    }
    // Adds blocks to a BlockMatrix, which stores them by columns.
    FROND_INLINE void add_blocks(const Lanes33<S> (&blocks)[10], const S& by, BlockMatrix& K,
                                 std::vector<uint8_t>*) const {
        NumbersInLines& A = K.values;
        S values[90];
        for (int k = 0; k < 10; ++k)
            for (int r = 0; r < 3; ++r) {
                values[9 * k + r] = by * blocks[k].r[r].x;
                values[9 * k + r + 3] = by * blocks[k].r[r].y;
                values[9 * k + r + 6] = by * blocks[k].r[r].z;
            }
        const double* from = reinterpret_cast<const double*>(values);
        for (int lane = 0; lane < count; ++lane)
            for (int r = 0, k = 0; r < 4; ++r)
                for (int c = 0; c <= r; ++c, ++k) {
                    double* to = A.data() + 9 * size_t(rod[lane]->slots[size_t(4 * r + c)]);
                    for (int i = 0; i < 9; ++i) to[i] += from[LANES<S> * (9 * k + i) + lane];
                }
    }
};

// One segment of as many plants as there are lanes.
template <class S>
struct PieceOfSeveral {
    static constexpr int MANY = 1;  // segment
    using Number = S;
    const RodSegment& rod;
    size_t first;
    FROND_INLINE PieceOfSeveral(const std::vector<RodSegment>& rods, size_t first) : rod(rods[first]), first(first) {}
    FROND_INLINE bool begins_at(int node) const { return rod.a == node; }
    FROND_INLINE int last_node() const { return rod.b; }
    FROND_INLINE Lanes3<S> vector(Vec3 RodSegment::*of) const {
        const Vec3& v = rod.*of;
        return {constant<S>(v[0]), constant<S>(v[1]), constant<S>(v[2])};
    }
    FROND_INLINE S element(int row, int column) const { return constant<S>(rod.frame.data()[row + 3 * column]); }
    FROND_INLINE S number(double RodSegment::*of) const { return constant<S>(rod.*of); }
    FROND_INLINE S own(const std::vector<double>& of) const { return constant<S>(of[first]); }
    FROND_INLINE Lanes3<S> point(const double* x, int RodSegment::*end, int from) const {
        return load3<S>(x, 6 * (rod.*end) + from);
    }
    FROND_INLINE void take_off(double* f, const RodGradient<S>& g) const {
        const auto from = [&](int at, const Lanes3<S>& part) { store3(load3<S>(f, at) - part, f, at); };
        from(6 * rod.a, g.place_a), from(6 * rod.a + 3, g.turn_a);
        from(6 * rod.b, g.place_b), from(6 * rod.b + 3, g.turn_b);
    }
    FROND_INLINE void put_second_ends(const Lanes3<S>& chord, const std::vector<uint8_t>& held, double* x) const {
        if (!rod.closes_loop && !held[size_t(2 * rod.b)]) store3(load3<S>(x, 6 * rod.a) + chord, x, 6 * rod.b);
    }
    // Adds to blocks that are filled, and overwrites the others.
    FROND_INLINE void add_blocks(const Lanes33<S> (&blocks)[10], const S& by, BlockMatrix& A,
                                 std::vector<uint8_t>* filled) const {
        for (int r = 0, k = 0; r < 4; ++r)
            for (int c = 0; c <= r; ++c, ++k) {
                const size_t slot = size_t(rod.slots[size_t(4 * r + c)]);
                double* to = A.values.data() + LANES<S> * 9 * slot;
                if ((*filled)[slot])
                    add_block(blocks[k], by, to, [](const double* at) { return load<S>(at); });
                else
                    add_block(blocks[k], by, to, [](const double*) { return S{}; });
                (*filled)[slot] = 1;
            }
    }
    template <class Before>
    FROND_INLINE static void add_block(const Lanes33<S>& block, const S& by, double* to, const Before& before) {
        const auto add = [&](int i, const S& value) {
            store(S(before(to + LANES<S> * i) + by * value), to + LANES<S> * i);
        };
        for (int i = 0; i < 3; ++i) {
            add(i, block.r[i].x);
            add(i + 3, block.r[i].y);
            add(i + 6, block.r[i].z);
        }
    }
};

template <class Pieces>
using LanesOf = decltype(std::declval<const Pieces&>().number(&RodSegment::length));

template <class Pieces, class S = LanesOf<Pieces>>
FROND_INLINE RodPiece<S> piece_of(const Pieces& pieces) {
    RodPiece<S> out;
    out.length = pieces.number(&RodSegment::length);
    out.centre = pieces.number(&RodSegment::centre);
    out.warping = pieces.number(&RodSegment::warping);
    for (int r = 0; r < 3; ++r) out.frame.r[r] = {pieces.element(r, 0), pieces.element(r, 1), pieces.element(r, 2)};
    out.stretch = pieces.vector(&RodSegment::stretch);
    out.bend = pieces.vector(&RodSegment::bend);
    out.rest_strain = pieces.vector(&RodSegment::rest_strain);
    out.rest_curvature = pieces.vector(&RodSegment::rest_curvature);
    out.set_curvature = pieces.vector(&RodSegment::set_curvature);
    out.set_w = pieces.number(&RodSegment::set_w);
    out.set_p = pieces.vector(&RodSegment::set_p);
    return out;
}

// Segments with the state of their ends.
template <class S>
struct Placed {
    RodPiece<S> piece;
    RodEnd<S> a, b;
    RodBent<S> bent;
    template <class Pieces>
    FROND_INLINE Placed(const Pieces& pieces, const double* x) : Placed(pieces, x, end_of(pieces, x, &RodSegment::a)) {}
    template <class Pieces>
    FROND_INLINE Placed(const Pieces& pieces, const double* x, const RodEnd<S>& a)
        : piece(piece_of(pieces)), a(a), b(end_of(pieces, x, &RodSegment::b)), bent(bend_between(piece, a, b)) {}
    template <class Pieces>
    FROND_INLINE static RodEnd<S> end_of(const Pieces& pieces, const double* x, int RodSegment::*which) {
        return rod_end(pieces.point(x, which, 0), pieces.point(x, which, 3));
    }
};

// The second end of the last segments: in a batch the next ones mostly begin there and need not compute it again.
template <class S>
struct LastEnd {
    int node = -1;  // chain node, -1: none
    RodEnd<S> end = {};
    Lanes33<S> rate = {};  // rate_of(end), if used

    template <class Pieces>
    FROND_INLINE RodEnd<S> begin(const Pieces& pieces, const double* x) const {
        if (pieces.begins_at(node)) return end;
        return Placed<S>::end_of(pieces, x, &RodSegment::a);
    }
    template <class Pieces>
    FROND_INLINE Placed<S> place(const Pieces& pieces, const double* x) const {
        return Placed<S>(pieces, x, begin(pieces, x));
    }
    template <class Pieces>
    FROND_INLINE void go_on(const Pieces& pieces, const RodEnd<S>& to) {
        node = pieces.last_node();
        end = to;
    }
};

}  // namespace frond
