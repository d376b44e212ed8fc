#include "studio/studio.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace frond::tools {

void must(bool ok) {
    if (!ok) throw SceneError(frond_picture_last_error());
}

Studio::Studio(const View& view) : view(view) {
    for (const std::string& overlay : view.overlays)
        if (overlay != "cage" && overlay != "faces" && overlay != "capsules" && overlay != "contacts" &&
            overlay != "force")
            throw SceneError("there is no overlay \"" + overlay +
                             "\"; there are cage, faces, capsules, contacts, force");
    frond_picture_def def = frond_default_picture_def();
    def.width = view.width;
    def.height = view.height;
    must(frond_picture_create(&def, &picture));
}

Studio::~Studio() {
    frond_picture_destroy(picture);
}

frond_picture_scene frame_stage(const Stage& stage, double azimuth, double elevation, double aspect) {
    frond_picture_scene scene = frond_default_picture_scene();
    // Leave a margin on all sides, since plants move.
    const double margin = 0.08 * (stage.upper.y - stage.lower.y);
    frond_vec3 lower = {stage.lower.x - margin, stage.lower.y, stage.lower.z - margin};
    frond_vec3 upper = {stage.upper.x + margin, stage.upper.y + margin, stage.upper.z + margin};
    if (stage.has_view) {
        lower = stage.view_lower;
        upper = stage.view_upper;
    }
    scene.camera = frond_picture_frame(lower, upper, {0, 1, 0}, azimuth, elevation, aspect);
    // The ground is at zero if only roots reach a little below it, else at the lowest point.
    constexpr double DEEPEST_ROOT = 0.15;
    const double depth = -stage.lower.y, height = stage.upper.y - stage.lower.y;
    scene.ground_height = depth > 0 && depth < DEEPEST_ROOT * height ? 0.0 : stage.lower.y;
    return scene;
}

void draw_stage(frond_picture* picture, const Stage& stage, uint32_t what) {
    const frond_color clay = {0.55f, 0.16f, 0.07f, 1}, orange = {0.80f, 0.32f, 0.04f, 1};
    for (size_t i = 0; i < stage.plants.size(); i++)
        if (stage.sees(i)) must(frond_picture_draw_plant(picture, stage.plants[i], stage.plant_models[i], what));
    for (size_t i = 0; i < stage.rigids.size(); i++)
        must(frond_picture_draw_rigid(picture, &stage.rigid_defs[i], stage.rigids[i], clay));
    for (frond_robot robot : stage.robots) must(frond_picture_draw_robot(picture, robot, orange));
    for (frond_grab grab : stage.grabs) must(frond_picture_draw_grab(picture, grab));
}

const uint8_t* Studio::shoot(const Stage& stage) {
    const frond_picture_scene scene =
        frame_stage(stage, view.azimuth, view.elevation, double(view.width) / view.height);
    must(frond_picture_begin(picture, &scene));
    const auto wants = [&](const char* overlay) {
        return std::find(view.overlays.begin(), view.overlays.end(), overlay) != view.overlays.end();
    };
    uint32_t what = FROND_PICTURE_SURFACE;
    if (wants("cage")) what |= FROND_PICTURE_CAGE;
    if (wants("faces")) what |= FROND_PICTURE_CAGE_FACES;
    if (wants("capsules")) what |= FROND_PICTURE_CAPSULES;
    if (wants("contacts")) what |= FROND_PICTURE_CONTACTS;
    draw_stage(picture, stage, what);
    must(frond_picture_end(picture));
    return frond_picture_get_pixels(picture);
}

void Studio::write(const std::string& png_path) {
    must(frond_picture_write(picture, png_path.c_str()));
}

Progress::Progress(const char* what, int total)
    : what(what),
      total(total),
      on_terminal(isatty(STDERR_FILENO)),
      start(std::chrono::steady_clock::now()),
      last(start) {}

Progress::~Progress() {
    if (shown) std::fprintf(stderr, "\r\033[K");
}

void Progress::at(int done) {
    if (!on_terminal) return;
    const auto now = std::chrono::steady_clock::now();
    using seconds = std::chrono::duration<double>;
    if (seconds(now - start).count() < 1 || seconds(now - last).count() < 0.2) return;
    last = now;
    shown = true;
    std::fprintf(stderr, "\r%s %d of %d\033[K", what, done, total);
}

}  // namespace frond::tools
