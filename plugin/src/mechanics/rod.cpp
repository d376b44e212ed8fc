// In: rods at rest and their nodes' positions and rotations. Out: energy, force and stiffness.
//
// Geometrically exact rods (Simo 1985; Simo, Vu-Quoc 1986) with two nodes and one integration point a segment:
//   c = F^T R^T (x2 - x1) / L,  strain G = (s(|c|, k), tilt of c from the axis),  k = F^T log(R1'^T R2') / L,
//   U = L/2 (G - G0) . C (G - G0) + L/2 (m(k) - k0) . B (m(k) - k0),
// F the segment's frame in the modelled shape, R1' = R1 exp(L F kp / 2) and R2' = R2 exp(-L F kp / 2) the rotations of
// its ends without the plastic curvature kp, R = R1' exp(log(R1'^T R2') / 2) the midway rotation, s the stretch of the
// arc that it is bent to, m the measures of bending and twist (rod_piece.hpp). So a segment that is bent for good is
// strained by what it turns from there, and is far from half a turn, where the vector of a rotation jumps. The shear
// stiffness is the residual bending flexibility, 12 EI / L^2 (MacNeal 1978): for small rotations the segment then is
// the Euler-Bernoulli beam with cubic shape functions, exact at its ends.
#include <algorithm>

#include "mechanics/dual.hpp"
#include "mechanics/rod_assemble.hpp"
#include "mechanics/rows.hpp"

namespace frond {

namespace {

template <class S>
FROND_INLINE void store(const Lanes3<S>& v, double* first, int stride, int lane) {
    first[0] = v.x[lane];
    first[stride] = v.y[lane];
    first[2 * stride] = v.z[lane];
}

struct FindStrains {
    const RodElements& elements;
    const VecX& x;
    std::vector<RodStrain>& out;
    template <class S>
    FROND_INLINE void run() const {
        out.resize(elements.segments.size());
        for (size_t s = 0; s < elements.segments.size(); s += size_t(LANES<S>)) {
            const PiecesOfOne<S> pieces(elements.segments, s);
            const Placed<S> at(pieces, x.data());
            for (int lane = 0; lane < pieces.count; ++lane) {
                store(at.bent.strain, out[s + size_t(lane)].strain.data(), 1, lane);
                store(at.bent.curvature, out[s + size_t(lane)].curvature.data(), 1, lane);
            }
        }
    }
};

struct FindEnergy {
    const RodElements& elements;
    const VecX& x;
    double& sum;
    template <class S>
    FROND_INLINE void run() const {
        for (size_t s = 0; s < elements.segments.size(); s += size_t(LANES<S>)) {
            const PiecesOfOne<S> pieces(elements.segments, s);
            const Placed<S> at(pieces, x.data());
            const S energy = 0.5 * at.piece.length *
                             (dot(at.piece.stretch, scaled(at.bent.strain, at.bent.strain)) +
                              dot(at.piece.bend, scaled(at.bent.curvature, at.bent.curvature)));
            for (int lane = 0; lane < pieces.count; ++lane) sum += energy[lane];
        }
    }
};

// Takes as many nodes at once as there are lanes, from the i-th on.
struct FindInertia {
    const RodElements& elements;
    const VecX& x;
    std::vector<Mat3>& out;
    size_t node(size_t i, int lane) const { return std::min(i + size_t(lane), elements.inertia.size() - 1); }
    template <class S>
    FROND_INLINE S turn(size_t i, int c) const {
        return gather<S>([&](int lane) { return x.data()[6 * node(i, lane) + 3 + size_t(c)]; });
    }
    template <class S>
    FROND_INLINE S entry(size_t i, int r, int c) const {
        return gather<S>([&](int lane) { return elements.inertia[node(i, lane)].data()[r + 3 * c]; });
    }
    template <class S>
    FROND_INLINE void run() const {
        for (size_t i = 0; i < elements.inertia.size(); i += size_t(LANES<S>)) {
            Lanes33<S> inertia;
            for (int r = 0; r < 3; ++r) inertia.r[r] = {entry<S>(i, r, 0), entry<S>(i, r, 1), entry<S>(i, r, 2)};
            const Lanes33<S> seen = inertia_by_rate({turn<S>(i, 0), turn<S>(i, 1), turn<S>(i, 2)}, inertia);
            for (int lane = 0; lane < LANES<S> && i + size_t(lane) < elements.inertia.size(); ++lane)
                for (int r = 0; r < 3; ++r) store(seen.r[r], out[i + size_t(lane)].data() + r, 3, lane);
        }
    }
};

template <class S>
FROND_INLINE Lanes3<Dual<S>> constants(const Vec3& v) {
    return {v[0], v[1], v[2]};
}

// Derivative of the energy's gradient, by forward differentiation of its own code.
struct AddExactStiffness {
    const RodElements& elements;
    const VecX& x;
    double scale;
    BlockMatrix& K;
    static constexpr int COUNT = 12;  // coordinates of a segment

    // Fills `slopes` row by row.
    template <class S>
    FROND_INLINE void differentiate(const RodSegment& rod, double (&slopes)[COUNT][COUNT]) const {
        RodPiece<Dual<S>> piece;
        piece.length = rod.length;
        piece.centre = rod.centre;
        piece.warping = rod.warping;
        for (int r = 0; r < 3; ++r) piece.frame.r[r] = constants<S>(rod.frame.row(r));
        piece.stretch = constants<S>(rod.stretch);
        piece.bend = constants<S>(rod.bend);
        piece.rest_strain = constants<S>(rod.rest_strain);
        piece.rest_curvature = constants<S>(rod.rest_curvature);
        piece.set_curvature = constants<S>(rod.set_curvature);
        piece.set_w = rod.set_w;
        piece.set_p = constants<S>(rod.set_p);
        Lanes3<Dual<S>> v[4];
        for (int n = 0; n < 4; ++n) {
            const double* from = x.data() + 3 * (2 * (n < 2 ? rod.a : rod.b) + n % 2);
            v[n] = {Dual<S>::variable(from[0], 3 * n), Dual<S>::variable(from[1], 3 * n + 1),
                    Dual<S>::variable(from[2], 3 * n + 2)};
        }
        const RodEnd<Dual<S>> a = rod_end(v[0], v[1]), b = rod_end(v[2], v[3]);
        const RodGradient<Dual<S>> gradient = gradient_of(piece, rate_of(a), rate_of(b), bend_between(piece, a, b));
        const auto put = [&](const Lanes3<Dual<S>>& part, int row) {
            for (int i = 0; i < Dual<S>::GROUPS; ++i) {
                frond::store(part.x.slope[i], slopes[row] + LANES<S> * i);
                frond::store(part.y.slope[i], slopes[row + 1] + LANES<S> * i);
                frond::store(part.z.slope[i], slopes[row + 2] + LANES<S> * i);
            }
        };
        put(gradient.place_a, 0), put(gradient.turn_a, 3), put(gradient.place_b, 6), put(gradient.turn_b, 9);
    }
    template <class S>
    FROND_INLINE void run() const {
        for (const RodSegment& rod : elements.segments) {
            double slopes[COUNT][COUNT];
            differentiate<S>(rod, slopes);
            for (int r = 0; r < 4; ++r)
                for (int c = 0; c <= r; ++c) {
                    auto block = K.block(rod.slots[size_t(4 * r + c)]);
                    for (int i = 3 * r; i < 3 * r + 3; ++i)
                        for (int j = 3 * c; j < 3 * c + 3; ++j)
                            block(i - 3 * r, j - 3 * c) += scale * (0.5 * (slopes[i][j] + slopes[j][i]));
                }
        }
    }
};

}  // namespace

std::vector<RodStrain> rod_strains(const RodElements& elements, const VecX& x) {
    std::vector<RodStrain> strains;
    run_in_lanes(FindStrains{elements, x, strains});
    return strains;
}

double rod_energy(const Elements& body, const VecX& x) {
    double energy = 0;
    run_in_lanes(FindEnergy{as_rods(body), x, energy});
    return energy;
}

int rod_add_force(const Elements& body, const VecX& x, VecX& f) {
    Assemble<PiecesOfOne> job = {as_rods(body), x.data()};
    job.f = f.data();
    run_in_lanes(job);
    return 0;
}

void rod_add_stiffness(const Elements& body, const VecX& x, Tangent tangent, double scale, BlockMatrix& K) {
    if (tangent == Tangent::exact) return run_in_lanes(AddExactStiffness{as_rods(body), x, scale, K});
    Assemble<PiecesOfOne> job = {as_rods(body), x.data()};
    job.K = &K;
    job.scale = scale;
    run_in_lanes(job);
}

int rod_add_both(const Elements& body, const VecX& x, Tangent tangent, VecX& f, BlockMatrix& K) {
    Assemble<PiecesOfOne> job = {as_rods(body), x.data()};
    job.f = f.data();
    if (tangent == Tangent::exact)
        run_in_lanes(AddExactStiffness{as_rods(body), x, 1, K});
    else
        job.K = &K;
    run_in_lanes(job);
    return 0;
}

int rod_add_damped(const Elements& body, const VecX& x, const std::vector<double>& damping, VecX& f, BlockMatrix& K,
                   BlockMatrix& D) {
    Assemble<PiecesOfOne> job = {as_rods(body), x.data()};
    job.f = f.data();
    job.K = &K;
    job.damping = &damping;
    job.D = &D;
    run_in_lanes(job);
    return 0;
}

int rod_add_ahead(const Elements& body, const VecX& x, const Ahead& ahead, VecX& f, BlockMatrix& A) {
    run_in_lanes(to_add_ahead<PiecesOfOne>(as_rods(body), x.data(), ahead, f.data(), A));
    return 0;
}

void rod_inertia(const Elements& body, const VecX& x, std::vector<Mat3>& out) {
    out.resize(as_rods(body).inertia.size());
    run_in_lanes(FindInertia{as_rods(body), x, out});
}

bool rods_are_calm(const Elements& body, const VecX& from, const VecX& to) {
    const RodElements& elements = as_rods(body);
    for (int i = 1; i < elements.node_count; i += 2)
        if (!((point(to, i) - point(from, i)).squaredNorm() < LARGEST_TURN * LARGEST_TURN)) return false;
    for (const RodSegment& rod : elements.segments) {
        const Vec3 change =
            point(to, 2 * rod.b) - point(to, 2 * rod.a) - point(from, 2 * rod.b) + point(from, 2 * rod.a);
        if (!(change.norm() < LARGEST_STRETCH * rod.length)) return false;
    }
    return true;
}

}  // namespace frond
