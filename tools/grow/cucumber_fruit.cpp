// Cucumber, fruit and flower. In: position and size. Out: a ribbed and warty body, or five yellow petals.
#include "cucumber.hpp"

namespace frond::grow {

TubeMesh add_cucumber_fruit(GrownPlant& plant, const CucumberFruit& fruit, Random random) {
    const Rgb dark = mix(Rgb{0.30, 0.52, 0.16}, Rgb{0.15, 0.37, 0.12}, fruit.ripe);
    const Rgb neck = mix(dark, Rgb{0.10, 0.28, 0.09}, 0.6), pale{0.62, 0.72, 0.38};
    const double curve = random.range(0.10, 0.22), heading_of_curve = random.range(0, TURN);
    const Vec away = unit(cross(fruit.down, heading(heading_of_curve)));

    Tube tube;
    tube.sides = fruit.sides;
    tube.close_start = true;
    std::vector<double> station;
    for (int r = 0; r < fruit.rings; r++) {
        // Rings stand closer at both ends, where the body is round.
        const double s = 0.5 - 0.5 * std::cos(PI * (r + 0.6) / (fruit.rings + 0.2));
        const double neck_shape = mix(0.52, 1.0, smooth_step(0.0, 0.26, s));
        const double ends = std::pow(std::max(0.0, 1 - std::pow(std::fabs(2 * s - 1), 7)), 0.5);
        const double belly = (1 + 0.05 * std::sin(PI * s)) * mix(1.0, 0.80, smooth_step(0.72, 1.0, s));
        const Vec center = fruit.top + (fruit.length * s) * fruit.down + (fruit.length * curve * s * (1 - s)) * away;
        tube.rings.push_back({center, fruit.radius * neck_shape * ends * belly, dark});
        station.push_back(s);
    }
    tube.start_reach = 0.0;
    tube.end_reach = 0.0;

    // Ten shallow ribs, and warts scattered over the skin.
    std::vector<double> warts(fruit.rings * fruit.sides);
    for (double& wart : warts) wart = random.unit();
    auto wart = [&](int r, int s) {
        const double inside = smooth_step(0.05, 0.15, station[r]) * smooth_step(1.0, 0.9, station[r]);
        return warts[r * fruit.sides + s] > 0.86 ? inside : 0.0;
    };
    tube.bulge = [&](int r, int s) {
        const double rib = 0.022 * std::cos(TURN * 10 * s / fruit.sides);
        return 1 + rib * smooth_step(0.02, 0.2, station[r]) + 0.085 * wart(r, s) / (0.6 + 0.4 * fruit.ripe);
    };
    tube.tint = [&](int r, int s) {
        const double u = station[r];
        Rgb color = mix(neck, dark, smooth_step(0.05, 0.45, u));
        // Pale streaks run up from the blossom end between the ribs.
        const double streak = std::fabs(std::cos(TURN * 5 * s / fruit.sides));
        color = mix(color, pale, 0.75 * smooth_step(0.45, 1.05, u) * (0.35 + 0.65 * streak * streak));
        return mix(color, Rgb{0.55, 0.62, 0.33}, 0.45 * wart(r, s));
    };
    return add_tube(plant, tube);
}

void add_cucumber_flower(GrownPlant& plant, Vec center, Vec axis, double size, Random random) {
    axis = unit(axis);
    const Vec right = unit(std::fabs(axis.y) < 0.9 ? cross(axis, {0, 1, 0}) : cross(axis, {1, 0, 0}));
    const double roll = random.range(0, TURN);
    const Rgb throat{0.86, 0.62, 0.10}, yellow{0.98, 0.84, 0.16};
    for (int k = 0; k < 5; k++) {
        const Vec out = turned(right, axis, roll + TURN * k / 5), beside = cross(axis, out);
        Sheet petal;
        petal.rows = 6, petal.columns = 5;
        petal.place = [&](int row, int column) {
            const double s = row / 6.0, side = (column - 2) / 2.0;
            const double half =
                row == 6 ? 0 : 0.36 * size * std::sin(PI * std::min(1.0, 0.10 + 0.62 * s)) * (1 - 0.25 * s * s);
            // A bell at the throat that opens flat; petals cup and their margins wave.
            const double rise =
                0.26 * std::sqrt(s) - 0.14 * s * s + 0.10 * side * side * s * (1 + 0.6 * std::sin(9 * s + k));
            return center + (size * (0.06 + 0.94 * s)) * out + (size * rise) * axis + (side * half) * beside;
        };
        petal.tint = [&](int row, int column) {
            return mix(throat, scaled(yellow, column == 2 ? 0.93 : 1.0), clamp01(row / 3.0));
        };
        add_sheet(plant, petal);
    }
}

}  // namespace frond::grow
