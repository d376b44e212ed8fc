// Corn (Zea mays). In: settings and a seed. Out: a plant of 925 vertices and 1184 triangles: culm with nodes and
// sheaths, two-ranked arching blades, an ear with husk and silk, a tassel and prop roots; habit after Kiesselbach, "The
// structure and reproduction of corn" (1949).
#include "corn.hpp"

namespace frond::grow {

const Phytomer PHYTOMERS[CORN_LEAVES] = {
    {0.035, 0.150, 0.46, 0.058, 44, 100, 9, 0.80}, {0.105, 0.245, 0.62, 0.072, 36, 118, 11, 0.30},
    {0.195, 0.365, 0.76, 0.084, 30, 130, 13, 0.0}, {0.320, 0.510, 0.86, 0.093, 27, 138, 14, 0.0},
    {0.470, 0.665, 0.92, 0.099, 24, 142, 15, 0.0}, {0.630, 0.825, 0.94, 0.102, 22, 144, 15, 0.0},
    {0.795, 0.990, 0.92, 0.100, 20, 142, 15, 0.0}, {0.965, 1.160, 0.84, 0.094, 19, 136, 14, 0.0},
    {1.135, 1.330, 0.74, 0.085, 18, 126, 13, 0.0}, {1.310, 1.500, 0.61, 0.073, 17, 108, 11, 0.0},
    {1.490, 1.665, 0.46, 0.058, 16, 84, 9, 0.0}};

// Returns the centre of the culm, which leans a little away from each blade: a slight zigzag.
Vec Corn::axis(double y) const {
    double push = 0;
    for (int i = 0; i < CORN_LEAVES; i++) {
        const double d = (y - PHYTOMERS[i].node) / 0.12;
        push += (i % 2 ? 1 : -1) * std::exp(-d * d);
    }
    const Vec sway = (0.012 * std::sin(1.7 * y)) * heading(plane + 1.2);
    return Vec{0, height * y, 0} + (0.0075 * smooth_step(0, 0.2, y) * push) * heading(plane) + sway;
}

double Corn::culm_radius(double y) const {
    return mix(0.0165, 0.0052, clamp01(y / 1.80));
}

namespace {

const Rgb CULM_GREEN{0.50, 0.58, 0.28}, NODE_PALE{0.70, 0.66, 0.42};
const Rgb ROOT_TOP{0.48, 0.50, 0.26}, ROOT_EARTH{0.45, 0.32, 0.20};

void grow_culm(Corn& corn) {
    begin_organ(corn.plant, "stem", corn.stem);
    Tube tube;
    tube.sides = 6;
    tube.roll = corn.plane;
    auto ring = [&](double y, double factor, Rgb color) {
        tube.rings.push_back({corn.axis(y), corn.culm_radius(y) * factor, color});
    };
    ring(-0.02, 1.10, ROOT_EARTH);
    ring(0.015, 1.10, mix(ROOT_TOP, ROOT_EARTH, 0.5));
    for (int i = 0; i < CORN_LEAVES; i++) {
        const Phytomer& p = PHYTOMERS[i];
        const double next = i + 1 < CORN_LEAVES ? PHYTOMERS[i + 1].node : p.collar + 0.10;
        const Rgb sheath = mix(SHEATH_GREEN, STRAW, 0.8 * p.dry);
        // A swollen node, the sheath around the culm, and bare culm between the sheath's collar and the next node.
        ring(p.node, 1.30, NODE_PALE);
        ring(p.node + 0.20 * (p.collar - p.node), 1.12, sheath);
        if (p.collar < next) {
            ring(p.collar, 1.28, mix(sheath, NODE_PALE, 0.5));
            ring(p.collar + 0.012, 0.92, CULM_GREEN);
        }
    }
    ring(1.80, 0.75, CULM_GREEN);
    ring(1.90, 0.60, TASSEL_STEM);
    tube.close_end = false;
    add_tube(corn.plant, tube);
}

void grow_roots(Corn& corn) {
    const int roots = 6;
    for (int k = 0; k < roots; k++) {
        begin_organ(corn.plant, "root_" + std::to_string(k + 1), corn.root);
        const double y = k % 2 ? 0.045 : 0.032;
        const Vec out = heading(corn.plane + TURN * (k + corn.random.spread(0.2)) / roots);
        const double reach = corn.random.range(0.045, 0.065) + (k % 2 ? 0.012 : 0);
        Tube tube;
        tube.sides = 3;
        tube.rings = {{corn.axis(y) + 0.011 * out, 0.0042, ROOT_TOP},
                      {corn.axis(y) + (0.6 * reach) * out + Vec{0, -0.016, 0}, 0.0036, ROOT_EARTH}};
        tube.end_reach = 0.0;
        add_tube(corn.plant, tube);
        // The point enters the ground steeply.
        const Vec tip = corn.axis(0) + reach * out + Vec{0, -0.03, 0};
        corn.plant.positions.back() = {tip.x, tip.y, tip.z};
    }
}

}  // namespace

GrownPlant grow_corn(const GrownSettings& value, uint64_t seed) {
    Corn corn;
    corn.random = Random(seed);
    corn.leaf_length = value.at("leaf_length"), corn.leaf_width = value.at("leaf_width");
    corn.arch = value.at("arch"), corn.height = value.at("height") / 2.2;
    corn.plane = value.at("azimuth") * PI / 180;
    corn.stem = add_material(corn.plant, "maize_stem", SHEATH_GREEN);
    corn.blade = add_material(corn.plant, "maize_blade", MIDRIB_PALE, "corn_blade.png");
    corn.dry_blade = add_material(corn.plant, "maize_blade_dry", STRAW);
    corn.ear = add_material(corn.plant, "husk", HUSK);
    corn.silk = add_material(corn.plant, "silk", SILK_DRY);
    corn.tassel = add_material(corn.plant, "tassel", TASSEL_GOLD);
    corn.root = add_material(corn.plant, "root", ROOT_EARTH);

    // The blades stand in two ranks, each a little out of line, and the ranks turn slowly with height.
    for (int i = 0; i < CORN_LEAVES; i++)
        corn.azimuths[i] = corn.plane + (i % 2 ? PI : 0) + 0.035 * (i - 5) + corn.random.spread(0.16);
    grow_culm(corn);
    for (int i = 0; i < CORN_LEAVES; i++) grow_blade(corn, i);
    grow_ear(corn, {1, 5, 1.0, -1.05, 3, 5});
    grow_tassel(corn, 29);
    grow_roots(corn);
    corn.plant.images.push_back(corn_blade_image());
    return corn.plant;
}

}  // namespace frond::grow
