// Materials: the defaults of every kind of organ, and the values that are refused.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "skeleton/organ.hpp"
#include "support/materials.hpp"

namespace frond {
namespace materials_tests {

const char* const KINDS[] = {"stem",   "petiole", "blade",   "midrib",  "peduncle",   "flower",      "fruit",
                             "branch", "root",    "tendril", "support", "grass_stem", "cereal_stem", "grass_blade"};

std::string refusal(const Material& material) {
    try {
        check_material(material, "leaf_7");
    } catch (const Error& error) {
        EXPECT_EQ(error.code, FROND_RESULT_BAD_ARGUMENT);
        return error.what();
    }
    return "";
}

struct Field {
    const char* name;
    double Material::*value;
    double least, most;
    bool or_zero;
};
const Field FIELDS[] = {{"density", &Material::density, 1, 2e4, false},
                        {"young", &Material::young, 1e3, 1e12, false},
                        {"poisson", &Material::poisson, 0, 0.499, true},
                        {"thickness", &Material::thickness, 1e-6, 1, false},
                        {"hollow", &Material::hollow, 0, 0.98, true},
                        {"twist_to_bend", &Material::twist_to_bend, 0.01, 100, true},
                        {"damping_ratio", &Material::damping_ratio, 0, 1, true},
                        {"friction", &Material::friction, 0, 100, true},
                        {"yield_strain", &Material::yield_strain, 1e-6, 10, true},
                        {"creep_rate", &Material::creep_rate, 0, 1e6, true},
                        {"strength", &Material::strength, 1, 1e12, true},
                        {"drag", &Material::drag, 0.01, 10, true},
                        {"midrib", &Material::midrib, 0, 0.5, true},
                        {"restitution", &Material::restitution, 0, 1, true}};

TEST(Materials, ArePresetForEveryKindAndInRange) {
    for (const char* kind : KINDS) {
        const Material* material = material_preset(kind);
        ASSERT_NE(material, nullptr) << kind;
        EXPECT_EQ(refusal(*material), "") << kind;
        EXPECT_NE(material_kinds().find(kind), std::string::npos);
    }
    EXPECT_EQ(material_preset("thorn"), nullptr);
    EXPECT_EQ(material_preset(""), nullptr);
}

// Stiffness and strength increase from petals to wood; materials that yield do so before they break, at strains that
// tissue can bear.
TEST(Materials, PresetsAreInPhysicalOrder) {
    const char* const rising[] = {"flower", "blade", "midrib", "petiole", "stem", "grass_stem", "branch", "support"};
    for (size_t i = 1; i < std::size(rising); i++) {
        const Material &softer = *material_preset(rising[i - 1]), &stiffer = *material_preset(rising[i]);
        EXPECT_LT(softer.young, stiffer.young) << rising[i];
        EXPECT_LT(softer.strength, stiffer.strength) << rising[i];
        EXPECT_GE(softer.damping_ratio, stiffer.damping_ratio) << rising[i];
    }
    for (const char* kind : KINDS) {
        const Material& material = *material_preset(kind);
        const double breaks = material.strength / material.young;
        EXPECT_GE(breaks, 0.01) << kind;
        EXPECT_LE(breaks, 0.1) << kind;
        EXPECT_LT(material.yield_strain, breaks) << kind;
        EXPECT_EQ(material.yield_strain > 0, material.creep_rate > 0) << kind;
        EXPECT_GE(material.density, 500) << kind;
        EXPECT_LE(material.density, 1100) << kind;
        EXPECT_GT(material.damping_ratio, 0) << kind;
        EXPECT_LE(material.damping_ratio, 0.15) << kind;
        EXPECT_GT(material.friction, 0) << kind;
        EXPECT_LE(material.friction, 1) << kind;
        // An axis never resists twist more than an isotropic one; blades are strips, whose torsion follows from that.
        if (material.twist_to_bend > 0) {
            EXPECT_GT(material.twist_to_bend, 1 + material.poisson) << kind;
        }
    }
    EXPECT_EQ(material_preset("blade")->twist_to_bend, 0);
    EXPECT_EQ(material_preset("grass_blade")->twist_to_bend, 0);
    for (const char* kind : KINDS)
        EXPECT_EQ(material_preset(kind)->midrib, std::string(kind).find("blade") == std::string::npos ? 0 : 0.05)
            << kind;
}

// A material consists of its numbers only, and all of them are checked.
TEST(Materials, EveryNumberHasARange) {
    EXPECT_EQ(std::size(FIELDS) * sizeof(double), sizeof(Material));
    const Material good = plain_material(1000, 1e8, 0.3, 1e-3);
    ASSERT_EQ(refusal(good), "");
    for (const Field& field : FIELDS) {
        const auto with = [&](double value) {
            Material material = good;
            material.*field.value = value;
            return refusal(material);
        };
        EXPECT_EQ(with(field.least), "") << field.name;
        EXPECT_EQ(with(field.most), "") << field.name;
        EXPECT_EQ(with(0).empty(), field.or_zero) << field.name;
        for (double bad : {-1.0, -1e-300, field.most * 1.001, double(NAN), double(INFINITY), -double(INFINITY)}) {
            const std::string text = with(bad);
            EXPECT_EQ(text.rfind(field.name, 0), 0u) << field.name << " " << bad << ": " << text;
            EXPECT_NE(text.find("leaf_7"), std::string::npos) << text;
        }
        EXPECT_EQ(with(0.5 * field.least).empty(), field.least == 0) << field.name;
    }
}

TEST(Materials, RefusalsNameTheValueAndTheRange) {
    Material material = plain_material(1000, 1e8, 0.3, 1e-3);
    material.hollow = 0.99;
    EXPECT_EQ(refusal(material), "hollow of organ \"leaf_7\" is 0.99; give a value from 0 to 0.98");
    material.hollow = 0;
    material.twist_to_bend = 200;
    EXPECT_EQ(refusal(material),
              "twist_to_bend of organ \"leaf_7\" is 200; give a value from 0.01 to 100, or 0 for none");
}

}  // namespace materials_tests

}  // namespace frond
