// A plant written as URDF is the same plant when it is read back.
#include "frond/frond_robot.h"
#include "support/urdf.hpp"

TEST(WrittenUrdf, IsTheSamePlantWhenItIsReadAgain) {
    const UrdfFolder folder;
    const frond_model_def def = frond_default_model_def();
    frond_model corn = {};
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &def, &corn), FROND_OK) << frond_last_error();
    frond_model_info info;
    ASSERT_EQ(frond_model_get_info(corn, &info), FROND_OK);
    const std::string file = folder.path + "/corn.urdf";
    ASSERT_EQ(frond_model_write_urdf(corn, file.c_str()), FROND_OK) << frond_last_error();
    const Loaded again(file);
    EXPECT_NEAR(again.info.chain_length, info.chain_length, 1e-4 * info.chain_length);
    EXPECT_NEAR(again.info.mass, info.mass, 1e-4 * info.mass);
    EXPECT_EQ(again.info.capsule_count, info.capsule_count);
    double of_organs = 0;
    int compared = 0;
    for (int i = 0; i < info.organ_count; i++) {
        frond_organ organ;
        ASSERT_EQ(frond_model_get_organ(corn, i, &organ), FROND_OK);
        if (organ.capsule_count == 0) continue;
        ASSERT_EQ(again.organs.count(organ.name), 1u) << organ.name;
        const frond_organ& other = again.organs.at(organ.name);
        EXPECT_STREQ(other.kind, organ.kind);
        of_organs += other.mass;
        EXPECT_NEAR(other.bending_thin.lower, organ.bending_thin.lower, 1e-4 * organ.bending_thin.lower) << organ.name;
        EXPECT_NEAR(other.bending_wide.upper, organ.bending_wide.upper, 1e-4 * organ.bending_wide.upper) << organ.name;
        EXPECT_NEAR(other.torsion.upper, organ.torsion.upper, 1e-4 * organ.torsion.upper) << organ.name;
        compared++;
    }
    EXPECT_GT(compared, 5);
    EXPECT_NEAR(of_organs, info.mass, 1e-4 * info.mass);
    EXPECT_LT(wandering(again.model, FROND_MECHANICS_ROD), 0.003);
    EXPECT_EQ(frond_model_write_urdf(corn, "/none/corn.urdf"), FROND_RESULT_FILE_NOT_FOUND);
    EXPECT_EQ(frond_model_write_urdf({}, file.c_str()), FROND_RESULT_BAD_HANDLE);
    frond_model_destroy(corn);
}

// A culm's strength and damping are its material's, which the file names.
TEST(WrittenUrdf, NamesTheMaterialsOfFamilies) {
    const UrdfFolder folder;
    const frond_model_def def = frond_default_model_def();
    frond_model wheat = {};
    ASSERT_EQ(frond_model_load(FROND_SOURCE_DIR "/models/wheat/wheat.obj", &def, &wheat), FROND_OK)
        << frond_last_error();
    frond_model_info info;
    ASSERT_EQ(frond_model_get_info(wheat, &info), FROND_OK);
    const std::string file = folder.path + "/wheat.urdf";
    ASSERT_EQ(frond_model_write_urdf(wheat, file.c_str()), FROND_OK) << frond_last_error();
    const Loaded again(file);
    int culms = 0;
    for (int i = 0; i < info.organ_count; i++) {
        frond_organ organ;
        ASSERT_EQ(frond_model_get_organ(wheat, i, &organ), FROND_OK);
        if (organ.capsule_count == 0) continue;
        const frond_material& other = again.organs.at(organ.name).material;
        EXPECT_EQ(other.strength, organ.material.strength) << organ.name;
        EXPECT_EQ(other.damping_ratio, organ.material.damping_ratio) << organ.name;
        culms += std::string(organ.kind) == "stem";
    }
    EXPECT_GT(culms, 0);
    frond_model_destroy(wheat);
}
