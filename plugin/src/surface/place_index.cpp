// Numbers positions: equal ones get the same number. Uses an open-addressing hash table over the coordinates' bits; -0
// and 0 are equal.
#include "surface/place_index.hpp"

#include <cstring>

namespace frond {

static uint64_t hash_of(const Vec3& position) {
    uint64_t hash = 0x9E3779B97F4A7C15ull;
    for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = position[axis] + 0.0;  // -0 becomes 0
        uint64_t bits;
        std::memcpy(&bits, &coordinate, sizeof bits);
        hash = (hash ^ bits) * 0xD6E8FEB86659FD93ull;
        hash ^= hash >> 32;
    }
    return hash;
}

PlaceIndex index_places(const std::vector<Vec3>& positions) {
    PlaceIndex index;
    index.place.resize(positions.size());
    size_t slot_count = 16;
    while (slot_count < 2 * positions.size()) slot_count *= 2;
    std::vector<int> slots(slot_count, -1);  // first vertex at a position
    for (size_t i = 0; i < positions.size(); ++i) {
        size_t slot = hash_of(positions[i]) & (slot_count - 1);
        while (slots[slot] >= 0 && positions[size_t(slots[slot])] != positions[i]) slot = (slot + 1) & (slot_count - 1);
        if (slots[slot] < 0) {
            slots[slot] = int(i);
            index.place[i] = index.count++;
        } else {
            index.place[i] = index.place[size_t(slots[slot])];
        }
    }
    return index;
}

}  // namespace frond
