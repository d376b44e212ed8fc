// In: boxes. Out: pairs that overlap. Boxes are sorted along the axis on which they are spread most and swept (Baraff
// 1992, "Dynamic Simulation of Non-penetrating Rigid Bodies"); each is compared with several at once.
#include "collide/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "core/lanes.hpp"

namespace frond {

namespace {

int axis_of_greatest_spread(const BoxSet& set) {
    double spread[3];
    for (int k = 0; k < 3; ++k) {
        double low = INFINITY, high = -INFINITY;
        for (const BoxSet::Bounds& box : set.boxes) {
            low = std::min(low, box.lower[k]);
            high = std::max(high, box.upper[k]);
        }
        spread[k] = high - low;
    }
    return int(std::max_element(spread, spread + 3) - spread);
}

// Boxes in the order of their lower ends along an axis, number by number; beyond the last one there are as many as fit
// into the lanes that compare with none.
struct SortedBoxes {
    std::vector<int> order;
    std::vector<double> begin, end, low[2], high[2], group;

    SortedBoxes(const BoxSet& set, int axis) {
        const size_t count = set.boxes.size(), all = count + MOST_LANES;
        std::vector<std::pair<double, int>> keys;
        for (size_t i = 0; i < count; ++i) keys.emplace_back(set.boxes[i].lower[axis], int(i));
        std::sort(keys.begin(), keys.end());
        for (std::vector<double>* list : {&begin, &end, &low[0], &low[1], &high[0], &high[1], &group})
            list->assign(all, NAN);
        for (size_t i = 0; i < count; ++i) {
            const BoxSet::Bounds& box = set.boxes[size_t(keys[i].second)];
            order.push_back(keys[i].second);
            begin[i] = box.lower[axis];
            end[i] = box.upper[axis];
            for (int k = 0; k < 2; ++k) {
                low[k][i] = box.lower[(axis + 1 + k) % 3];
                high[k][i] = box.upper[(axis + 1 + k) % 3];
            }
            group[i] = box.group;
        }
    }
};

struct Sweep {
    const SortedBoxes& boxes;
    std::vector<std::array<int, 2>>& pairs;

    template <class S>
    FROND_INLINE void run() const {
        const SortedBoxes& b = boxes;
        const size_t count = b.order.size();
        for (size_t i = 0; i < count; ++i) {
            const S end = constant<S>(b.end[i]), group = constant<S>(b.group[i]);
            const S low0 = constant<S>(b.low[0][i]), high0 = constant<S>(b.high[0][i]);
            const S low1 = constant<S>(b.low[1][i]), high1 = constant<S>(b.high[1][i]);
            for (size_t k = i + 1; b.begin[k] <= b.end[i]; k += LANES<S>) {
                const auto meet = (load<S>(&b.begin[k]) <= end) & (load<S>(&b.low[0][k]) <= high0) &
                                  (load<S>(&b.high[0][k]) >= low0) & (load<S>(&b.low[1][k]) <= high1) &
                                  (load<S>(&b.high[1][k]) >= low1) & (load<S>(&b.group[k]) != group);
                if (!any(meet)) continue;
                for (int lane = 0; lane < LANES<S>; ++lane)
                    if (meet[lane]) pairs.push_back({b.order[i], b.order[k + size_t(lane)]});
            }
        }
    }
};

}  // namespace

BoxSet::Bounds box_around(const Capsule& capsule, double margin) {
    BoxSet::Bounds box = BoxSet::none();
    for (int k = 0; k < 3; ++k) {
        box.lower[k] = std::min(capsule.begin[k], capsule.end[k]) - capsule.radius - margin;
        box.upper[k] = std::max(capsule.begin[k], capsule.end[k]) + capsule.radius + margin;
    }
    return box;
}

std::vector<std::array<int, 2>> find_pairs_by_sweep(const BoxSet& set) {
    std::vector<std::array<int, 2>> pairs;
    const SortedBoxes boxes(set, axis_of_greatest_spread(set));
    run_in_lanes(Sweep{boxes, pairs});
    for (std::array<int, 2>& pair : pairs)
        if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace frond
