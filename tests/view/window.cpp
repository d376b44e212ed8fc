// A real window on an invisible screen (Xvfb), with a mouse and keys that XTest controls.
#include "view/window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include "studio/studio.hpp"
#include "view/driver.hpp"
#include "view/on_plants.hpp"
#include "view/screen.hpp"

using namespace frond::tools;

namespace window_tests {

constexpr int WIDTH = 480, HEIGHT = 360;

// Acts as a user, and runs frames until the window has handled the events.
struct User {
    Window& window;
    UnseenScreen& screen;
    int left = 0, top = 0;
    User(Window& window, UnseenScreen& screen) : window(window), screen(screen) {
        see(3);
        keep_driver();
        window.get_place(left, top);
    }
    void see(int frames = 2) {
        for (int i = 0; i < frames; i++) window.frame();
    }
    void move(double x, double y) {
        screen.move_mouse(left + int(std::lround(x)), top + int(std::lround(y)));
        see();
    }
    void button(unsigned number, bool down) {
        screen.press_button(number, down);
        see();
    }
    void key(const char* name) {
        screen.tap_key(name);
        see();
    }
};

struct ViewWindow : ::testing::Test {
    UnseenScreen screen;
    void SetUp() override { ASSERT_TRUE(screen.is_there()) << "Xvfb is missing; run tools/install-packages"; }
    Viewer viewer_of(const char* scene) {
        const Casting casting = cast(scene);
        return make_viewer(casting, settings_of(casting, {"pull=0", "mechanics=rod"}), WIDTH, HEIGHT);
    }
};

TEST_F(ViewWindow, ADragMovesTheLeafThatWasGrabbedAndNothingElse) {
    Viewer viewer = viewer_of("corn");
    Window window(viewer, "test");
    User user(window, screen);
    const std::vector<float> start = surface_of(viewer);
    const Camera camera = viewer.camera;
    const auto [leaf, x, y] = leaf_tip(viewer);

    user.move(x, y);
    EXPECT_NEAR(viewer.mouse_x, x, 1);
    EXPECT_NEAR(viewer.mouse_y, y, 1);
    user.button(1, true);
    ASSERT_EQ(viewer.drag, Viewer::Drag::HAND);
    for (int i = 1; i <= 10; i++) user.move(x, y - 4 * i);
    while (viewer.play->stage.time < 1.5) window.frame();
    const std::vector<float> now = surface_of(viewer);
    // The leaf follows the mouse; foot and camera do not move, and the other side of the plant hardly does.
    double reached_x = 0, reached_y = 0;
    pixel_of(viewer.camera, vertex(now, leaf), viewer.width, viewer.height, reached_x, reached_y);
    EXPECT_LT(reached_y, y - 15);
    EXPECT_NEAR(reached_x, x, 30);
    EXPECT_GT(vertex(now, leaf).y, vertex(start, leaf).y + 0.08);
    const int foot = lowest(start);
    EXPECT_LT(distance(vertex(start, foot), vertex(now, foot)), 1e-3);
    EXPECT_EQ(viewer.camera.azimuth, camera.azimuth);
    EXPECT_EQ(viewer.camera.distance, camera.distance);
    int moved = 0;
    for (int i = 0; i < int(start.size() / 3); i++) moved += distance(vertex(start, i), vertex(now, i)) > 0.05;
    EXPECT_LT(moved, int(start.size() / 3) / 4);  // it is one of several leaves
    // A step in which a leaf turns over may be solved again; none is rewound.
    EXPECT_EQ(viewer.trouble & (FROND_TROUBLE_REWOUND | FROND_TROUBLE_INVERTED), 0u);

    user.button(1, false);
    EXPECT_EQ(viewer.drag, Viewer::Drag::NONE);
    const double let_go = viewer.play->stage.time;
    while (viewer.play->stage.time < let_go + 1) window.frame();
    EXPECT_LT(distance(vertex(start, leaf), vertex(surface_of(viewer), leaf)),
              distance(vertex(start, leaf), vertex(now, leaf)));
}

TEST_F(ViewWindow, KeysAndTheWheelReachTheViewer) {
    Viewer viewer = viewer_of("corn");
    Window window(viewer, "test");
    User user(window, screen);
    user.move(WIDTH - 5, HEIGHT / 2);
    user.key("space");
    EXPECT_TRUE(viewer.is_paused);
    const double time = viewer.play->stage.time;
    user.key("n");
    EXPECT_NEAR(viewer.play->stage.time, time + viewer.settings.dt, 1e-9);
    user.key("k");
    EXPECT_TRUE(viewer.overlays[size_t(Overlay::CAPSULES)]);
    const double distance_before = viewer.camera.distance, azimuth = viewer.camera.azimuth;
    user.button(4, true);
    user.button(4, false);
    EXPECT_LT(viewer.camera.distance, distance_before);
    user.button(3, true);
    EXPECT_EQ(viewer.drag, Viewer::Drag::ORBIT);
    user.move(WIDTH - 60, HEIGHT / 2);
    user.button(3, false);
    EXPECT_NE(viewer.camera.azimuth, azimuth);
    EXPECT_EQ(viewer.drag, Viewer::Drag::NONE);
    EXPECT_TRUE(window.is_open());
    user.key("Escape");
    EXPECT_FALSE(window.is_open());
}

TEST_F(ViewWindow, ThePanelTakesTheMouseWhereItIs) {
    Viewer viewer = viewer_of("corn");
    Window window(viewer, "test");
    User user(window, screen);
    user.move(40, 16);  // title bar of the panel
    user.button(1, true);
    EXPECT_EQ(viewer.drag, Viewer::Drag::NONE);
    user.button(1, false);
    user.key("h");
    user.move(40, 17);
    user.button(1, true);
    EXPECT_EQ(viewer.drag, Viewer::Drag::ORBIT);
    user.button(1, false);
}

// The screen shows the rendered picture.
TEST_F(ViewWindow, ShowsThePicture) {
    Viewer viewer = viewer_of("corn");
    viewer.is_paused = true;
    Window window(viewer, "test");
    User user(window, screen);
    user.see(4);
    const std::vector<uint8_t> shown = screen.pixels(user.left, user.top, WIDTH, HEIGHT);
    ASSERT_EQ(shown.size(), size_t(3 * WIDTH * HEIGHT));
    const std::vector<uint8_t> drawn = window.pixels();
    double difference = 0;
    int dark = 0;
    for (size_t i = 0; i < shown.size(); i++) {
        difference += std::abs(int(shown[i]) - int(drawn[i]));
        dark += shown[i] < 60;
    }
    EXPECT_LT(difference / (3 * WIDTH * HEIGHT), 2);
    EXPECT_GT(dark, 1000);  // the plant and the panel
}

TEST(ViewWithoutAScreen, SaysWhatToDoInstead) {
    unsetenv("DISPLAY");
    const Casting casting = cast("twig");
    Viewer viewer = make_viewer(casting, settings_of(casting, {}), 64, 64);
    try {
        Window window(viewer, "test");
        FAIL() << "a window without a display";
    } catch (const SceneError& error) {
        EXPECT_NE(std::strstr(error.what(), "--shot"), nullptr) << error.what();
    }
}

}  // namespace window_tests
