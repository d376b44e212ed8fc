// The lines of text beside the picture.
#include <cstdio>

#include "view/viewer.hpp"

namespace frond::tools {

namespace {

template <class... Values>
std::string text_of(const char* format, Values... values) {
    char text[128];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

Row overlay_row(const Viewer& viewer, char key, const char* name, Overlay overlay) {
    const bool is_on = viewer.overlays[size_t(overlay)];
    return {text_of("[%c] %s: %s", key, name, is_on ? "on" : "off"), key,
            [overlay](Viewer& v) { v.overlays[size_t(overlay)] = !v.overlays[size_t(overlay)]; }};
}

Row effect_row(const Viewer& viewer, int bit) {
    const frond_effects effect = 1u << bit;
    const bool is_on = viewer.settings.plant.effects & effect, ran = viewer.report.effects_run & effect;
    const double ms = viewer.cost.ms_of_effect[bit];
    const std::string cost = !ran ? "" : ms > 0 ? text_of("  %.3f ms", ms) : "  at work";
    return {text_of("    %s %-14s", is_on ? "[x]" : "[  ]", frond_effect_name(effect)) + cost, 0,
            [effect](Viewer& v) { toggle_effect(v, effect); }};
}

std::string trouble_text(uint32_t trouble) {
    std::string text;
    if (trouble & FROND_TROUBLE_NOT_CONVERGED) text += " not converged";
    if (trouble & FROND_TROUBLE_REWOUND) text += " rewound";
    if (trouble & FROND_TROUBLE_INVERTED) text += " inverted";
    if (trouble & FROND_TROUBLE_RETRIED) text += " retried";
    if (trouble & FROND_TROUBLE_BAD_WIND) text += " bad wind";
    return "trouble so far:" + (text.empty() ? " none" : text);
}

void add_costs(const Viewer& viewer, std::vector<Row>& rows) {
    const frond_report& report = viewer.report;
    const frond_profile& cost = viewer.cost;
    const auto tell = [&](const std::string& text) { rows.push_back({text, 0, nullptr}); };
    tell("");
    tell(text_of("%d plants, %d awake, %d tets; %.2f s", report.plant_count, report.awake_count, report.tet_count,
                 viewer.play->stage.time));
    tell(text_of("a step: %.2f ms; %.0f frames a second", cost.ms_step,
                 viewer.frame_time > 0 ? 1 / viewer.frame_time : 0.0));
    const struct {
        const char* name;
        double ms;
    } stages[] = {{"collide", cost.ms_collide}, {"effects", cost.ms_effects},   {"assembly", cost.ms_assembly},
                  {"solve", cost.ms_solve},     {"response", cost.ms_response}, {"capsules", cost.ms_capsules},
                  {"surface", cost.ms_surface}};
    for (const auto& stage : stages) tell(text_of("    %.3f ms  %s", stage.ms, stage.name));
    tell(text_of("%d contacts with bodies, %d of plants", report.contact_count, report.plant_contact_count));
    tell(trouble_text(viewer.trouble));
    if (viewer.overlays[size_t(Overlay::STRAIN)])
        tell(text_of("strain: blue 0, red %.0f %% and more", 100 * RED_STRAIN));
}

}  // namespace

std::vector<Row> panel_of(const Viewer& viewer) {
    const frond_plant_def& plant = viewer.settings.plant;
    std::vector<Row> rows;
    rows.push_back({text_of("[space] %s", viewer.is_paused ? "go on" : "pause"), ' ',
                    [](Viewer& v) { v.is_paused = !v.is_paused; }});
    rows.push_back({"[n] one step", 'n', [](Viewer& v) {
                        v.is_paused = true;
                        step_once(v);
                    }});
    rows.push_back({"[r] from the start", 'r', [](Viewer& v) { reset(v); }});
    rows.push_back({"[b] throw a ball", 'b', [](Viewer& v) { throw_ball(v); }});
    rows.push_back({text_of("[m] mechanics: %s", frond_mechanics_name(plant.mechanics)), 'm', [](Viewer& v) {
                        set_mechanics(v, frond_mechanics((v.settings.plant.mechanics + 1) % FROND_MECHANICS_COUNT));
                    }});
    rows.push_back({text_of("[i] integrator: %s", frond_integrator_name(plant.integrator)), 'i', [](Viewer& v) {
                        set_integrator(v, frond_integrator((v.settings.plant.integrator + 1) % FROND_INTEGRATOR_COUNT));
                    }});
    rows.push_back(overlay_row(viewer, 'c', "cage", Overlay::CAGE));
    rows.push_back(overlay_row(viewer, 'k', "capsules", Overlay::CAPSULES));
    rows.push_back(overlay_row(viewer, 't', "contacts", Overlay::CONTACTS));
    rows.push_back(overlay_row(viewer, 's', "strain", Overlay::STRAIN));
    rows.push_back({"[h] hide this", 'h', [](Viewer& v) { v.shows_panel = !v.shows_panel; }});
    rows.push_back({"effects:", 0, nullptr});
    for (int bit = 0; bit < FROND_EFFECT_COUNT; bit++) rows.push_back(effect_row(viewer, bit));
    add_costs(viewer, rows);
    return rows;
}

}  // namespace frond::tools
