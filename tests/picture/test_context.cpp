// Contexts: platforms, the caller's own context, and restoring a host's context.
#include <cstdlib>

#include "canvas.hpp"

extern "C" int picture_header_works_in_c(void);

namespace test_context_tests {

std::vector<uint8_t> draw_ball(const frond_picture_def& def) {
    Canvas canvas(def);
    frond_picture_scene scene = front_scene();
    scene.ground = true;
    scene.ground_height = -1;
    canvas.begin(scene);
    EXPECT_TRUE(frond_picture_draw_sphere(canvas.picture, {0.1, 0, 0}, 0.6, {0.6f, 0.2f, 0.1f, 1}));
    return canvas.end();
}

TEST(PictureContext, HeaderWorksInC) {
    EXPECT_TRUE(picture_header_works_in_c());
}

TEST(PictureContext, PlatformsGiveTheSamePixels) {
    frond_picture_def def = small_def();
    def.platform = FROND_PICTURE_SURFACELESS;
    const std::vector<uint8_t> surfaceless = draw_ball(def);
    def.platform = FROND_PICTURE_DEVICE;
    const std::vector<uint8_t> device = draw_ball(def);
    ASSERT_EQ(surfaceless.size(), size_t(WIDTH * HEIGHT * 3));
    EXPECT_EQ(surfaceless, device);
}

TEST(PictureContext, SaysWhichPlatformItUses) {
    frond_picture_def def = small_def();
    def.platform = FROND_PICTURE_DEVICE;
    Canvas device(def);
    EXPECT_EQ(std::string(frond_picture_get_renderer(device.picture)).rfind("device, OpenGL", 0), 0u);
    def.platform = FROND_PICTURE_SURFACELESS;
    Canvas surfaceless(def);
    EXPECT_EQ(std::string(frond_picture_get_renderer(surfaceless.picture)).rfind("surfaceless, OpenGL", 0), 0u);
}

TEST(PictureContext, EnvironmentChoosesThePlatform) {
    setenv("FROND_PICTURE_PLATFORM", "device", 1);
    EXPECT_EQ(frond_default_picture_def().platform, FROND_PICTURE_DEVICE);
    setenv("FROND_PICTURE_PLATFORM", "surfaceless", 1);
    EXPECT_EQ(frond_default_picture_def().platform, FROND_PICTURE_SURFACELESS);
    setenv("FROND_PICTURE_PLATFORM", "nonsense", 1);
    EXPECT_EQ(frond_default_picture_def().platform, FROND_PICTURE_ANY);
    unsetenv("FROND_PICTURE_PLATFORM");
    EXPECT_EQ(frond_default_picture_def().platform, FROND_PICTURE_ANY);
}

TEST(PictureContext, OwnContextMustBeCurrent) {
    frond_picture_def def = small_def();
    def.platform = FROND_PICTURE_CURRENT;
    frond_picture* picture = nullptr;
    EXPECT_FALSE(frond_picture_create(&def, &picture));
    EXPECT_EQ(picture, nullptr);
    EXPECT_NE(std::string(frond_picture_last_error()).find("current"), std::string::npos);
}

TEST(PictureContext, SameCallsGiveTheSamePixels) {
    const std::vector<uint8_t> first = draw_ball(small_def());
    for (int i = 0; i < 3; i++) EXPECT_EQ(first, draw_ball(small_def()));
}

TEST(PictureContext, TwoPicturesDoNotDisturbEachOther) {
    Canvas first(small_def()), second(small_def());
    first.begin(front_scene());
    second.begin(front_scene());
    EXPECT_TRUE(frond_picture_draw_sphere(first.picture, {0, 0, 0}, 0.5, {1, 0, 0, 1}));
    const std::vector<uint8_t> empty = second.end(), ball = first.end();
    EXPECT_GT(at(ball, 0, 0).r, at(ball, 0, 0).g + 40);
    EXPECT_LT(std::abs(at(empty, 0, 0).r - at(empty, 0, 0).g), 40);
}

}  // namespace test_context_tests
