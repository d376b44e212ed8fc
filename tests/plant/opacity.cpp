// A leaf that is drawn as a card, with a picture that cuts most of it out, weighs, bends and catches the wind as what
// is left of it.
#include <gtest/gtest.h>

#include "io/import_files.hpp"
#include "modelling/build.hpp"
#include "plant/air.hpp"
#include "support/model_def.hpp"

namespace frond::test {
namespace opacity_tests {

struct Leaf {
    double mass, stiffness, area;  // [kg], EI [N m^2], in the wind [m^2]
    double opacity;                // [-]
    double whole;                  // mass of the plant [kg]
    std::string why;
};

Leaf leaf_cut_from(int column) {
    files::Folder folder;
    folder.write("plant.mtl", "newmtl green\nmap_Kd leaf.tga\n");
    folder.write("leaf.tga", files::tga_cut_from(column));
    std::string text = files::obj(false, "plant.mtl");
    for (const char* name : {"o stem", "o leaf"})
        text.replace(text.find(name), 6, "o mesh");  // names that tell nothing
    const auto model = build_from_file(folder.write("plant.obj", text), model_def());
    Leaf leaf = {};
    leaf.whole = model->mass();
    for (size_t o = 0; o < model->organs.size(); o++) {
        if (model->organs[o].kind != "blade") continue;
        leaf.mass += model->organ_mass[o];
        leaf.why = model->organs[o].why;
        leaf.opacity = model->organs[o].opacity;
    }
    for (size_t i = 0; i < model->chain.nodes.size(); i++) {
        const ChainNode& node = model->chain.nodes[i];
        if (node.parent >= 0 && model->organs[size_t(node.organ)].kind == "blade")
            leaf.stiffness += model->sections[i].bending_thin();
    }
    for (const AirPiece& piece : make_air_pieces(*model))
        if (piece.shape == AirShape::SHEET) leaf.area += piece.area.y();
    return leaf;
}

TEST(Opacity, ALeafWeighsBendsAndCatchesWindAsWhatItsPictureLeaves) {
    const Leaf whole = leaf_cut_from(8);
    ASSERT_GT(whole.mass, 0);
    for (const int column : {6, 4, 2}) {
        const Leaf cut = leaf_cut_from(column);
        EXPECT_NEAR(cut.opacity, column / 8.0, 0.05);
        EXPECT_NEAR(cut.mass / whole.mass, cut.opacity, 0.01);
        EXPECT_NEAR(cut.stiffness / whole.stiffness, cut.opacity, 1e-6);
        EXPECT_NEAR(cut.area / whole.area, cut.opacity, 1e-6);
        EXPECT_NEAR(whole.whole - cut.whole, whole.mass - cut.mass, 0.05 * whole.mass) << "the stem is as it was";
        EXPECT_NE(cut.why.find("cuts out"), std::string::npos) << cut.why;
    }
    EXPECT_EQ(whole.opacity, 1);
    EXPECT_EQ(whole.why.find("cuts out"), std::string::npos) << whole.why;
}

}  // namespace opacity_tests
}  // namespace frond::test
