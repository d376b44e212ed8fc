// Plants from URDF files: links become organs, joints become the tree, and errors in a file are reported.
#include "support/urdf.hpp"

#include <cstring>
#include <vector>

namespace urdf_tests {

std::string file_of(const char* name) {
    return std::string(FROND_SOURCE_DIR "/models/urdf/") + name;
}

TEST(UrdfPlant, OfCylindersAndCapsulesHasTheirSections) {
    const Loaded sapling(file_of("sapling.urdf"));
    ASSERT_EQ(sapling.organs.size(), 5u);
    EXPECT_STREQ(sapling.organs.at("stem_low").kind, "branch");
    EXPECT_STREQ(sapling.organs.at("stem_top").kind, "stem");
    EXPECT_STREQ(sapling.organs.at("shoot_left").kind, "petiole");
    frond_material stem;
    ASSERT_EQ(frond_material_preset("stem", &stem), FROND_OK);
    EXPECT_EQ(sapling.organs.at("shoot_left").material.young, stem.young);
    const double pi = 3.14159265358979;
    EXPECT_NEAR(sapling.organs.at("stem_low").area.upper, pi * 0.008 * 0.008, 1e-12);
    EXPECT_NEAR(sapling.organs.at("shoot_right").area.lower, pi * 0.004 * 0.004, 1e-12);
    EXPECT_NEAR(sapling.organs.at("stem_low").length, 0.3, 1e-9);
    EXPECT_NEAR(sapling.info.chain_length, 0.3 + 0.25 + 0.2 + 0.2 + 0.16, 1e-9);
    EXPECT_EQ(sapling.info.root_count, 1);
    EXPECT_EQ(sapling.info.fork_count, 2);
    // +z of the file is up.
    EXPECT_NEAR(sapling.info.upper.y, 0.755, 1e-6);
    EXPECT_EQ(sapling.info.up.z, 1);
    EXPECT_LT(wandering(sapling.model, FROND_MECHANICS_ROD), 1e-4);
}

TEST(UrdfPlant, OfEveryShapeStands) {
    const Loaded seedling(file_of("seedling.urdf"));
    ASSERT_EQ(seedling.organs.size(), 5u);
    EXPECT_STREQ(seedling.organs.at("stem").kind, "stem");
    EXPECT_STREQ(seedling.organs.at("leaf_1").kind, "blade");
    EXPECT_STREQ(seedling.organs.at("berry").kind, "fruit");
    // The kind comes from the file, not from the name.
    EXPECT_STREQ(seedling.organs.at("part_7").kind, "blade");
    frond_material grass;
    ASSERT_EQ(frond_material_preset("grass_blade", &grass), FROND_OK);
    EXPECT_EQ(seedling.organs.at("part_7").material.young, grass.young);
    EXPECT_GT(seedling.info.upper.y, 0.5);
    EXPECT_EQ(seedling.info.contained, 1);
    EXPECT_LT(wandering(seedling.model, FROND_MECHANICS_ROD), 0.003);
    EXPECT_LT(wandering(seedling.model, FROND_MECHANICS_TET_COROTATIONAL), 0.003);
}

// Returns a leaf that its joint attaches to one stem and that all but touches another.
std::string two_stems(const char* parent) {
    return urdf_robot(urdf_link("ground", "") + urdf_stem("stem_a") + urdf_stem("stem_b") +
                      urdf_link("leaf", urdf_visual("<box size=\"0.15 0.04 0.002\"/>", "0.095 0 0")) +
                      urdf_joint("ground", "stem_a") + urdf_joint("ground", "stem_b", "0.2 0 0") +
                      (parent == std::string("stem_a") ? urdf_joint("stem_a", "leaf", "0 0 0.3")
                                                       : urdf_joint("stem_b", "leaf", "-0.2 0 0.3")));
}

// Returns the x coordinate of the stem to which the leaf's part of the chain is connected.
double x_of_leaf_foot(const Loaded& loaded) {
    frond_chain_view chain;
    EXPECT_EQ(frond_model_get_chain(loaded.model, &chain), FROND_OK);
    for (int i = 0; i < chain.node_count; i++) {
        const int parent = chain.parents[i];
        const double x = chain.nodes[3 * i];
        if (parent < 0 || x < 0.03 || x > 0.17) continue;
        const double before = chain.nodes[3 * parent];
        if (before < 0.03 || before > 0.17) return before;
    }
    return -1;
}

TEST(UrdfPlant, PiecesHangWhereTheirJointsAreNotWhereTheyAreNearest) {
    const UrdfFolder folder;
    const Loaded on_a(folder.write("a.urdf", two_stems("stem_a"))), on_b(folder.write("b.urdf", two_stems("stem_b")));
    EXPECT_NEAR(x_of_leaf_foot(on_a), 0, 0.03);
    EXPECT_NEAR(x_of_leaf_foot(on_b), 0.2, 0.03);
}

TEST(UrdfPlant, MeshesAreFoundByPackagePath) {
    const UrdfFolder folder;
    const std::string leaf = "v 0 0 0\nv 0.1 0 0\nv 0.1 0 0.1\nv 0 0 0.1\nf 1 2 3\nf 1 3 4\n";
    folder.write("elsewhere/plants/leaf.obj", leaf);
    const std::string file = folder.write(
        "p/deep/a.urdf",
        urdf_robot(urdf_stem() + urdf_link("leaf", urdf_visual("<mesh filename=\"package://plants/leaf.obj\"/>")) +
                   urdf_joint("stem", "leaf", "0 0 0.4")));
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    EXPECT_EQ(frond_model_load(file.c_str(), &def, &model), FROND_RESULT_FILE_NOT_FOUND);
    EXPECT_NE(std::strstr(frond_last_error(), "FROND_PACKAGE_PATH"), nullptr) << frond_last_error();
#ifdef _WIN32
    const std::string between = ";";
#else
    const std::string between = ":";
#endif
    set_environment("FROND_PACKAGE_PATH", ("/none" + between + folder.path + "/elsewhere").c_str());
    const Loaded found(file);
    set_environment("FROND_PACKAGE_PATH", nullptr);
    EXPECT_EQ(found.organs.size(), 2u);
    // Found beside the file's own folders.
    folder.write("p/plants/leaf.obj", leaf);
    EXPECT_EQ(Loaded(file).organs.size(), 2u);
}

struct Damage {
    const char* name;
    std::string text;
    const char* said;
};

std::string nested(int depth) {
    std::string text;
    for (int i = 0; i < depth; i++) text += "<a>";
    return text;
}

std::string long_chain(int count) {
    std::string text;
    for (int i = 0; i < count; i++) {
        text += "<link name=\"l" + std::to_string(i) + "\"/>";
        if (i > 0) text += urdf_joint("l" + std::to_string(i - 1), "l" + std::to_string(i));
    }
    return urdf_robot(text);
}

std::vector<Damage> damages() {
    const std::string leaf = urdf_link("leaf", urdf_visual("<box size=\"0.1 0.1 0.001\"/>"));
    const auto stem_of = [](const std::string& geometry) {
        return urdf_robot(urdf_link("stem", urdf_visual(geometry)));
    };
    return {
        {"no XML", "this is no XML", "XML"},
        {"cut", urdf_robot(urdf_stem()).substr(0, 120), "line"},
        {"SDF", "<sdf version=\"1.6\"><model name=\"x\"/></sdf>", "<sdf>"},
        {"no links", urdf_robot(""), "no links"},
        {"deep", "<robot name=\"r\">" + nested(40000), "nested too deeply"},
        {"too many links", long_chain(30000), "more than 20000 links"},
        {"xacro", "<robot name=\"r\" xmlns:xacro=\"x\"><xacro:include filename=\"a\"/></robot>", "xacro"},
        {"cycle", urdf_robot(urdf_stem() + leaf + urdf_joint("stem", "leaf") + urdf_joint("leaf", "stem")), "cycle"},
        {"cycle beside a root",
         urdf_robot(urdf_stem() + leaf + urdf_link("b", "") + urdf_joint("leaf", "b") + urdf_joint("b", "leaf")),
         "cycle"},
        {"two roots", urdf_robot(urdf_stem() + leaf), "both have no parent"},
        {"two parents",
         urdf_robot(urdf_stem() + leaf + urdf_link("b", "") + urdf_joint("stem", "leaf") + urdf_joint("stem", "b") +
                    urdf_joint("b", "leaf")),
         "second parent"},
        {"same name", urdf_robot(urdf_stem() + urdf_stem()), "two links"},
        {"ball joint", urdf_robot(urdf_stem() + leaf + urdf_joint("stem", "leaf", "0 0 0", "ball")), "type \"ball\""},
        {"no such link", urdf_robot(urdf_stem() + urdf_joint("stem", "twig")), "\"twig\""},
        {"nan", stem_of("<cylinder radius=\"nan\" length=\"1\"/>"), "decimal commas"},
        {"comma", stem_of("<capsule radius=\"0,01\" length=\"1\"/>"), "decimal commas"},
        {"negative radius", stem_of("<cylinder radius=\"-0.01\" length=\"1\"/>"), "size -0.01"},
        {"huge", stem_of("<sphere radius=\"1e308\"/>"), "size 1e+308"},
        {"no geometry", urdf_robot(urdf_link("stem", "<visual/>")), "cannot be read"},
        {"no axis",
         urdf_robot(urdf_stem() + leaf + urdf_joint("stem", "leaf", "0 0 0", "continuous", "<axis xyz=\"0 0 0\"/>")),
         "no axis"},
        {"nothing to see", urdf_robot(urdf_link("stem", "")), "none of the 1 links"},
        {"missing mesh", stem_of("<mesh filename=\"meshes/none.obj\"/>"), "meshes/none.obj was not found"},
        {"other mesh", stem_of("<mesh filename=\"x.blend\"/>"), "not found"},
        {"unknown organ",
         urdf_robot(urdf_link("stem", urdf_visual("<sphere radius=\"0.1\"/>") + "<frond organ=\"leg\"/>")),
         "no organ \"leg\""},
        {"unknown material",
         urdf_robot(urdf_link("stem", urdf_visual("<sphere radius=\"0.1\"/>") + "<frond material=\"tin\"/>")),
         "no material \"tin\""},
    };
}

TEST(UrdfPlant, WhatIsWrongWithAFileIsSaid) {
    const UrdfFolder folder;
    const frond_model_def def = frond_default_model_def();
    for (const Damage& damage : damages()) {
        const std::string file = folder.write("broken.urdf", damage.text);
        frond_model model = {7};
        const frond_result result = frond_model_load(file.c_str(), &def, &model);
        EXPECT_NE(result, FROND_OK) << damage.name;
        EXPECT_NE(result, FROND_RESULT_INTERNAL) << damage.name;
        EXPECT_EQ(model.id, 0u);
        EXPECT_NE(std::strstr(frond_last_error(), "broken.urdf"), nullptr) << damage.name << ": " << frond_last_error();
        EXPECT_NE(std::strstr(frond_last_error(), damage.said), nullptr) << damage.name << ": " << frond_last_error();
    }
}

}  // namespace urdf_tests
