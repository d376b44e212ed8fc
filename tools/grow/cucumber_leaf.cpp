// Cucumber, the leaf. Out: a blade with five lobes, toothed margin and palmate veins, as fans of ever finer rings about
// the end of the petiole.
#include "cucumber.hpp"

namespace frond::grow {
namespace {

// Outline by angle from the tip: lobes and the bays between them, as shares of the distance from petiole to tip.
struct Corner {
    double angle;  // [degree]
    double radius;
    bool lobe;
};
const Corner CORNERS[] = {{-166, 0.50, false}, {-118, 0.74, true}, {-88, 0.66, false}, {-57, 0.92, true},
                          {-27, 0.75, false},  {0, 1.00, true},    {27, 0.75, false},  {57, 0.92, true},
                          {88, 0.66, false},   {118, 0.74, true},  {166, 0.50, false}};
constexpr int SECTORS = 10;
// Samples per sector on each ring, and the ring's share of the radius.
struct Ring {
    int samples;
    double reach;
};
const Ring RINGS[] = {{1, 0.09}, {2, 0.25}, {4, 0.50}, {8, 0.77}, {16, 1.0}};
constexpr int RING_COUNT = sizeof(RINGS) / sizeof(RINGS[0]);

// Returns the radius on the edge between two corners, in polar form: straight but bulging a little.
double outline(int sector, double u) {
    const Corner &a = CORNERS[sector], &b = CORNERS[sector + 1];
    const double whole = (b.angle - a.angle) * PI / 180, part = whole * u;
    const double straight =
        a.radius * b.radius * std::sin(whole) / (a.radius * std::sin(part) + b.radius * std::sin(whole - part));
    return straight * (1 + 0.055 * std::sin(PI * u));
}

// Returns a sample's share of its sector; samples stand closer beside the veins, which run to the lobes.
double eased(int sector, double u) {
    const bool vein_first = CORNERS[sector].lobe;
    const double t = vein_first ? u : 1 - u;
    const double e = mix(t, t * t, 0.35);
    return vein_first ? e : 1 - e;
}

// Joins a fan about the centre, then ring to ring, always advancing the side that lags behind in angle.
void join_rings(GrownPlant& plant, int center, const std::vector<std::vector<int>>& rings) {
    for (size_t k = 0; k + 1 < rings[0].size(); k++) add_triangle(plant, center, rings[0][k + 1], rings[0][k]);
    for (int r = 0; r + 1 < RING_COUNT; r++) {
        const auto &inner = rings[r], &outer = rings[r + 1];
        size_t i = 0, o = 0;
        while (i + 1 < inner.size() || o + 1 < outer.size()) {
            const double next_inner = (i + 0.999) / (inner.size() - 1.0), next_outer = (o + 1) / (outer.size() - 1.0);
            const bool step_out = o + 1 < outer.size() && (i + 1 == inner.size() || next_outer <= next_inner);
            if (step_out) {
                add_triangle(plant, inner[i], outer[o + 1], outer[o]), o++;
            } else {
                add_triangle(plant, inner[i], inner[i + 1], outer[o]), i++;
            }
        }
    }
}

// Adds a tooth on every edge of the margin, leaning towards the tip of the leaf.
void add_teeth(GrownPlant& plant, const CucumberBlade& blade, const std::vector<int>& margin, Random& random) {
    const Vec normal = unit(blade.normal);
    const size_t half = margin.size() / 2;
    for (size_t k = 0; k + 1 < margin.size(); k++) {
        const Vec a = position_of(plant, margin[k]), b = position_of(plant, margin[k + 1]);
        const Vec middle = mix(a, b, k < half ? 0.70 : 0.30), out = unit(middle - blade.center);
        const double tall = length(b - a) * (k % 4 == 1 ? 0.75 : 0.45) * random.range(0.8, 1.2);
        const auto &uv_a = plant.uvs[margin[k]], &uv_b = plant.uvs[margin[k + 1]];
        const double u = 0.5 * (uv_a[0] + uv_b[0]), v = 0.5 * (uv_a[1] + uv_b[1]);
        const int tip = add_vertex(plant, middle + tall * unit(out - 0.2 * normal), blade.margin, u, v);
        add_triangle(plant, margin[k], margin[k + 1], tip);
    }
}

}  // namespace

void add_cucumber_blade(GrownPlant& plant, const CucumberBlade& blade, Random random) {
    const Vec normal = unit(blade.normal);
    const Vec forward = unit(blade.forward - dot(blade.forward, normal) * normal), side = cross(normal, forward);
    const double wave = random.range(0, TURN), skew = random.spread(0.10), bend = blade.droop * random.range(0.8, 1.2);
    const double tone = random.unit();

    // Shape of the sheet above its flat outline, all lengths as shares of the size.
    auto place = [&](double angle, double radius, double vein, double reach) {
        const double fore = radius * std::cos(angle), aside = radius * std::sin(angle) * (1 + skew * std::sin(angle));
        double lift = 0.16 * radius * radius * (1 - 0.5 * radius);           // cupped
        lift -= 0.045 * vein * reach * (1.3 - reach);                        // sunk along the veins
        lift += 0.050 * reach * reach * reach * std::sin(5 * angle + wave);  // waved at the margin
        lift += 0.022 * reach * reach * std::sin(13 * angle + 2 * wave);
        // The tip and the side lobes hang down.
        const double hang = bend * (fore > 0 ? 0.42 * fore * fore : 0.20 * fore * fore) + 0.16 * bend * aside * aside;
        return blade.center + blade.size * (fore * forward + aside * side + (lift - hang) * normal) +
               (blade.size * 0.10 * bend * fore * std::fabs(fore)) * Vec{0, -1, 0};
    };
    const Rgb base = scaled(blade.color, mix(1.0, 0.86, tone));
    std::vector<std::vector<int>> rings;
    // The texture shows one half of the leaf; both halves share it.
    auto map = [](double angle, double radius) {
        return std::array<double, 2>{std::fabs(radius * std::sin(angle)), 0.36 + 0.57 * radius * std::cos(angle)};
    };
    const auto middle_uv = map(0, 0);
    const int center = add_vertex(plant, blade.center, blade.color, middle_uv[0], middle_uv[1]);
    for (int r = 0; r < RING_COUNT; r++) {
        rings.emplace_back();
        const int samples = RINGS[r].samples;
        for (int k = 0; k <= SECTORS * samples; k++) {
            const int sector = std::min(k / samples, SECTORS - 1);
            const double u = eased(sector, static_cast<double>(k - sector * samples) / samples);
            const Corner &a = CORNERS[sector], &b = CORNERS[sector + 1];
            const double angle = mix(a.angle, b.angle, u) * PI / 180;
            // Distance from the nearer main vein.
            const double to_vein = std::fabs(angle - (a.lobe ? a.angle : b.angle) * PI / 180);
            const double edge = outline(sector, u);
            const double reach = RINGS[r].reach, radius = edge * reach;
            const double off = radius * std::sin(std::min(to_vein, PI / 2)), along = radius * std::cos(to_vein);
            const double vein =
                std::max(std::exp(-off * off / (0.035 * 0.035)), 0.55 * cucumber_side_vein(along, off, 0.36));
            const Rgb color =
                scaled(mix(base, blade.margin, 0.6 * smooth_step(0.8, 1.0, reach)), 1 + random.spread(0.03));
            const auto uv = map(angle, radius);
            rings.back().push_back(add_vertex(plant, place(angle, radius, vein, reach), color, uv[0], uv[1]));
        }
    }

    join_rings(plant, center, rings);
    add_teeth(plant, blade, rings.back(), random);
}

}  // namespace frond::grow
