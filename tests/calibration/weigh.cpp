// The cage weighs as much as the chain carries: the same organ by organ, with every mechanics.
#include <gtest/gtest.h>

#include <map>

#include "cage/tet_geometry.hpp"
#include "calibration/calibration.hpp"
#include "calibration/weigh.hpp"
#include "modelling/build.hpp"
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
// Expects the chain to have the mass of the tets, and its centre where theirs is.
void expect_same_centre(const Model& model) {
    constexpr double OFF = 0.02;  // over the plant's height: what a cage is to one side of its organs [-]
    Vec3 tets = Vec3::Zero(), chain = tets;
    double mass = 0;
    for (size_t e = 0; e < model.cage.tets.size(); e++) {
        const Tet& tet = model.cage.tets[e];
        for (int corner : tet)
            tets += model.tet_density[e] * tet_volume(model.cage.nodes, tet) / 4 * model.cage.nodes[size_t(corner)];
    }
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        EXPECT_GE(model.chain_mass[i], 0);
        mass += model.chain_mass[i];
        chain += model.chain_mass[i] * model.chain.nodes[i].position;
    }
    EXPECT_NEAR(mass, model.mass(), 1e-9 * model.mass());
    const double height = model.surface.upper().y() - model.surface.lower().y();
    EXPECT_LT((chain - tets).norm() / model.mass(), OFF * height);
}

// A square tower of one cube, cut into six tets, a layer.
TetMesh tower(int layers) {
    constexpr double WIDE = 0.1, HIGH = 1;  // [m]
    TetMesh mesh;
    mesh.regions = {"stem"};
    for (int layer = 0; layer <= layers; layer++)
        for (int corner = 0; corner < 4; corner++)
            mesh.nodes.push_back({WIDE * (corner % 2), HIGH * layer / layers, WIDE * (corner / 2)});
    for (int layer = 0; layer < layers; layer++)
        for (const Tet& tet :
             {Tet{0, 1, 3, 7}, Tet{0, 3, 2, 7}, Tet{0, 2, 6, 7}, Tet{0, 6, 4, 7}, Tet{0, 4, 5, 7}, Tet{0, 5, 1, 7}}) {
            Tet raised = tet;
            for (int& node : raised) node += 4 * layer;
            mesh.tets.push_back(raised);
            mesh.tet_region.push_back(0);
        }
    return mesh;
}

// A leaf of 5 by 20 cm, drawn with two faces `thickness` apart; the last of its twelve triangles may be missing.
Surface drawn_leaf(double thickness, bool whole) {
    Surface surface;
    for (int corner = 0; corner < 8; corner++)
        surface.positions.push_back({0.05 * (corner & 1), 0.2 * (corner >> 1 & 1), thickness * (corner >> 2)});
    surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                         {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    if (!whole) surface.triangles.pop_back();
    surface.parts.emplace_back();
    surface.parts[0].name = "leaf";
    surface.parts[0].triangle_count = int(surface.triangles.size());
    surface.normals.assign(surface.positions.size(), Vec3f::UnitZ());
    return surface;
}

TEST(Weigh, ALeafByItsFacesHoweverThickItWasDrawn) {
    frond_model_def def = model_def();
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    const Material& blade = *material_preset("blade");
    const double face = 0.05 * 0.2 * blade.thickness * blade.density;
    EXPECT_NEAR(build_from_surface(drawn_leaf(5e-4, true), def)->mass(), 0.05 * 0.2 * 5e-4 * blade.density,
                0.05 * face);
    for (const bool whole : {true, false})
        EXPECT_NEAR(build_from_surface(drawn_leaf(4e-3, whole), def)->mass(), 2 * face, 0.25 * face) << whole;
    // A leaf that is as thick as it was drawn.
    frond_organ_material given = {"leaf", blade};
    given.material.thickness = 4e-3;
    def.organs = &given;
    def.organ_count = 1;
    EXPECT_NEAR(build_from_surface(drawn_leaf(4e-3, true), def)->mass(), 0.05 * 0.2 * 4e-3 * blade.density,
                0.05 * face);
}

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

TEST_P(WeighedPlant, CarriesTheMassOfItsTetsWhereTheyAre) {
    expect_same_centre(*model);
}

TEST(WeighedTets, AreCarriedWhereTheyAreHoweverCoarse) {
    for (const int layers : {1, 2, 3, 6, 12}) {
        SCOPED_TRACE(layers);
        expect_same_centre(*build_from_tets(tower(layers), model_def()));
    }
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
