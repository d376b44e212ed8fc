// Corn, the tassel. Out: branches about the top of the culm and a central spike, set with spikelets.
#include "corn.hpp"

namespace frond::grow {
namespace {

const Rgb TASSEL_RED{0.66, 0.42, 0.30};

// Grows a branch of the tassel, set with spikelets; the central spike is one too.
void grow_branch(Corn& corn, Vec foot, Vec direction, double length, double sag, int rings, int spikelets) {
    const Vec side = unit(cross(direction, {0.3, 0.1, 0.9}));
    auto at = [&](double s) { return foot + (length * s) * direction + Vec{0, -sag * length * s * s, 0}; };
    Tube tube;
    tube.sides = 3;
    for (int r = 0; r < rings; r++) {
        const double s = static_cast<double>(r) / rings;
        tube.rings.push_back({at(s), mix(0.0044, 0.0030, s), mix(TASSEL_STEM, TASSEL_GOLD, 0.3 + s)});
    }
    tube.end_reach = length / rings;
    add_tube(corn.plant, tube);

    // Each spikelet is a small folded leaf whose foot is inside the branch.
    for (int k = 0; k < spikelets; k++) {
        const double s = mix(0.16, 0.93, (k + 0.5) / spikelets);
        const Vec along = unit(at(s + 0.02) - at(s - 0.02));
        const Vec out = turned(unit(side - dot(side, along) * along), along, 2.4 * k + corn.random.spread(0.4));
        const Vec beside = cross(along, out);
        const Vec base = at(s);
        const double size = corn.random.range(0.036, 0.046);
        const Rgb color = mix(TASSEL_GOLD, TASSEL_RED, corn.random.unit());
        const int a = add_vertex(corn.plant, base, TASSEL_STEM);
        const Vec middle = base + (0.5 * size) * along + (0.11 * size) * out;
        const int b = add_vertex(corn.plant, middle + (0.17 * size) * beside, color);
        const int c = add_vertex(corn.plant, middle - (0.17 * size) * beside, scaled(color, 0.85));
        const int d = add_vertex(corn.plant, base + size * along + (0.26 * size) * out, color);
        add_triangle(corn.plant, a, b, d);
        add_triangle(corn.plant, a, d, c);
    }
}

}  // namespace

void grow_tassel(Corn& corn, int spikelets_left) {
    begin_organ(corn.plant, "tassel", corn.tassel);
    const int branches = 8;
    for (int k = 0; k < branches; k++) {
        const double y = 1.84 + 0.05 * k / branches;
        const double azimuth = corn.plane + 2.4 * k + corn.random.spread(0.25);
        const double lean = mix(1.05, 0.60, k / (branches - 1.0)) + corn.random.spread(0.10);
        const Vec direction = std::sin(lean) * heading(azimuth) + Vec{0, std::cos(lean), 0};
        const int spikelets = 3 - k % 4 / 3;
        spikelets_left -= spikelets;
        grow_branch(corn, corn.axis(y), direction, corn.random.range(0.20, 0.27), corn.random.range(0.15, 0.42), 2,
                    spikelets);
    }
    const Vec top = corn.axis(1.885);
    grow_branch(corn, top, unit(corn.axis(1.89) - corn.axis(1.80)), 0.33, 0.0, 4, spikelets_left);
}

}  // namespace frond::grow
