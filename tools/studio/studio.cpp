#include "studio/studio.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

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

frond_picture_scene Studio::draw(const Stage& stage, const std::function<void(frond_picture*)>& draw) {
    const frond_picture_scene scene =
        frame_stage(stage, view.azimuth, view.elevation, double(view.width) / view.height);
    must(frond_picture_begin(picture, &scene));
    draw(picture);
    must(frond_picture_end(picture));
    return scene;
}

const uint8_t* Studio::shoot(const Stage& stage) {
    const auto wants = [&](const char* overlay) {
        return std::find(view.overlays.begin(), view.overlays.end(), overlay) != view.overlays.end();
    };
    uint32_t what = FROND_PICTURE_SURFACE;
    if (wants("cage")) what |= FROND_PICTURE_CAGE;
    if (wants("faces")) what |= FROND_PICTURE_CAGE_FACES;
    if (wants("capsules")) what |= FROND_PICTURE_CAPSULES;
    if (wants("contacts")) what |= FROND_PICTURE_CONTACTS;
    draw(stage, [&](frond_picture*) { draw_stage(picture, stage, what); });
    return pixels();
}

void Studio::write(const std::string& png_path) {
    must(frond_picture_write(picture, png_path.c_str()));
}

Film::Film(const std::string& folder, const View& view, double frames_per_second) : folder(folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) throw SceneError("cannot make the folder " + folder + ": " + failure.message());
    frond_film_def def = frond_default_film_def();
    def.width = view.width;
    def.height = view.height;
    def.frames_per_second = std::clamp(frames_per_second, 1.0, 1000.0);
    must(frond_film_create(&def, &film));
}

Film::~Film() {
    frond_film_destroy(film);
}

void Film::add(Studio& studio, const Stage& stage) {
    must(frond_film_add(film, studio.shoot(stage)));
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04d.png", frond_film_get_frame_count(film) - 1);
    studio.write(folder + "/" + name);
}

void Film::finish() {
    must(frond_film_write_sheet(film, (folder + "/sheet.png").c_str(), 4, 3));
    must(frond_film_write_webp(film, (folder + "/film.webp").c_str()));
}

}  // namespace frond::tools
