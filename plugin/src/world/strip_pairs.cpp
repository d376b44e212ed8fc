// In: strips on their way through a step. Out: pairs that may meet. Boxes around the ways are sorted along one axis and
// swept (Baraff 1992, "Dynamic Simulation of Non-penetrating Rigid Bodies").
#include <algorithm>

#include "world/strip_search.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Plain numbers: this file is compiled without inlining Eigen's.
struct WayBox {
    double lower[3] = {INFINITY, INFINITY, INFINITY}, upper[3] = {-INFINITY, -INFINITY, -INFINITY};
    int body = 0, strip = 0;
    void add(const double* p) {
        for (int k = 0; k < 3; k++) {
            if (p[k] < lower[k]) lower[k] = p[k];
            if (p[k] > upper[k]) upper[k] = p[k];
        }
    }
    void widen(double by) {
        for (int k = 0; k < 3; k++) {
            lower[k] -= by;
            upper[k] += by;
        }
    }
    bool meets(const WayBox& other) const {
        for (int k = 0; k < 3; k++)
            if (lower[k] > other.upper[k] || other.lower[k] > upper[k]) return false;
        return true;
    }
};

WayBox way_box(const StripPath& path, int body, int number, double margin) {
    WayBox box;
    box.body = body;
    box.strip = number;
    const Strip& strip = path.strip(number);
    for (const int corner : strip.corners) {
        box.add(path.before[corner].data());
        box.add(path.after[corner].data());
    }
    box.widen(strip.radius + 0.5 * margin + path.astray);
    return box;
}

// Gathers the boxes that meet another plant's, and all of plants that touch themselves.
std::vector<WayBox> gather(const std::vector<StripPath>& paths, double margin) {
    std::vector<WayBox> wholes(paths.size()), all, wanted;
    for (size_t b = 0; b < paths.size(); b++)
        for (size_t s = 0; s < paths[b].body->touched().strips.size(); s++) {
            all.push_back(way_box(paths[b], int(b), int(s), margin));
            wholes[b].add(all.back().lower);
            wholes[b].add(all.back().upper);
        }
    for (const WayBox& box : all) {
        bool meets = paths[size_t(box.body)].with_itself;
        for (size_t b = 0; b < wholes.size() && !meets; b++) meets = int(b) != box.body && box.meets(wholes[b]);
        if (meets) wanted.push_back(box);
    }
    return wanted;
}

}  // namespace

std::vector<StripPair> find_strip_pairs(const std::vector<StripPath>& paths, double margin) {
    std::vector<WayBox> boxes = gather(paths, margin);
    WayBox whole;
    for (const WayBox& box : boxes) {
        whole.add(box.lower);
        whole.add(box.upper);
    }
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (whole.upper[k] - whole.lower[k] > whole.upper[axis] - whole.lower[axis]) axis = k;
    std::sort(boxes.begin(), boxes.end(),
              [axis](const WayBox& a, const WayBox& b) { return a.lower[axis] < b.lower[axis]; });
    std::vector<StripPair> pairs;
    for (size_t i = 0; i < boxes.size(); i++)
        for (size_t k = i + 1; k < boxes.size() && boxes[k].lower[axis] <= boxes[i].upper[axis]; k++) {
            if (!boxes[i].meets(boxes[k])) continue;
            const WayBox &a = boxes[i], &b = boxes[k];
            if (a.body == b.body) {
                const StripPath& path = paths[size_t(a.body)];
                const auto piece = [&](const WayBox& box) { return path.strip(box.strip).piece; };
                if (!path.with_itself || path.body->touched().collider.are_near(piece(a), piece(b))) continue;
            }
            const bool in_order = std::tie(a.body, a.strip) < std::tie(b.body, b.strip);
            const WayBox &first = in_order ? a : b, &second = in_order ? b : a;
            pairs.push_back({first.body, first.strip, second.body, second.strip});
        }
    const auto key = [](const StripPair& p) { return std::tie(p.a, p.b, p.strip_a, p.strip_b); };
    std::sort(pairs.begin(), pairs.end(), [&](const StripPair& p, const StripPair& q) { return key(p) < key(q); });
    return pairs;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
