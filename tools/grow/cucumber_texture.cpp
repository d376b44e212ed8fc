// Cucumber, the texture of its leaf: palmate veins, their side veins and the net between them, by distance.
#include "cucumber.hpp"

namespace frond::grow {

// Returns 1 on a secondary vein, 0 away from it. Veins leave the main vein of their lobe at about 45 degrees.
double cucumber_side_vein(double along, double off, double sharp) {
    const double offset = along - 0.80 * off - 0.5 * off * off;  // where the vein through this point left the main one
    const double cell = offset / 0.145;
    const double d = std::fabs(cell - std::floor(cell) - 0.5);
    return offset > 0.06 ? smooth_step(sharp, 0.5, d) : 0;
}

namespace {

const Rgb BLADE_DARK{0.22, 0.44, 0.14};

// Returns the lightness of the texture at a point of the half leaf: 0 blade .. 1 vein.
double vein_light(double fore, double aside) {
    const double radius = std::hypot(fore, aside), angle = std::atan2(aside, fore);
    double light = 0, edge = 1e9;
    for (double lobe : {0.0, 57.0, 118.0}) {
        const double to_vein = std::fabs(angle - lobe * PI / 180);
        if (to_vein > PI / 2) continue;
        // A main vein thins out towards its lobe.
        const double off = radius * std::sin(to_vein), along = radius * std::cos(to_vein);
        const double width = mix(0.015, 0.004, std::min(1.0, along));
        light = std::max(light, std::exp(-off * off / (width * width)));
        if (to_vein < edge) {
            edge = to_vein;
            const double thin = 0.44 + 0.02 * std::min(1.0, radius);
            light = std::max(light, 0.62 * cucumber_side_vein(along, off, thin) * smooth_step(0.0, 0.03, radius));
        }
    }
    // The finest veins separate scattered cells: on their border two cell centres are equally near.
    const double pitch = 0.042;
    const int row = static_cast<int>(std::floor(fore / pitch)), column = static_cast<int>(std::floor(aside / pitch));
    double first = 1e9, second = 1e9;
    for (int r = row - 2; r <= row + 2; r++) {
        for (int c = column - 2; c <= column + 2; c++) {
            Random scatter(static_cast<uint64_t>((r + 100) * 1000 + c + 100));
            const double x = pitch * (r + scatter.unit()) - fore, y = pitch * (c + scatter.unit()) - aside;
            const double d = x * x + y * y;
            second = std::min(second, std::max(first, d)), first = std::min(first, d);
        }
    }
    first = std::sqrt(first), second = std::sqrt(second);
    light = std::max(light, 0.15 * smooth_step(0.010, 0.0, second - first));
    // The blade bulges between veins and is a little darker beside them.
    return clamp01(light + 0.08 * smooth_step(0.0, 0.04, first));
}

}  // namespace

GrownImage cucumber_blade_image() {
    GrownImage image{"cucumber_blade.png", 192, 320, {}, {}};
    fill_palette(image, BLADE_DARK, CUCUMBER_VEIN);
    Random random(42);
    for (int row = 0; row < image.height; row++) {
        for (int column = 0; column < image.width; column++) {
            const double v = 1 - (row + 0.5) / image.height, u = (column + 0.5) / image.width;
            const double speck = random.range(-0.03, 0.03);
            const double light = vein_light((v - 0.36) / 0.57, u) + speck;
            image.pixels.push_back(static_cast<uint8_t>(std::lround(255 * clamp01(light))));
        }
    }
    return image;
}

}  // namespace frond::grow
