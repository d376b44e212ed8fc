// Cucumber (Cucumis sativus). In: settings and a seed. Out: a climbing plant of 22004 vertices and 30244 triangles: one
// stem with alternate leaves (two turns in five), fruits on peduncles, flowers, coiled tendrils, stiff hairs on stem
// and fruit, and the stake that it is tied to, as no cucumber of this height stands by itself.
#include <stdexcept>

#include "cucumber.hpp"

namespace frond::grow {
namespace {

constexpr int VERTICES = 22004, TRIANGLES = 30244;
constexpr int NODES = 20;

// The organs at each node, from the ground up. Lengths in metres, angles in degrees.
struct Node {
    double petiole;  // length of the petiole
    double blade;    // length of the blade from petiole to tip
    double tilt;     // angle of the blade below the horizontal
    double fruit;    // length of the fruit, 0 for none
    bool tendril;
    int flowers;
};
const Node NODE_TABLE[NODES] = {
    {0.120, 0.112, 14, 0, false, 0},     {0.145, 0.132, 20, 0, false, 0},     {0.160, 0.146, 26, 0, true, 0},
    {0.170, 0.156, 31, 0, false, 0},     {0.176, 0.163, 34, 0.185, false, 0}, {0.182, 0.168, 36, 0, true, 0},
    {0.185, 0.171, 38, 0.200, false, 0}, {0.185, 0.172, 38, 0, true, 0},      {0.183, 0.172, 38, 0.170, false, 0},
    {0.182, 0.170, 37, 0, true, 1},      {0.178, 0.167, 36, 0.135, false, 0}, {0.174, 0.163, 36, 0, true, 1},
    {0.168, 0.157, 34, 0.085, false, 1}, {0.160, 0.150, 32, 0, true, 1},      {0.148, 0.140, 28, 0, true, 1},
    {0.130, 0.124, 24, 0, true, 1},      {0.108, 0.104, 16, 0, false, 1},     {0.084, 0.080, 4, 0, true, 1},
    {0.058, 0.058, -16, 0, false, 0},    {0.034, 0.038, -42, 0, false, 0}};

const Rgb STEM_GREEN{0.46, 0.62, 0.26}, STEM_WOOD{0.56, 0.56, 0.33}, PETIOLE_GREEN{0.50, 0.66, 0.29};
// Blade colours, multiplied with the texture.
const Rgb BLADE_OLD = scaled(CUCUMBER_VEIN, 0.90), BLADE_YOUNG = scaled(CUCUMBER_VEIN, 1.15);
const Rgb TENDRIL_GREEN{0.58, 0.74, 0.33}, HAIR{0.84, 0.88, 0.72};

struct Cucumber {
    GrownPlant plant;
    uint64_t seed;
    double leaf_size, petiole_length, droop;
    int stem, petiole, blade, fruit, peduncle, flower, tendril, stake, tie;  // material indices
    // Hairs: number of possible feet, number of hairs to spread over them, and how many of those are curved.
    int places = 0, hairs = 0, curved = 0;
    int place = 0, hair = 0;

    Random random_for(int node, int what) const { return Random(seed * 7919 + node * 101 + what); }
};

double node_height(int node) {
    // Internodes are short near the ground and at the growing tip.
    const double t = static_cast<double>(node) / (NODES - 1);
    return 0.060 + 1.90 * (t - 0.035 * std::sin(TURN * t) + 0.045 * t * (1 - t) * (2 * t - 1) + 0.05 * t * (1 - t));
}
double node_azimuth(int node) {
    return 0.35 + node * 0.8 * PI + 0.10 * std::sin(3.1 * node);
}

double stem_radius(double y) {
    return mix(0.0078, 0.0022, std::pow(clamp01(y / 2.0), 1.3));
}

// Position of the stake; the stem is tied to it between every other pair of nodes.
const double STEM_SIDE = 3.4;  // mean azimuth of the stem seen from the stake [rad]
const Vec STAKE_FOOT = -0.023 * heading(STEM_SIDE);
double tie_height(int tie) {
    return 0.5 * (node_height(2 * tie + 1) + node_height(2 * tie + 2));
}
constexpr int TIES = (NODES - 2) / 2;

// Returns the azimuth of the stem seen from the stake: it winds a little.
double stem_azimuth(double y) {
    return STEM_SIDE + 0.55 * std::sin(2.6 * y);
}
// The stem touches the stake where it is tied and keeps clear of it at its nodes, where leaves need space.
Vec axis(double y) {
    double loose = 1;
    for (int tie = 0; tie < TIES; tie++)
        loose = std::min(loose, smooth_step(0.01, 0.09, std::fabs(y - tie_height(tie))));
    const double below = smooth_step(tie_height(0), 0, y);
    const double away = 1.15 * cucumber_stake_radius(y) + 1.1 * stem_radius(y) + 0.013 * std::max(loose, below);
    return STAKE_FOOT + Vec{0, y, 0} + away * heading(stem_azimuth(y));
}
// Returns the azimuth of an organ, turned aside if the organ would grow into the stake.
double past_stake(double azimuth, double y, double clearance) {
    const double toward = std::remainder(azimuth - stem_azimuth(y) - PI, TURN);
    return std::fabs(toward) >= clearance ? azimuth : azimuth - toward + std::copysign(clearance, toward);
}

// Returns the point where an organ leaves the stem: under the skin of the swollen node.
Vec socket(double y, Vec out) {
    return axis(y) + (0.80 * stem_radius(y)) * out;
}

// Offers each vertex of a tube as the foot of a hair; grows those that are chosen.
void grow_hairs(Cucumber& c, const TubeMesh& mesh, int from_ring, int to_ring, double height, Random random) {
    for (int r = from_ring; r < to_ring; r++) {
        const Vec along = unit(mesh.centers[std::min(r + 1, mesh.rings - 1)] - mesh.centers[std::max(r - 1, 0)]);
        for (int s = 0; s < mesh.sides; s++) {
            const double tall = height * random.range(0.6, 1.3), lean = random.spread(0.5), wind = random.spread(0.5);
            const long long i = c.place++;
            if (c.hairs == 0 || (i + 1) * c.hairs / c.places == i * c.hairs / c.places) continue;
            const long long h = c.hair++;
            const bool curved = (h + 1) * c.curved / c.hairs != h * c.curved / c.hairs;
            const Vec out = unit(position_of(c.plant, mesh.at(r, s)) - mesh.centers[r]);
            const Vec beside = cross(along, out);
            const Vec foot = unit(along + wind * beside);
            add_hair(c.plant, mesh.at(r, s), unit(out + lean * along + (0.5 * wind) * beside), foot, tall, 0.0006,
                     curved, HAIR);
        }
    }
}

// Grows the stem, and the stake with its ties.
void grow_stem(Cucumber& c) {
    begin_organ(c.plant, "stem", c.stem);
    Tube tube;
    tube.sides = 10;
    const int rings = 90;
    const double top = node_height(NODES - 1) + 0.02;
    std::vector<double> swell(rings);
    for (int r = 0; r < rings; r++) {
        const double y = mix(-0.012, top, r / (rings - 1.0));
        double node = 0;
        for (int i = 0; i < NODES; i++) node += std::exp(-std::pow((y - node_height(i)) / 0.010, 2));
        const Rgb color = mix(mix(STEM_WOOD, STEM_GREEN, smooth_step(0.0, 0.35, y)), PETIOLE_GREEN, 0.6 * node);
        tube.rings.push_back({axis(y), stem_radius(y) * (1 + 0.28 * node), color});
    }
    // The stem has five ridges.
    tube.bulge = [](int, int s) { return s % 2 ? 0.93 : 1.07; };
    tube.tint = [&](int r, int s) { return scaled(tube.rings[r].color, s % 2 ? 0.92 : 1.05); };
    tube.end_reach = 0.004;
    const TubeMesh mesh = add_tube(c.plant, tube);
    grow_hairs(c, mesh, 1, rings - 1, 0.0034, c.random_for(0, 1));

    CucumberStake stake{STAKE_FOOT, top + 0.072, {}, c.stake, c.tie};
    for (int tie = 0; tie < TIES; tie++) stake.ties.push_back(tie_height(tie));
    add_cucumber_stake(c.plant, stake, mesh, stem_radius);
}

void grow_leaf(Cucumber& c, int i) {
    const Node& node = NODE_TABLE[i];
    Random random = c.random_for(i, 2);
    const double y = node_height(i), reach = node.petiole * c.petiole_length;
    const Vec out = heading(past_stake(node_azimuth(i) + random.spread(0.08), y, 0.80)), up{0, 1, 0},
              foot = socket(y, out);
    const double steep = mix(0.75, 1.6, smooth_step(0.80, 1.0, i / (NODES - 1.0))) * random.range(0.9, 1.1);

    // The petiole rises, then bows outwards under the blade.
    const Vec bow = (0.12 * random.spread(1)) * cross(up, out);
    const std::vector<Vec> control = {foot, foot + (0.30 * reach) * (out + steep * up + bow),
                                      foot + (0.62 * reach) * (out + (0.82 * steep) * up + 1.5 * bow),
                                      foot + (0.92 * reach) * (out + (0.62 * steep) * up + 1.2 * bow)};
    Tube tube;
    tube.sides = 6;
    const int rings = 8;
    const double radius = mix(0.0014, 0.0031, clamp01(node.blade / 0.15));
    const std::vector<Vec> line = curve_through(control, rings);
    for (int r = 0; r < rings; r++) {
        const double t = r / (rings - 1.0);
        tube.rings.push_back({line[r], radius * mix(1.25, 0.85, t), mix(PETIOLE_GREEN, CUCUMBER_VEIN, t)});
    }
    tube.bulge = [](int, int s) { return s % 2 ? 0.95 : 1.05; };
    tube.end_reach = 0.0006;
    begin_organ(c.plant, "petiole_" + std::to_string(i + 1), c.petiole);
    const TubeMesh mesh = add_tube(c.plant, tube);
    grow_hairs(c, mesh, 2, rings - 1, 0.0028, random);

    const double tilt = (node.tilt * c.droop + random.spread(7)) * PI / 180;
    const Vec outward = turned(out, up, random.spread(0.30));
    const double young = smooth_step(0.70, 1.0, i / (NODES - 1.0));
    CucumberBlade blade;
    blade.center = line.back();
    blade.forward = std::cos(tilt) * outward - std::sin(tilt) * up;
    blade.normal = turned(std::sin(tilt) * outward + std::cos(tilt) * up, blade.forward, random.spread(0.22));
    blade.size = node.blade * c.leaf_size * random.range(0.96, 1.04);
    blade.droop = c.droop * mix(1.0, 0.2, young);
    blade.color = mix(BLADE_OLD, BLADE_YOUNG, young);
    blade.margin = scaled(blade.color, 1.10);
    begin_organ(c.plant, "leaf_" + std::to_string(i + 1), c.blade);
    add_cucumber_blade(c.plant, blade, random);
}

// Grows a stalk from the stem to a point; returns its end.
Vec grow_stalk(Cucumber& c, const std::vector<Vec>& control, int rings, double radius) {
    Tube tube;
    tube.sides = 6;
    for (const Vec& p : curve_through(control, rings)) tube.rings.push_back({p, radius, PETIOLE_GREEN});
    tube.rings.back().radius *= 1.5;
    tube.end_reach = 0.0015;
    add_tube(c.plant, tube);
    return control.back();
}

void grow_fruit(Cucumber& c, int i, int number) {
    const Node& node = NODE_TABLE[i];
    Random random = c.random_for(i, 3);
    const double y = node_height(i) - 0.003;
    const Vec out = heading(past_stake(node_azimuth(i) - 1.85, y, 0.62)), up{0, 1, 0}, foot = socket(y, out);
    const double ripe = smooth_step(0.06, 0.19, node.fruit), away = 0.052 + 0.012 * ripe;
    begin_organ(c.plant, "peduncle_" + std::to_string(number), c.peduncle);
    const Vec end = grow_stalk(c,
                               {foot, foot + 0.026 * out + 0.012 * up, foot + (0.85 * away) * out + 0.006 * up,
                                foot + away * out - 0.022 * up},
                               9, 0.0024);

    begin_organ(c.plant, "fruit_" + std::to_string(number), c.fruit);
    CucumberFruit fruit;
    fruit.down = unit(Vec{0, -1, 0} + 0.10 * out);
    fruit.top = end - (0.003) * fruit.down;
    fruit.length = node.fruit;
    fruit.radius = mix(0.008, 0.0215, ripe);
    fruit.ripe = ripe;
    fruit.rings = 25, fruit.sides = 20;
    const TubeMesh mesh = add_cucumber_fruit(c.plant, fruit, random);
    grow_hairs(c, mesh, 4, fruit.rings - 2, 0.0022, random);

    // A young fruit still bears its flower.
    if (ripe < 0.8) {
        begin_organ(c.plant, "flower_fruit_" + std::to_string(number), c.flower);
        add_cucumber_flower(c.plant, mesh.centers.back() - 0.002 * fruit.down, fruit.down, 0.026, random);
    }
}

void grow_flower(Cucumber& c, int i, int number) {
    Random random = c.random_for(i, 4);
    const double y = node_height(i) + 0.003;
    const Vec out = heading(past_stake(node_azimuth(i) + 1.55, y, 0.65)), up{0, 1, 0}, foot = socket(y, out);
    begin_organ(c.plant, "flower_" + std::to_string(number), c.flower);
    const Vec end = grow_stalk(c, {foot, foot + 0.020 * out + 0.016 * up, foot + 0.048 * out + 0.034 * up}, 5, 0.0014);
    add_cucumber_flower(c.plant, end - 0.001 * up, out + random.range(0.2, 0.7) * up, 0.030, random);
}

// Grows a tendril that reaches out and ends in a coil.
void grow_tendril(Cucumber& c, int i, int number) {
    Random random = c.random_for(i, 5);
    const double y = node_height(i);
    const Vec out = heading(past_stake(node_azimuth(i) + random.range(2.3, 2.9), y, 0.7)), up{0, 1, 0},
              foot = socket(y, out);
    const double straight = random.range(0.07, 0.11), radius = random.range(0.006, 0.010);
    const double turns = random.range(2.5, 3.6);
    const Vec along = unit(out + random.range(0.35, 0.9) * up), beside = unit(cross(up, out)),
              over = cross(beside, along);
    const int rings = 32;
    Tube tube;
    tube.sides = 3;
    for (int r = 0; r < rings; r++) {
        const double t = r / (rings - 1.0), coil = std::max(0.0, (t - 0.25) / 0.75);
        const double reach = straight * std::min(1.0, t / 0.25) + 0.055 * coil;
        const double angle = TURN * turns * coil, round = radius * (1 - 0.45 * coil);
        const Vec center = foot + reach * along + (0.012 * std::sin(PI * std::min(1.0, t / 0.25))) * over +
                           (round * std::sin(angle)) * beside +
                           (radius - round * std::cos(angle) - radius * 0.45 * coil) * over;
        tube.rings.push_back({center, mix(0.0013, 0.0006, t), mix(PETIOLE_GREEN, TENDRIL_GREEN, t)});
    }
    tube.end_reach = 0.002;
    begin_organ(c.plant, "tendril_" + std::to_string(number), c.tendril);
    add_tube(c.plant, tube);
}

void grow_all(Cucumber& c) {
    c.plant = GrownPlant();
    c.place = c.hair = 0;
    c.stem = add_material(c.plant, "stem", STEM_GREEN);
    c.petiole = add_material(c.plant, "petiole", PETIOLE_GREEN);
    c.blade = add_material(c.plant, "blade", CUCUMBER_VEIN, "cucumber_blade.png");
    c.fruit = add_material(c.plant, "fruit", {0.16, 0.36, 0.12});
    c.peduncle = add_material(c.plant, "peduncle", PETIOLE_GREEN);
    c.flower = add_material(c.plant, "flower", {0.98, 0.84, 0.16});
    c.tendril = add_material(c.plant, "tendril", TENDRIL_GREEN);
    c.stake = add_material(c.plant, "stake", {0.79, 0.68, 0.42});
    c.tie = add_material(c.plant, "tie", {0.80, 0.72, 0.55});
    grow_stem(c);
    for (int i = 0; i < NODES; i++) grow_leaf(c, i);
    int fruits = 0, flowers = 0, tendrils = 0;
    for (int i = 0; i < NODES; i++) {
        if (NODE_TABLE[i].fruit > 0) grow_fruit(c, i, ++fruits);
        if (NODE_TABLE[i].flowers) grow_flower(c, i, ++flowers);
        if (NODE_TABLE[i].tendril) grow_tendril(c, i, ++tendrils);
    }
}

}  // namespace

GrownPlant grow_cucumber(const GrownSettings& value, uint64_t seed) {
    Cucumber c;
    c.seed = seed;
    c.leaf_size = value.at("leaf_size"), c.petiole_length = value.at("petiole_length"), c.droop = value.at("droop");

    // Grow without hairs to count vertices, then choose straight hairs (2 vertices, 1 triangle) and curved ones (3 and
    // 2) to make up the totals.
    grow_all(c);
    const int vertices = VERTICES - static_cast<int>(c.plant.positions.size());
    const int triangles = TRIANGLES - static_cast<int>(c.plant.triangles.size());
    const int straight = 2 * vertices - 3 * triangles;
    c.curved = 2 * triangles - vertices;
    c.hairs = straight + c.curved;
    c.places = c.place;
    if (straight < 0 || c.curved < 0 || c.hairs > c.places)
        throw std::logic_error("the hairs cannot fill up the cucumber: " + std::to_string(straight) + " straight, " +
                               std::to_string(c.curved) + " curved, " + std::to_string(c.places) + " places");
    grow_all(c);

    c.plant.images.push_back(cucumber_blade_image());

    // The height is that of the plant's highest point, not the stake's.
    double top = 0;
    for (const GrownOrgan& organ : c.plant.organs)
        for (int v = organ.first_vertex; v < organ.first_vertex + organ.vertex_count; v++)
            if (organ.material != c.stake) top = std::max(top, c.plant.positions[v][1]);
    const double scale = value.at("height") / top;
    for (auto& p : c.plant.positions)
        for (double& x : p) x *= scale;
    return c.plant;
}

}  // namespace frond::grow
