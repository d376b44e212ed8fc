// Input: the bytes of a run, consumed one choice at a time, followed by zeros; and the conditions that hold after any
// call.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "frond/frond_robot.h"
#include "frond/frond_snapshot.h"

namespace frond::fuzz {

struct Input {
    const uint8_t* data;
    size_t left;

    bool is_empty() const { return left == 0; }
    uint8_t byte() {
        if (left == 0) return 0;
        left--;
        return *data++;
    }
    int below(int count) { return byte() % count; }
    template <class T>
    T raw() {
        T value = {};
        const size_t count = left < sizeof value ? left : sizeof value;
        std::memcpy(&value, data, count);
        data += count;
        left -= count;
        return value;
    }
    // Returns mostly meaningful numbers, sometimes arbitrary ones.
    double number() {
        static const double KNOWN[] = {0,   1,   -1,   0.1,  0.5,    -0.3,   2,   10,      1e-6,
                                       1e6, 1e9, 1e10, 1e30, -1e308, 1e-310, NAN, INFINITY};
        const uint8_t choice = byte();
        if (choice < 200) return (choice - 100) / 50.0;
        if (choice < 240) return KNOWN[choice % (sizeof KNOWN / sizeof *KNOWN)];
        return raw<double>();
    }
    int integer() {
        const uint8_t choice = byte();
        return choice < 220 ? choice - 10 : raw<int>();
    }
    frond_vec3 vec() {
        const double x = number(), y = number();
        return {x, y, number()};
    }
};

// Changes bytes of a file from a place on, or now and then ends it there.
inline void damage(Input& input, size_t at, std::vector<uint8_t>& bytes) {
    const double number = input.number();
    const uint32_t word = input.raw<uint32_t>();
    switch (input.below(4)) {
        case 0:
            bytes[at] ^= uint8_t(word);
            break;
        case 1:
            if (at + sizeof number <= bytes.size()) std::memcpy(&bytes[at], &number, sizeof number);
            break;
        case 2:
            if (at + sizeof word <= bytes.size()) std::memcpy(&bytes[at], &word, sizeof word);
            break;
        default:
            if (word % 16 == 0) bytes.resize(at + 1);
    }
}

inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: %s; last error: %s\n", what, frond_last_error());
    std::abort();
}

// Whatever was done, all that a plant reports is finite.
inline void require_finite(frond_plant plant) {
    const int nodes = frond_plant_get_node_count(plant);
    if (nodes == 0) return;
    std::vector<double> x(3 * size_t(nodes)), v(x.size());
    require(frond_plant_get_state(plant, x.data(), v.data(), nodes) == FROND_OK, "a valid plant has no state");
    for (size_t i = 0; i < x.size(); i++) require(std::isfinite(x[i]) && std::isfinite(v[i]), "a state is not finite");
}

}  // namespace frond::fuzz
