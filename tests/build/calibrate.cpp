// A cage bends as the rod with the organ's true section does, and a plant stands as it was modelled.
#include <gtest/gtest.h>

#include <cmath>

#include "build/build.hpp"
#include "build/static_stiffness.hpp"

using namespace frond;

static frond_model_def model_def() {
    frond_model_def def = {};
    def.cage_smoothness = CageOptions().smoothness;
    def.scale = 1;
    def.up = {0, 1, 0};
    return def;
}

static std::shared_ptr<const Model> upright_stem(double length, double radius, double young, double cell) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, length, 0}, radius, radius};
    frond_model_def def = model_def();
    frond_organ_material organ = {"stem", *material_preset("stem")};
    organ.material.young = young;
    def.organs = &organ;
    def.organ_count = 1;
    def.cage_size = cell;
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    return build_from_stems(&stem, 1, def);
}

// Deflection of the cage's top under a sideways force of one newton there, by the cage's own linear stiffness.
struct Deflection {
    double top;  // height of the force [m]
    double move;
};
static Deflection tip_deflection(const Model& model, int axis) {
    const TetElements elements = make_tet_elements(model);
    StaticStiffness stiffness(elements.pattern);
    EXPECT_TRUE(stiffness.set(elements, model.root, FROND_TET_LINEAR, Tangent::positive, elements.rest_positions));
    double top = -INFINITY;
    for (const Vec3& node : model.cage.nodes) top = std::max(top, node.y());
    std::vector<int> tip;
    for (size_t i = 0; i < model.cage.nodes.size(); i++)
        if (model.cage.nodes[i].y() > top - 0.01) tip.push_back(int(i));
    VecX load = VecX::Zero(elements.rest_positions.size()), u(load.size());
    for (int i : tip) load[3 * i + axis] += 1.0 / double(tip.size());
    solve(*stiffness.factor, load, u);
    Deflection sum = {0, 0};
    for (int i : tip) {
        sum.top += model.cage.nodes[size_t(i)].y() / double(tip.size());
        sum.move += u[3 * i + axis] / double(tip.size());
    }
    return sum;
}

TEST(Calibration, MakesAStemBendAsTheBeamFormulaSays) {
    const double length = 1, radius = 0.01, young = 1e9;
    const double bending = young * M_PI * std::pow(radius, 4) / 4;
    // The cage reaches beyond the stem; what is beyond turns with its end.
    const auto over_beam = [&](const Deflection& cage) {
        const double d = cage.top - length;
        return cage.move * bending / (std::pow(length, 3) / 3 + d * length * length + d * d * length);
    };
    for (double cell : {0.03, 0.06, 0.1}) {
        const auto model = upright_stem(length, radius, young, cell);
        // The lattice is not equally stiff in all directions: the mean is what one modulus can set.
        const double x = over_beam(tip_deflection(*model, 0)), z = over_beam(tip_deflection(*model, 2));
        EXPECT_NEAR((x + z) / 2, 1, 0.1) << "cell " << cell;
        EXPECT_NEAR(x, 1, 0.16) << "cell " << cell;
        EXPECT_NEAR(z, 1, 0.16) << "cell " << cell;
    }
}

TEST(Calibration, MakesAStemWeighWhatItsTissueWeighs) {
    const auto model = upright_stem(1, 0.01, 1e9, 0.06);
    const double tissue = material_preset("stem")->density * M_PI * 1e-4;
    EXPECT_NEAR(model->mass(), tissue, 1e-9 * tissue);
}

TEST(Calibration, ScalesWithTheMaterial) {
    const auto soft = upright_stem(1, 0.01, 1e8, 0.06), stiff = upright_stem(1, 0.01, 1e10, 0.06);
    EXPECT_NEAR(tip_deflection(*soft, 0).move / tip_deflection(*stiff, 0).move, 100, 1e-3);
}

// A stem with two boughs.
static std::vector<frond_stem> boughs() {
    return {{-1, {0, 0, 0}, {0, 0.5, 0}, 0.012, 0.01},
            {0, {0, 0.5, 0}, {0.05, 1, 0}, 0.01, 0.006},
            {0, {0, 0.5, 0}, {-0.4, 0.8, 0.1}, 0.008, 0.004}};
}

static double largest_unbalance(const Model& model, frond_mechanics which) {
    const TetElements elements = make_tet_elements(model, &model.rest_shapes->positions[size_t(which)]);
    VecX x(elements.rest_positions.size()), f = VecX::Zero(x.size());
    for (size_t i = 0; i < model.cage.nodes.size(); i++) point(x, int(i)) = model.cage.nodes[i];
    double weight = 0;
    for (size_t e = 0; e < elements.tets.size(); e++)
        for (int corner : elements.tets[e]) {
            f[3 * corner + 1] -= 9.81 * elements.density[e] * elements.volume[e] / 4;
            weight += 9.81 * elements.density[e] * elements.volume[e] / 4;
        }
    mechanics(which).add_force(elements, x, f);
    double largest = 0;
    for (size_t i = 0; i < model.root.size(); i++)
        if (!model.root[i]) largest = std::max(largest, point(f, int(i)).norm());
    return largest / weight;
}

TEST(RestShape, BalancesWeightInTheModelledShapeForEveryMechanics) {
    const std::vector<frond_stem> stems = boughs();
    const auto model = build_from_stems(stems.data(), int(stems.size()), model_def());
    EXPECT_LT(model->stiffened, 1.7);
    for (int which = 0; which <= FROND_TET_NEOHOOKEAN; which++) {
        ensure_rest_shape(*model, frond_mechanics(which));
        ASSERT_GT(model->rest_shapes->positions[size_t(which)].size(), 0) << frond_mechanics(which);
        EXPECT_LT(largest_unbalance(*model, frond_mechanics(which)), 1e-6) << frond_mechanics(which);
    }
}

TEST(RestShape, StiffensAPlantThatCannotCarryItselfAndSaysSo) {
    std::vector<frond_stem> stems = boughs();
    frond_model_def def = model_def();
    frond_organ_material organ = {"stem", *material_preset("stem")};
    organ.material.young = 1e5;
    def.organs = &organ;
    def.organ_count = 1;
    const auto model = build_from_stems(stems.data(), int(stems.size()), def);
    EXPECT_GT(model->stiffened, 1);
    EXPECT_LT(largest_unbalance(*model, FROND_TET_COROTATIONAL), 1e-6);
}

// Greenhill (1881): a column of weight w per length topples above w L^3 / EI = 7.8373. The factor by which a softer
// column is stiffened must bring it to that limit, to the step of the search and the tolerance of the calibration.
TEST(RestShape, FindsGreenhillsLimit) {
    const double length = 1, radius = 0.01;
    const double inertia = M_PI * std::pow(radius, 4) / 4;
    const double weight = material_preset("stem")->density * M_PI * radius * radius * 9.81;
    const double limit = weight * std::pow(length, 3) / (7.8373 * inertia);  // Young's modulus [Pa]
    for (double share : {0.3, 3.0}) {
        const frond_stem stem = {-1, {0, 0, 0}, {0, length, 0}, radius, radius};
        frond_model_def def = model_def();
        frond_organ_material organ = {"stem", *material_preset("stem")};
        organ.material.young = share * limit;
        def.organs = &organ;
        def.organ_count = 1;
        const auto model = build_from_stems(&stem, 1, def);
        // A given material gets what it needs to stand and two per cent.
        EXPECT_NEAR(model->organ_stiffer.front(), std::max(1.0, 1.02 / share), 0.03 / share) << share;
    }
}
