// Organ shape. In: a surface and its topology. Out: which lumps are foliage drawn as one solid. A lump is what a
// component has of one material, so that a trunk welded to its crown is none of it. A large round lump that is held up
// stands for leaves; if it encloses a volume it is a crown.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/elementary.hpp"
#include "skeleton/bands.hpp"
#include "skeleton/organ_clues.hpp"

namespace frond {

// Box, area and volume of a lump.
struct Lump {
    Eigen::AlignedBox3d box;
    double area = 0;    // [m^2]
    double volume = 0;  // enclosed by its triangles, computed about a corner of the first one [m^3]
};

// Returns the lump of each triangle, numbered in the order in which they appear.
static std::vector<int> number_lumps(const Surface& surface, const Topology& topology) {
    std::vector<int> lump_of(topology.triangles.size(), -1);
    std::map<std::pair<int, std::string>, int> number;
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
            lump_of[size_t(t)] =
                number
                    .emplace(std::make_pair(topology.triangle_component[size_t(t)], part.material), int(number.size()))
                    .first->second;
    return lump_of;
}

static std::vector<Lump> measure_lumps(const Topology& topology, const std::vector<int>& lump_of) {
    std::vector<Lump> lumps(size_t(1 + *std::max_element(lump_of.begin(), lump_of.end())));
    std::vector<Vec3> origin(lumps.size());
    for (size_t t = 0; t < topology.triangles.size(); t++) {
        const size_t number = size_t(lump_of[t]);
        Lump& lump = lumps[number];
        const Triangle& corners = topology.triangles[t];
        const Vec3 &a = topology.points[size_t(corners[0])], &b = topology.points[size_t(corners[1])],
                   &c = topology.points[size_t(corners[2])];
        if (lump.box.isEmpty()) origin[number] = a;
        lump.box.extend(a).extend(b).extend(c);
        lump.area += 0.5 * (b - a).cross(c - a).norm();
        lump.volume += (topology.turned[t] ? -1 : 1) *
                       (a - origin[number]).dot((b - origin[number]).cross(c - origin[number])) / 6;
    }
    return lumps;
}

// Finds lumps that stand for many leaves: about as wide as high, with nearly as much surface as a ball of that
// size at least, large, and held up by something else unless they may stand on the ground.
static std::vector<char> find_round(const std::vector<Lump>& lumps, bool on_ground, double solid) {
    constexpr double ROUND = 0.35, LARGE = 0.2,
                     HELD_UP = 0.12;  // least size over the largest; size, and height of its foot, over the whole's [-]
    Eigen::AlignedBox3d whole;
    for (const Lump& lump : lumps) whole.extend(lump.box);
    std::vector<char> round(lumps.size(), 0);
    for (size_t i = 0; i < lumps.size(); i++) {
        if (lumps[i].box.isEmpty()) continue;
        const Vec3 size = lumps[i].box.sizes();
        const double surface = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
        const double foot = whole.min().y() + HELD_UP * whole.sizes().y();
        round[i] = size.minCoeff() > ROUND * size.maxCoeff() && lumps[i].area > solid * surface &&
                   size.norm() > LARGE * whole.sizes().norm() && (on_ground || lumps[i].box.min().y() > foot);
    }
    return round;
}

// Finds lumps whose triangles share nearly all their edges.
static std::vector<char> find_skins(const Topology& topology, const std::vector<int>& lump_of, size_t count) {
    constexpr double NEARLY_ALL = 0.8;  // share of a lump's edges [-]
    std::vector<double> shared(count, 0.0), all(shared);
    for (int lump : lump_of) all[size_t(lump)] += 3;
    for (const SharedEdge& edge : find_shared_edges(topology)) {
        shared[size_t(lump_of[size_t(edge.triangle_a)])] += 1;
        shared[size_t(lump_of[size_t(edge.triangle_b)])] += 1;
    }
    std::vector<char> skin(shared.size());
    for (size_t i = 0; i < skin.size(); i++) skin[i] = shared[i] >= NEARLY_ALL * all[i];
    return skin;
}

std::vector<char> find_crowns(const Surface& surface, const Topology& topology, bool on_ground) {
    constexpr double FULL = 0.2;     // least share of its box that a solid fills: a cone fills 0.26, a ball 0.52
    constexpr double COMPACT = 0.2;  // least 36 pi V^2 / A^3: a ball has 1, a cube 0.52; a rosette of thick leaves 0.1
    if (!on_ground && surface.height() < CROWN_HEIGHT) return std::vector<char>(topology.triangles.size(), 0);
    const std::vector<int> lump_of = number_lumps(surface, topology);
    const std::vector<Lump> lumps = measure_lumps(topology, lump_of);
    constexpr double FILLED = 0.35, COVERED = 0.45;  // least area, as a share of that of the box
    std::vector<char> crown = find_round(lumps, on_ground, FILLED);
    // A tier of a fir is a thick skin over little volume.
    const std::vector<char> covered = find_round(lumps, false, COVERED),
                            skin = find_skins(topology, lump_of, lumps.size());
    for (size_t i = 0; i < lumps.size(); i++)
        crown[i] =
            (covered[i] && skin[i]) || (crown[i] && std::abs(lumps[i].volume) > FULL * lumps[i].box.volume() &&
                                        36 * PI * squared(lumps[i].volume) > COMPACT * frond::pow(lumps[i].area, 3));
    std::vector<char> found(topology.triangles.size());
    for (size_t t = 0; t < found.size(); t++) found[t] = crown[size_t(lump_of[t])];
    return found;
}

}  // namespace frond
