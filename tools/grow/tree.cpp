// A broad-leaved tree. In: settings and a seed. Out: a trunk with branches, boughs and twigs of ten leaves each. The
// kind with many organs: each leaf and each length of wood is an organ of its own.
#include "organs.hpp"

namespace frond::grow {
namespace {

constexpr int LEAVES_A_TWIG = 10, TWIGS_A_BOUGH = 10;
constexpr double GOLDEN = 2.399963;  // angle between successive ones around what they grow on [radian]

const Rgb BARK{0.36, 0.29, 0.22}, TWIG{0.44, 0.38, 0.25}, YOUNG{0.45, 0.60, 0.22}, OLD{0.20, 0.40, 0.14};

struct Wood {
    Vec foot, along;
    double length, thick, thin;  // length, and radii at both ends [m]
    double sag;                  // sag of the tip, as a share of the length
    Vec at(double s) const { return foot + (length * s) * along + Vec{0, -length * sag * s * s, 0}; }
    Vec heading_at(double s) const { return unit(at(s + 0.01) - at(s - 0.01)); }
    double radius(double s) const { return mix(thick, thin, s); }
};

struct Tree {
    GrownPlant plant;
    Random random{0};
    double leaf_size;
    int wood, leaf;  // material indices
    int leaves = 0;

    // Returns the direction at `angle` to the axis `along`, at `azimuth` around it.
    static Vec off(Vec along, double angle, double azimuth) {
        const Vec side = unit(cross(along, std::fabs(along.y) < 0.9 ? Vec{0, 1, 0} : Vec{1, 0, 0}));
        return unit(turned(turned(along, side, angle), along, azimuth));
    }

    void add_wood(const std::string& name, const Wood& piece, int rings, int sides, Rgb color) {
        begin_organ(plant, name, wood);
        Tube tube;
        tube.sides = sides;
        for (int r = 0; r < rings; r++) {
            const double s = r / (rings - 1.0);
            tube.rings.push_back({piece.at(s), piece.radius(s), scaled(color, random.range(0.9, 1.1))});
        }
        add_tube(plant, tube);
    }

    void add_leaf(Vec foot, Vec along) {
        begin_organ(plant, "leaf_" + std::to_string(++leaves), leaf);
        const double length = leaf_size * random.range(0.08, 0.11), half = 0.3 * length;
        const Vec flat = unit(cross(along, Vec{0.2, 1, 0.1})), up = cross(flat, along);
        const double fall = random.range(0.1, 0.35);
        const Rgb color = mix(OLD, YOUNG, random.unit());
        Sheet sheet;
        sheet.rows = 3, sheet.columns = 3;
        sheet.place = [&](int row, int column) {
            const double t = row / 3.0, side = column - 1;
            const double width = half * (row == 0 ? 0.12 : row == 1 ? 1 : 0.8);
            return foot + (length * t) * along + Vec{0, -fall * length * t * t, 0} + (width * side) * flat +
                   (0.2 * width * std::fabs(side)) * up;
        };
        sheet.tint = [&](int, int column) { return scaled(color, column == 1 ? 1.15 : 1.0); };
        add_sheet(plant, sheet);
    }

    void add_twig(int number, const Wood& bough, double s, double azimuth) {
        const Wood twig = {bough.at(s),
                           off(bough.heading_at(s), random.range(0.6, 1.0), azimuth),
                           random.range(0.2, 0.3),
                           0.0035,
                           0.0015,
                           random.range(0, 0.15)};
        add_wood("twig_" + std::to_string(number), twig, 6, 5, TWIG);
        for (int k = 0; k < LEAVES_A_TWIG; k++) {
            const double at = (k + 1.0) / LEAVES_A_TWIG;
            add_leaf(twig.at(at), off(twig.heading_at(at), random.range(0.7, 1.1), GOLDEN * k + azimuth));
        }
    }
};

}  // namespace

GrownPlant grow_tree(const GrownSettings& value, uint64_t seed) {
    Tree tree;
    tree.random = Random(seed);
    tree.leaf_size = value.at("leaf_size");
    tree.wood = add_material(tree.plant, "bark", BARK);
    tree.leaf = add_material(tree.plant, "leaf", OLD);
    const int twigs = int(value.at("leaves")) / LEAVES_A_TWIG;
    const int boughs = (twigs + TWIGS_A_BOUGH - 1) / TWIGS_A_BOUGH;
    const int branches = std::max(4, int(1.6 * std::sqrt(double(boughs))));

    const double height = value.at("height");
    const Wood trunk = {{0, -0.04, 0}, {0, 1, 0}, 0.93 * height, 0.03 * height, 0.006 * height, 0};
    tree.add_wood("trunk", trunk, 16, 12, BARK);
    for (int b = 0, bough_count = 0, twig_count = 0; b < branches; b++) {
        const double s = 0.28 + 0.70 * (b + 0.5) / branches;
        const Wood branch = {trunk.at(s),
                             Tree::off({0, 1, 0}, 1.25 - 0.6 * s, GOLDEN * b + tree.random.spread(0.3)),
                             height * tree.random.range(0.42, 0.5) * (1.2 - 0.8 * s),
                             0.42 * trunk.radius(s),
                             0.008,
                             tree.random.range(0, 0.12)};
        tree.add_wood("branch_" + std::to_string(b + 1), branch, 12, 8, BARK);
        // As many boughs as bring all branches so far to their share.
        const int most = boughs * (b + 1) / branches - boughs * b / branches;
        for (int k = 0; k < most; k++) {
            const double t = 0.25 + 0.75 * (k + 0.6) / most;
            const Wood bough = {branch.at(t),
                                Tree::off(branch.heading_at(t), tree.random.range(0.6, 0.9), GOLDEN * k + b),
                                branch.length * tree.random.range(0.28, 0.36) * (1.2 - 0.5 * t),
                                0.011,
                                0.004,
                                tree.random.range(0, 0.1)};
            tree.add_wood("bough_" + std::to_string(++bough_count), bough, 8, 6, mix(BARK, TWIG, 0.5));
            for (int n = 0; n < TWIGS_A_BOUGH && twig_count < twigs; n++)
                tree.add_twig(++twig_count, bough, 0.12 + 0.88 * (n + 0.8) / TWIGS_A_BOUGH, GOLDEN * n + k);
        }
    }
    return tree.plant;
}

}  // namespace frond::grow
