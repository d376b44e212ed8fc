// In: elastic forces, stiffness, drags and fibres of several plants, one a lane. Out: the linear system of a stage,
// with the operations of stage_equations.cpp in the same order.
#pragma once

#include "batch/batch_step.hpp"
#include "core/lane_vectors.hpp"
#include "mechanics/attachment_lanes.hpp"
#include "mechanics/batch.hpp"
#include "solve/springs.hpp"

namespace frond {

template <class S>
FROND_INLINE Lanes33<S> drag_damping(const Batch& a, int drag) {
    const Lanes3<S> first = load3<S>(a.drag_damping.data(), 6 * drag),
                    rest = load3<S>(a.drag_damping.data(), 6 * drag + 3);
    return {{first, {first.y, rest.x, rest.y}, {first.z, rest.y, rest.z}}};
}
// Returns the lanes that have drag; in the others even adding zero would change the sign of zeros.
template <class S>
FROND_INLINE auto is_dragged(const Lanes3<S>& push, const Lanes33<S>& damping) {
    return dot(push, push) + dot(damping, damping) > 0.0;
}
// Does what hold() in stage_equations.cpp does.
template <class S>
FROND_INLINE void hold(Batch& a) {
    const BlockPattern& pattern = *a.A.pattern;
    for (int j = 0; j < pattern.node_count; ++j) {
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)];
            if (!a.held[size_t(i)] && !a.held[size_t(j)]) continue;
            for (int n = 0; n < 9; ++n)
                store(constant<S>(i == j && n % 4 == 0 ? 1 : 0), a.A.values.data() + LANES<S> * size_t(9 * k + n));
        }
        if (a.held[size_t(j)]) store3(Lanes3<S>{}, a.rhs.data(), 3 * j);
    }
}

// Forms the linear system from elastic forces and stiffness, for pairs of nodes, position and rotation.
struct FormPairs {
    Batch& a;
    double step, mass;  // step of the stage [s], and factor of the masses [-]

    template <class S>
    FROND_INLINE void form_right_side(int i) const {
        const Masses& masses = a.system->masses;
        const Lanes3<S> v = load3<S>(a.v_start.data(), 3 * i);
        const S own = constant<S>(masses.node[i]);
        Lanes3<S> rhs = Lanes3<S>{} + own * load3<S>(a.gravity.data(), 0) + load3<S>(a.elastic.data(), 3 * i);
        if (i % 2 == 0) {
            const Lanes33<S> damping = drag_damping<S>(a, i / 2);
            const Lanes3<S> push = load3<S>(a.drag_force.data(), 3 * (i / 2));
            rhs = select(is_dragged(push, damping), rhs + (push - damping * v), rhs);
        }
        rhs = constant<S>(step) * rhs;
        const Lanes3<S> dv = load3<S>(a.v_base.data(), 3 * i) - constant<S>(mass) * v;
        Lanes3<S> momentum = own * dv;
        if (i % 2) momentum = momentum + inertia_of<S>(i / 2) * dv;
        store3(rhs + momentum, a.rhs.data(), 3 * i);
    }
    template <class S>
    FROND_INLINE Lanes33<S> inertia_of(int pair) const {
        const double* from = a.inertia.data();
        return {{load3<S>(from, 9 * pair), load3<S>(from, 9 * pair + 3), load3<S>(from, 9 * pair + 6)}};
    }
    // Forms the diagonal block of node i, which is stored by columns.
    template <class S>
    FROND_INLINE void form_block(int i) const {
        const int slot = a.A.pattern->start[size_t(i)];
        double* block = a.A.values.data();
        Lanes33<S> over = {{load3<S>(block, 9 * slot), load3<S>(block, 9 * slot + 3), load3<S>(block, 9 * slot + 6)}};
        add_to_diagonal(constant<S>(mass * a.system->masses.slot[size_t(slot)]), over);
        if (i % 2 && !a.held[size_t(i)]) over = over + transposed(constant<S>(mass) * inertia_of<S>(i / 2));
        if (i % 2 == 0) {
            const Lanes33<S> damping = drag_damping<S>(a, i / 2);
            const Lanes3<S> push = load3<S>(a.drag_force.data(), 3 * (i / 2));
            over = select(is_dragged(push, damping), over + constant<S>(step) * damping, over);
        }
        for (int r = 0; r < 3; ++r) store3(over.r[r], block, 9 * slot + 3 * r);
    }
    template <class S>
    FROND_INLINE void run() const {
        for (int i = 0; i < a.system->elements->node_count; ++i) {
            form_right_side<S>(i);
            form_block<S>(i);
        }
        hold<S>(a);
    }
};

// Copies numbers of a lane.
inline void take_lane(const NumbersInLines& from, int lanes, int lane, VecX& to) {
    to.resize(Eigen::Index(from.size()) / lanes);
    for (Eigen::Index k = 0; k < to.size(); ++k) to[k] = from[size_t(k * lanes + lane)];
}

// Adds force and stiffness of a lane's taut fibres.
inline void add_fibres(Batch& a, int lane, double step) {
    const VecX x = linearized_end(a, lane);
    VecX force;
    take_lane(a.rhs, a.lanes, lane, force);
    for (const Fibre& fibre : *a.fibres) {
        add_fibre_force(fibre, x, force);
        for_each_fibre_block(fibre, x, step * step, *a.A.pattern, [&](int slot, const Mat3& block) {
            for (int n = 0; n < 9; ++n) a.A.values[size_t((9 * slot + n) * a.lanes + lane)] += block.data()[n];
        });
    }
    for (Eigen::Index k = 0; k < force.size(); ++k) a.rhs[size_t(k * a.lanes + lane)] = force[k];
}

// The same for nodes that are positions only; drags act on points between them.
struct FormPlaces {
    Batch& a;
    double step, mass;

    template <class S>
    FROND_INLINE void add_drag(int drag) const {
        const Attachment& attachment = a.system->chain[size_t(drag)];
        const Lanes33<S> damping = drag_damping<S>(a, drag);
        const Lanes3<S> push = load3<S>(a.drag_force.data(), 3 * drag);
        const auto dragged = is_dragged(push, damping);
        const Lanes3<S> force = push - damping * attachment_sum<S>(attachment, a.v_start.data());
        const Lanes33<S> block = constant<S>(step) * damping;
        for (size_t r = 0; r < size_t(attachment.count); ++r) {
            const int i = attachment.node[r];
            const Lanes3<S> rhs = load3<S>(a.rhs.data(), 3 * i);
            store3(select(dragged, rhs + constant<S>(attachment.weight[r]) * force, rhs), a.rhs.data(), 3 * i);
            for (size_t c = 0; c < size_t(attachment.count); ++c) {
                if (i < attachment.node[c]) continue;
                // The block is symmetric: its rows are columns too.
                const int slot = 9 * a.A.pattern->slot(i, attachment.node[c]);
                const S by = constant<S>(attachment.weight[r] * attachment.weight[c]);
                for (int k = 0; k < 3; ++k) {
                    const Lanes3<S> over = load3<S>(a.A.values.data(), slot + 3 * k);
                    store3(select(dragged, over + by * block.r[k], over), a.A.values.data(), slot + 3 * k);
                }
            }
        }
    }
    template <class S>
    FROND_INLINE void run() const {
        const Masses& masses = a.system->masses;
        const int count = a.system->elements->node_count;
        for (int i = 0; i < count; ++i) {
            const S own = constant<S>(masses.node[i]);
            store3(Lanes3<S>{} + own * load3<S>(a.gravity.data(), 0) + load3<S>(a.elastic.data(), 3 * i), a.rhs.data(),
                   3 * i);
            const size_t slot = size_t(a.A.pattern->start[size_t(i)]);
            for (size_t n = 0; n < 9; n += 4) {
                double* at = a.A.values.data() + LANES<S> * (9 * slot + n);
                store(S(load<S>(at) + constant<S>(mass * masses.slot[slot])), at);
            }
        }
        for (int lane = 0; lane < a.lanes; ++lane)
            if (a.with_fibres >> lane & 1) add_fibres(a, lane, step);
        for (int drag = 0; drag < int(a.system->chain.size()); ++drag) add_drag<S>(drag);
        for (int i = 0; i < count; ++i) {
            const Lanes3<S> dv =
                load3<S>(a.v_base.data(), 3 * i) - constant<S>(mass) * load3<S>(a.v_start.data(), 3 * i);
            store3(constant<S>(step) * load3<S>(a.rhs.data(), 3 * i) + constant<S>(masses.node[i]) * dv, a.rhs.data(),
                   3 * i);
        }
        hold<S>(a);
    }
};

}  // namespace frond
