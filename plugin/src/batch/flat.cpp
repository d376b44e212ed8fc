// In: several plants. Out: the frames that flat_place.cpp finds for one.
#include "batch/flat.hpp"

#include <algorithm>
#include <array>

#include "batch/batch_step.hpp"
#include "core/lane_vectors.hpp"
#include "core/lanes_of_plants.hpp"
#include "plant/air_push.hpp"
#include "plant/flat.hpp"
#include "plant/plant.hpp"

namespace frond {

namespace {

struct FindFramesOfBatch {
    const Plant* const* plants;
    int count;
    const std::vector<int>& capsules;
    const std::vector<Flat>& flats;
    ChainBatch& out;

    template <class S>
    FROND_INLINE void gather_places() const {
        std::array<const double*, LANES<S>> from;
        for (int lane = 0; lane < LANES<S>; lane++)
            from[size_t(lane)] = plants[std::min(lane, count - 1)]->state.motion.x.data();
        put_side_by_side<S>(from.data(), size_t(plants[0]->state.motion.x.size()), out.x.data());
    }
    template <class S>
    FROND_INLINE Lanes3<S> turned(int node, const Lanes3<S>& direction) const {
        const double* turn = out.turns.data();
        const Lanes33<S> rows = {
            {load3<S>(turn, 9 * node), load3<S>(turn, 9 * node + 3), load3<S>(turn, 9 * node + 6)}};
        return rows * direction;
    }
    template <class S>
    FROND_INLINE void run() const {
        gather_places<S>();
        const double* x = out.x.data();
        for (int i = 0; i < int(out.turns.size()) / (9 * LANES<S>); i++) {
            const Lanes33<S> rows = rotation_by(load3<S>(x, 6 * i + 3));
            for (int r = 0; r < 3; r++) store3(rows.r[r], out.turns.data(), 9 * i + 3 * r);
        }
        for (size_t i = 0; i < capsules.size(); i++) {
            const auto& [begin, end] = plants[0]->model->capsules[size_t(capsules[i])];
            const Vec3& wide = flats[size_t(capsules[i])].wide;
            const Lanes3<S> modelled = {constant<S>(wide[0]), constant<S>(wide[1]), constant<S>(wide[2])};
            const Lanes33<S> rows = air_frame<S>(load3<S>(x, 6 * end) - load3<S>(x, 6 * begin),
                                                 turned(begin, modelled) + turned(end, modelled));
            for (int r = 0; r < 3; r++) store3(rows.r[r], out.frames.data(), 9 * int(i) + 3 * r);
        }
    }
};

}  // namespace

void look_at_chains(const Plant* const* plants, int count, const std::vector<int>& capsules,
                    const std::vector<Flat>& flats, ChainBatch& out) {
    out.lanes = lanes_for(count);
    const size_t lanes = size_t(out.lanes), numbers = size_t(plants[0]->state.motion.x.size());
    make_room(out.x, numbers * lanes);
    make_room(out.turns, numbers / 6 * 9 * lanes);
    make_room(out.frames, 9 * capsules.size() * lanes);
    run_in_lanes(out.lanes, FindFramesOfBatch{plants, count, capsules, flats, out});
}

}  // namespace frond
