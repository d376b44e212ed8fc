// Organ regions. In: slabs, each a sheet or a tube, in a tree that grows from the ground. Out: regions.
// 1. A subtree of one mesh that encloses much for its area, is about as wide as long and hangs on a neck much thinner
//    than itself is a solid: a fruit, a cap, a crown drawn as a ball, with all that is part of the same mesh in it.
// 2. Elsewhere runs of slabs of one form, one part and one mesh are a region. Where a tube forks, the branch that bears
//    most goes on and the others begin. Where a sheet forks near its base, as leaves do that meet in the heart of a
//    rosette, each branch is a leaf of its own; lobes and teeth, which leave a larger sheet, are not.
// 3. Slivers join the region that they grow out of.
// 4. Two sheets in the same place are the two faces of one.
#include "skeleton/organ_regions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/decompose.hpp"
#include "core/elementary.hpp"

namespace frond {

namespace {

constexpr double SOLID_COMPACT = 0.2;  // least 36 pi V^2 / A^3 of a solid: a ball has 1, a cube 0.52
constexpr double SOLID_ROUND = 0.3;    // least width of a solid over its length
constexpr double SOLID_NECK = 0.62;    // largest radius of a solid's neck over that of a ball of its area
constexpr double SOLID_OPEN = 0.12;    // largest hole in a solid beside its neck, as a share of its area
constexpr double ALL_OF_IT = 0.85;     // share of a solid's volume beyond a place farther out at its neck
constexpr double SAME_NECK = 1.15;     // radius of the neck there, over that at the place before
constexpr double OF_BRANCH = 0.25;     // least area of a sheet's branch over that of the largest branch
constexpr double OF_BASE = 0.5;        // largest area of the base of branching sheets over that of a branch
constexpr double SHORT_BRANCH = 1.5;   // in lengths of a slab: shorter branches of tubes are knots
constexpr double SLIVER = 8;           // largest area of a sliver, in squares of the tube's radius that it lies on

// What grows out of a slab, itself included, within its mesh.
struct Subtree {
    double area = 0, flux = 0, far = 0;
    Vec3 normal = Vec3::Zero();
    Vec3 sum = Vec3::Zero();     // as Piece
    Mat3 square = Mat3::Zero();  // as Piece
    double alike = 0;            // area of slabs of its form and part that are connected to it [m^2]
};

struct Finder {
    const Slabs& cut;
    std::vector<Subtree> subtrees = {};
    std::vector<double> volume = {};  // by slab, of the solid that begins with it, else 0 [m^3]
    std::vector<int> region = {};     // by slab
    std::vector<Region> regions = {};
    std::vector<double> base = {};  // by slab, area of its region up to it [m^2]

    const Piece& piece(int i) const { return cut.bands.pieces[size_t(i)]; }
    const Slab& slab(int i) const { return cut.slabs[size_t(i)]; }
    const SlabLink& link(int i) const { return cut.tree.links[size_t(cut.tree.shoots[size_t(i)].link)]; }
    bool same_mesh(int i) const {
        const int parent = slab(i).parent;
        return parent >= 0 && piece(i).component == piece(parent).component;
    }
    bool alike(int i) const {
        const int parent = slab(i).parent;
        return same_mesh(i) && piece(i).group == piece(parent).group && slab(i).is_sheet == slab(parent).is_sheet;
    }
    double foot_radius(int i) const {
        const Piece& foot = piece(i);
        if (!(foot.area > 0)) return 0;
        const Vec3 middle = foot.sum / foot.area;
        const Mat3 spread = foot.square / foot.area - middle * middle.transpose();
        return 1.2 * std::sqrt(std::max(0.0, spread(0, 0) + spread(2, 2)));
    }
    // Returns the radius of a ring as long as the line where a slab grows out of another one of its mesh [m].
    double neck_radius(int i) const { return same_mesh(i) ? std::max(0.0, link(i).length) / (2 * PI) : 0; }
};

// Where the solids that grow out of a slab begin: their volume and the widest of their necks.
struct Beyond {
    double volume = 0, neck = 0;
};

void sum_subtrees(Finder& finder) {
    finder.subtrees.resize(finder.cut.slabs.size());
    const std::vector<int>& order = finder.cut.tree.order;
    for (auto at = order.rbegin(); at != order.rend(); ++at) {
        Subtree& own = finder.subtrees[size_t(*at)];
        const Slab& slab = finder.slab(*at);
        own.area += finder.piece(*at).area;
        own.alike += finder.piece(*at).area;
        own.flux += slab.flux;
        own.normal += slab.normal;
        own.sum += finder.piece(*at).sum;
        own.square += finder.piece(*at).square;
        own.far = std::max(own.far, finder.piece(*at).far);
        if (!finder.same_mesh(*at)) continue;
        Subtree& parent = finder.subtrees[size_t(slab.parent)];
        parent.area += own.area;
        parent.flux += own.flux;
        parent.normal += own.normal;
        parent.sum += own.sum;
        parent.square += own.square;
        parent.far = std::max(parent.far, own.far);
        if (finder.alike(*at)) parent.alike += own.alike;
    }
}

// Returns the volume of the solid that begins with a slab, or 0 if what begins there is none [m^3].
double solid_volume(const Finder& finder, int i) {
    const Subtree& tree = finder.subtrees[size_t(i)];
    if (!(tree.area > 0)) return 0;
    const Vec3 centre = tree.sum / tree.area;
    const Vec3 spread = symmetric_values(Mat3(tree.square / tree.area - centre * centre.transpose()));
    if (!(spread[0] > squared(SOLID_ROUND) * spread[2])) return 0;
    const bool on_neck = finder.same_mesh(i);
    const double neck = finder.neck_radius(i);
    // A ball's spread along each axis is a third of its radius squared; the stub of a tube is no wider than its neck.
    const double widest = std::min(std::sqrt(3 * spread[1]), std::sqrt(tree.area / (4 * PI)));
    // What stands on the ground by itself stands broadly.
    if (finder.slab(i).parent < 0 ? finder.foot_radius(i) < SOLID_NECK * widest : neck > SOLID_NECK * widest) return 0;
    const Vec3 from = on_neck ? finder.link(i).middle : Vec3(centre + finder.cut.bands.origin);
    const double volume = std::abs(tree.flux - from.dot(tree.normal)) / 3, area = tree.area + PI * neck * neck;
    // The normals of a closed surface add up to nothing but its neck.
    if (tree.normal.norm() > SOLID_OPEN * tree.area + 1.3 * PI * neck * neck) return 0;
    return 36 * PI * squared(volume) > SOLID_COMPACT * frond::pow(area, 3) ? volume : 0;
}

// Finds the slabs with which solids may begin, and their volumes. A solid begins as far out as it can without losing
// much of its volume, where its neck is no wider: on top of its stem, and each of several on its own branch.
std::vector<double> find_solids(const Finder& finder) {
    std::vector<double> volumes(finder.cut.slabs.size(), 0.0);
    std::vector<Beyond> beyond(volumes.size());
    const std::vector<int>& order = finder.cut.tree.order;
    for (auto at = order.rbegin(); at != order.rend(); ++at) {
        const int i = *at;
        const double neck = finder.slab(i).parent < 0 ? finder.foot_radius(i) : finder.neck_radius(i);
        const double volume = solid_volume(finder, i);
        Beyond best = beyond[size_t(i)];
        if (volume > 0 && !(best.volume >= ALL_OF_IT * volume && best.neck <= SAME_NECK * neck)) {
            volumes[size_t(i)] = volume;
            best = {volume, neck};
        }
        if (!finder.same_mesh(i)) continue;
        Beyond& parent = beyond[size_t(finder.slab(i).parent)];
        parent.volume += best.volume;
        if (best.volume > 0) parent.neck = std::max(parent.neck, best.neck);
    }
    return volumes;
}

// Finds the branch of each slab that bears most; -1 where nothing of its form and mesh grows out of it.
std::vector<int> find_leaders(const Finder& finder) {
    std::vector<int> leaders(finder.cut.slabs.size(), -1);
    const auto bears = [&](int one) {
        const Subtree& tree = finder.subtrees[size_t(one)];
        return finder.slab(one).is_sheet ? tree.alike : tree.area;
    };
    for (int i : finder.cut.tree.order) {
        if (!finder.alike(i)) continue;
        int& leader = leaders[size_t(finder.slab(i).parent)];
        if (leader < 0 || bears(i) > bears(leader)) leader = i;
    }
    return leaders;
}

// Returns whether a branch is a region of its own, beside the one that bears most: no lobe and no knot.
bool is_own_branch(const Finder& finder, int i, int leader) {
    if (i == leader) return false;
    const Subtree& own = finder.subtrees[size_t(i)];
    if (!finder.slab(i).is_sheet)
        return own.far - finder.piece(i).near > SHORT_BRANCH * (finder.piece(i).far - finder.piece(i).near);
    return own.alike > OF_BRANCH * finder.subtrees[size_t(leader)].alike &&
           finder.base[size_t(finder.slab(i).parent)] < OF_BASE * own.alike;
}

int begin_region(Finder& finder, int i, Form form) {
    Region region;
    region.form = form;
    region.component = finder.piece(i).component;
    region.part = finder.piece(i).group - SUPPORT_GROUP - 1;
    region.same_mesh = finder.same_mesh(i);
    const int parent = finder.slab(i).parent;
    region.parent = parent >= 0 ? finder.region[size_t(parent)] : -1;
    region.begin = parent >= 0 ? finder.link(i).middle : finder.cut.tree.foot[size_t(i)];
    region.neck = finder.neck_radius(i);
    region.volume = finder.volume[size_t(i)];
    finder.regions.push_back(region);
    return int(finder.regions.size()) - 1;
}

void add_slab(Finder& finder, int i, int number) {
    Region& region = finder.regions[size_t(number)];
    const Slab& slab = finder.slab(i);
    const double area = finder.piece(i).area;
    finder.region[size_t(i)] = number;
    if (region.length == 0) region.begin_radius = slab.radius(area);
    region.end_radius = slab.radius(area);
    region.area += area;
    region.normal += slab.normal;
    region.box.extend(slab.box);
    region.middle += finder.piece(i).sum + area * finder.cut.bands.origin;
    region.sum += finder.piece(i).sum;
    region.square += finder.piece(i).square;
    const int parent = slab.parent;
    const bool goes_on = parent >= 0 && finder.region[size_t(parent)] == number;
    finder.base[size_t(i)] = area + (goes_on ? finder.base[size_t(parent)] : 0);
    region.length += slab.length;
}

void grow_regions(Finder& finder) {
    const size_t count = finder.cut.slabs.size();
    finder.volume = find_solids(finder);
    finder.region.assign(count, -1);
    finder.base.assign(count, 0);
    const std::vector<int> leaders = find_leaders(finder);
    std::vector<char> solid(count, 0);
    for (int i : finder.cut.tree.order) {
        const int parent = finder.slab(i).parent;
        const bool same_part = parent >= 0 && finder.piece(i).group == finder.piece(parent).group;
        // Twigs that go on within a crown are of another part than it.
        const bool in_solid = finder.same_mesh(i) && same_part && solid[size_t(parent)];
        solid[size_t(i)] = in_solid || finder.volume[size_t(i)] > 0;
        int number = -1;
        if (in_solid)
            number = finder.region[size_t(parent)];
        else if (!solid[size_t(i)] && finder.alike(i) && !is_own_branch(finder, i, leaders[size_t(parent)]))
            number = finder.region[size_t(parent)];
        const Form form = solid[size_t(i)] ? Form::SOLID : finder.slab(i).is_sheet ? Form::SHEET : Form::TUBE;
        if (number < 0) number = begin_region(finder, i, form);
        add_slab(finder, i, number);
    }
    for (Region& region : finder.regions)
        if (region.area > 0) region.middle /= region.area;
}

// Adds one region to another.
void take_in(Region& into, const Region& from) {
    const double area = into.area + from.area;
    if (area > 0) into.middle = (into.area * into.middle + from.area * from.middle) / area;
    into.area = area;
    into.normal += from.normal;
    into.sum += from.sum;
    into.square += from.square;
    into.box.extend(from.box);
}

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

double Region::flatness() const {
    if (!(area > 0)) return 1;
    const Vec3 centre = sum / area;
    const Vec3 spread = symmetric_values(Mat3(square / area - centre * centre.transpose()));
    return spread[0] > 0 ? std::sqrt(spread[1] / spread[0]) : 100;
}

Regions find_regions(const Surface& surface, const Topology& topology) {
    const Slabs cut = cut_slabs(surface, topology);
    Finder finder{cut};
    sum_subtrees(finder);
    grow_regions(finder);

    std::vector<Region>& regions = finder.regions;
    std::vector<int> into(regions.size());
    std::iota(into.begin(), into.end(), 0);
    join_slivers(regions, into);
    join_faces(regions, into);
    const auto last = [&](int r) {
        while (into[size_t(r)] != r) r = into[size_t(r)];
        return r;
    };
    Regions out;
    std::vector<int> number(regions.size(), -1);
    for (size_t r = 0; r < regions.size(); r++) {
        if (last(int(r)) != int(r)) continue;
        number[r] = int(out.regions.size());
        out.regions.push_back(regions[r]);
    }
    for (size_t r = 0; r < regions.size(); r++) {
        const int own = last(int(r));
        if (own != int(r)) take_in(out.regions[size_t(number[size_t(own)])], regions[r]);
        number[r] = number[size_t(own)];
    }
    for (size_t r = 0; r < out.regions.size(); r++) {
        Region& region = out.regions[r];
        if (region.parent >= 0) region.parent = number[size_t(region.parent)];
        if (region.parent == int(r)) region.parent = -1;
        if (region.parent < 0) continue;
        Region& parent = out.regions[size_t(region.parent)];
        (region.form == Form::TUBE ? parent.tubes : region.form == Form::SHEET ? parent.sheets : parent.solids)++;
    }
    out.region_of.resize(topology.triangles.size());
    for (size_t t = 0; t < out.region_of.size(); t++)
        out.region_of[t] = number[size_t(finder.region[size_t(cut.slab_of[t])])];
    return out;
}

}  // namespace frond
