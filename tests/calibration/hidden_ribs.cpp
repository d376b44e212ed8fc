// Leaves that a bare sheet would not carry get a midrib.
#include <gtest/gtest.h>

#include <algorithm>

#include "modelling/build.hpp"
#include "support/model_def.hpp"
#include "support/narrow_leaf.hpp"

namespace frond::test {

TEST(HiddenRibs, CarryALeafThatIsNarrowAtItsBase) {
    const auto model = build_from_surface(narrow_leaf(), model_def());
    EXPECT_LE(model->organ_stiffer[0], 3);
    frond_organ_material given = {"leaf", *material_preset("blade")};
    frond_model_def def = model_def();
    def.organs = &given;
    def.organ_count = 1;
    // A midrib or modulus that the caller gives is taken as it is.
    for (double Material::*field : {&Material::midrib, &Material::young}) {
        given.material = *material_preset("blade");
        given.material.*field *= 0.99;
        EXPECT_GT(build_from_surface(narrow_leaf(), def)->organ_stiffer[0], 4);
    }
    // The rib is thickest at the base.
    const auto thickest = [](const Model& one) {
        size_t best = 0;
        for (size_t i = 0; i < one.sections.size(); i++)
            if (one.chain.nodes[i].parent >= 0 && one.sections[i].bending_thin() > one.sections[best].bending_thin())
                best = i;
        return one.chain.nodes[best].position.y();
    };
    EXPECT_LT(thickest(*model), 0.3);
}

// A tree whose twigs are drawn thinner than their leaves ask is not made stiffer as a whole.
TEST(HiddenRibs, CarryATwigThatIsDrawnToAPoint) {
    const frond_stem drawn[] = {{-1, {0, 0, 0}, {0, 1, 0}, 0.03, 0.02}, {0, {0, 1, 0}, {0, 1.5, 0.3}, 0.004, 1e-4}};
    Surface tree = surface_from_stems(drawn, 2);
    for (Part& part : tree.parts) part.name = "branch";
    const Surface leaf = narrow_leaf();
    for (int k = 0; k < 8; k++) {
        Part part = leaf.parts[0];
        part.first_triangle = int(tree.triangles.size());
        tree.parts.push_back(part);
        const int first = int(tree.positions.size());
        const Eigen::AngleAxisd turn(k * M_PI / 4, Vec3::UnitY());
        for (const Vec3& place : leaf.positions) tree.positions.push_back(Vec3(0, 1.5, 0.3) + turn * place);
        for (const Triangle& t : leaf.triangles) tree.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    tree.normals.clear();
    tree.uvs.clear();
    tree.colors.clear();
    const auto model = build_from_surface(tree, model_def());
    EXPECT_LE(model->stiffening_factor, 3);
    // Its trunk is no stiffer than it is drawn.
    EXPECT_NEAR(model->sections[1].inertia_thin / (M_PI / 4 * std::pow(0.03, 4)), 0.9, 0.15);
}

// The branches of corn's tassel bear spikelets to their tips, which are drawn as points.
TEST(HiddenRibs, CarryTheTipsOfATassel) {
    const auto model = build_from_file(FROND_SOURCE_DIR "/models/corn/corn.obj", model_def());
    const auto tassel = std::find_if(model->organs.begin(), model->organs.end(),
                                     [](const Organ& organ) { return organ.kind == "peduncle"; });
    ASSERT_NE(tassel, model->organs.end());
    EXPECT_LE(model->organ_stiffer[size_t(tassel - model->organs.begin())], 3);
}

}  // namespace frond::test
