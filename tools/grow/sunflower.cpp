// Sunflower (Helianthus annuus). In: settings and a seed. Out: a tall stem with heart-shaped leaves and one nodding
// head.
#include "organs.hpp"

namespace frond::grow {
namespace {

constexpr int LEAVES = 12, RAYS = 21, RIM = 21;

const Rgb SUNFLOWER_STEM{0.45, 0.58, 0.26}, SUNFLOWER_BLADE{0.25, 0.44, 0.15}, VEIN_PALE{0.50, 0.64, 0.30},
    BRACT{0.36, 0.52, 0.20};
const Rgb RAY{0.98, 0.76, 0.08}, RAY_DEEP{0.90, 0.55, 0.05}, DISK{0.30, 0.17, 0.07}, DISK_RIM{0.62, 0.40, 0.10};

struct Sunflower {
    GrownPlant plant;
    Random random{0};
    double height, leaf_size, head, nod, facing;
    int stem, petiole, blade, bract, ray, disk;  // material indices

    // The stem is upright, and bends under the head over its last eighth.
    Vec axis(double s) const {
        const double bow = std::max(0.0, s - 0.86) / 0.14;
        return Vec{0, height * (s - 0.022 * nod * bow * bow * bow), 0} +
               (0.012 * std::sin(5 * s) + height * 0.045 * nod * bow * bow) * heading(facing);
    }
    double radius(double s) const { return mix(0.016, 0.0085, s); }
};

void grow_stem(Sunflower& f) {
    begin_organ(f.plant, "stem", f.stem);
    Tube tube;
    tube.sides = 8;
    const int rings = 24;
    for (int r = 0; r < rings; r++) {
        const double s = std::pow(r / (rings - 1.0), 0.8);
        tube.rings.push_back({f.axis(s) - Vec{0, r == 0 ? 0.02 : 0.0, 0}, f.radius(s),
                              mix(scaled(SUNFLOWER_STEM, 0.85), SUNFLOWER_STEM, s)});
    }
    tube.close_end = true;
    add_tube(f.plant, tube);
}

void grow_leaf(Sunflower& f, int i) {
    const double s = mix(0.14, 0.84, i / (LEAVES - 1.0)),
                 size = f.leaf_size * mix(0.27, 0.13, s) * f.random.range(0.9, 1.1);
    const Vec out = heading(f.facing + 0.7 + 2.4 * i + f.random.spread(0.2)), up{0, 1, 0}, across = cross(up, out);
    const Vec foot = f.axis(s) + (0.7 * f.radius(s)) * out;
    const double reach = 0.55 * size + 0.02;
    const std::vector<Vec> line =
        curve_through({foot, foot + (0.5 * reach) * (out + 0.85 * up), foot + reach * (out + 0.55 * up)}, 4);
    Tube stalk;
    stalk.sides = 4;
    for (const Vec& p : line) stalk.rings.push_back({p, 0.0036, mix(SUNFLOWER_STEM, VEIN_PALE, 0.5)});
    stalk.end_reach = 0.002;
    begin_organ(f.plant, "petiole_" + std::to_string(i + 1), f.petiole);
    add_tube(f.plant, stalk);

    // Heart-shaped: the side columns begin behind the end of the petiole.
    const int rows = 8;
    const double hang = f.random.range(0.5, 0.9), fold = f.random.range(0.15, 0.4);
    Sheet sheet;
    sheet.rows = rows, sheet.columns = 5;
    sheet.place = [&](int row, int column) {
        const double t = static_cast<double>(row) / rows, side = (column - 2) / 2.0;
        const double half =
            row == rows ? 0
                        : size * 0.43 * std::pow(std::sin(PI * std::min(1.0, 0.11 + 0.89 * std::pow(t, 0.62))), 0.8);
        const double fore = size * (t - 0.20 * std::fabs(side) * (1 - t) * (1 - t) * (1 - t)) - 0.004;
        const double wave = 0.03 * size * std::sin(9 * t + 2 * side + i) * side * side;
        return line.back() + fore * out + (half * side) * across +
               Vec{0, 0.30 * fore - hang * std::max(0.0, fore) * fore / size + fold * std::fabs(side) * half + wave, 0};
    };
    sheet.tint = [&](int row, int column) {
        return mix(SUNFLOWER_BLADE, VEIN_PALE, column == 2 ? mix(0.9, 0.3, row / 8.0) : column % 2 ? 0.0 : 0.18);
    };
    begin_organ(f.plant, "leaf_" + std::to_string(i + 1), f.blade);
    add_sheet(f.plant, sheet);
}

void grow_head(Sunflower& f) {
    const Vec axis = unit((0.35 + 0.9 * f.nod) * heading(f.facing) + Vec{0, 0.9 - 0.75 * f.nod, 0});
    const Vec right = unit(cross({0, 1, 0}, axis)), up = cross(axis, right), center = f.axis(1) + 0.012 * axis;
    auto rim = [&](double angle) { return std::cos(angle) * right + std::sin(angle) * up; };

    // A shallow dish around the end of the stem, closed in front by the disk.
    begin_organ(f.plant, "flower_disk", f.disk);
    Tube dish;
    dish.sides = RIM, dish.close_start = true, dish.start_reach = 0.020;
    const double radius = 0.085 * f.head;
    dish.rings = {{center, 0.45 * radius, BRACT},
                  {center + 0.020 * axis, radius, BRACT},
                  {center + 0.034 * axis, 0.98 * radius, DISK_RIM},
                  {center + 0.040 * axis, 0.78 * radius, DISK_RIM},
                  {center + 0.0415 * axis, 0.62 * radius, DISK},
                  {center + 0.0425 * axis, 0.30 * radius, mix(DISK, VEIN_PALE, 0.25)}};
    dish.end_reach = 0.0003;
    dish.tint = [&](int r, int s) { return scaled(dish.rings[r].color, (r + s) % 2 ? 0.85 : 1.1); };
    add_tube(f.plant, dish);

    // Rays in front, bracts behind; both begin under the rim.
    for (const bool rays : {true, false}) {
        begin_organ(f.plant, rays ? "flower_rays" : "flower_bracts", rays ? f.ray : f.bract);
        for (int k = 0; k < RAYS; k++) {
            const double angle = TURN * (k + (rays ? 0.0 : 0.5) + f.random.spread(0.15)) / RAYS;
            const Vec out = rim(angle), beside = cross(axis, out);
            const double length = f.head * (rays ? f.random.range(0.085, 0.105) : f.random.range(0.035, 0.05));
            const double half = f.head * (rays ? 0.017 : 0.012), lift = rays ? f.random.range(-0.1, 0.35) : -0.45;
            Sheet sheet;
            sheet.rows = 3, sheet.columns = 3;
            sheet.place = [&](int row, int column) {
                const double t = row / 3.0, side = column - 1;
                const double width = row == 3 ? 0 : half * (row == 0 ? 0.6 : row == 1 ? 1.0 : 0.85);
                return center + (rays ? 0.026 : 0.014) * axis + ((rays ? 0.90 : 0.70) * radius + length * t) * out +
                       (length * lift * t * t) * axis + (width * side) * beside - (0.35 * width * side * side) * axis;
            };
            sheet.tint = [&](int row, int) {
                return rays ? mix(RAY_DEEP, RAY, row / 2.0) : scaled(BRACT, 1 - 0.08 * row);
            };
            add_sheet(f.plant, sheet);
        }
    }
}

}  // namespace

GrownPlant grow_sunflower(const GrownSettings& value, uint64_t seed) {
    Sunflower f;
    f.random = Random(seed);
    f.height = value.at("height"), f.leaf_size = value.at("leaf_size"), f.head = value.at("head_size");
    f.nod = value.at("nod"), f.facing = value.at("azimuth") * PI / 180;
    f.stem = add_material(f.plant, "stem", SUNFLOWER_STEM);
    f.petiole = add_material(f.plant, "petiole", SUNFLOWER_STEM);
    f.blade = add_material(f.plant, "blade", SUNFLOWER_BLADE);
    f.bract = add_material(f.plant, "bract", BRACT);
    f.ray = add_material(f.plant, "petal", RAY);
    f.disk = add_material(f.plant, "flower", DISK);
    grow_stem(f);
    for (int i = 0; i < LEAVES; i++) grow_leaf(f, i);
    grow_head(f);
    return f.plant;
}

}  // namespace frond::grow
