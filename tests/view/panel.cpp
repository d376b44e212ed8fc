// The panel without a window: the test makes Dear ImGui's frames and moves its mouse.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "view/viewer.hpp"

using namespace frond::tools;

namespace panel_tests {

constexpr int WIDTH = 640, HEIGHT = 900;

struct ViewPanel : ::testing::Test {
    Viewer viewer;
    ViewPanel() {
        const Casting casting = cast("corn");
        viewer = make_viewer(casting, settings_of(casting, {"pull=0", "mechanics=rod"}), WIDTH, HEIGHT);
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {float(WIDTH), float(HEIGHT)};
        unsigned char* pixels;
        int width, height;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        // A window has its size only after its first frame.
        frame(), frame();
    }
    ~ViewPanel() override { ImGui::DestroyContext(); }

    void frame() {
        ImGui::NewFrame();
        show_panel(viewer);
        ImGui::Render();
    }
    void mouse(float x, float y, bool is_down) {
        ImGui::GetIO().MousePos = {x, y};
        ImGui::GetIO().MouseDown[0] = is_down;
        frame();
    }
    // Extent of a widget, found by moving over the panel until it is hovered.
    struct Place {
        float left, right, y;
    };
    Place place_of(const char* label) {
        ImGuiWindow* panel = ImGui::FindWindowByName("frond");
        const ImGuiID id = panel->GetID(label);
        const float left = panel->Pos.x + 2, right = panel->Pos.x + panel->Size.x;
        for (float y = panel->Pos.y + 2; y < panel->Pos.y + panel->Size.y; y += 4) {
            Place place = {right, left, y};
            for (float x = left; x < right; x += 6) {
                mouse(x, y, false);
                if (ImGui::GetCurrentContext()->HoveredId != id) continue;
                place.left = std::min(place.left, x);
                place.right = std::max(place.right, x);
            }
            if (place.left <= place.right) return place;
        }
        ADD_FAILURE() << label << " is nowhere in the panel";
        return {};
    }
    void click(const char* label) {
        const Place place = place_of(label);
        mouse(place.left, place.y, true);
        mouse(place.left, place.y, false);
    }
    // Moves a slider's knob to a share of its length and keeps holding it.
    Place slide(const char* label, float share) {
        const Place place = place_of(label);
        mouse(0.5f * (place.left + place.right), place.y, true);
        mouse(place.left + share * (place.right - place.left), place.y, true);
        return place;
    }
    void let_go() {
        mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y, false);
        frame();
    }
    std::string text() {
        ImGui::NewFrame();
        ImGui::LogToClipboard();
        show_panel(viewer);
        ImGui::LogFinish();
        ImGui::Render();
        return ImGui::GetClipboardText();
    }
    int tets() const {
        frond_model_info info;
        EXPECT_EQ(frond_model_get_info(viewer.play->stage.models[0], &info), FROND_OK);
        return info.tet_count;
    }
};

TEST_F(ViewPanel, ShowsCommandsCostsAndEffects) {
    for (int i = 0; i < 3; i++) advance(viewer, viewer.settings.dt);
    const std::string all = text();
    for (const Command& command : commands())
        EXPECT_NE(all.find(command.name(viewer)), std::string::npos) << command.name(viewer) << "\n" << all;
    for (const StageTime& stage : STAGE_TIMES) EXPECT_NE(all.find(stage.name), std::string::npos) << stage.name;
    for (int bit = 0; bit < FROND_EFFECT_COUNT; bit++)
        EXPECT_NE(all.find(frond_effect_name(1u << bit)), std::string::npos) << frond_effect_name(1u << bit);
    for (const char* word : {"mechanics: rod", "integrator: bdf2", "trouble so far: none", "1 plant, 1 awake"})
        EXPECT_NE(all.find(word), std::string::npos) << word << "\n" << all;
}

TEST_F(ViewPanel, ButtonsAndBoxesDoWhatTheySay) {
    click("###space");
    EXPECT_TRUE(viewer.is_paused);
    const frond_effects before = viewer.settings.plant.effects;
    click("###effect friction");
    EXPECT_EQ(viewer.settings.plant.effects, before ^ FROND_EFFECT_FRICTION);
    click("###c");
    EXPECT_TRUE(viewer.overlays[size_t(Overlay::CAGE)]);
    click("###h");
    EXPECT_FALSE(viewer.shows_panel);
    frame(), frame();
    EXPECT_FALSE(ImGui::GetIO().WantCaptureMouse);
    press(viewer, 'h');
    EXPECT_TRUE(viewer.shows_panel);
}

TEST_F(ViewPanel, TheWindBlowsAsTheSliderSays) {
    slide("wind", 0.5f);
    let_go();
    const double speed = wind_speed(viewer.settings);
    EXPECT_NEAR(speed, 10, 1);
    EXPECT_TRUE(viewer.settings.plant.effects & FROND_EFFECT_WIND);
    for (int i = 0; i < 30; i++) advance(viewer, viewer.settings.dt);
    EXPECT_TRUE(viewer.report.effects_run & FROND_EFFECT_WIND);
    EXPECT_EQ(viewer.trouble & FROND_TROUBLE_BAD_WIND, 0u);
    // From calm, the wind returns in its previous direction.
    set_wind_speed(viewer, 0);
    set_wind_speed(viewer, speed);
    EXPECT_NEAR(viewer.settings.wind.velocity.x, speed, 1e-12);
}

// A stiffer plant with finer cells needs a new model: it is built when the mouse lets go, not while dragging.
TEST_F(ViewPanel, SlidersOfTheModelMakeItAnewWhenLetGo) {
    const int before = tets();
    slide("cell size", 0.9f);
    EXPECT_NE(viewer.wanted.cage_size, viewer.settings.model.cage_size);
    EXPECT_EQ(tets(), before);
    let_go();
    EXPECT_EQ(viewer.wanted.cage_size, viewer.settings.model.cage_size);
    EXPECT_TRUE(viewer.refusal.empty()) << viewer.refusal;
    EXPECT_NE(tets(), before);

    slide("stiffness", 0.8f);
    let_go();
    EXPECT_GT(viewer.settings.stiffness, 1.5);
    frond_organ organ;
    ASSERT_EQ(frond_model_get_organ(viewer.play->stage.models[0], 0, &organ), FROND_OK);
    const double stiff = organ.material.young;
    viewer.wanted.stiffness = 1;
    take_wanted(viewer);
    ASSERT_EQ(frond_model_get_organ(viewer.play->stage.models[0], 0, &organ), FROND_OK);
    EXPECT_GT(stiff, 1.5 * organ.material.young);
}

TEST_F(ViewPanel, WhatTheLibraryRefusesChangesNothingAndIsSaid) {
    for (int i = 0; i < 3; i++) advance(viewer, viewer.settings.dt);
    const double time = viewer.play->stage.time;
    viewer.wanted.cage_size = 1e-9;
    take_wanted(viewer);
    EXPECT_FALSE(viewer.refusal.empty());
    EXPECT_EQ(viewer.play->stage.time, time);
    EXPECT_EQ(viewer.wanted.cage_size, viewer.settings.model.cage_size);
    EXPECT_NE(text().find(viewer.refusal.substr(0, 20)), std::string::npos);
    advance(viewer, viewer.settings.dt);
}

TEST_F(ViewPanel, EnergyIsMeasuredOnlyWhileItIsShown) {
    advance(viewer, viewer.settings.dt);
    EXPECT_FALSE(viewer.measures_energy);
    click("energy");
    frame();
    ASSERT_TRUE(viewer.measures_energy);
    throw_ball(viewer);
    for (int i = 0; i < 10; i++) advance(viewer, viewer.settings.dt);
    double largest = 0;
    for (const float joule : viewer.energies[1].values) largest = std::max(largest, double(joule));
    EXPECT_GT(largest, 0);
}

}  // namespace panel_tests
