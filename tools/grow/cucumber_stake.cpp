// Cucumber, the stake. In: the axis of the stem. Out: a bamboo stake beside it and twine that ties the two together.
// Twine shares one corner of the skin of each, so that all three are one connected component of the mesh.
#include "cucumber.hpp"

namespace frond::grow {
namespace {

const Rgb BAMBOO{0.79, 0.68, 0.42}, BAMBOO_NODE{0.58, 0.47, 0.27}, TWINE{0.80, 0.72, 0.55};
constexpr double DEPTH = 0.02;           // depth in the ground [m]
constexpr double INTERNODE = 0.24;       // length of a bamboo internode [m]
constexpr double TWINE_RADIUS = 0.0013;  // [m]
constexpr int STAKE_SIDES = 10, TWINE_SIDES = 4, TWINE_RINGS = 14;

// Returns the vertex of a tube's ring that lies farthest in a direction.
int outermost(const GrownPlant& plant, const TubeMesh& mesh, int ring, Vec direction) {
    int best = mesh.at(ring, 0);
    for (int s = 1; s < mesh.sides; s++)
        if (dot(position_of(plant, mesh.at(ring, s)), direction) > dot(position_of(plant, best), direction))
            best = mesh.at(ring, s);
    return best;
}

// Moves the nearest of the twine's vertices to a corner of another mesh.
void hold(GrownPlant& plant, const TubeMesh& twine, int corner) {
    const Vec place = position_of(plant, corner);
    int nearest = twine.first;
    for (int v = twine.first; v < twine.first + twine.rings * twine.sides; v++)
        if (length(position_of(plant, v) - place) < length(position_of(plant, nearest) - place)) nearest = v;
    plant.positions[size_t(nearest)] = {place.x, place.y, place.z};
}

// Adds a ring of twine around both, as tight as a belt around two wheels.
void add_tie(GrownPlant& plant, const TubeMesh& stem, int stem_ring, double stem_radius, const TubeMesh& stake,
             int stake_ring, double stake_radius) {
    const Vec a = stem.centers[size_t(stem_ring)], b = stake.centers[size_t(stake_ring)];
    const Vec apart = a - b, along = unit({apart.x, 0, apart.z}), beside = cross({0, 1, 0}, along);
    Tube tube;
    tube.sides = TWINE_SIDES;
    tube.close_end = false;
    for (int r = 0; r < TWINE_RINGS; r++) {
        // The ends overlap a little, one above the other, as in a knot.
        const double t = r / (TWINE_RINGS - 1.0), angle = 1.06 * TURN * (t - 0.5);
        const Vec out = std::cos(angle) * along + std::sin(angle) * beside;
        const bool at_stem = std::cos(angle) > 0;
        const Vec center = (at_stem ? a : b) + (at_stem ? stem_radius : stake_radius) * out;
        tube.rings.push_back({center + Vec{0, 0.004 * (t - 0.5), 0}, TWINE_RADIUS, scaled(TWINE, r % 2 ? 0.9 : 1.05)});
    }
    const TubeMesh twine = add_tube(plant, tube);
    hold(plant, twine, outermost(plant, stem, stem_ring, along));
    hold(plant, twine, outermost(plant, stake, stake_ring, -1 * along));
}

}  // namespace

double cucumber_stake_radius(double y) {
    return mix(0.0080, 0.0068, clamp01(y / 2.1));
}

void add_cucumber_stake(GrownPlant& plant, const CucumberStake& stake, const TubeMesh& stem,
                        const std::function<double(double)>& stem_radius) {
    // Rings where the twine is attached, and three about each node of the bamboo.
    std::vector<double> heights = {-DEPTH, stake.top};
    std::vector<int> stem_rings;
    for (double y : stake.ties) {
        int ring = 0;
        for (int r = 1; r < stem.rings; r++)
            if (std::fabs(stem.centers[size_t(r)].y - y) < std::fabs(stem.centers[size_t(ring)].y - y)) ring = r;
        stem_rings.push_back(ring);
        heights.push_back(stem.centers[size_t(ring)].y);
    }
    for (double y = 0.10; y < stake.top - 0.02; y += INTERNODE)
        for (double offset : {-0.006, 0.0, 0.006}) heights.push_back(y + offset);
    std::sort(heights.begin(), heights.end());

    const auto nodeness = [](double y) {
        const double miss = std::remainder(y - 0.10, INTERNODE) / 0.004;
        return std::exp(-miss * miss);
    };
    Tube tube;
    tube.sides = STAKE_SIDES;
    for (double y : heights) {
        const Rgb tone = scaled(mix(BAMBOO, BAMBOO_NODE, nodeness(y)), 1 - 0.25 * smooth_step(0.1, -DEPTH, y));
        tube.rings.push_back(
            {{stake.foot.x, y, stake.foot.z}, cucumber_stake_radius(y) * (1 + 0.14 * nodeness(y)), tone});
    }
    tube.tint = [&](int r, int s) {
        return scaled(tube.rings[size_t(r)].color, 1 + 0.05 * std::sin(2.4 * s + 0.7 * r));
    };
    begin_organ(plant, "stake", stake.material);
    const TubeMesh mesh = add_tube(plant, tube);

    for (size_t k = 0; k < stem_rings.size(); k++) {
        const double y = stem.centers[size_t(stem_rings[k])].y;
        const int ring = int(std::find(heights.begin(), heights.end(), y) - heights.begin());
        begin_organ(plant, "tie_" + std::to_string(k + 1), stake.tie_material);
        add_tie(plant, stem, stem_rings[k], stem_radius(y), mesh, ring, cucumber_stake_radius(y));
    }
}

}  // namespace frond::grow
