// Corn, the blade. In: a phytomer. Out: a long sheet that arches over, folded along its midrib and wavy at its margins.
#include "corn.hpp"

namespace frond::grow {
namespace {

const Rgb BLADE_TIRED{0.72, 0.66, 0.30};
constexpr int STEPS = 120;

// Points and directions along the midrib, in even steps.
struct Midrib {
    std::vector<Vec> place, forward, sideways;
};

// Marches from the collar; the midrib turns downwards ever faster, as a strip that bends under its own weight does.
Midrib march(Vec start, Vec outward, double length, double lean, double bend, double kink, double drift) {
    Midrib midrib;
    midrib.place.push_back(start);
    const Vec across = cross({0, 1, 0}, outward);
    for (int k = 0; k <= STEPS; k++) {
        const double s = static_cast<double>(k) / STEPS;
        const double angle = (lean + bend * std::pow(s, kink) * (1.12 - 0.12 * s)) * PI / 180;
        const Vec flat = unit(outward + (drift * s) * across);
        const Vec along = std::sin(angle) * flat + Vec{0, std::cos(angle), 0};
        midrib.forward.push_back(along);
        midrib.sideways.push_back(unit(cross({0, 1, 0}, flat)));
        midrib.place.push_back(midrib.place.back() + (length / STEPS) * along);
    }
    return midrib;
}

// Returns the share of the length at which a row lies; rows are closer at the collar.
double share_of(const Phytomer& p, int row) {
    return std::pow(static_cast<double>(row) / p.rows, 1.12);
}

// Returns a vertex colour of the lowest blade, which dries from the tip and the margins and has no texture.
Rgb dry_tint(const Phytomer& p, double s, bool middle) {
    const Rgb color = middle ? mix(MIDRIB_PALE, CORN_GREEN, 0.15 + 0.7 * s) : CORN_GREEN;
    const double margin = middle ? 0.0 : 0.25;
    return mix(color, STRAW, clamp01(p.dry * smooth_step(0.0, 0.8, s + margin) + margin * smooth_step(0.85, 1.0, s)));
}

}  // namespace

void grow_blade(Corn& corn, int index) {
    const Phytomer& p = PHYTOMERS[index];
    Random random(corn.random.bits());
    const Vec outward = heading(corn.azimuths[index]), across = cross({0, 1, 0}, outward);
    const double length = p.length * corn.leaf_length * random.range(0.96, 1.04);
    const double width = p.width * corn.leaf_width;
    const double bend = corn.arch * p.bend * random.range(0.86, 1.14);
    const double drift = random.spread(0.35), twist = random.spread(0.8), wave = random.range(2.4, 3.4);
    const double phase = random.range(0, TURN), kink = random.range(1.25, 1.75), tone = random.range(0.84, 1);
    const double start = corn.culm_radius(p.collar);
    const Vec foot = corn.axis(p.collar) + (0.75 * start) * outward;
    const Midrib midrib = march(foot, outward, length, p.lean, bend, kink, drift);

    Sheet sheet;
    sheet.rows = p.rows, sheet.columns = 3;
    sheet.place = [&](int row, int column) {
        const double s = share_of(p, row), side = column - 1;
        const int k = static_cast<int>(std::lround(s * STEPS));
        if (row == p.rows || (row == 0 && column == 1)) return midrib.place[k];
        // The collar embraces the stem.
        if (row == 0)
            return corn.axis(p.collar) + Vec{0, 0.006, 0} + (1.32 * start) * unit((0.35 * outward) + side * across);
        // Narrow at the collar, widest at a third of the length, tapering to the tip.
        const double half =
            0.5 * width * std::min(1.0, 0.62 + 1.5 * s) * std::pow(std::max(0.0, 1 - std::pow(s, 2.6)), 0.75);
        // A gutter at the base, flat further out; margins are longer than the midrib, so they wave.
        const double fold = mix(0.95, 0.20, smooth_step(0, 0.35, s));
        const double ruffle = 0.26 * width * smooth_step(0.05, 0.3, s) * (1 - 0.5 * s) *
                              std::sin(TURN * wave * s + phase + (side > 0 ? 0 : 2.1));
        const Vec aside = turned(midrib.sideways[k], midrib.forward[k], twist * s);
        return midrib.place[k] + (side * half * std::cos(fold)) * aside +
               (std::fabs(side) * (half * std::sin(fold) + ruffle)) * cross(midrib.forward[k], aside);
    };
    // The texture shows one half of the blade; both halves share it.
    sheet.map = [&](int row, int column) {
        return std::array<double, 2>{column == 1 || row == p.rows ? 0.0 : 1.0, share_of(p, row)};
    };
    const bool textured = p.dry < 0.5;
    sheet.tint = [&](int row, int column) {
        const double s = share_of(p, row);
        if (!textured) return dry_tint(p, s, column == 1);
        return mix(scaled(MIDRIB_PALE, tone), BLADE_TIRED, clamp01(p.dry * s + 0.4 * smooth_step(0.85, 1.0, s)));
    };
    begin_organ(corn.plant, "leaf_" + std::to_string(index + 1), textured ? corn.blade : corn.dry_blade);
    add_sheet(corn.plant, sheet);
}

// Draws half a blade from midrib (left) to margin, base at the bottom: a pale midrib that thins out and parallel veins.
GrownImage corn_blade_image() {
    GrownImage image{"corn_blade.png", 96, 128, {}, {}};
    fill_palette(image, CORN_GREEN, MIDRIB_PALE);
    Random random(7);
    std::vector<double> stripes;
    for (int column = 0; column < image.width; column++) stripes.push_back(random.range(0, 0.06));
    for (int row = 0; row < image.height; row++) {
        for (int column = 0; column < image.width; column++) {
            const double along = 1 - (row + 0.5) / image.height, across = (column + 0.5) / image.width;
            const double midrib = 1 - smooth_step(mix(0.07, 0.015, along), mix(0.15, 0.06, along), across);
            const double vein = column % 8 == 7 ? 0.20 : column % 8 == 0 ? 0.08 : 0.0;
            const double pale_base = 0.45 * smooth_step(0.06, 0.0, along) + 0.10 * smooth_step(0.94, 1.0, across);
            const double light = std::max(mix(1.0, 0.6, along) * midrib, vein) + pale_base + stripes[column];
            image.pixels.push_back(static_cast<uint8_t>(std::lround(255 * clamp01(light + random.range(0, 0.03)))));
        }
    }
    return image;
}

}  // namespace frond::grow
