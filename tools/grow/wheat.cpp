// Wheat (Triticum aestivum). In: settings and a seed. Out: a tuft of a few culms with blades and bearded ears, light
// enough for a field of them.
#include "organs.hpp"

namespace frond::grow {
namespace {

constexpr int CULMS = 5, CULM_RINGS = 7, CULM_BLADES = 3, BLADE_ROWS = 6, AWNS = 12;

const Rgb GREEN{0.42, 0.54, 0.22}, BLADE_GREEN{0.33, 0.48, 0.17}, STRAW{0.80, 0.68, 0.36}, EAR{0.83, 0.70, 0.38};
const Rgb EARTH{0.45, 0.34, 0.20};

struct Wheat {
    GrownPlant plant;
    Random random{0};
    double height, ripe, spread;
    int stem, blade, ear;  // material indices
};

// A culm, which leans out of the tuft and nods under its ear.
struct Culm {
    Vec foot, out;
    double height, lean, nod;
    Vec at(double s) const {
        return foot + (height * (lean * s * s + nod * std::pow(s, 5))) * out +
               Vec{0, height * (s - 0.35 * nod * std::pow(s, 6)), 0};
    }
    Vec along(double s) const { return unit(at(s + 0.005) - at(s - 0.005)); }
};

void add_culm(Wheat& wheat, const Culm& culm) {
    Tube tube;
    tube.sides = 4;
    for (int r = 0; r < CULM_RINGS; r++) {
        const double s = 0.90 * r / (CULM_RINGS - 1.0);
        tube.rings.push_back({culm.at(s), mix(0.0026, 0.0015, s), mix(GREEN, STRAW, clamp01(wheat.ripe * (0.6 + s)))});
    }
    add_tube(wheat.plant, tube);
}

void add_blade(Wheat& wheat, const Culm& culm, double s, double azimuth) {
    const Vec out = heading(azimuth), beside = cross({0, 1, 0}, out), foot = culm.at(s);
    const double length = wheat.random.range(0.20, 0.30) * wheat.height, half = 0.0065;
    const double rise = wheat.random.range(0.55, 0.95), fall = wheat.random.range(0.8, 1.35);
    Sheet sheet;
    sheet.rows = BLADE_ROWS, sheet.columns = 3;
    sheet.place = [&](int row, int column) {
        const double t = static_cast<double>(row) / BLADE_ROWS, side = column - 1;
        const Vec middle =
            foot + (length * t * (0.55 + 0.35 * t)) * out + Vec{0, length * (rise * t - fall * t * t), 0};
        const double width = half * (row == BLADE_ROWS ? 0 : std::sqrt(1.02 - t));
        return middle + (width * side) * beside + Vec{0, 0.5 * width * std::fabs(side), 0};
    };
    sheet.tint = [&](int row, int column) {
        const double t = static_cast<double>(row) / BLADE_ROWS;
        return mix(scaled(BLADE_GREEN, column == 1 ? 1.15 : 1.0), STRAW, clamp01(wheat.ripe * (0.4 + t)));
    };
    add_sheet(wheat.plant, sheet);
}

void add_ear(Wheat& wheat, const Culm& culm) {
    // Spikelets stand in two rows: the spindle is flat and its sides are notched.
    const int rings = 9;
    const Rgb color = mix(GREEN, EAR, clamp01(0.4 + wheat.ripe));
    Tube tube;
    tube.sides = 6;
    tube.close_start = true;
    for (int r = 0; r < rings; r++) {
        const double t = (r + 0.5) / rings, s = 0.885 + 0.115 * t;
        const double body = std::sqrt(std::sin(PI * mix(0.12, 0.93, t)));
        tube.rings.push_back({culm.at(s), 0.0078 * body, scaled(color, r % 2 ? 0.82 : 1.06)});
    }
    tube.bulge = [](int r, int s) { return (r + s) % 2 ? 0.78 : 1.12; };
    tube.tint = [&](int r, int s) { return scaled(tube.rings[r].color, (r + s) % 2 ? 0.85 : 1.1); };
    tube.end_reach = 0.006;
    add_tube(wheat.plant, tube);

    // Awns fan out to both sides.
    for (int k = 0; k < AWNS; k++) {
        const double s = 0.90 + 0.095 * k / AWNS;
        const Vec along = culm.along(s), foot = culm.at(s);
        const Vec aside = unit(turned(cross(along, {0.3, 0.1, 0.95}), along, k * PI + wheat.random.spread(0.7)));
        const Vec across = cross(along, aside);
        const Vec tip = foot + wheat.random.range(0.065, 0.09) * unit(along + 0.33 * aside);
        const int a = add_vertex(wheat.plant, foot + 0.0009 * across, color);
        const int b = add_vertex(wheat.plant, foot - 0.0009 * across + 0.0002 * along, color);
        add_triangle(wheat.plant, a, b, add_vertex(wheat.plant, tip, mix(color, STRAW, 0.6)));
    }
}

}  // namespace

GrownPlant grow_wheat(const GrownSettings& value, uint64_t seed) {
    Wheat wheat;
    wheat.random = Random(seed);
    wheat.height = value.at("height"), wheat.ripe = value.at("ripe"), wheat.spread = value.at("spread");
    wheat.stem = add_material(wheat.plant, "wheat_stem", GREEN);
    wheat.blade = add_material(wheat.plant, "wheat_blade", BLADE_GREEN);
    wheat.ear = add_material(wheat.plant, "ear", EAR);

    // The crown, from which all culms rise.
    begin_organ(wheat.plant, "stem", wheat.stem);
    Tube crown;
    crown.sides = 8, crown.close_start = true;
    crown.rings = {{{0, -0.012, 0}, 0.010, EARTH}, {{0, 0.008, 0}, 0.013, mix(EARTH, GREEN, 0.5)}};
    crown.end_reach = 0.004, crown.start_reach = 0.006;
    add_tube(wheat.plant, crown);
    for (int k = 0; k < CULMS; k++) {
        const std::string number = "_" + std::to_string(k + 1);
        const double azimuth = TURN * (k + wheat.random.spread(0.25)) / CULMS;
        Culm culm;
        culm.out = heading(azimuth);
        culm.foot = 0.010 * culm.out;
        culm.height = wheat.height * wheat.random.range(0.88, 1.0);
        culm.lean = wheat.spread * wheat.random.range(0.08, 0.20),
        culm.nod = wheat.ripe * wheat.random.range(0.02, 0.10);
        begin_organ(wheat.plant, "stem" + number, wheat.stem);
        add_culm(wheat, culm);
        begin_organ(wheat.plant, "leaf" + number, wheat.blade);
        for (int i = 0; i < CULM_BLADES; i++)
            add_blade(wheat, culm, 0.19 + 0.20 * i, azimuth + (i % 2 ? 1.4 : -0.9) + wheat.random.spread(0.4));
        begin_organ(wheat.plant, "ear" + number, wheat.ear);
        add_ear(wheat, culm);
    }
    return wheat.plant;
}

}  // namespace frond::grow
