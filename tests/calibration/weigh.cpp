// The cage weighs as much as the chain carries: the same organ by organ, with every mechanics.
#include <gtest/gtest.h>

#include <map>

#include "cage/tet_geometry.hpp"
#include "calibration/calibration.hpp"
#include "calibration/weigh.hpp"
#include "solve/solve.hpp"
#include "support/model_def.hpp"

namespace frond::test {
namespace weigh_tests {

struct WeighedPlant : testing::TestWithParam<const char*> {
    std::shared_ptr<const Model> model = build_from_file(
        std::string(FROND_SOURCE_DIR) + "/models/" + GetParam() + "/" + GetParam() + ".obj", model_def());
    double tet_mass(size_t e) const {
        return model->tet_density[e] * tet_volume(model->cage.nodes, model->cage.tets[e]);
    }
};
INSTANTIATE_TEST_SUITE_P(Weigh, WeighedPlant, testing::Values("corn", "cucumber"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(WeighedPlant, HangsEachTetOnItsOwnOrgan) {
    std::vector<char> has_nodes(model->organs.size(), 0);
    for (const ChainNode& node : model->chain.nodes)
        if (node.organ >= 0) has_nodes[size_t(node.organ)] = 1;
    const std::vector<int> hangs = hang_tets(*model);
    ASSERT_EQ(hangs.size(), model->cage.tets.size());
    for (size_t e = 0; e < hangs.size(); e++) {
        const int organ = model->cage.tet_organ[e];
        if (!has_nodes[size_t(organ)]) continue;
        EXPECT_EQ(model->chain.nodes[size_t(hangs[e])].organ, organ) << "tet " << e;
    }
}

// An organ without chain nodes, such as a tie, hangs on others.
TEST_P(WeighedPlant, GivesOrgansOfTheChainTheMassOfTheirTets) {
    std::vector<double> tets(model->organs.size(), 0), chain(tets), borne(tets);
    const std::vector<int> hangs = hang_tets(*model);
    double whole = 0;
    for (size_t e = 0; e < hangs.size(); e++) {
        const size_t on = size_t(model->chain.nodes[size_t(hangs[e])].organ);
        tets[size_t(model->cage.tet_organ[e])] += tet_mass(e);
        if (on != size_t(model->cage.tet_organ[e])) borne[on] += tet_mass(e);
        whole += tet_mass(e);
    }
    double left_out = 0;
    for (size_t i = 0; i < model->chain.nodes.size(); i++)
        chain[size_t(model->chain.nodes[i].organ)] += model->chain_mass[i];
    for (size_t o = 0; o < tets.size(); o++) {
        EXPECT_NEAR(chain[o], chain[o] > 0 ? tets[o] + borne[o] : 0, 1e-9 * whole) << model->organs[o].name;
        if (chain[o] == 0) left_out += tets[o];
    }
    EXPECT_LT(left_out, 0.05 * whole);
}

TEST_P(WeighedPlant, WeighsTheSameInAllMechanics) {
    for (int which = 0; which < FROND_MECHANICS_COUNT; which++) {
        ensure_rest_shape(*model, frond_mechanics(which), 1);
        const auto system = make_system(model, frond_mechanics(which), FROND_MASS_LUMPED);
        EXPECT_NEAR(node_mass_of(*system).sum(), model->mass(), 0.01 * model->mass())
            << mechanics(frond_mechanics(which)).name;
    }
}

}  // namespace weigh_tests

}  // namespace frond::test
