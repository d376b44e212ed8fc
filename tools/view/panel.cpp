// The panel: commands, sliders, effects and the cost of the last steps, as widgets of Dear ImGui.
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cstdio>

#include "view/viewer.hpp"

namespace frond::tools {

namespace {

constexpr float LEFT = 8, TOP = 8, WIDTH = 300;  // [pixel]

std::string trouble_text(uint32_t trouble) {
    std::string text;
    if (trouble & FROND_TROUBLE_NOT_CONVERGED) text += " not converged";
    if (trouble & FROND_TROUBLE_REWOUND) text += " rewound";
    if (trouble & FROND_TROUBLE_INVERTED) text += " inverted";
    if (trouble & FROND_TROUBLE_RETRIED) text += " retried";
    if (trouble & FROND_TROUBLE_HELD_BACK) text += " held back";
    if (trouble & FROND_TROUBLE_CROWDED) text += " crowded";
    if (trouble & FROND_TROUBLE_PASSED) text += " passed";
    if (trouble & FROND_TROUBLE_BAD_WIND) text += " bad wind";
    return "trouble so far:" + (text.empty() ? " none" : text);
}

void show_commands(Viewer& viewer) {
    bool is_left = true;
    for (const Command& command : commands()) {
        const std::string key = command.key == ' ' ? "space" : std::string(1, command.key);
        // The text after ### identifies the button, so that its name may change.
        const std::string label = "[" + key + "] " + command.name(viewer) + "###" + key;
        // A name with a value gets a line of its own.
        const bool is_wide = command.key == 'm' || command.key == 'i';
        if (!is_left && !is_wide) ImGui::SameLine();
        const float half = 0.5f * (ImGui::GetWindowContentRegionWidth() - ImGui::GetStyle().ItemSpacing.x);
        if (ImGui::Button(label.c_str(), {is_wide ? -1 : half, 0})) command.run(viewer);
        is_left = is_wide || !is_left;
    }
}

// Shows a logarithmic slider between two lengths; 0 lets the library choose. Returns true once it is released.
bool slide_length(const char* name, double& metres, double least, double most) {
    float value = float(metres);
    const bool is_chosen = metres == 0;
    ImGui::SetNextItemWidth(-130);
    if (ImGui::SliderFloat(name, &value, float(least), float(most), is_chosen ? "chosen" : "%.3f m",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        metres = value;
    bool is_done = ImGui::IsItemDeactivatedAfterEdit();
    if (is_chosen) return is_done;
    ImGui::SameLine();
    ImGui::PushID(name);
    if (ImGui::SmallButton("x")) {
        metres = 0;
        is_done = true;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("let Frond choose it");
    ImGui::PopID();
    return is_done;
}

void show_sliders(Viewer& viewer) {
    const Stage& stage = viewer.play->stage;
    float wind = float(wind_speed(viewer.settings));
    ImGui::SetNextItemWidth(-130);
    if (ImGui::SliderFloat("wind", &wind, 0, 20, "%.1f m/s", ImGuiSliderFlags_AlwaysClamp))
        set_wind_speed(viewer, double(wind));
    // These rebuild models, which takes a moment: they apply once the mouse lets go.
    float stiffness = float(viewer.wanted.stiffness);
    ImGui::SetNextItemWidth(-130);
    if (ImGui::SliderFloat("stiffness", &stiffness, 0.1f, 10, "x %.2f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        viewer.wanted.stiffness = double(stiffness);
    bool is_done = ImGui::IsItemDeactivatedAfterEdit();
    const double height = std::max(stage.upper.y - stage.lower.y, 1e-6);
    is_done |= slide_length("capsule height", viewer.wanted.capsule_height, height / 60, height / 4);
    is_done |= slide_length("cell size", viewer.wanted.cage_size, height / 25, height / 4);
    if (is_done) take_wanted(viewer);
    if (!viewer.refusal.empty()) ImGui::TextWrapped("%s", viewer.refusal.c_str());
}

void show_effects(Viewer& viewer) {
    if (!ImGui::CollapsingHeader("effects", ImGuiTreeNodeFlags_DefaultOpen)) return;
    for (int bit = 0; bit < FROND_EFFECT_COUNT; bit++) {
        const frond_effects effect = 1u << bit;
        const std::string name = frond_effect_name(effect);
        bool is_on = viewer.settings.plant.effects & effect;
        if (ImGui::Checkbox((name + "###effect " + name).c_str(), &is_on)) toggle_effect(viewer, effect);
        if (!(viewer.report.effects_run & effect)) continue;
        ImGui::SameLine(180);
        const double ms = viewer.cost.ms_of_effect[bit];
        if (ms > 0)
            ImGui::Text("%.3f ms", ms);
        else
            ImGui::TextUnformatted("at work");
    }
}

void plot(const char* name, const char* value, const History& history, float least, float most) {
    const std::string label = std::string(value) + "  " + name + "###plot " + name;
    ImGui::PlotLines(label.c_str(), history.values.data(), int(history.values.size()), history.next, nullptr, least,
                     most, {130, 20});
}

void show_times(const Viewer& viewer) {
    const frond_report& report = viewer.report;
    ImGui::Text("%d plant%s, %d awake, %d tets; %.2f s", report.plant_count, report.plant_count == 1 ? "" : "s",
                report.awake_count, report.tet_count, viewer.play->stage.time);
    ImGui::Text("%d contacts with bodies, %d of plants", report.contact_count, report.plant_contact_count);
    ImGui::TextUnformatted(trouble_text(viewer.trouble).c_str());
    if (viewer.overlays[size_t(Overlay::STRAIN)]) ImGui::Text("strain: blue 0, red %.0f %% and more", 100 * RED_STRAIN);
    ImGui::Text("a step: %.2f ms; %.0f frames a second", viewer.cost.ms_step,
                viewer.frame_time > 0 ? 1 / viewer.frame_time : 0.0);
    if (!ImGui::CollapsingHeader("time by stage", ImGuiTreeNodeFlags_DefaultOpen)) return;
    // One scale for all, so that the heights can be compared.
    float most = 1e-3f;
    for (const History& history : viewer.stage_times)
        most = std::max(most, *std::max_element(history.values.begin(), history.values.end()));
    for (size_t i = 0; i < viewer.stage_times.size(); i++) {
        char value[32];
        std::snprintf(value, sizeof value, "%6.3f ms", viewer.cost.*STAGE_TIMES[i].ms);
        plot(STAGE_TIMES[i].name, value, viewer.stage_times[i], 0, most);
    }
}

void show_energies(Viewer& viewer) {
    // Energies are computed only while this section is open.
    viewer.measures_energy = ImGui::CollapsingHeader("energy");
    if (!viewer.measures_energy) return;
    for (size_t i = 0; i < viewer.energies.size(); i++) {
        const History& history = viewer.energies[i];
        char value[32];
        const size_t last = (size_t(history.next) + history.values.size() - 1) % history.values.size();
        std::snprintf(value, sizeof value, "%9.3g J", double(history.values[last]));
        plot(ENERGIES[i].name, value, history, FLT_MAX, FLT_MAX);
    }
}

}  // namespace

void show_panel(Viewer& viewer) {
    if (!viewer.shows_panel) return;
    ImGui::SetNextWindowPos({LEFT, TOP}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints({WIDTH, 0}, {WIDTH, ImGui::GetIO().DisplaySize.y - 2 * TOP});
    ImGui::SetNextWindowBgAlpha(0.8f);
    ImGui::Begin("frond", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    show_commands(viewer);
    show_sliders(viewer);
    show_times(viewer);
    show_energies(viewer);
    show_effects(viewer);
    ImGui::End();
}

}  // namespace frond::tools
