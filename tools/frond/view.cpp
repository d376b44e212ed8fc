// frond view SCENE|FILE: opens a window in which to play with a scene.
#include "view/window.hpp"

#include <memory>

#include "commands.hpp"
#include "studio/studio.hpp"

namespace frond::tools {
namespace {

struct ViewOptions {
    std::string what, shot;
    int frames = 0;  // 0: until the window is closed
    View view;
    bool is_paused = false;
    std::vector<std::string> assignments;
};

void set_overlays(Viewer& viewer, const std::vector<std::string>& names) {
    const std::pair<const char*, Overlay> known[] = {{"cage", Overlay::CAGE},
                                                     {"capsules", Overlay::CAPSULES},
                                                     {"contacts", Overlay::CONTACTS},
                                                     {"strain", Overlay::STRAIN}};
    for (const std::string& name : names) {
        bool is_known = false;
        for (const auto& [own, overlay] : known)
            if (name == own) is_known = viewer.overlays[size_t(overlay)] = true;
        if (!is_known)
            throw SceneError("there is no overlay \"" + name + "\"; there are cage, capsules, contacts, strain");
    }
}

void view(const ViewOptions& options) {
    const Casting casting = cast(options.what);
    std::vector<std::string> assignments = options.assignments;
    // Only the user pulls a plant of the user's own file.
    if (!casting.file.empty()) assignments.insert(assignments.begin(), "pull=0");
    Viewer viewer = make_viewer(casting, settings_of(casting, assignments), options.view.width, options.view.height);
    set_overlays(viewer, options.view.overlays);
    viewer.is_paused = options.is_paused;
    Window window(viewer, ("frond view " + options.what).c_str());
    for (int i = 0; window.is_open() && (options.frames == 0 || i < options.frames); i++) window.frame();
    if (!options.shot.empty()) window.write(options.shot);
}

}  // namespace

void add_view(CLI::App& app) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App* command = app.add_subcommand("view", "play with a scene or a plant file in a window");
    command->add_option("what", options->what, "a mesh file, or a scene as for run")->required();
    command->add_option("--overlay", options->view.overlays, "cage, capsules, contacts, strain")->delimiter(',');
    command->add_option("--width", options->view.width, "of the window")->check(CLI::Range(64, 8192));
    command->add_option("--height", options->view.height, "of the window")->check(CLI::Range(64, 8192));
    command->add_flag("--paused", options->is_paused, "begin with a pause");
    command->add_option("--frames", options->frames, "close it after so many")->check(CLI::Range(1, 1000000000));
    command->add_option("--shot", options->shot, "write what it showed last (PNG)")->check(file_ending_in(".png"));
    command->add_option("--set", options->assignments, "key=value, may be repeated");
    command->footer(
        "Drag a plant with the left button, everything else with the right one, the view with the middle one;\n"
        "the wheel goes nearer. The window tells the keys.\nKeys of --set:\n" +
        settings_help());
    command->callback([options] { view(*options); });
}

}  // namespace frond::tools
