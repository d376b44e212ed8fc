// In: a batch of plants and the air of their world. Out: drags on their chain nodes, as in air_gather.cpp.
#include "batch/air.hpp"

#include <algorithm>

#include "mechanics/attachment_lanes.hpp"
#include "plant/air_push.hpp"
#include "plant/plant_step.hpp"
#include "plant/wind_lanes.hpp"
#include "solve/system.hpp"

namespace frond {

namespace {

// Reads positions and velocities of chain nodes where the mechanics move the chain.
struct Chains {
    template <class S>
    FROND_INLINE static Lanes3<S> place(const AirBatch&, const Batch& step, int i) {
        return load3<S>(step.x.data(), 6 * i);
    }
    template <class S>
    FROND_INLINE static Lanes3<S> velocity(const Batch&, const NumbersInLines& v, int i) {
        return load3<S>(v.data(), 6 * i);
    }
};
// Reads them where the chain follows a cage.
struct Cages {
    template <class S>
    FROND_INLINE static Lanes3<S> place(const AirBatch& air, const Batch&, int i) {
        return load3<S>(air.chain.data(), 3 * i);
    }
    template <class S>
    FROND_INLINE static Lanes3<S> velocity(const Batch& step, const NumbersInLines& v, int i) {
        return attachment_sum<S>(step.system->chain[size_t(i)], v.data());
    }
};
// Runs Job<Chains> or Job<Cages>, depending on the plants, constructed from `parts`.
template <template <class> class Job, class... Parts>
void run_of(const Batch& step, Parts&&... parts) {
    if (step.system->chain.empty())
        run_in_lanes(step.lanes, Job<Chains>{parts...});
    else
        run_in_lanes(step.lanes, Job<Cages>{parts...});
}

struct PlaceChain {
    AirBatch& air;
    const Batch& step;
    template <class S>
    FROND_INLINE void run() const {
        const std::vector<Attachment>& attachments = step.system->chain;
        for (size_t i = 0; i < attachments.size(); i++)
            store3(attachment_sum<S>(attachments[i], step.x.data()), air.chain.data(), 3 * int(i));
    }
};

// Finds the world positions of the chain nodes of all plants, and the wind there.
template <class Of>
struct LookAtWind {
    AirBatch& air;
    const Batch& step;
    const WindNow& now;
    int count;  // number of chain nodes
    template <class S>
    FROND_INLINE void run() const {
        constexpr int MOST = 4;  // nodes at once
        const Lanes33<S> to_world = {
            {load3<S>(air.to_world.data(), 0), load3<S>(air.to_world.data(), 3), load3<S>(air.to_world.data(), 6)}};
        const Lanes3<S> position = load3<S>(air.position.data(), 0);
        for (int begin = 0; begin < count; begin += MOST) {
            const int here = std::min(MOST, count - begin);
            Lanes3<S> places[MOST], velocities[MOST];
            for (int i = 0; i < here; i++)
                places[i] = to_world * Of::template place<S>(air, step, begin + i) + position;
            wind_at(now, places, here, velocities);
            for (int i = 0; i < here; i++) {
                store3(places[i], air.places.data(), 3 * (begin + i));
                store3(velocities[i], air.wind.data(), 3 * (begin + i));
            }
        }
    }
};

// Gathers the plants' rotations and positions.
void look_at_frames(AirBatch& air, Plant* const* plants, int plant_count, int lanes) {
    air.to_world.resize(9 * size_t(lanes));
    air.position.resize(3 * size_t(lanes));
    for (int lane = 0; lane < lanes; lane++) {
        const Plant& plant = *plants[std::min(lane, plant_count - 1)];
        const Mat3 to_world = plant.rotation.toRotationMatrix();
        for (int k = 0; k < 9; k++) air.to_world[size_t(k * lanes + lane)] = to_world(k / 3, k % 3);
        for (int c = 0; c < 3; c++) air.position[size_t(c * lanes + lane)] = plant.position[c];
    }
}

// Queries the host's own field, plant by plant. Returns the plants for which it was unsound, a bit each.
unsigned ask_field(AirBatch& air, const Surroundings& surroundings, int plant_count, int lanes) {
    unsigned unsound = 0;
    const size_t count = air.wind.size() / (3 * size_t(lanes));
    std::vector<frond_vec3> points(count), velocities(count);
    for (int lane = 0; lane < plant_count; lane++) {
        const auto at = [&](auto& of, size_t i, int c) -> auto& {
            return of[(3 * i + size_t(c)) * size_t(lanes) + size_t(lane)];
        };
        for (size_t i = 0; i < count; i++) {
            points[i] = {at(air.places, i, 0), at(air.places, i, 1), at(air.places, i, 2)};
            velocities[i] = {at(air.wind, i, 0), at(air.wind, i, 1), at(air.wind, i, 2)};
        }
        if (!blow_by_field(*surroundings.wind, surroundings.time, points, velocities)) unsound |= 1u << lane;
        for (size_t i = 0; i < count; i++)
            at(air.wind, i, 0) = velocities[i].x, at(air.wind, i, 1) = velocities[i].y,
                            at(air.wind, i, 2) = velocities[i].z;
    }
    return unsound;
}

template <class Of>
struct GatherPiecesOfBatch {
    AirBatch& air;
    Batch& step;
    int count;  // number of chain nodes
    double density, h;
    bool is_dragged;  // whether air also damps motion

    template <class S>
    FROND_INLINE void look_at_air() const {
        const double* turn = air.to_world.data();
        const Lanes33<S> to_world = {{load3<S>(turn, 0), load3<S>(turn, 3), load3<S>(turn, 6)}};
        const Lanes33<S> to_model = transposed(to_world);
        for (int i = 0; i < count; i++) {
            const Lanes3<S> velocity = is_dragged ? Of::template velocity<S>(step, step.v, i) : Lanes3<S>{};
            store3(velocity, air.velocities.data(), 3 * i);
            store3(to_model * load3<S>(air.wind.data(), 3 * i) - velocity, air.passing.data(), 3 * i);
        }
    }
    template <class S>
    FROND_INLINE void add_at(int node, const AirPiece& of, const AirLanes<S>& piece, const Lanes33<S>& frame) const {
        const AirPush<S> push = air_push(piece, of.shape, frame, load3<S>(air.passing.data(), 3 * node),
                                         load3<S>(air.velocities.data(), 3 * node), density, h);
        for (int k = 0; k < 6; k++) {
            const auto add = [&](NumbersInLines& to, const S& value) {
                double* at = to.data() + LANES<S> * (6 * node + k);
                store(S(load<S>(at) + value), at);
            };
            add(air.resistance, push.resistance[k]);
            add(air.lag, push.lag * push.resistance[k]);
        }
    }
    template <class S>
    FROND_INLINE void put_drag(int node) const {
        S six[6];
        for (int k = 0; k < 6; k++) six[k] = load<S>(air.resistance.data() + LANES<S> * (6 * node + k));
        const Lanes33<S> resistance = {{{six[0], six[1], six[2]}, {six[1], six[3], six[4]}, {six[2], six[4], six[5]}}};
        store3(resistance * (load3<S>(air.passing.data(), 3 * node) + load3<S>(air.velocities.data(), 3 * node)),
               step.drag_force.data(), 3 * node);
        for (int k = 0; k < 6; k++) {
            const S damping = is_dragged ? S(six[k] + load<S>(air.lag.data() + LANES<S> * (6 * node + k))) : S{};
            store(damping, step.drag_damping.data() + LANES<S> * (6 * node + k));
        }
    }
    template <class S>
    FROND_INLINE void add_of(const AirPiece& of, const Lanes3<S>& wide) const {
        const auto place = [&](int i) FROND_INLINED { return Of::template place<S>(air, step, i); };
        const AirLanes<S> piece([&](int) -> const AirPiece& { return of; });
        const Lanes33<S> frame = air_frame<S>(place(of.node) - place(of.parent), wide);
        add_at(of.parent, of, piece, frame);
        add_at(of.node, of, piece, frame);
    }
    template <class S>
    FROND_INLINE void add_pieces(Chains) const {
        const double* x = step.x.data();
        // Most segments continue the one before.
        int last_node = -1;
        Lanes33<S> last_turn = {};
        for (const AirPiece& of : *air.pieces) {
            Lanes33<S> turn = last_turn;
            if (of.parent != last_node) turn = rotation_by(load3<S>(x, 6 * of.parent + 3));
            last_node = of.node;
            last_turn = rotation_by(load3<S>(x, 6 * of.node + 3));
            const Lanes3<S> wide = {constant<S>(of.wide[0]), constant<S>(of.wide[1]), constant<S>(of.wide[2])};
            add_of(of, turn * wide + last_turn * wide);
        }
    }
    // Finds `wide` as wide_now() does.
    template <class S>
    FROND_INLINE void add_pieces(Cages) const {
        for (const AirPiece& of : *air.pieces) {
            Lanes3<S> wide = {};
            for (size_t k = 0; k < 2; k++) {
                const Attachment& attachment = step.system->chain[size_t(k == 0 ? of.parent : of.node)];
                for (size_t c = 0; c < 4; c++)
                    wide = wide + constant<S>(of.spread[k][c]) * load3<S>(step.x.data(), 3 * attachment.node[c]);
            }
            add_of(of, wide);
        }
    }
    template <class S>
    FROND_INLINE void run() const {
        look_at_air<S>();
        add_pieces<S>(Of());
        for (int i = 0; i < count; i++) put_drag<S>(i);
    }
};

template <class Of>
struct AddForces {
    const Batch& step;
    NumbersInLines& out;
    template <class S>
    FROND_INLINE void run() const {
        Lanes3<S> sum = {};
        for (int i = 0; i < int(step.drag_force.size()) / (3 * LANES<S>); i++) {
            const Lanes3<S> force = load3<S>(step.drag_force.data(), 3 * i),
                            first = load3<S>(step.drag_damping.data(), 6 * i),
                            rest = load3<S>(step.drag_damping.data(), 6 * i + 3);
            const Lanes33<S> damping = {{first, {first.y, rest.x, rest.y}, {first.z, rest.y, rest.z}}};
            sum = sum + (force - damping * Of::template velocity<S>(step, step.v_end, i));
        }
        store3(sum, out.data(), 0);
    }
};

}  // namespace

unsigned gather_air(AirBatch& air, Batch& step, Plant* const* plants, int plant_count, const Surroundings& surroundings,
                    frond_effects effects, double h) {
    const int lanes = step.lanes, count = int(plants[0]->view.chain_positions.size());
    if (!surroundings.wind || !(effects & (FROND_EFFECT_WIND | FROND_EFFECT_AIR_DRAG))) {
        for (NumbersInLines* drags : {&step.drag_force, &step.drag_damping}) drags->assign(drags->size(), 0);
        return 0;
    }
    if (!air.pieces) air.pieces = air_pieces_of(*plants[0]);
    const size_t n = 3 * size_t(count) * size_t(lanes);
    for (NumbersInLines* numbers : {&air.wind, &air.places, &air.passing, &air.velocities}) make_room(*numbers, n);
    for (NumbersInLines* sums : {&air.resistance, &air.lag}) {
        make_room(*sums, 2 * n);
        sums->assign(2 * n, 0);
    }
    make_room(air.chain, step.system->chain.empty() ? 0 : n);
    if (!air.chain.empty()) run_in_lanes(lanes, PlaceChain{air, step});
    look_at_frames(air, plants, plant_count, lanes);
    unsigned unsound = 0;
    if (effects & FROND_EFFECT_WIND) {
        const WindNow now = wind_now(*surroundings.wind, up_of(surroundings.gravity));
        run_of<LookAtWind>(step, air, step, now, count);
        if (surroundings.wind->field) unsound = ask_field(air, surroundings, plant_count, lanes);
    } else {
        air.wind.assign(n, 0);
    }
    run_of<GatherPiecesOfBatch>(step, air, step, count, surroundings.wind->def.density, h,
                                (effects & FROND_EFFECT_AIR_DRAG) != 0);
    return unsound;
}

void air_forces(const Batch& step, NumbersInLines& out) {
    out.resize(3 * size_t(step.lanes));
    run_of<AddForces>(step, step, out);
}

void take_drags(const Batch& step, int lane, std::vector<Drag>& out) {
    const auto number = [&](const NumbersInLines& of, size_t i) { return of[i * size_t(step.lanes) + size_t(lane)]; };
    out.clear();
    for (size_t i = 0; i < step.system->chain.size(); i++) {
        Drag drag;
        SixOf damping;
        for (size_t c = 0; c < 3; c++) drag.force[Eigen::Index(c)] = number(step.drag_force, 3 * i + c);
        for (size_t k = 0; k < 6; k++) damping[k] = number(step.drag_damping, 6 * i + k);
        drag.damping = matrix_of(damping);
        drag.attachment = step.system->chain[i];
        if (drag.force != Vec3::Zero() || damping != SixOf{}) out.push_back(drag);
    }
}

}  // namespace frond
