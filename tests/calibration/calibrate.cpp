// A calibrated cage bends as a rod with the organ's true section does, and a plant stands as it was modelled.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/static_stiffness.hpp"
#include "modelling/build.hpp"
#include "support/model_def.hpp"

using namespace frond;
using frond::test::model_def;

// A straight stem, held at its beginning.
struct Stem {
    const char* name;
    Vec3 begin, end;
    double radius_begin, radius_end;
    double cell = 0;    // size of the cage's cells [m]; 0: Frond's choice
    double hollow = 0;  // hollow share of the radius
    double young = 1e9;
    int pieces = 1;  // parts in a row as which it is given
    static constexpr double DENSITY = 1000;

    double length() const { return (end - begin).norm(); }
    Vec3 axis() const { return (end - begin).normalized(); }
    Vec3 at(double s) const { return begin + s * (end - begin); }
    double radius(double s) const { return radius_begin + s * (radius_end - radius_begin); }
    double bending(double s) const {  // E I at a share of the length [N m^2]
        const double r = radius(s);
        return young * M_PI * std::pow(r, 4) / 4 * (1 - std::pow(hollow, 4));
    }
    double weight(double s) const {  // [kg/m]
        const double r = radius(s);
        return DENSITY * M_PI * r * r * (1 - hollow * hollow);
    }
};

static std::shared_ptr<const Model> build(const Stem& stem, frond_rest rest = FROND_REST_WITHOUT_GRAVITY) {
    std::vector<frond_stem> given;
    for (int i = 0; i < stem.pieces; i++) {
        const double from = double(i) / stem.pieces, to = double(i + 1) / stem.pieces;
        const Vec3 begin = stem.at(from), end = stem.at(to);
        given.push_back({i - 1,
                         {begin.x(), begin.y(), begin.z()},
                         {end.x(), end.y(), end.z()},
                         stem.radius(from),
                         stem.radius(to)});
    }
    frond_model_def def = model_def();
    frond_organ_material organ = {"stem", *material_preset("stem")};
    organ.material.young = stem.young;
    organ.material.density = Stem::DENSITY;
    organ.material.hollow = stem.hollow;
    organ.material.twist_to_bend = 0;
    def.organs = &organ;
    def.organ_count = 1;
    def.cage_size = stem.cell;
    def.rest = rest;
    return build_from_stems(given.data(), stem.pieces, def);
}

// Displacement of the end of a clamped beam under a force of one newton on it, and under its own weight, taken across
// at one m/s^2, by the beam formula [m].
struct BeamAnswer {
    double force = 0, weight = 0;
};
static BeamAnswer beam_answer(const Stem& stem) {
    constexpr int SLICES = 400;
    const double L = stem.length(), step = L / SLICES;
    BeamAnswer answer;
    double above = 0, moment = 0;  // weight and its moment beyond the slice, from the end down
    for (int i = SLICES; i-- > 0;) {
        const double s = (i + 0.5) / SLICES, arm = (1 - s) * L, w = stem.weight(s) * step;
        moment += above * step;
        above += w;
        answer.force += step * arm * arm / stem.bending(s);
        answer.weight += step * moment * arm / stem.bending(s);
    }
    return answer;
}

// A cage under small loads.
struct Cantilever {
    const Model& model;
    TetElements elements;
    StaticStiffness stiffness;
    VecX load, moved;

    explicit Cantilever(const Model& model)
        : model(model), elements(make_tet_elements(model)), stiffness(elements.pattern) {
        EXPECT_TRUE(stiffness.set(elements, model.root, FROND_MECHANICS_TET_LINEAR, Tangent::positive,
                                  elements.rest_positions));
        load = moved = VecX::Zero(elements.rest_positions.size());
    }
    void solve_load() {
        for (size_t i = 0; i < model.root.size(); i++)
            if (model.root[i]) point(load, int(i)).setZero();
        solve(stiffness.factor, load, moved);
    }
};

static size_t end_node(const Model& model) {
    size_t end = 0;
    for (size_t i = 0; i < model.chain.nodes.size(); i++)
        if (model.chain.nodes[i].distance > model.chain.nodes[end].distance) end = i;
    return end;
}

static void push_end(const Model& model, const Vec3& force, VecX& load) {
    const size_t end = end_node(model);
    for (size_t k = 0; k < 4; k++)
        point(load, model.cage.tets[size_t(model.chain_embedding.tet[end])][k]) +=
            model.chain_embedding.weights[end][k] * force;
}

static Vec3 end_of(const Model& model, const VecX& x) {
    const size_t end = end_node(model);
    Vec3 place = Vec3::Zero();
    for (size_t k = 0; k < 4; k++)
        place += model.chain_embedding.weights[end][k] *
                 point(x, model.cage.tets[size_t(model.chain_embedding.tet[end])][k]);
    return place;
}

static const Stem STEMS[] = {
    {"aspect_5", {0, 0, 0}, {0, 1, 0}, 0.1, 0.1},
    {"aspect_10", {0, 0, 0}, {0, 1, 0}, 0.05, 0.05},
    {"aspect_20", {0, 0, 0}, {0, 1, 0}, 0.025, 0.025},
    {"aspect_40", {0, 0, 0}, {0, 1, 0}, 0.0125, 0.0125},
    {"aspect_125", {0, 0, 0}, {0, 1, 0}, 0.004, 0.004},
    {"cells_of_3_cm", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0.03},
    {"cells_of_6_cm", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0.06},
    {"cells_of_10_cm", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0.1},
    {"five_cells", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0.2},
    {"tapered", {0, 0, 0}, {0, 1, 0}, 0.02, 0.008},
    {"tapered_in_coarse_cells", {0, 0, 0}, {0, 1, 0}, 0.02, 0.006, 0.06},
    {"tilted", {0.1, 0, 0}, {0.6, 0.7, 0.3}, 0.01, 0.01},
    {"nearly_level", {0, 0, 0}, {0.9, 0.3, 0.2}, 0.01, 0.01, 0.06},
    {"hollow", {0, 0, 0}, {0, 0.5, 0}, 0.01, 0.01, 0, 0.8},
    {"small", {0, 0, 0}, {0, 0.03, 0.01}, 0.0005, 0.0004},
    {"cells_as_long_as_thick", {0, 0, 0}, {0, 1, 0}, 0.05, 0.05, 0.1},
    {"cells_longer_than_thick", {0, 0, 0}, {0, 1, 0}, 0.04, 0.04, 0.13},
    {"cells_twice_as_long", {0, 0, 0}, {0, 1, 0}, 0.025, 0.025, 0.1},
    {"tilted_in_coarse_cells", {0.1, 0, 0}, {0.6, 0.7, 0.3}, 0.03, 0.03, 0.1},
    {"two_pieces", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0, 0, 1e9, 2},
    {"ten_pieces", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0, 0, 1e9, 10},
    {"ten_pieces_in_coarse_cells", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0.06, 0, 1e9, 10},
    {"tapered_in_five_pieces", {0, 0, 0}, {0, 1, 0}, 0.02, 0.008, 0, 0, 1e9, 5},
};

struct EveryStem : testing::TestWithParam<Stem> {};
INSTANTIATE_TEST_SUITE_P(Calibration, EveryStem, testing::ValuesIn(STEMS),
                         [](const auto& info) { return info.param.name; });

static void expect_to_bend(const Stem& stem, const Model& model) {
    const double wanted = beam_answer(stem).force;
    Cantilever cage(model);
    const Vec3 across = stem.axis().unitOrthogonal();
    for (int k = 0; k < 8; k++) {
        const Vec3 direction = Eigen::AngleAxisd(k * M_PI / 8, stem.axis()) * across;
        cage.load.setZero();
        push_end(model, direction, cage.load);
        cage.solve_load();
        EXPECT_LT((end_of(model, cage.moved) - wanted * direction).norm(), 0.05 * wanted) << "direction " << k;
    }
}

TEST_P(EveryStem, BendsAsTheBeamFormulaSaysInAllDirections) {
    expect_to_bend(GetParam(), *build(GetParam()));
}

TEST(Calibration, MakesAStemThatStandsBendAsTheBeamFormulaSays) {
    for (const Stem& stem : STEMS)
        if (stem.pieces > 1 || std::string(stem.name) == "aspect_40") {
            SCOPED_TRACE(stem.name);
            expect_to_bend(stem, *build(stem, FROND_REST_STANDS_AS_MODELLED));
        }
}

TEST_P(EveryStem, SagsUnderItsOwnWeightAsTheBeamFormulaSays) {
    const Stem& stem = GetParam();
    const auto model = build(stem);
    const double wanted = beam_answer(stem).weight;
    Cantilever cage(*model);
    const VecX masses = mechanics(FROND_MECHANICS_TET_LINEAR).masses(cage.elements, FROND_MASS_LUMPED).node;
    const Vec3 across = stem.axis().unitOrthogonal();
    for (int k = 0; k < 4; k++) {
        const Vec3 direction = Eigen::AngleAxisd(k * M_PI / 4, stem.axis()) * across;
        for (int i = 0; i < cage.elements.node_count; i++) point(cage.load, i) = masses[i] * direction;
        cage.solve_load();
        EXPECT_NEAR(end_of(*model, cage.moved).dot(direction), wanted, 0.05 * wanted) << "direction " << k;
    }
}

// Returns the first natural frequency by inverse iteration from a transverse displacement.
static double first_frequency(const Model& model, const Vec3& across) {
    Cantilever cage(model);
    const VecX masses = mechanics(FROND_MECHANICS_TET_LINEAR).masses(cage.elements, FROND_MASS_LUMPED).node;
    for (int i = 0; i < cage.elements.node_count; i++) point(cage.moved, i) = across;
    double square = 0;
    for (int round = 0; round < 12; round++) {
        for (int i = 0; i < cage.elements.node_count; i++) point(cage.load, i) = masses[i] * point(cage.moved, i);
        cage.solve_load();
        double kinetic = 0;
        for (int i = 0; i < cage.elements.node_count; i++) kinetic += masses[i] * point(cage.moved, i).squaredNorm();
        square = cage.load.dot(cage.moved) / kinetic;
        cage.moved /= std::sqrt(kinetic);
    }
    return std::sqrt(square) / (2 * M_PI);
}

TEST(Calibration, MakesAStemSwayAsTheBeamFormulaSays) {
    for (const Stem& stem : STEMS) {
        // Round ends add mass beyond the formula's length: four thirds of a radius.
        if (stem.radius_begin != stem.radius_end || stem.radius_begin > 0.06 * stem.length()) continue;
        const auto model = build(stem);
        const double wanted = std::pow(1.8751041, 2) / (2 * M_PI) *
                              std::sqrt(stem.bending(0) / (stem.weight(0) * std::pow(stem.length(), 4)));
        EXPECT_NEAR(first_frequency(*model, stem.axis().unitOrthogonal()), wanted, 0.05 * wanted) << stem.name;
    }
}

// Returns the rotation of the cage's upper end under a moment of one newton metre about the axis [rad].
static double twist(const Model& model, double length) {
    Cantilever cage(model);
    std::vector<int> end;
    for (size_t i = 0; i < model.cage.nodes.size(); i++)
        if (model.cage.nodes[i].y() > length) end.push_back(int(i));
    Vec3 centre = Vec3::Zero();
    for (int i : end) centre += model.cage.nodes[size_t(i)] / double(end.size());
    double inertia = 0, turn = 0;
    for (int i : end) {
        const Vec3 d = model.cage.nodes[size_t(i)] - centre;
        inertia += d.x() * d.x() + d.z() * d.z();
    }
    for (int i : end) point(cage.load, i) = Vec3::UnitY().cross(model.cage.nodes[size_t(i)] - centre) / inertia;
    cage.solve_load();
    for (int i : end)
        turn += Vec3::UnitY().cross(model.cage.nodes[size_t(i)] - centre).dot(point(cage.moved, i)) / inertia;
    return turn;
}

// Four-node tets resist twist more than bending, and calibration favours bending.
TEST(Calibration, LetsARoundStemTwist) {
    for (const Stem& stem : STEMS) {
        if (stem.radius_begin != stem.radius_end || stem.axis() != Vec3(Vec3::UnitY())) continue;
        const double shear = stem.young / (2 * (1 + material_preset("stem")->poisson));
        const double wanted = stem.length() / (shear * 2 * stem.bending(0) / stem.young);
        const double share = twist(*build(stem), stem.length()) / wanted;
        EXPECT_GT(share, 0.5) << stem.name;
        EXPECT_LT(share, 1.1) << stem.name;
    }
}

// Returns the position of the end under a force of constant direction, raised in steps, by Newton's method.
static Vec3 pulled_end(const Model& model, frond_mechanics which, const Vec3& force) {
    constexpr int STEPS = 10, MOST_ROUNDS = 100;
    Cantilever cage(model);
    VecX x = cage.elements.rest_positions;
    for (int step = 1; step <= STEPS; step++)
        for (int round = 0; round < MOST_ROUNDS; round++) {
            cage.load.setZero();
            push_end(model, force * step / STEPS, cage.load);
            mechanics(which).add_force(cage.elements, x, cage.load);
            EXPECT_TRUE(cage.stiffness.set(cage.elements, model.root, which, Tangent::positive, x));
            cage.solve_load();
            x += cage.moved;
            if (cage.moved.lpNorm<Eigen::Infinity>() < 1e-7) break;
        }
    return end_of(model, x);
}

// Bisshopp and Drucker (1945): under P L^2 / EI = 1 the end of a level cantilever sinks by 0.30172 of its length and
// moves towards the clamp by 0.05643.
TEST(Calibration, HoldsUnderALargeLoad) {
    for (const Stem& stem : {STEMS[1], STEMS[3], STEMS[6], STEMS[7], STEMS[11]}) {
        const auto model = build(stem);
        const Vec3 across = stem.axis().unitOrthogonal();
        const double L = stem.length();
        const Vec3 start = model->chain.nodes[end_node(*model)].position;
        for (const Vec3& direction : {across, Vec3(stem.axis().cross(across))}) {
            const Vec3 end =
                pulled_end(*model, FROND_MECHANICS_TET_COROTATIONAL, stem.bending(0) / (L * L) * direction) - start;
            const Vec3 wanted = L * (0.30172 * direction - 0.05643 * stem.axis());
            EXPECT_LT((end - wanted).norm(), 0.05 * wanted.norm()) << stem.name;
        }
    }
}

TEST(Calibration, MakesAStemWeighWhatItsTissueWeighs) {
    const auto model = build({"stem", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0.06});
    const double tissue = Stem::DENSITY * M_PI * 1e-4;
    EXPECT_NEAR(model->mass(), tissue, 1e-9 * tissue);
}

TEST(Calibration, ScalesWithTheMaterial) {
    Stem stem = {"stem", {0, 0, 0}, {0, 1, 0}, 0.01, 0.01, 0.06};
    stem.young = 1e8;
    const auto soft = build(stem);
    stem.young = 1e10;
    const auto stiff = build(stem);
    for (size_t e = 0; e < soft->tet_young.size(); e++)
        EXPECT_NEAR(stiff->tet_young[e] / soft->tet_young[e], 100, 1e-3);
}
