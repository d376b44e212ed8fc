// In: a plant. Out: the frames of its flat segments, and attachments to them.
#include <algorithm>

#include "mechanics/rotation.hpp"
#include "plant/air_push.hpp"
#include "plant/flat.hpp"
#include "plant/touch.hpp"

namespace frond {

Vec3 wide_now(const Plant& plant, int node, const Vec3& modelled, const TetSpread& spread) {
    const VecX& x = plant.state.motion.x;
    const int ends[2] = {plant.model->chain.nodes[size_t(node)].parent, node};
    Vec3 wide = Vec3::Zero();
    for (size_t k = 0; k < 2; k++) {
        if (plant.follow) {
            wide += rotation_of<double>(point(x, 2 * ends[k] + 1)) * modelled;
            continue;
        }
        const Tet& tet = plant.model->cage.tets[size_t(plant.model->chain_embedding.tet[size_t(ends[k])])];
        for (size_t c = 0; c < 4; c++) wide += spread[k][c] * point(x, tet[c]);
    }
    return wide;
}

bool piece_frame(const Plant& plant, int node, const Vec3& wide, const TetSpread& spread, Mat3& frame) {
    constexpr double LEAST = 1e-9;  // [m], [-]
    const int parent = plant.model->chain.nodes[size_t(node)].parent;
    const Vec3 chord = plant.view.chain_positions[size_t(node)] - plant.view.chain_positions[size_t(parent)];
    if (!(chord.norm() > LEAST)) return false;
    const Vec3 axis = chord.normalized(), now = wide_now(plant, node, wide, spread);
    const Vec3 across = now - axis * axis.dot(now);
    if (!(across.norm() > LEAST)) return false;
    frame.col(0) = axis;
    frame.col(2) = across.normalized();
    frame.col(1) = frame.col(2).cross(axis);
    return true;
}

namespace {

// Finds frames of several segments of a chain at once; lanes beyond the last one repeat it.
struct FindFrames {
    const Plant& plant;
    const std::vector<int>& capsules;
    const std::vector<Flat>& flats;
    std::vector<Mat3>& frames;
    template <class S>
    FROND_INLINE void run() const {
        const double* x = plant.state.motion.x.data();
        for (size_t i = 0; i < capsules.size(); i += size_t(LANES<S>)) {
            const auto at = [&](int lane) { return std::min(i + size_t(lane), capsules.size() - 1); };
            const auto capsule = [&](int lane) { return size_t(capsules[at(lane)]); };
            const auto three = [&](const auto& value) -> Lanes3<S> {
                return {gather<S>([&](int l) { return value(l, 0); }), gather<S>([&](int l) { return value(l, 1); }),
                        gather<S>([&](int l) { return value(l, 2); })};
            };
            const auto place = [&](size_t end) {
                return three([&](int l, int c) {
                    return plant.view.chain_positions[size_t(plant.model->capsules[capsule(l)][end])][c];
                });
            };
            const auto turn = [&](size_t end) {
                return three([&](int l, int c) { return x[6 * plant.model->capsules[capsule(l)][end] + 3 + c]; });
            };
            const Lanes3<S> wide = three([&](int l, int c) { return flats[capsule(l)].wide[c]; });
            const Lanes33<S> rows =
                air_frame<S>(place(1) - place(0), turned_by(turn(0), wide) + turned_by(turn(1), wide));
            double numbers[9 * LANES<S>];
            for (int r = 0; r < 3; r++) store3(rows.r[r], numbers, 3 * r);
            for (int lane = 0; lane < LANES<S> && i + size_t(lane) < capsules.size(); lane++)
                for (int k = 0; k < 9; k++) frames[i + size_t(lane)].data()[k] = numbers[LANES<S> * k + lane];
        }
    }
};

}  // namespace

void piece_frames(const Plant& plant, const std::vector<int>& capsules, const std::vector<Flat>& flats,
                  std::vector<Mat3>& frames) {
    frames.resize(capsules.size());
    if (plant.follow && plant.state.fragments.empty()) return run_in_lanes(FindFrames{plant, capsules, flats, frames});
    for (size_t i = 0; i < capsules.size(); i++) {
        const Flat& flat = flats[size_t(capsules[i])];
        if (!piece_frame(plant, plant.model->capsules[size_t(capsules[i])][1], flat.wide, flat.spread, frames[i]))
            frames[i].setZero();
    }
}

Attachment flat_attachment(const Plant& plant, int capsule, const Flat& flat, double along, double across) {
    Attachment attachment = capsule_attachment(plant, capsule, along);
    if (across == 0) return attachment;
    if (plant.follow) {
        attachment.turns = true;
        for (size_t k = 0; k < size_t(attachment.count); k++)
            attachment.arm[k] = attachment.weight[k] * across * flat.wide;
        return attachment;
    }
    // An attachment has no space for the nodes of two quadratic tets, nor for a lever.
    if (plant.nodes->order == 2) return attachment;
    const auto& ends = plant.model->capsules[size_t(capsule)];
    const double share[2] = {1 - along, along};
    for (size_t k = 0; k < 2; k++) {
        const Tet& tet = plant.model->cage.tets[size_t(plant.model->chain_embedding.tet[size_t(ends[k])])];
        for (size_t c = 0; c < 4; c++)
            for (size_t n = 4 * k; n < 4 * k + 4; n++)
                if (attachment.node[n] == tet[c]) attachment.weight[n] += share[k] * across * flat.spread[k][c];
    }
    return attachment;
}

}  // namespace frond
