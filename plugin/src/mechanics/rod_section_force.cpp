// In: rods and their nodes' positions and rotations. Out: the force and moment in each section, by equilibrium of its
// half: the gradient of the energy at its end, and the force's lever from there.
#include "mechanics/rod_groups.hpp"

namespace frond {

namespace {

struct FindSectionForces {
    const RodElements& elements;
    const VecX& x;
    std::vector<RodSectionForce>& out;
    template <class S>
    FROND_INLINE static Vec3 lane_of(const Lanes3<S>& v, int lane) {
        return {v.x[lane], v.y[lane], v.z[lane]};
    }
    template <class S>
    FROND_INLINE void run() const {
        const S one = constant<S>(1);
        const Lanes33<S> identity = {{{one, S{}, S{}}, {S{}, one, S{}}, {S{}, S{}, one}}};
        out.resize(elements.segments.size());
        for (size_t s = 0; s < elements.segments.size(); s += size_t(LANES<S>)) {
            const PiecesOfOne<S> pieces(elements.segments, s);
            const Placed<S> at(pieces, x.data());
            // With unit rates, gradients by rotations are moments.
            const RodGradient<S> g = gradient_of(at.piece, identity, identity, at.bent);
            const Lanes33<S> columns = transposed(at.bent.middle);
            for (int lane = 0; lane < pieces.count; ++lane) {
                RodSectionForce& section = out[s + size_t(lane)];
                const Vec3 chord = lane_of(at.bent.chord, lane), thin = lane_of(columns.r[1], lane);
                section.force = lane_of(g.place_b, lane);
                section.moment = lane_of(g.turn_b, lane) + 0.5 * chord.cross(section.force);
                section.axis = chord.normalized();
                section.thin = (thin - section.axis.dot(thin) * section.axis).normalized();
            }
        }
    }
};

}  // namespace

std::vector<RodSectionForce> rod_section_forces(const RodElements& elements, const VecX& x) {
    std::vector<RodSectionForce> forces;
    run_in_lanes(FindSectionForces{elements, x, forces});
    return forces;
}

}  // namespace frond
