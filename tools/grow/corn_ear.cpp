// Corn, the ear. In: the axil in which it stands. Out: a spindle in its husk, loose husk tips and silk.
#include "corn.hpp"

namespace frond::grow {
namespace {

const Rgb HUSK_TIP{0.64, 0.70, 0.36}, SILK_FRESH{0.80, 0.66, 0.36};

// The axis of the ear, which leans away from the culm.
struct Line {
    Vec start, out;
    double length;
    Vec at(double s) const {
        const double lean = mix(0.66, 0.34, s);
        return start + (length * s) * (std::sin(lean) * out + Vec{0, std::cos(lean), 0});
    }
};

void add_spindle(Corn& corn, const Line& line, double size, double roll) {
    struct Profile {
        double s, radius;
        Rgb color;
    };
    const Profile profile[] = {{0.0, 0.0080, SHEATH_GREEN}, {0.15, 0.0195, HUSK},     {0.36, 0.0300, HUSK},
                               {0.60, 0.0290, HUSK},        {0.82, 0.0195, HUSK_TIP}, {0.97, 0.0085, HUSK_TIP}};
    Tube tube;
    tube.sides = 6;
    for (const Profile& ring : profile) tube.rings.push_back({line.at(ring.s), ring.radius * size, ring.color});
    tube.tint = [&](int r, int s) { return scaled(profile[r].color, s % 2 ? 0.90 : 1.06); };
    tube.end_reach = 0.010 * size;
    tube.roll = roll;
    add_tube(corn.plant, tube);
}

// Adds the loose end of a husk leaf, which begins under the skin of the ear.
void add_husk_tip(Corn& corn, const Line& line, double size, double angle) {
    const Vec away = heading(angle), beside = cross({0, 1, 0}, away);
    Sheet sheet;
    sheet.rows = 3, sheet.columns = 3;
    sheet.place = [&](int row, int column) {
        const double s = row / 3.0, side = column - 1;
        const double half = 0.017 * size * (1 - 0.25 * s - 0.2 * s * s);
        const Vec middle = line.at(0.50 + 0.16 * row) + (size * (0.026 - 0.004 * row + 0.0120 * s * s)) * away;
        if (row == 3) return middle + size * Vec{0, 0.03, 0} + (0.016 * size) * away;
        return middle + (side * half) * beside - (std::fabs(side) * 0.4 * half) * away;
    };
    sheet.tint = [&](int row, int) { return mix(HUSK, row == 3 ? STRAW : HUSK_TIP, row / 3.0); };
    add_sheet(corn.plant, sheet);
}

// Adds a flat strand of silk that hangs over from the tip.
void add_silk(Corn& corn, Vec tip, double size, double angle) {
    const Vec away = heading(angle), beside = cross({0, 1, 0}, away);
    const double reach = size * corn.random.range(0.030, 0.050), fall = size * corn.random.range(0.03, 0.085);
    Sheet sheet;
    sheet.rows = 3, sheet.columns = 2;
    sheet.place = [&](int row, int column) {
        const double s = row / 3.0;
        const Vec middle = tip + (reach * std::pow(s, 0.8) + 0.001) * away +
                           Vec{0, size * 0.10 * s - (fall + 0.10 * size) * s * s * s, 0};
        return row == 3 ? middle : middle + (size * (column - 0.5) * mix(0.007, 0.012, s)) * beside;
    };
    sheet.tint = [&](int row, int) { return mix(SILK_FRESH, SILK_DRY, row / 3.0); };
    add_sheet(corn.plant, sheet);
}

}  // namespace

void grow_ear(Corn& corn, const Ear& ear) {
    const Phytomer& p = PHYTOMERS[ear.phytomer];
    const double azimuth = corn.azimuths[ear.phytomer] + ear.turn, foot = p.node + 0.055;
    Line line;
    line.out = heading(azimuth);
    line.start = corn.axis(foot) + (0.3 * corn.culm_radius(foot)) * line.out;
    line.length = 0.27 * ear.size;

    begin_organ(corn.plant, "ear_" + std::to_string(ear.number), corn.ear);
    add_spindle(corn, line, ear.size, azimuth);
    for (int k = 0; k < ear.husk_tips; k++)
        add_husk_tip(corn, line, ear.size, azimuth + 0.7 + TURN * k / ear.husk_tips);
    begin_organ(corn.plant, "silk_" + std::to_string(ear.number), corn.silk);
    for (int k = 0; k < ear.strands; k++)
        add_silk(corn, line.at(0.94), ear.size, azimuth + TURN * (k + corn.random.spread(0.25)) / ear.strands);
}

}  // namespace frond::grow
