// Welds render vertices. In: corners. Out: the same triangles over fewer vertices. Some readers give a vertex per face
// corner; equal ones are merged by a hash over their bits.
#include <cstring>

#include "importer/importer.hpp"

namespace frond {

template <typename Number>
static void mix(uint64_t& hash, const Number* values, int count) {
    for (int i = 0; i < count; ++i) {
        const Number value = values[i] + Number(0);  // -0 becomes 0
        uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof value);
        hash = (hash ^ bits) * 0x9E3779B97F4A7C15ull;
        hash ^= hash >> 30;
    }
}

static uint64_t hash_of(const Corners& corners, size_t i) {
    uint64_t hash = 1;
    mix(hash, corners.positions[i].data(), 3);
    if (!corners.normals.empty()) mix(hash, corners.normals[i].data(), 3);
    if (!corners.uvs.empty()) mix(hash, corners.uvs[i].data(), 2);
    if (!corners.colors.empty()) {
        uint32_t bits;
        std::memcpy(&bits, corners.colors[i].data(), sizeof bits);
        hash = (hash ^ bits) * 0xD6E8FEB86659FD93ull;
        hash ^= hash >> 32;
    }
    return hash;
}

static bool are_equal(const Corners& corners, size_t a, size_t b) {
    return corners.positions[a] == corners.positions[b] &&
           (corners.normals.empty() || corners.normals[a] == corners.normals[b]) &&
           (corners.uvs.empty() || corners.uvs[a] == corners.uvs[b]) &&
           (corners.colors.empty() || corners.colors[a] == corners.colors[b]);
}

template <typename Value>
static void keep_first(std::vector<Value>& values, const std::vector<int>& kept) {
    if (values.empty()) return;
    for (size_t i = 0; i < kept.size(); ++i) values[i] = values[size_t(kept[i])];
    values.resize(kept.size());
}

void weld_corners(Corners& corners) {
    const size_t count = corners.positions.size();
    size_t slot_count = 16;
    while (slot_count < 2 * count) slot_count *= 2;
    std::vector<int> slots(slot_count, -1), number(count), kept;
    for (size_t i = 0; i < count; ++i) {
        size_t slot = hash_of(corners, i) & (slot_count - 1);
        while (slots[slot] >= 0 && !are_equal(corners, size_t(slots[slot]), i)) slot = (slot + 1) & (slot_count - 1);
        if (slots[slot] < 0) {
            slots[slot] = int(i);
            number[i] = int(kept.size());
            kept.push_back(int(i));
        } else {
            number[i] = number[size_t(slots[slot])];
        }
    }
    for (Triangle& triangle : corners.triangles)
        for (int& corner : triangle) corner = number[size_t(corner)];
    keep_first(corners.positions, kept);
    keep_first(corners.normals, kept);
    keep_first(corners.uvs, kept);
    keep_first(corners.colors, kept);
}

// Appends the values of new vertices to an optional array; fills in `missing` for whichever side has none.
template <typename Value>
static void append_values(std::vector<Value>& to, size_t before, const std::vector<Value>& from, size_t count,
                          const Value& missing) {
    if (from.empty() && to.empty()) return;
    to.resize(before, missing);
    if (from.empty())
        to.resize(before + count, missing);
    else
        to.insert(to.end(), from.begin(), from.end());
}

void append_part(Surface& surface, const Corners& corners, const Part& part) {
    if (corners.triangles.empty()) return;
    const size_t before = surface.positions.size(), count = corners.positions.size();
    if (surface.triangles.size() + corners.triangles.size() > size_t(MAX_TRIANGLES) ||
        before + count > size_t(3) * MAX_TRIANGLES)
        fail(FROND_RESULT_BAD_GEOMETRY, "the file has more than the %d triangles that are allowed; simplify it",
             MAX_TRIANGLES);
    surface.positions.insert(surface.positions.end(), corners.positions.begin(), corners.positions.end());
    append_values(surface.normals, before, corners.normals, count, Vec3f(0, 0, 0));
    append_values(surface.uvs, before, corners.uvs, count, Vec2f(0, 0));
    append_values(surface.colors, before, corners.colors, count, Color{255, 255, 255, 255});
    Part added = part;
    added.first_triangle = int(surface.triangles.size());
    added.triangle_count = int(corners.triangles.size());
    for (const Triangle& triangle : corners.triangles)
        surface.triangles.push_back({triangle[0] + int(before), triangle[1] + int(before), triangle[2] + int(before)});
    surface.parts.push_back(std::move(added));
}

}  // namespace frond
