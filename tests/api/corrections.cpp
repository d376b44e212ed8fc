// Corrections of organs through the C API, and plants that cannot carry themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "support/stems.hpp"

namespace corrections_tests {

const std::string CORN = FROND_SOURCE_DIR "/tests/corpus/quaternius/Corn_1.glb";

struct Loaded {
    frond_result result = FROND_OK;
    frond_model_info info = {};
    std::map<std::string, std::string> kinds;  // by name of organ
};

Loaded load(const frond_model_def& def, const std::string& path = CORN) {
    Loaded loaded;
    frond_model model = {};
    loaded.result = frond_model_load(path.c_str(), &def, &model);
    if (loaded.result != FROND_OK) return loaded;
    EXPECT_EQ(frond_model_get_info(model, &loaded.info), FROND_OK);
    for (int i = 0; i < loaded.info.organ_count; i++) {
        frond_organ organ;
        EXPECT_EQ(frond_model_get_organ(model, i, &organ), FROND_OK);
        loaded.kinds[organ.name] = organ.kind;
    }
    frond_model_destroy(model);
    return loaded;
}

Loaded load_with(const frond_organ_correction& correction) {
    frond_model_def def = frond_default_model_def();
    def.corrections = &correction;
    def.correction_count = 1;
    return load(def);
}

bool error_names(const char* word) {
    return std::string(frond_last_error()).find(word) != std::string::npos;
}

// A tree of organs: by what they grow out of, all come down to the stem that stands on the ground.
TEST(Organs, KnowWhatTheyGrowOutOf) {
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    ASSERT_EQ(frond_model_load(CORN.c_str(), &def, &model), FROND_OK) << frond_last_error();
    frond_model_info info;
    ASSERT_EQ(frond_model_get_info(model, &info), FROND_OK);
    std::vector<frond_organ> organs(size_t(info.organ_count));
    for (int i = 0; i < info.organ_count; i++) ASSERT_EQ(frond_model_get_organ(model, i, &organs[size_t(i)]), FROND_OK);
    int standing = 0, steps = 0;
    for (const frond_organ& organ : organs) {
        standing += organ.parent < 0;
        if (organ.parent < 0) {
            EXPECT_STREQ(organ.kind, "stem");
        }
        const frond_organ* below = &organ;
        for (steps = 0; below->parent >= 0 && steps < info.organ_count; steps++) {
            ASSERT_LT(below->parent, info.organ_count);
            below = &organs[size_t(below->parent)];
        }
        EXPECT_EQ(below->parent, -1) << organ.name;
    }
    EXPECT_EQ(standing, 1);
    frond_model_destroy(model);
}

// By their sections the ears alone weighed more than this plant.
TEST(Organs, WeighTogetherWhatThePlantWeighs) {
    frond_model_def def = frond_default_model_def();
    def.allow_stiffening = INFINITY;
    frond_model model = {};
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/tests/corpus/quaternius/Corn_2.glb", &def, &model), FROND_OK);
    frond_model_info info;
    ASSERT_EQ(frond_model_get_info(model, &info), FROND_OK);
    double sum = 0;
    for (int i = 0; i < info.organ_count; i++) {
        frond_organ organ;
        ASSERT_EQ(frond_model_get_organ(model, i, &organ), FROND_OK);
        sum += organ.mass;
    }
    EXPECT_NEAR(sum, info.mass, 1e-9 * info.mass);
    frond_model_destroy(model);
}

TEST(Corrections, ChangeKindsAndLeaveOrgansOut) {
    const Loaded found = load(frond_default_model_def());
    ASSERT_EQ(found.kinds.at("blade_1"), "blade");
    EXPECT_EQ(load_with({"blade_1", "branch", nullptr, false, false}).kinds.at("blade_1"), "branch");
    // The presets of families are of kinds.
    EXPECT_EQ(load_with({"blade_1", "grass_stem", nullptr, false, false}).kinds.at("blade_1"), "stem");
    EXPECT_EQ(load_with({"blade_1", "cereal_stem", nullptr, false, false}).kinds.at("blade_1"), "stem");
    const Loaded less = load_with({"blade_1", nullptr, nullptr, false, true});
    EXPECT_EQ(less.info.organ_count, found.info.organ_count - 1);
    EXPECT_EQ(less.kinds.count("blade_1"), 0u);
    EXPECT_LT(less.info.triangle_count, found.info.triangle_count);
    EXPECT_LT(less.info.mass, found.info.mass);
}

TEST(Corrections, ChooseWhereThePlantStands) {
    const Loaded found = load(frond_default_model_def());
    ASSERT_EQ(found.kinds.count("blade_2"), 1u);
    // Held by a leaf, its chain begins there and is another one.
    const Loaded held = load_with({"blade_2", nullptr, nullptr, true, false});
    ASSERT_EQ(held.result, FROND_OK) << frond_last_error();
    EXPECT_NE(held.info.chain_length, found.info.chain_length);
}

TEST(Corrections, OfWhatIsNotThereAreRefused) {
    EXPECT_EQ(load_with({"pancake", nullptr, nullptr, false, false}).result, FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("pancake") && error_names("blade_1 (blade)")) << frond_last_error();
    EXPECT_EQ(load_with({"blade_1", "pancake", nullptr, false, false}).result, FROND_RESULT_BAD_ARGUMENT);
    EXPECT_TRUE(error_names("pancake") && error_names("petiole")) << frond_last_error();
    EXPECT_EQ(load_with({"blade_1", nullptr, "blade_1", false, false}).result, FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(load_with({nullptr, nullptr, nullptr, false, false}).result, FROND_RESULT_BAD_ARGUMENT);
    const frond_organ_correction correction = {"stem_0", "branch", nullptr, false, false};
    frond_model_def def = frond_default_model_def();
    def.corrections = &correction;
    def.correction_count = 1;
    const frond_stem stem = {-1, {0, 0, 0}, {0, 0.6, 0}, 0.012, 0.012};
    frond_model model;
    EXPECT_EQ(frond_model_from_stems(&stem, 1, &def, &model), FROND_RESULT_UNSUPPORTED);
}

TEST(Corrections, AreTakenFromAFileBesideTheMeshOrElsewhere) {
    const std::string folder = testing::TempDir() + "frond_corrections";
    std::filesystem::create_directories(folder);
    const std::string mesh = folder + "/corn.glb", beside = folder + "/corn.frond.json", other = folder + "/x.json";
    std::filesystem::copy_file(CORN, mesh, std::filesystem::copy_options::overwrite_existing);
    std::ofstream(beside) << R"({"organs": {"blade_1": {"kind": "branch"}}})";
    std::ofstream(other) << R"({"organs": {"blade_1": {"kind": "tendril"}}})";
    frond_model_def def = frond_default_model_def();
    EXPECT_EQ(load(def, mesh).kinds.at("blade_1"), "branch");
    def.corrections_file = other.c_str();
    EXPECT_EQ(load(def, mesh).kinds.at("blade_1"), "tendril");
    def.corrections_file = "";
    EXPECT_EQ(load(def, mesh).kinds.at("blade_1"), "blade");
    std::filesystem::remove_all(folder);
}

// A ball of lead on a straw.
TEST(Stiffening, NeedsConsent) {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.9, 0}, 0.004, 0.004}, {0, {0, 0.9, 0}, {0, 1.1, 0}, 0.05, 0.05}};
    frond_model_def def = frond_default_model_def();
    frond_model model = {};
    EXPECT_EQ(frond_model_from_stems(stems, 2, &def, &model), FROND_RESULT_BAD_GEOMETRY);
    EXPECT_TRUE(error_names("stem_0, a stem") && error_names("allow_stiffening is 3")) << frond_last_error();
    EXPECT_EQ(model.id, 0u);
    def.allow_stiffening = INFINITY;
    ASSERT_EQ(frond_model_from_stems(stems, 2, &def, &model), FROND_OK) << frond_last_error();
    frond_model_info info;
    frond_model_get_info(model, &info);
    EXPECT_GT(info.stiffening_factor, 10);
    frond_model_destroy(model);
    for (double wrong : {0.0, 0.5, -1.0, double(NAN)}) {
        def.allow_stiffening = wrong;
        EXPECT_EQ(frond_model_from_stems(stems, 2, &def, &model), FROND_RESULT_BAD_ARGUMENT);
    }
}

}  // namespace corrections_tests
