// In: plants side by side and the air of their world. Out: drags on their chain nodes, as in air_gather.cpp.
#include "plant/air_abreast.hpp"

#include "core/product.hpp"
#include "plant/air_push.hpp"

namespace frond {

namespace {

// The wind at the chain nodes of a plant; none where it has no effect.
bool look_at_wind(AirAbreast& air, const Plant& plant, const Mat3& to_world, const Surroundings& surroundings,
                  frond_effects effects) {
    const size_t count = plant.chain_positions.size();
    air.wind_at.assign(count, frond_vec3{0, 0, 0});
    if (!(effects & FROND_WIND)) return true;
    air.points.resize(count);
    for (size_t i = 0; i < count; i++) {
        const Vec3 p = product(to_world, plant.chain_positions[i]) + plant.position;
        air.points[i] = {p.x(), p.y(), p.z()};
    }
    return wind_velocities(*surroundings.wind, up_of(surroundings.gravity), surroundings.time, air.points, air.wind_at);
}

// Into the lanes from one to another.
void put_wind(AirAbreast& air, const Mat3& to_world, int first, int end, int lanes) {
    for (int lane = first; lane < end; lane++) {
        const auto put = [&](VecX& to, size_t i, double value) { to[Eigen::Index(i) * lanes + lane] = value; };
        for (int k = 0; k < 9; k++) put(air.to_world, size_t(k), to_world(k / 3, k % 3));
        for (size_t i = 0; i < air.wind_at.size(); i++) {
            const frond_vec3& v = air.wind_at[i];
            put(air.wind, 3 * i, v.x), put(air.wind, 3 * i + 1, v.y), put(air.wind, 3 * i + 2, v.z);
        }
    }
}

struct GatherPieces {
    AirAbreast& air;
    Abreast& step;
    int count;  // of chain nodes
    double density, h;
    bool is_dragged;  // not only pushed

    template <class S>
    FROND_INLINE void look_at_air() const {
        const double* turn = air.to_world.data();
        const Lanes33<S> to_world = {{load3<S>(turn, 0), load3<S>(turn, 3), load3<S>(turn, 6)}};
        const Lanes33<S> to_model = transposed(to_world);
        for (int i = 0; i < count; i++) {
            const Lanes3<S> velocity = is_dragged ? load3<S>(step.v.data(), 6 * i) : Lanes3<S>{};
            store3(velocity, air.velocities.data(), 3 * i);
            store3(to_model * load3<S>(air.wind.data(), 3 * i) - velocity, air.passing.data(), 3 * i);
        }
    }
    template <class S>
    FROND_INLINE void add_at(int node, const AirPiece& of, const AirLanes<S>& piece, const Lanes33<S>& frame) const {
        const AirPush<S> push = air_push(piece, of.shape, frame, load3<S>(air.passing.data(), 3 * node),
                                         load3<S>(air.velocities.data(), 3 * node), density, h);
        for (int k = 0; k < 6; k++) {
            const auto add = [&](VecX& to, const S& value) {
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
    FROND_INLINE void run() const {
        look_at_air<S>();
        const double* x = step.x.data();
        for (const AirPiece& of : *air.pieces) {
            const AirLanes<S> piece([&](int) -> const AirPiece& { return of; });
            const Lanes3<S> wide = {constant<S>(of.wide[0]), constant<S>(of.wide[1]), constant<S>(of.wide[2])};
            const Lanes33<S> frame = air_frame<S>(
                load3<S>(x, 6 * of.node) - load3<S>(x, 6 * of.parent),
                turned_by(load3<S>(x, 6 * of.parent + 3), wide) + turned_by(load3<S>(x, 6 * of.node + 3), wide));
            add_at(of.parent, of, piece, frame);
            add_at(of.node, of, piece, frame);
        }
        for (int i = 0; i < count; i++) put_drag<S>(i);
    }
};

struct AddForces {
    const Abreast& step;
    VecX& out;
    unsigned& dragged;
    template <class S>
    FROND_INLINE void run() const {
        Lanes3<S> sum = {};
        S any = {};
        for (int i = 0; i < int(step.drag_force.size()) / (3 * LANES<S>); i++) {
            const Lanes3<S> force = load3<S>(step.drag_force.data(), 3 * i),
                            first = load3<S>(step.drag_damping.data(), 6 * i),
                            rest = load3<S>(step.drag_damping.data(), 6 * i + 3);
            const Lanes33<S> damping = {{first, {first.y, rest.x, rest.y}, {first.z, rest.y, rest.z}}};
            sum = sum + (force - damping * load3<S>(step.v_end.data(), 6 * i));
            any += dot(force, force) + dot(first, first) + dot(rest, rest);
        }
        store3(sum, out.data(), 0);
        dragged = 0;
        for (int lane = 0; lane < LANES<S>; lane++) dragged |= unsigned(any[lane] > 0) << lane;
    }
};

}  // namespace

unsigned gather_air(AirAbreast& air, Abreast& step, Plant* const* plants, int plant_count,
                    const Surroundings& surroundings, frond_effects effects, double h) {
    const int lanes = step.lanes, count = int(plants[0]->chain_positions.size());
    step.drag_force.setZero();
    step.drag_damping.setZero();
    if (!surroundings.wind || !(effects & (FROND_WIND | FROND_AIR_DRAG))) return 0;
    if (!air.pieces) air.pieces = air_pieces_of(*plants[0]);
    const Eigen::Index n = Eigen::Index(3 * count) * lanes;
    air.to_world.resize(9 * lanes);
    for (VecX* numbers : {&air.wind, &air.passing, &air.velocities}) numbers->resize(n);
    air.resistance.setZero(2 * n);
    air.lag.setZero(2 * n);
    unsigned unsound = 0;
    for (int i = 0; i < plant_count; i++) {
        const Mat3 to_world = plants[i]->rotation.toRotationMatrix();
        if (!look_at_wind(air, *plants[i], to_world, surroundings, effects)) unsound |= 1u << i;
        put_wind(air, to_world, i, i + 1 < plant_count ? i + 1 : lanes, lanes);
    }
    run_in_lanes(lanes, GatherPieces{air, step, count, surroundings.wind->def.density, h, (effects & FROND_AIR_DRAG) != 0});
    return unsound;
}

unsigned air_forces(const Abreast& step, VecX& out) {
    out.resize(3 * step.lanes);
    unsigned dragged = 0;
    run_in_lanes(step.lanes, AddForces{step, out, dragged});
    return dragged;
}

}  // namespace frond
