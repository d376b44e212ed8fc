// Grows a rosette. In: settings only. Out: a model of nine leaves around a short stem.
#include "scenes/rosette.hpp"

#include <algorithm>
#include <cmath>

namespace frond::tools {
namespace {

constexpr double PI = 3.14159265358979;
constexpr int LEAVES = 9;
constexpr double REACH = 0.42, RISE = 0.26, WIDTH = 0.09;  // dimensions of a leaf [m]

struct Triangles {
    std::vector<float> xyz;
    std::vector<int32_t> indices;
    int32_t add(double x, double y, double z) {
        xyz.insert(xyz.end(), {float(x), float(y), float(z)});
        return int32_t(xyz.size() / 3) - 1;
    }
    void quad(int32_t a, int32_t b, int32_t c, int32_t d) { indices.insert(indices.end(), {a, b, c, b, d, c}); }
};

// Adds a cone with a round top.
void add_heart(Triangles& out) {
    constexpr int SIDES = 10;
    constexpr double RADII[] = {0.03, 0.03, 0.022}, STEP = 0.03;  // [m]
    for (int ring = 0; ring < 3; ring++)
        for (int s = 0; s < SIDES; s++) {
            const double turn = 2 * PI * s / SIDES;
            out.add(RADII[ring] * std::cos(turn), STEP * ring, RADII[ring] * std::sin(turn));
        }
    for (int32_t ring = 0; ring < 2; ring++)
        for (int32_t s = 0; s < SIDES; s++) {
            const int32_t a = ring * SIDES + s, b = ring * SIDES + (s + 1) % SIDES;
            out.quad(a, a + SIDES, b, b + SIDES);
        }
    const int32_t tip = out.add(0, 0.07, 0);
    for (int32_t s = 0; s < SIDES; s++)
        out.indices.insert(out.indices.end(), {2 * SIDES + s, tip, 2 * SIDES + (s + 1) % SIDES});
}

// Adds a leaf, which rises, arches over and hangs a little; both halves slope down from the midrib.
void add_leaf(Triangles& out, double turn, double rise) {
    constexpr int LONG = 16;
    constexpr int32_t WIDE = 4;
    const int32_t first = int32_t(out.xyz.size() / 3);
    for (int i = 0; i <= LONG; i++) {
        const double t = double(i) / LONG, past = std::max(0.0, t - 0.55) / 0.45;
        const double away = 0.02 + REACH * (t - 0.12 * std::sin(PI * t));
        const double high = 0.04 + RISE * rise * std::sin(0.5 * PI * std::min(1.0, 1.35 * t)) - 0.1 * past * past;
        const double width = WIDTH * (0.35 + 0.65 * std::sin(PI * (0.15 + 0.8 * t))) * (i == LONG ? 0.15 : 1);
        for (int k = 0; k <= WIDE; k++) {
            const double beside = width * (double(k) / WIDE - 0.5);
            out.add(away * std::cos(turn) - beside * std::sin(turn), high - 0.25 * std::abs(beside),
                    away * std::sin(turn) + beside * std::cos(turn));
        }
    }
    for (int32_t i = 0; i < LONG; i++)
        for (int32_t k = 0; k < WIDE; k++) {
            const int32_t a = first + i * (WIDE + 1) + k, b = a + WIDE + 1;
            out.quad(a, b, a + 1, b + 1);
        }
}

}  // namespace

frond_model make_rosette(Stage& stage) {
    constexpr double GOLDEN = 2.399963;  // angle between successive leaves [rad]
    Triangles triangles;
    add_heart(triangles);
    for (int i = 0; i < LEAVES; i++) add_leaf(triangles, GOLDEN * i, 1 - 0.08 * (i % 3));
    // Leaves that store water: thick, and carried by their fibres.
    frond_organ_material leaf = {"blade", {}};
    must(frond_material_preset("blade", &leaf.material));
    leaf.material.thickness = 3e-3;
    leaf.material.young = 2e8;
    frond_model_def def = stage.settings.model;
    def.scale = 1;
    def.up = {0, 1, 0};
    def.organs = &leaf;
    def.organ_count = 1;
    frond_model model = {};
    must(frond_model_from_triangles(triangles.xyz.data(), int(triangles.xyz.size() / 3), triangles.indices.data(),
                                    int(triangles.indices.size() / 3), &def, &model));
    return stage.keep(model);
}

}  // namespace frond::tools
