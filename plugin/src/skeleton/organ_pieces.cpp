// Slivers and faces. In: regions as slabs give them. Out: which of them are one.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/elementary.hpp"
#include "skeleton/organ_regions.hpp"

namespace frond {

namespace {

constexpr double SLIVER = 8;  // largest area of a sliver, in squares of the tube's radius that it lies on

// Finds the regions that are too small to be told apart from what they grow out of: caps of tubes, joints, knots, the
// narrow tip and the stiff middle of a leaf.
void join_slivers(const std::vector<Region>& regions, std::vector<int>& into) {
    const auto is_cap = [](const Region& sheet, const Region& tube) {
        return sheet.form == Form::SHEET && tube.form != Form::SHEET &&
               sheet.area < SLIVER * squared(tube.begin_radius);
    };
    std::vector<int> children(regions.size(), 0);
    for (const Region& region : regions)
        if (region.parent >= 0) children[size_t(region.parent)]++;
    for (size_t r = 0; r < regions.size(); r++) {
        const Region& region = regions[r];
        if (region.parent < 0 || !region.same_mesh) continue;
        const size_t p = size_t(region.parent);
        const Region& parent = regions[p];
        if (region.part != parent.part || region.form == parent.form) continue;
        // The lower end of a tube, closed by a cap.
        if (into[p] == int(p) && children[p] == 1 && is_cap(parent, region) && !parent.same_mesh) {
            into[p] = int(r);
            continue;
        }
        const Region& whole = regions[size_t(into[p])];
        const bool is_end = region.form == Form::SHEET && parent.form == Form::TUBE && children[r] == 0 &&
                            region.area < SLIVER * squared(parent.radius());
        const bool is_tip = region.form == Form::TUBE && parent.form == Form::SHEET && children[r] <= 1 &&
                            region.length < 2 * parent.length && region.area < parent.area;
        const bool goes_on = region.form == Form::SHEET && parent.form == Form::TUBE && whole.form == Form::SHEET &&
                             into[p] != int(p) && children[p] == 1;
        if (is_end || is_tip || goes_on) into[r] = into[p];
    }
}

bool are_two_faces(const Region& a, const Region& b) {
    const Vec3 size = a.box.sizes(), other = b.box.sizes();
    const double across = a.box.diagonal().norm();
    return a.component != b.component && a.part == b.part && std::abs(a.area - b.area) < 0.15 * a.area &&
           (a.middle - b.middle).norm() < 0.06 * across && (size - other).cwiseAbs().maxCoeff() < 0.1 * across &&
           a.normal.normalized().cross(b.normal.normalized()).norm() < 0.3;
}

// Finds sheets that are the other face of an earlier one.
void join_faces(const std::vector<Region>& regions, std::vector<int>& into) {
    std::vector<int> sheets;
    for (size_t r = 0; r < regions.size(); r++)
        if (regions[r].form == Form::SHEET && into[r] == int(r)) sheets.push_back(int(r));
    std::sort(sheets.begin(), sheets.end(), [&](int a, int b) {
        const double xa = regions[size_t(a)].middle.x(), xb = regions[size_t(b)].middle.x();
        return xa != xb ? xa < xb : a < b;
    });
    for (size_t i = 0; i < sheets.size(); i++)
        for (size_t k = i + 1; k < sheets.size(); k++) {
            const Region &a = regions[size_t(sheets[i])], &b = regions[size_t(sheets[k])];
            if (b.middle.x() - a.middle.x() > 0.06 * a.box.diagonal().norm()) break;
            if (into[size_t(sheets[i])] != sheets[i] || into[size_t(sheets[k])] != sheets[k] || !are_two_faces(a, b))
                continue;
            into[size_t(std::max(sheets[i], sheets[k]))] = std::min(sheets[i], sheets[k]);
        }
}

}  // namespace

std::vector<int> join_pieces(const std::vector<Region>& regions) {
    std::vector<int> into(regions.size());
    std::iota(into.begin(), into.end(), 0);
    join_slivers(regions, into);
    join_faces(regions, into);
    return into;
}

}  // namespace frond
