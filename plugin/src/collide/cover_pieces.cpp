// Covers regions: places of nodes and axes come in, capsules around each region's nodes go out.
#include <algorithm>

#include "collide/cover.hpp"

namespace frond {

std::vector<Capsule> cover_pieces(const Collider& collider, const Vec3* places, const std::vector<Axis>& axes) {
    std::vector<Capsule> capsules;
    for (int piece = 0; piece < collider.piece_count; ++piece) {
        const Vec3 &begin = axes[size_t(piece)][0], &end = axes[size_t(piece)][1], along = end - begin;
        const double squared_length = along.squaredNorm();
        double farthest = 0;
        for (const int n : collider.piece_nodes[piece]) {
            const Vec3 from_begin = places[n] - begin;
            const double share =
                squared_length > 0 ? std::clamp(along.dot(from_begin) / squared_length, 0.0, 1.0) : 0.0;
            farthest = std::max(farthest, (from_begin - share * along).squaredNorm());
        }
        capsules.push_back({begin, end, std::sqrt(farthest)});
    }
    return capsules;
}

}  // namespace frond
