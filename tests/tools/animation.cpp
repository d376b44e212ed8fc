// Animations written by frond export, read back by another importer.
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace animation_tests {

constexpr int SAMPLES = 7;  // 60 steps, every tenth of them, and the start

// Returns heights of the tip from the table written in the same run.
std::vector<double> tips_of(const std::string& csv) {
    std::ifstream file(csv);
    std::string line, field;
    std::vector<double> tips;
    std::getline(file, line);
    for (int row = 0; std::getline(file, line); row++) {
        std::stringstream fields(line);
        for (int k = 0; k <= 3; k++) std::getline(fields, field, ',');
        if (row % 10 == 0) tips.push_back(std::stod(field));
    }
    return tips;
}

class Animation : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Export, Animation, ::testing::Values("glb", "gltf"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(Animation, HasATargetASampleWhereTheTableSaysAndOneWeightAtATime) {
    const std::string folder = ::testing::TempDir() + "frond_animation_" + GetParam();
    std::filesystem::create_directories(folder);
    const std::string file = folder + "/twig." + GetParam(), csv = folder + "/twig.csv";
    const std::string command =
        std::string(FROND_COMMAND) + " export twig --at 1 --every 10 --animation " + file + " --csv " + csv;
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::vector<double> tips = tips_of(csv);
    ASSERT_EQ(tips.size(), size_t(SAMPLES));

    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file, 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    ASSERT_GT(scene->mNumMeshes, 0u);
    for (unsigned s = 0; s < unsigned(SAMPLES); s++) {
        double highest = -1;
        for (unsigned m = 0; m < scene->mNumMeshes; m++) {
            const aiMesh& mesh = *scene->mMeshes[m];
            ASSERT_EQ(mesh.mNumAnimMeshes, unsigned(SAMPLES));
            for (unsigned v = 0; v < mesh.mNumVertices; v++) {
                const aiVector3D &p = mesh.mAnimMeshes[s]->mVertices[v], &base = mesh.mVertices[v];
                highest = std::max(highest, double(p.y));
                if (s + 1 == unsigned(SAMPLES)) {
                    ASSERT_LT((p - base).Length(), 1e-6f);  // the mesh itself is the final shape
                }
                const aiVector3D& normal = mesh.mAnimMeshes[s]->mNormals[v];
                ASSERT_NEAR(double(normal.Length()), 1, 1e-4);
            }
        }
        EXPECT_NEAR(highest, tips[s], 1e-5) << s;
    }
    EXPECT_GT(std::abs(tips.front() - tips.back()), 1e-3);

    ASSERT_EQ(scene->mNumAnimations, 1u);
    const aiAnimation& animation = *scene->mAnimations[0];
    EXPECT_EQ(animation.mNumMorphMeshChannels, scene->mNumMeshes);
    const aiMeshMorphAnim& channel = *animation.mMorphMeshChannels[0];
    ASSERT_EQ(channel.mNumKeys, unsigned(SAMPLES));
    for (unsigned k = 0; k < channel.mNumKeys; k++) {
        ASSERT_EQ(channel.mKeys[k].mNumValuesAndWeights, unsigned(SAMPLES));
        for (unsigned i = 0; i < unsigned(SAMPLES); i++) EXPECT_EQ(channel.mKeys[k].mWeights[i], i == k ? 1 : 0);
        if (k > 0) {
            EXPECT_NEAR(
                (channel.mKeys[k].mTime - channel.mKeys[k - 1].mTime) * SAMPLES / channel.mKeys[SAMPLES - 1].mTime,
                SAMPLES / (SAMPLES - 1.0), 1e-3);
        }
    }
    std::filesystem::remove_all(folder);
}

TEST(AnimationExport, RefusesOtherFormatsAndNoTime) {
    const std::string command = std::string(FROND_COMMAND) + " export twig --at 0.1 --animation /tmp/x.obj 2>/dev/null";
    EXPECT_NE(std::system(command.c_str()), 0);
    const std::string still = std::string(FROND_COMMAND) + " export twig --animation /tmp/x.glb 2>/dev/null";
    EXPECT_NE(std::system(still.c_str()), 0);
}

}  // namespace animation_tests
