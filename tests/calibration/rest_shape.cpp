// The shape without gravity: weight bends it to the modelled shape, and organs that are too soft are identified.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibration.hpp"
#include "calibration/rest_system.hpp"
#include "mechanics/tet_element.hpp"
#include "modelling/build.hpp"
#include "support/model_def.hpp"

using namespace frond;
using frond::test::model_def;

namespace rest_shape_tests {

// Returns a thick stem with a long thin arm; `young` is Young's modulus.
std::shared_ptr<const Model> gallows(double young) {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.6, 0}, 0.02, 0.02},
                                {0, {0, 0.6, 0}, {0.7, 0.65, 0}, 0.004, 0.003}};
    frond_model_def def = model_def();
    frond_organ_material organ = {"stem", *material_preset("stem")};
    organ.material.young = young;
    def.organs = &organ;
    def.organ_count = 1;
    def.cage_size = 0.05;
    return build_from_stems(stems, 2, def);
}

struct EveryTets : testing::TestWithParam<std::tuple<frond_mechanics, int>> {
    const frond_mechanics which = std::get<0>(GetParam());
    const int order = std::get<1>(GetParam());
};
INSTANTIATE_TEST_SUITE_P(RestShape, EveryTets,
                         testing::Combine(testing::Values(FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL,
                                                          FROND_MECHANICS_TET_NEOHOOKEAN),
                                          testing::Values(1, 2)),
                         [](const auto& info) {
                             return std::string(mechanics(std::get<0>(info.param)).name) +
                                    (std::get<1>(info.param) == 1 ? "" : "_quadratic");
                         });

TEST_P(EveryTets, WeightBendsItToTheShapeThatWasModelled) {
    const auto model = gallows(2e8);
    ensure_rest_shape(*model, which, order);
    const VecX& rest = model->rest_shapes->positions[size_t(order - 1)][size_t(which)];
    ASSERT_GT(rest.size(), 0);
    const auto own = mechanics(which, order).make(*model, which);
    const TetElements& elements = static_cast<const TetElements&>(*own);
    const std::vector<uint8_t> held = with_middles(elements.nodes, model->root);
    const VecX force = unbalanced_force(elements, held, which, elements.modelled, GRAVITY);
    double weight = 0;
    for (size_t e = 0; e < elements.tets.size(); e++) weight += GRAVITY * elements.density[e] * elements.volume[e];
    EXPECT_LT(force.norm(), 1e-6 * weight);
    // The arm sags by more than its own thickness.
    EXPECT_GT((rest - elements.modelled).lpNorm<Eigen::Infinity>(), 0.01);
}

TEST_P(EveryTets, NewtonsMethodFindsItInAFewRounds) {
    if (which == FROND_MECHANICS_TET_LINEAR) GTEST_SKIP() << "swells where it turns far, so that whole moves overshoot";
    const auto model = gallows(2e8);
    ensure_rest_shape(*model, which, order);  // calibrates the moduli too
    TetElements elements = make_tet_elements(*model, nullptr, order);
    const std::vector<uint8_t> held = with_middles(elements.nodes, model->root);
    RestSystem system(elements, held);
    VecX rest = elements.modelled, move;
    std::vector<double> moves;
    for (int round = 0; round < 8; round++) {
        const VecX force = unbalanced_force(elements, held, which, elements.modelled, GRAVITY);
        ASSERT_TRUE(system.find_move(elements, which, elements.modelled, GRAVITY, force, move));
        rest += move;
        set_rest_positions(elements, rest);
        moves.push_back(move.lpNorm<Eigen::Infinity>());
    }
    EXPECT_GT(moves[0], 0.01);
    EXPECT_LT(moves[7], 1e-9);
}

// A heavy head on a thin neck on a thick foot: the neck has to be stiffened, not the head, whose weight bends it.
TEST(Strengthen, FindsTheOrganThatGivesWay) {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.4, 0}, 0.03, 0.03},
                                {0, {0, 0.4, 0}, {0, 0.9, 0}, 0.004, 0.004},
                                {1, {0, 0.9, 0}, {0, 1.0, 0}, 0.04, 0.04}};
    const auto model = build_from_stems(stems, 3, model_def());
    EXPECT_GT(model->stiffening_factor, 2);
    const Chain& chain = model->chain;
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        if (chain.nodes[i].parent < 0) continue;
        const double y = chain.nodes[i].position.y(), stiffer = model->organ_stiffer[size_t(chain.nodes[i].organ)];
        if (y > 0.45 && y < 0.85) {
            EXPECT_GT(stiffer, 2) << y;
        } else if (y > 0.95) {
            EXPECT_LT(stiffer, 1.1) << y;
        }
    }
}

// Returns a stem with two boughs.
std::vector<frond_stem> boughs() {
    return {{-1, {0, 0, 0}, {0, 0.5, 0}, 0.012, 0.01},
            {0, {0, 0.5, 0}, {0.05, 1, 0}, 0.01, 0.006},
            {0, {0, 0.5, 0}, {-0.4, 0.8, 0.1}, 0.008, 0.004}};
}

double largest_unbalance(const Model& model, frond_mechanics which) {
    const auto own = mechanics(which).make(model, which);
    const TetElements& elements = static_cast<const TetElements&>(*own);
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
    EXPECT_LT(model->stiffening_factor, 1.7);
    for (int which = 0; which < FROND_MECHANICS_ROD; which++) {
        ensure_rest_shape(*model, frond_mechanics(which), 1);
        ASSERT_GT(model->rest_shapes->positions[0][size_t(which)].size(), 0) << frond_mechanics(which);
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
    EXPECT_GT(model->stiffening_factor, 1);
    EXPECT_LT(largest_unbalance(*model, FROND_MECHANICS_TET_COROTATIONAL), 1e-6);
}

// Greenhill (1881): a column of weight w per length buckles above w L^3 / EI = 7.8373. The factor by which a softer
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
        // A given material becomes as stiff as it must be to stand, plus two per cent.
        EXPECT_NEAR(model->organ_stiffer.front(), std::max(1.0, 1.02 / share), 0.03 / share) << share;
    }
}

}  // namespace rest_shape_tests
