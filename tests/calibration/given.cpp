// What a caller gives of a material counts as given, and nothing else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/import.hpp"
#include "modelling/build.hpp"
#include "support/model_def.hpp"
#include "support/narrow_leaf.hpp"

namespace frond::test {

// A slender pole, which gets a margin.
static Surface pole() {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.9, 0}, 0.006, 0.005}};
    return surface_from_stems(stems, 1);
}

static std::shared_ptr<const Model> build(const Surface& surface, const std::string& kind, const Material* material) {
    Surface named = surface;
    named.parts[0].name = named.parts[0].material = kind;
    const frond_organ_material given = {kind.c_str(), material ? *material : Material()};
    frond_model_def def = model_def();
    def.organs = &given;
    def.organ_count = material ? 1 : 0;
    return build_from_surface(named, def);
}

static void expect_same_body(const Model& a, const Model& b) {
    ASSERT_EQ(a.sections.size(), b.sections.size());
    for (size_t i = 0; i < a.sections.size(); i++) {
        const Section &one = a.sections[i], &other = b.sections[i];
        EXPECT_EQ(one.bending_thin(), other.bending_thin());
        EXPECT_EQ(one.bending_wide(), other.bending_wide());
        EXPECT_EQ(one.twisting(), other.twisting());
        EXPECT_EQ(one.stretching(), other.stretching());
        EXPECT_EQ(one.mass(), other.mass());
    }
    EXPECT_EQ(a.organ_stiffer, b.organ_stiffer);
    EXPECT_EQ(a.chain_mass, b.chain_mass);
    EXPECT_EQ(a.tet_young, b.tet_young);
    EXPECT_EQ(a.tet_density, b.tet_density);
    EXPECT_EQ(a.surface.positions, b.surface.positions);
    EXPECT_EQ(a.cage.nodes, b.cage.nodes);
    const auto &rest = a.rest_shapes->positions[0][FROND_MECHANICS_TET_COROTATIONAL],
               &other = b.rest_shapes->positions[0][FROND_MECHANICS_TET_COROTATIONAL];
    EXPECT_TRUE(rest.size() == other.size() && rest == other);
}

static void change_what_bears_nothing(Material& material) {
    material.friction += 0.1;
    material.damping_ratio *= 0.5;
    material.yield_strain = 0.011;
    material.creep_rate = 2e-3;
    material.strength = 3e6;
    material.drag = 1.5;
    material.restitution = 0.25;
}

TEST(Given, WhatBearsNothingChangesNoModulusMassOrShape) {
    for (const char* kind : {"stem", "petiole", "blade", "midrib", "peduncle", "flower", "fruit", "branch", "root",
                             "tendril", "crown", "support"})
        for (const Surface& surface : {narrow_leaf(), pole()}) {
            SCOPED_TRACE(kind);
            const auto chosen = build(surface, kind, nullptr);
            Material material = chosen->organs[0].material;
            change_what_bears_nothing(material);
            expect_same_body(*chosen, *build(surface, kind, &material));
        }
}

// The wheat's culms have a margin.
TEST(Given, FrictionOfOneKindOfAPlantChangesNoModulus) {
    const std::string file = FROND_SOURCE_DIR "/models/wheat/wheat.obj";
    const auto chosen = build_from_file(file, model_def());
    ASSERT_GT(chosen->stiffening_factor, 1.1);
    std::string kind;
    for (const Organ& organ : chosen->organs) {
        if (organ.kind == kind) continue;
        kind = organ.kind;
        frond_organ_material given = {kind.c_str(), organ.material};
        given.material.friction = 0.9;
        frond_model_def def = model_def();
        def.organs = &given;
        def.organ_count = 1;
        SCOPED_TRACE(kind);
        expect_same_body(*chosen, *build_from_file(file, def));
    }
}

TEST(Given, FrictionInAFileOfCorrectionsChangesNoModulus) {
    const std::string file = FROND_SOURCE_DIR "/models/wheat/wheat.obj";
    const auto chosen = build_from_file(file, model_def());
    const std::string beside = testing::TempDir() + "frond_given.frond.json";
    const auto build_with = [&](const char* number) {
        std::ofstream(beside) << R"({"organs": {")" << chosen->organs[0].name << R"(": {"material": {)" << number
                              << "}}}}";
        frond_model_def def = model_def();
        def.corrections_file = beside.c_str();
        return build_from_file(file, def);
    };
    const auto rubbed = build_with(R"("friction": 0.9)");
    EXPECT_EQ(rubbed->organs[0].material.friction, 0.9);
    expect_same_body(*chosen, *rubbed);
    // A number that a file names is given even if Frond would have chosen it.
    const double young = chosen->organs[0].material.young;
    EXPECT_TRUE(build_with(("\"young\": " + std::to_string(young)).c_str())->organs[0].young_given);
    std::filesystem::remove(beside);
}

// A modulus is used as it is given, in its own organ alone: the other of two poles keeps its margin.
TEST(Given, AModulusTakesTheMarginFromItsOwnOrganAlone) {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.9, 0}, 0.0045, 0.0045},
                                {-1, {0.5, 0, 0}, {0.5, 0.9, 0}, 0.0045, 0.0045}};
    Surface poles = surface_from_stems(stems, 2);
    for (const int i : {0, 1}) poles.parts[size_t(i)].name = poles.parts[size_t(i)].material = i ? "branch" : "stem";
    const frond_organ_material given = {"branch", {950, 4e9, 0.35, 3e-3, 0, 7, 0.03, 0.5, 0, 0, 0, 0, 0, 0}};
    frond_model_def def = model_def();
    const auto chosen = build_from_surface(poles, def);
    def.organs = &given;
    def.organ_count = 1;
    const auto measured = build_from_surface(poles, def);
    size_t stem = 0;
    while (chosen->organs[stem].kind != "stem") stem++;
    EXPECT_GT(chosen->organ_stiffer[stem], 1.1);
    EXPECT_EQ(measured->organ_stiffer[1 - stem], 1);
    EXPECT_NEAR(measured->organ_stiffer[stem], chosen->organ_stiffer[stem], 0.03 * chosen->organ_stiffer[stem]);
    for (size_t e = 0; e < chosen->tet_young.size(); e++) {
        if (size_t(chosen->cage.tet_organ[e]) != stem) continue;
        EXPECT_NEAR(measured->tet_young[e], chosen->tet_young[e], 0.05 * chosen->tet_young[e]);
    }
}

}  // namespace frond::test
