// Absurd sizes from a caller are refused with a text, before time or memory is spent on them.
#include <chrono>
#include <cstring>
#include <string>
#include <vector>

#include "frond/frond_robot.h"
#include "support/stems.hpp"

namespace limits_tests {

// Expects a refusal within a time that a game can wait for.
template <class Call>
void expect_refused(Call&& call, frond_result code, const char* word) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(call(), code);
    EXPECT_NE(std::strstr(frond_last_error(), word), nullptr) << frond_last_error();
    EXPECT_LT(std::strlen(frond_last_error()), 1000u);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 20);
}

frond_result from_triangles(const std::vector<float>& xyz, const std::vector<int32_t>& indices) {
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    const frond_result result = frond_model_from_triangles(xyz.data(), int(xyz.size() / 3), indices.data(),
                                                           int(indices.size() / 3), &def, &model);
    frond_model_destroy(model);
    return result;
}

TEST(Limits, AMillionTrianglesInAPointAreNoPlant) {
    const std::vector<float> xyz(3000000, 0.25f);
    std::vector<int32_t> indices(3000000);
    for (size_t i = 0; i < indices.size(); i++) indices[i] = int32_t(i % 1000000);
    expect_refused([&] { return from_triangles(xyz, indices); }, FROND_RESULT_BAD_GEOMETRY, "triangles");
}

TEST(Limits, CoordinatesBeyondAllPlantsAreRefused) {
    for (float huge : {1e30f, -3e38f}) {
        std::vector<float> xyz = {0, 0, 0, huge, 0, 0, 0, huge, 0};
        expect_refused([&] { return from_triangles(xyz, {0, 1, 2}); }, FROND_RESULT_BAD_GEOMETRY, "1e9");
    }
    const double nodes[] = {0, 0, 0, 1e30, 0, 0, 0, 1, 0, 0, 0, 1};
    const int32_t tet[] = {0, 1, 2, 3};
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    expect_refused([&] { return frond_model_from_tets(nodes, 4, tet, 1, &def, &model); }, FROND_RESULT_BAD_GEOMETRY,
                   "1e9");
}

TEST(Limits, CountsThatNoMemoryHoldsAreRefusedUnread) {
    const float xyz[9] = {};
    const int32_t indices[3] = {};
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    expect_refused([&] { return frond_model_from_triangles(xyz, 2147483647, indices, 1, &def, &model); },
                   FROND_RESULT_BAD_ARGUMENT, "vertex_count");
    expect_refused([&] { return frond_model_from_triangles(xyz, 3, indices, 2147483647, &def, &model); },
                   FROND_RESULT_BAD_ARGUMENT, "triangle_count");
}

TEST(Limits, EndlessNamesAreRefused) {
    const std::string endless(64u << 20, 'x');
    frond_model_def def = frond_default_model_def();
    frond_model model = {};
    expect_refused([&] { return frond_model_load(endless.c_str(), &def, &model); }, FROND_RESULT_BAD_ARGUMENT, "path");
    frond_organ_material organ = {endless.c_str(), {}};
    def.organs = &organ;
    def.organ_count = 1;
    expect_refused([&] { return frond_model_load("x.obj", &def, &model); }, FROND_RESULT_BAD_ARGUMENT, "organ");
    const SmallWorld small;
    const frond_robot_def robot_def = frond_default_robot_def();
    frond_robot robot = {};
    expect_refused([&] { return frond_robot_load(small.world, endless.c_str(), &robot_def, &robot); },
                   FROND_RESULT_BAD_ARGUMENT, "path");
    expect_refused([&] { return frond_model_write_urdf(small.model, endless.c_str()); }, FROND_RESULT_BAD_ARGUMENT,
                   "path");
    frond_material material;
    expect_refused([&] { return frond_material_preset(endless.c_str(), &material); }, FROND_RESULT_BAD_ARGUMENT,
                   "no material");
}

}  // namespace limits_tests
