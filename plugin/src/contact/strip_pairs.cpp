// In: strips on their way through a step. Out: pairs that may meet, by boxes around the ways.
#include <algorithm>

#include "collide/sweep.hpp"
#include "contact/strip_search.hpp"
#include "world/fragments.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

void add_box(const BoxSet::Bounds& box, BoxSet::Bounds& to) {
    for (int k = 0; k < 3; k++) {
        to.lower[k] = std::min(to.lower[k], box.lower[k]);
        to.upper[k] = std::max(to.upper[k], box.upper[k]);
    }
}

BoxSet::Bounds way_box(const StripPath& path, int number, double margin) {
    const Strip& strip = path.strip(number);
    return box_of_way(strip, path.before, path.after, strip.radius + 0.5 * margin);
}

// Boxes of strips, and which they are.
struct StripBoxes {
    BoxSet set;
    std::vector<std::array<int, 2>> strips;  // body and strip
};

// Gathers the boxes that meet another plant's, and all of plants that touch themselves, of which each is a group.
StripBoxes gather_strips(const std::vector<StripPath>& paths, double margin) {
    StripBoxes all, wanted;
    BoxSet wholes;
    for (size_t b = 0; b < paths.size(); b++) {
        wholes.boxes.push_back(BoxSet::none());
        wholes.boxes[b].group = int(b);
        for (size_t s = 0; s < paths[b].body->touched().strips.size(); s++) {
            if (has_come_off(*paths[b].body->plant, paths[b].strip(int(s)).piece)) continue;
            all.set.boxes.push_back(way_box(paths[b], int(s), margin));
            all.set.boxes.back().group = int(b);
            all.strips.push_back({int(b), int(s)});
            add_box(all.set.boxes.back(), wholes.boxes[b]);
        }
    }
    std::vector<std::vector<int>> others(paths.size());  // plants whose boxes meet each
    for (const auto& [a, b] : find_pairs_by_sweep(wholes)) {
        others[size_t(a)].push_back(b);
        others[size_t(b)].push_back(a);
    }
    int groups = int(paths.size());
    for (size_t i = 0; i < all.strips.size(); i++) {
        BoxSet::Bounds& box = all.set.boxes[i];
        const size_t body = size_t(box.group);
        const auto meets = [&](int other) { return boxes_meet(box, wholes.boxes[size_t(other)]); };
        if (paths[body].with_itself)
            box.group = groups++;
        else if (std::none_of(others[body].begin(), others[body].end(), meets))
            continue;
        wanted.set.boxes.push_back(box);
        wanted.strips.push_back(all.strips[i]);
    }
    return wanted;
}

// Finds the pairs that come nearer than `margin` [m] within the step, by their boxes; those near each other as
// modelled, as at a joint, are left out.
std::vector<StripPair> find_strip_pairs(const std::vector<StripPath>& paths, double margin) {
    const StripBoxes boxes = gather_strips(paths, margin);
    std::vector<StripPair> pairs;
    for (const auto& [first, second] : find_pairs_by_sweep(boxes.set)) {
        const auto& [body_a, strip_a] = boxes.strips[size_t(first)];
        const auto& [body_b, strip_b] = boxes.strips[size_t(second)];
        if (body_a == body_b) {
            const StripPath& path = paths[size_t(body_a)];
            if (path.body->touched().collider.are_near(path.strip(strip_a).piece, path.strip(strip_b).piece)) continue;
        }
        pairs.push_back({body_a, strip_a, body_b, strip_b});
    }
    const auto key = [](const StripPair& p) { return std::tie(p.a, p.b, p.strip_a, p.strip_b); };
    std::sort(pairs.begin(), pairs.end(), [&](const StripPair& p, const StripPair& q) { return key(p) < key(q); });
    return pairs;
}

}  // namespace

void remember_pairs(const std::vector<StripPath>& paths, PlantSearch& memory) {
    memory.pairs = find_strip_pairs(paths, 2 * STRAY);
    memory.foreseen.resize(paths.size());
    for (size_t i = 0; i < paths.size(); i++) memory.foreseen[i] = memory.corners[i][1];
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
