// Comparison: passes if only edges differ, fails if a person would see the difference. And one reference picture.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

#include "canvas.hpp"

namespace test_compare_tests {

// Draws a small plant: a stem that bends by `bend` radians with leaves, of which `missing` is left out.
std::vector<uint8_t> draw_plant(double bend, int missing, int samples = 4, double shift = 0) {
    frond_picture_def def = small_def();
    def.width = 320, def.height = 240;
    def.samples = samples;
    static auto& canvases = *new std::map<int, std::unique_ptr<Canvas>>;
    std::unique_ptr<Canvas>& kept = canvases[samples];
    if (!kept) kept = std::make_unique<Canvas>(def);
    Canvas& canvas = *kept;
    frond_picture_scene scene = frond_default_picture_scene();
    scene.camera = frond_picture_frame({-0.5, 0, -0.5}, {0.5, 1.2, 0.5}, {0, 1, 0}, 0.4, 0.2, 4.0 / 3);
    canvas.begin(scene);
    frond_vec3 at = {shift, 0, 0};
    for (int i = 0; i < 8; i++) {
        const double angle = bend * (i + 1) / 8;
        const frond_vec3 next = {at.x + 0.14 * std::sin(angle), at.y + 0.14 * std::cos(angle), 0};
        EXPECT_TRUE(frond_picture_draw_capsule(canvas.picture, at, next, 0.02, {0.25f, 0.4f, 0.1f, 1}));
        if (i >= 2 && i != missing) {
            // A leaf: two triangles to alternating sides.
            const float s = i % 2 ? 1.0f : -1.0f, x = float(next.x), y = float(next.y);
            const std::vector<float> positions = {
                x, y, 0, x + 0.18f * s, y + 0.08f, 0.08f, x + 0.42f * s, y, 0, x + 0.18f * s, y + 0.06f, -0.08f};
            const std::vector<int32_t> indices = {0, 1, 2, 0, 2, 3};
            frond_picture_mesh mesh{};
            mesh.positions = positions.data(), mesh.indices = indices.data();
            mesh.vertex_count = 4, mesh.triangle_count = 2;
            EXPECT_TRUE(frond_picture_draw_mesh(canvas.picture, &mesh));
        }
        at = next;
    }
    return canvas.end();
}

frond_picture_difference compare(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b,
                                 std::vector<uint8_t>* heat = nullptr) {
    frond_picture_difference difference;
    if (heat) heat->resize(a.size());
    EXPECT_TRUE(frond_picture_compare(a.data(), b.data(), 320, 240, FROND_PICTURE_TOLERANCE, &difference,
                                      heat ? heat->data() : nullptr));
    return difference;
}

TEST(PictureCompare, SamePicturesDifferByNothing) {
    const std::vector<uint8_t> plant = draw_plant(0.3, -1);
    const frond_picture_difference difference = compare(plant, plant);
    EXPECT_TRUE(difference.same);
    EXPECT_EQ(difference.worst, 0);
    EXPECT_EQ(difference.mean, 0);
    EXPECT_EQ(difference.share, 0);
}

TEST(PictureCompare, ForgivesAntiAliasingAndRounding) {
    const std::vector<uint8_t> plant = draw_plant(0.3, -1);
    // No anti-aliasing at all, an offset of a third of a pixel, and changes of the lowest bit.
    EXPECT_TRUE(compare(plant, draw_plant(0.3, -1, 1)).same);
    EXPECT_TRUE(compare(plant, draw_plant(0.3, -1, 4, 0.002)).same)
        << compare(plant, draw_plant(0.3, -1, 4, 0.002)).worst;
    std::vector<uint8_t> noisy = plant;
    for (size_t i = 0; i < noisy.size(); i += 2) noisy[i] ^= 1;
    EXPECT_TRUE(compare(plant, noisy).same);
}

TEST(PictureCompare, SeesABentPlant) {
    const std::vector<uint8_t> plant = draw_plant(0.3, -1);
    // The tip moves by some four pixels.
    const frond_picture_difference difference = compare(plant, draw_plant(0.34, -1));
    EXPECT_FALSE(difference.same) << difference.worst;
    EXPECT_GT(difference.worst, 2 * FROND_PICTURE_TOLERANCE);
}

TEST(PictureCompare, SeesAMissingLeafAndWhereItWas) {
    const std::vector<uint8_t> plant = draw_plant(0.3, -1);
    std::vector<uint8_t> heat;
    const frond_picture_difference difference = compare(plant, draw_plant(0.3, 5), &heat);
    EXPECT_FALSE(difference.same);
    EXPECT_GT(difference.worst, 10);
    EXPECT_GT(difference.share, 0.001);
    EXPECT_LT(difference.share, 0.2);
    // The leaf is to the right of the stem in the upper half; there the difference is bright, elsewhere black.
    EXPECT_GT(difference.worst_x, 160);
    EXPECT_GT(heat[(size_t(difference.worst_y) * 320 + size_t(difference.worst_x)) * 3], 150);
    EXPECT_EQ(heat[0], 0);
}

TEST(PictureCompare, SeesAFaintCastOverTheWholePicture) {
    const std::vector<uint8_t> plant = draw_plant(0.3, -1);
    std::vector<uint8_t> tinted = plant;
    for (size_t i = 0; i < tinted.size(); i += 3) tinted[i] = uint8_t(std::max(0, tinted[i] - 12));
    EXPECT_FALSE(compare(plant, tinted).same);
}

TEST(PictureCompare, DoesNotDependOnTheOrder) {
    const std::vector<uint8_t> a = draw_plant(0.3, -1), b = draw_plant(0.5, 3);
    const frond_picture_difference first = compare(a, b), second = compare(b, a);
    EXPECT_DOUBLE_EQ(first.worst, second.worst);
    EXPECT_DOUBLE_EQ(first.mean, second.mean);
}

TEST(PictureCompare, BlackAgainstWhiteIsAHundred) {
    const std::vector<uint8_t> black(320 * 240 * 3, 0), white(320 * 240 * 3, 255);
    EXPECT_NEAR(compare(black, white).worst, 100, 0.1);
}

TEST(PictureCompare, KeepsADifferencePictureOnFailureOnly) {
    const std::vector<uint8_t> plant = draw_plant(0.3, -1), other = draw_plant(0.3, 5);
    const std::string reference = out_path("reference.png"), kept = out_path("kept.png");
    ASSERT_TRUE(frond_picture_write_png(reference.c_str(), plant.data(), 320, 240));
    std::remove(kept.c_str());
    frond_picture_difference difference;
    ASSERT_TRUE(frond_picture_compare_file(plant.data(), 320, 240, reference.c_str(), FROND_PICTURE_TOLERANCE,
                                           &difference, kept.c_str()));
    EXPECT_TRUE(difference.same);
    EXPECT_EQ(std::fopen(kept.c_str(), "rb"), nullptr);
    ASSERT_TRUE(frond_picture_compare_file(other.data(), 320, 240, reference.c_str(), FROND_PICTURE_TOLERANCE,
                                           &difference, kept.c_str()));
    EXPECT_FALSE(difference.same);
    uint8_t* sheet = nullptr;
    int width = 0, height = 0;
    ASSERT_TRUE(frond_picture_read_png(kept.c_str(), &sheet, &width, &height)) << frond_picture_last_error();
    EXPECT_EQ(width, 3 * 320 + 8);
    EXPECT_EQ(height, 240);
    frond_picture_free(sheet);
    // Another size is an error, and is written too.
    std::remove(kept.c_str());
    EXPECT_FALSE(frond_picture_compare_file(plant.data(), 240, 320, reference.c_str(), FROND_PICTURE_TOLERANCE,
                                            &difference, kept.c_str()));
    EXPECT_TRUE(frond_picture_read_png(kept.c_str(), &sheet, &width, &height));
    frond_picture_free(sheet);
}

// FROND_UPDATE_PICTURES=1 rewrites the reference.
TEST(PictureCompare, PlantLooksAsInItsReference) {
    const std::vector<uint8_t> plant = draw_plant(0.3, -1);
    const std::string reference = std::string(FROND_PICTURE_TESTS) + "/reference/little_plant.png";
    if (std::getenv("FROND_UPDATE_PICTURES")) {
        ASSERT_TRUE(frond_picture_write_png(reference.c_str(), plant.data(), 320, 240)) << frond_picture_last_error();
    }
    frond_picture_difference difference;
    const std::string kept = out_path("little_plant_difference.png");
    ASSERT_TRUE(frond_picture_compare_file(plant.data(), 320, 240, reference.c_str(), FROND_PICTURE_TOLERANCE,
                                           &difference, kept.c_str()))
        << frond_picture_last_error();
    EXPECT_TRUE(difference.same) << "worst difference " << difference.worst << " at " << difference.worst_x << ", "
                                 << difference.worst_y << "; see " << kept;
}

}  // namespace test_compare_tests
