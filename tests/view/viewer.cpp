// The viewer without a window: the effects of mouse and keys.
#include "view/viewer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "studio/studio.hpp"
#include "view/on_plants.hpp"

using namespace frond::tools;

namespace viewer_tests {

constexpr int WIDTH = 640, HEIGHT = 480;

Viewer view_of(const char* scene, std::vector<std::string> assignments = {"pull=0", "mechanics=rod"}) {
    const Casting casting = cast(scene);
    return make_viewer(casting, settings_of(casting, assignments), WIDTH, HEIGHT);
}

TEST(ViewCamera, IsThatOfThePictureAndRaysGoThroughItsPixels) {
    const frond_picture_camera given = frond_picture_frame({-1, 0, -2}, {3, 2, 1}, {0, 1, 0}, 0.7, 0.3, 4.0 / 3);
    const Camera camera = camera_of(given);
    const frond_picture_camera again = picture_camera(camera);
    EXPECT_NEAR(again.eye.x, given.eye.x, 1e-9);
    EXPECT_NEAR(again.eye.y, given.eye.y, 1e-9);
    EXPECT_NEAR(again.eye.z, given.eye.z, 1e-9);
    const frond_vec3 points[] = {{0.3, 0.4, -0.5}, {1.5, 1.9, 0.4}, given.target};
    for (const frond_vec3& p : points) {
        double x = 0, y = 0;
        pixel_of(camera, p, WIDTH, HEIGHT, x, y);
        const Ray ray = ray_through(camera, x, y, WIDTH, HEIGHT);
        const frond_vec3 way = {p.x - ray.origin.x, p.y - ray.origin.y, p.z - ray.origin.z};
        const double along = way.x * ray.direction.x + way.y * ray.direction.y + way.z * ray.direction.z;
        const double far = std::hypot(way.x, way.y, way.z);
        EXPECT_NEAR(along, far, 1e-9 * far);
        const frond_vec3 met = meet_facing_plane(camera, ray, p);
        EXPECT_NEAR(std::hypot(met.x - p.x, met.y - p.y, met.z - p.z), 0, 1e-9);
    }
}

TEST(ViewMouse, DragsTheLeafThatItTakes) {
    Viewer viewer = view_of("corn");
    const std::vector<float> start = surface_of(viewer);
    const auto [leaf, x, y] = leaf_tip(viewer);
    move_mouse(viewer, x, y);
    press_button(viewer, Button::LEFT);
    ASSERT_EQ(viewer.drag, Viewer::Drag::HAND);
    for (int i = 0; i < 60; i++) {
        move_mouse(viewer, x, y - i);
        advance(viewer, viewer.settings.dt);
    }
    const std::vector<float> now = surface_of(viewer);
    EXPECT_GT(distance(vertex(start, leaf), vertex(now, leaf)), 0.1);
    EXPECT_GT(vertex(now, leaf).y, vertex(start, leaf).y + 0.05);
    EXPECT_LT(distance(vertex(start, lowest(start)), vertex(now, lowest(start))), 1e-3);
    frond_vec3 force;
    ASSERT_EQ(frond_grab_get(viewer.hand.grab, nullptr, nullptr, &force), FROND_OK);
    EXPECT_GT(force.y, 0);
    release_button(viewer, Button::LEFT);
    EXPECT_FALSE(frond_grab_is_valid(viewer.hand.grab));
    EXPECT_EQ(viewer.drag, Viewer::Drag::NONE);
    EXPECT_EQ(viewer.trouble, 0u);
}

// Moves the mouse far between two frames, as happens if frames are slow.
TEST(ViewMouse, DragsGentlyHoweverFarItGoesInAFrame) {
    Viewer viewer = view_of("corn");
    const std::vector<float> start = surface_of(viewer);
    const auto [leaf, x, y] = leaf_tip(viewer);
    move_mouse(viewer, x, y);
    press_button(viewer, Button::LEFT);
    move_mouse(viewer, x, y - 60);
    for (int i = 0; i < 90; i++) advance(viewer, viewer.settings.dt);
    EXPECT_EQ(viewer.trouble, 0u);
    EXPECT_EQ(viewer.hand.target.y, viewer.hand.wanted.y);
    EXPECT_GT(vertex(surface_of(viewer), leaf).y, vertex(start, leaf).y + 0.05);
}

TEST(ViewMouse, OrbitsPansAndZoomsBesideThePlant) {
    Viewer viewer = view_of("corn");
    const Camera start = viewer.camera;
    move_mouse(viewer, WIDTH - 3, HEIGHT / 2);
    press_button(viewer, Button::LEFT);
    EXPECT_EQ(viewer.drag, Viewer::Drag::ORBIT);
    press_button(viewer, Button::MIDDLE);  // only one drag at a time
    move_mouse(viewer, WIDTH - 103, HEIGHT / 2 + 50);
    release_button(viewer, Button::MIDDLE);
    EXPECT_EQ(viewer.drag, Viewer::Drag::ORBIT);
    release_button(viewer, Button::LEFT);
    EXPECT_NE(viewer.camera.azimuth, start.azimuth);
    EXPECT_GT(viewer.camera.elevation, start.elevation);
    EXPECT_EQ(viewer.camera.distance, start.distance);
    // Panning moves the scene with the mouse.
    const Camera turned = viewer.camera;
    double x = 0, y = 0;
    press_button(viewer, Button::MIDDLE);
    move_mouse(viewer, viewer.mouse_x + 30, viewer.mouse_y - 20);
    release_button(viewer, Button::MIDDLE);
    pixel_of(viewer.camera, turned.target, WIDTH, HEIGHT, x, y);
    EXPECT_NEAR(x, WIDTH / 2 + 30, 0.5);
    EXPECT_NEAR(y, HEIGHT / 2 - 20, 0.5);
    turn_wheel(viewer, 2);
    EXPECT_LT(viewer.camera.distance, start.distance);
}

TEST(ViewTime, PausesStepsAndBeginsAnew) {
    Viewer viewer = view_of("corn");
    const double dt = viewer.settings.dt;
    advance(viewer, 2.5 * dt);
    EXPECT_NEAR(viewer.play->stage.time, 2 * dt, 1e-12);
    EXPECT_NEAR(viewer.left_over, 0.5 * dt, 1e-12);
    press(viewer, ' ');
    advance(viewer, 10 * dt);
    EXPECT_NEAR(viewer.play->stage.time, 2 * dt, 1e-12);
    press(viewer, 'n');
    EXPECT_NEAR(viewer.play->stage.time, 3 * dt, 1e-12);
    press(viewer, ' ');
    advance(viewer, 100 * dt);  // a slow machine drops time
    EXPECT_NEAR(viewer.play->stage.time, 7 * dt, 1e-12);
    EXPECT_EQ(viewer.left_over, 0);
    press(viewer, 'r');
    EXPECT_EQ(viewer.play->stage.time, 0);
    press(viewer, '?');  // a key without a command
}

TEST(ViewSwitches, ChangeMechanicsIntegratorsAndEffectsWhileItRuns) {
    Viewer viewer = view_of("corn", {"pull=0"});
    frond_report report;
    for (int i = 0; i < FROND_MECHANICS_COUNT + FROND_INTEGRATOR_COUNT; i++) {
        press(viewer, i < FROND_MECHANICS_COUNT ? 'm' : 'i');
        if (viewer.settings.plant.integrator == FROND_INTEGRATOR_SYMPLECTIC_EULER) continue;  // unstable at this step
        for (int k = 0; k < 3; k++) advance(viewer, viewer.settings.dt);
        EXPECT_EQ(viewer.trouble & FROND_TROUBLE_REWOUND, 0u) << i;
    }
    EXPECT_EQ(viewer.settings.plant.mechanics, FROND_MECHANICS_TET_COROTATIONAL);
    EXPECT_EQ(viewer.settings.plant.integrator, FROND_INTEGRATOR_BDF2);
    toggle_effect(viewer, FROND_EFFECT_GRAVITY);
    advance(viewer, viewer.settings.dt);
    ASSERT_EQ(frond_world_get_report(viewer.play->stage.world, &report), FROND_OK);
    EXPECT_EQ(report.effects_run & FROND_EFFECT_GRAVITY, 0u);
    // The settings survive a restart.
    press(viewer, 'm');
    reset(viewer);
    advance(viewer, viewer.settings.dt);
    ASSERT_EQ(frond_world_get_report(viewer.play->stage.world, &report), FROND_OK);
    EXPECT_EQ(report.effects_run & FROND_EFFECT_GRAVITY, 0u);
    EXPECT_EQ(viewer.settings.plant.mechanics, FROND_MECHANICS_TET_NEOHOOKEAN);
}

TEST(ViewBall, FliesAtWhatIsUnderTheMouse) {
    Viewer viewer = view_of("corn");
    double x = 0, y = 0;
    pixel_of(viewer.camera, {0, 1, 0}, WIDTH, HEIGHT, x, y);
    move_mouse(viewer, x, y);
    press(viewer, 'b');
    ASSERT_EQ(viewer.play->stage.rigids.size(), 2u);  // the ball and the ground
    int touches = 0;
    for (int i = 0; i < 60; i++) {
        advance(viewer, viewer.settings.dt);
        touches += frond_plant_get_contact_count(viewer.play->stage.plants[0]);
    }
    EXPECT_GT(touches, 0);
    for (int i = 0; i < 30; i++) press(viewer, 'b');
    EXPECT_EQ(viewer.play->stage.rigids.size(), 21u);
    for (const frond_rigid rigid : viewer.play->stage.rigids) EXPECT_TRUE(frond_rigid_is_valid(rigid));
}

TEST(ViewStrain, GoesFromBlueOverGreenToRed) {
    const auto blue = strain_color(0), green = strain_color(RED_STRAIN / 3), red = strain_color(5 * RED_STRAIN);
    EXPECT_GT(blue[2], blue[0] + 60);
    EXPECT_GT(green[1], green[0] + 60);
    EXPECT_GT(red[0], red[1] + 60);
}

// Each overlay changes the picture, strain most at the bend.
TEST(ViewPicture, ShowsEachOverlay) {
    Viewer viewer = view_of("snap", {"mechanics=rod", "breaking=off"});
    for (int i = 0; i < 120; i++) advance(viewer, viewer.settings.dt);
    frond_picture_def def = frond_default_picture_def();
    def.width = WIDTH;
    def.height = HEIGHT;
    def.sky_samples = 0;
    frond_picture* picture = nullptr;
    ASSERT_TRUE(frond_picture_create(&def, &picture)) << frond_picture_last_error();
    const auto shoot = [&] {
        draw(viewer, picture);
        const uint8_t* pixels = frond_picture_get_pixels(picture);
        return std::vector<uint8_t>(pixels, pixels + WIDTH * HEIGHT * 3);
    };
    const std::vector<uint8_t> plain = shoot();
    for (const Overlay overlay : {Overlay::CAGE, Overlay::CAPSULES, Overlay::STRAIN}) {
        viewer.overlays[size_t(overlay)] = true;
        const std::vector<uint8_t> with = shoot();
        int differ = 0, red = 0;
        for (size_t i = 0; i < plain.size(); i += 3) {
            differ += std::abs(plain[i] - with[i]) > 40 || std::abs(plain[i + 2] - with[i + 2]) > 40;
            red += with[i] > 130 && with[i + 1] < 70 && with[i + 2] < 70;
        }
        EXPECT_GT(differ, 300) << int(overlay);
        if (overlay == Overlay::STRAIN) {
            EXPECT_GT(red, 20);
        }
        viewer.overlays[size_t(overlay)] = false;
    }
    frond_picture_destroy(picture);
}

}  // namespace viewer_tests
