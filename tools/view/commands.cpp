// The commands behind the keys.
#include "view/viewer.hpp"

namespace frond::tools {

namespace {

std::string on_or_off(const Viewer& viewer, const char* name, Overlay overlay) {
    return std::string(name) + (viewer.overlays[size_t(overlay)] ? ": on" : ": off");
}

void toggle(Viewer& viewer, Overlay overlay) {
    viewer.overlays[size_t(overlay)] = !viewer.overlays[size_t(overlay)];
}

}  // namespace

const std::vector<Command>& commands() {
    static const std::vector<Command> table = {
        {' ', [](const Viewer& v) { return std::string(v.is_paused ? "go on" : "pause"); },
         [](Viewer& v) { v.is_paused = !v.is_paused; }},
        {'n', [](const Viewer&) { return std::string("one step"); },
         [](Viewer& v) {
             v.is_paused = true;
             step_once(v);
         }},
        {'r', [](const Viewer&) { return std::string("start again"); }, [](Viewer& v) { reset(v); }},
        {'b', [](const Viewer&) { return std::string("throw a ball"); }, [](Viewer& v) { throw_ball(v); }},
        {'m',
         [](const Viewer& v) { return std::string("mechanics: ") + frond_mechanics_name(v.settings.plant.mechanics); },
         [](Viewer& v) {
             set_mechanics(v, frond_mechanics((v.settings.plant.mechanics + 1) % FROND_MECHANICS_COUNT));
         }},
        {'i',
         [](const Viewer& v) {
             return std::string("integrator: ") + frond_integrator_name(v.settings.plant.integrator);
         },
         [](Viewer& v) {
             set_integrator(v, frond_integrator((v.settings.plant.integrator + 1) % FROND_INTEGRATOR_COUNT));
         }},
        {'c', [](const Viewer& v) { return on_or_off(v, "cage", Overlay::CAGE); },
         [](Viewer& v) { toggle(v, Overlay::CAGE); }},
        {'k', [](const Viewer& v) { return on_or_off(v, "capsules", Overlay::CAPSULES); },
         [](Viewer& v) { toggle(v, Overlay::CAPSULES); }},
        {'t', [](const Viewer& v) { return on_or_off(v, "contacts", Overlay::CONTACTS); },
         [](Viewer& v) { toggle(v, Overlay::CONTACTS); }},
        {'s', [](const Viewer& v) { return on_or_off(v, "strain", Overlay::STRAIN); },
         [](Viewer& v) { toggle(v, Overlay::STRAIN); }},
        {'h', [](const Viewer&) { return std::string("hide this"); },
         [](Viewer& v) { v.shows_panel = !v.shows_panel; }},
    };
    return table;
}

}  // namespace frond::tools
