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

#include "core/decompose.hpp"
#include "core/elementary.hpp"

namespace frond {

namespace {

constexpr double SOLID_FULL = 0.35;   // least volume over that of an ellipsoid that is as spread out: a ball has 1
constexpr double SOLID_ROUND = 0.3;   // least width of a solid over its length
constexpr double SOLID_NECK = 0.62;   // largest radius of a solid's neck over that of a ball of its area
constexpr double SOLID_OPEN = 0.12;   // largest hole in a solid beside its neck, as a share of its area
constexpr double ALL_OF_IT = 0.85;    // share of a solid's volume beyond a place farther out at its neck
constexpr double SAME_NECK = 1.15;    // radius of the neck there, over that at the place before
constexpr double OF_BRANCH = 0.25;    // least area of a sheet's branch over that of the largest branch
constexpr double OF_BASE = 0.5;       // largest area of the base of branching sheets over that of a branch
constexpr double SHORT_BRANCH = 1.5;  // in lengths of a slab: shorter branches of tubes are knots

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
    const double volume = std::abs(tree.flux - from.dot(tree.normal)) / 3;
    // The normals of a closed surface add up to nothing but its neck.
    if (tree.normal.norm() > SOLID_OPEN * tree.area + 1.3 * PI * neck * neck) return 0;
    const double outline = 4.0 / 3 * PI * std::sqrt(27 * std::max(0.0, spread.prod()));
    return volume > SOLID_FULL * outline ? volume : 0;
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
        const bool goes_on =
            in_solid || (!solid[size_t(i)] && finder.alike(i) && !is_own_branch(finder, i, leaders[size_t(parent)]));
        int number = goes_on ? finder.region[size_t(parent)] : -1;
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
    const std::vector<int> into = join_pieces(regions);
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
        // It grows where the first of those that joined it does.
        Region& region = out.regions.back();
        for (int below = region.parent; below >= 0 && last(below) == int(r); below = regions[size_t(below)].parent) {
            const Region& first = regions[size_t(below)];
            region.parent = first.parent;
            region.same_mesh = first.same_mesh;
            region.begin = first.begin;
        }
    }
    for (size_t r = 0; r < regions.size(); r++) {
        const int own = last(int(r));
        if (own != int(r)) take_in(out.regions[size_t(number[size_t(own)])], regions[r]);
        number[r] = number[size_t(own)];
    }
    for (size_t r = 0; r < out.regions.size(); r++) {
        Region& region = out.regions[r];
        if (region.parent >= 0) region.parent = number[size_t(region.parent)];
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
