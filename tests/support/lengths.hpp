// Lengths of what is drawn of a plant.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "frond/frond.h"
#include "support/must.hpp"

namespace frond::test {

// Returns the lengths of a plant's capsules [m].
inline std::vector<double> capsule_lengths(frond_plant plant) {
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
    must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
    std::vector<double> lengths;
    for (const auto& [begin, end, radius] : capsules)
        lengths.push_back(std::hypot(end.x - begin.x, end.y - begin.y, end.z - begin.z));
    return lengths;
}

// Returns how far a plant's capsules are drawn out at most: their lengths now over their own ones [-].
inline double most_drawn_out(frond_plant plant, const std::vector<double>& own) {
    const std::vector<double> now = capsule_lengths(plant);
    double most = 0;
    for (size_t i = 0; i < now.size(); i++) most = std::max(most, now[i] / own[i]);
    return most;
}

// Returns the lengths of the edges of a plant's surface, three a triangle [m].
inline std::vector<double> edge_lengths(frond_plant plant) {
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    std::vector<double> lengths;
    for (int i = 0; i < 3 * view.triangle_count; i++) {
        const float* a = view.positions + 3 * view.indices[i];
        const float* b = view.positions + 3 * view.indices[i % 3 == 2 ? i - 2 : i + 1];
        lengths.push_back(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
    return lengths;
}

}  // namespace frond::test
