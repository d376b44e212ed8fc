// Finds regions that meet: covers of bodies come in, regions whose capsules are near another's go out. Boxes of the
// capsules are swept, then the capsules are tested.
#include <algorithm>

#include "collide/cover.hpp"
#include "collide/sweep.hpp"

namespace frond {

std::vector<std::vector<uint8_t>> find_meeting_pieces(const std::vector<CoveredBody>& bodies, double margin) {
    BoxSet set;
    std::vector<std::array<int, 2>> places;  // body and region
    int group = 0;
    for (size_t b = 0; b < bodies.size(); ++b)
        for (int piece = 0; piece < bodies[b].collider->piece_count; ++piece) {
            const Capsule& cover = (*bodies[b].capsules)[size_t(piece)];
            set.boxes.push_back(cover.radius == NOTHING ? BoxSet::none() : box_around(cover, 0.5 * margin));
            set.boxes.back().group = group;
            places.push_back({int(b), piece});
            // Of a body that collides with itself each region is a group.
            group += bodies[b].with_itself || piece + 1 == bodies[b].collider->piece_count;
        }
    std::vector<std::vector<uint8_t>> pieces(bodies.size());
    const auto takes_part = [&](const std::array<int, 2>& place) {
        std::vector<uint8_t>& list = pieces[size_t(place[0])];
        list.resize(size_t(bodies[size_t(place[0])].collider->piece_count), 0);
        list[size_t(place[1])] = 1;
    };
    for (const auto& [first, second] : find_pairs_by_sweep(set)) {
        const std::array<int, 2>&a = places[size_t(first)], &b = places[size_t(second)];
        const CoveredBody &of_a = bodies[size_t(a[0])], &of_b = bodies[size_t(b[0])];
        if (a[0] == b[0] && of_a.collider->are_near(a[1], b[1])) continue;
        if (gap_between((*of_a.capsules)[size_t(a[1])], (*of_b.capsules)[size_t(b[1])]).distance > margin) continue;
        takes_part(a);
        takes_part(b);
    }
    return pieces;
}

}  // namespace frond
