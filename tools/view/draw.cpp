// In: a viewer. Out: a frame of the stage, overlays and the hand's force.
#include <algorithm>

#include "studio/studio.hpp"
#include "view/viewer.hpp"

namespace frond::tools {

namespace {

void draw_strained(frond_picture* picture, frond_plant plant, const Shades& shades) {
    std::vector<double> strains(size_t(frond_plant_get_capsule_count(plant)));
    must(frond_plant_get_strains(plant, strains.data(), int(strains.size())));
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    std::vector<uint8_t> colors;
    for (const int capsule : shades) {
        const std::array<uint8_t, 4> color = strain_color(strains[size_t(capsule)]);
        colors.insert(colors.end(), color.begin(), color.end());
    }
    const frond_picture_part part = {0, view.triangle_count, {1, 1, 1, 1}, -1, 0.2f, 0, false};
    frond_picture_mesh mesh{};
    mesh.positions = view.positions, mesh.normals = view.normals, mesh.indices = view.indices;
    mesh.colors = colors.data();
    mesh.vertex_count = view.vertex_count, mesh.triangle_count = view.triangle_count;
    mesh.parts = &part, mesh.part_count = 1;
    must(frond_picture_draw_mesh(picture, &mesh));
}

}  // namespace

std::array<uint8_t, 4> strain_color(double strain) {
    constexpr double STOPS[][3] = {{40, 70, 200}, {40, 170, 90}, {235, 210, 50}, {210, 30, 20}};
    const double at = 3 * std::clamp(strain / RED_STRAIN, 0.0, 1.0);
    const size_t low = std::min(size_t(at), size_t(2));
    std::array<uint8_t, 4> color = {0, 0, 0, 255};
    for (size_t k = 0; k < 3; k++)
        color[k] = uint8_t(STOPS[low][k] + (at - double(low)) * (STOPS[low + 1][k] - STOPS[low][k]) + 0.5);
    return color;
}

void draw(Viewer& viewer, frond_picture* picture) {
    const Stage& stage = viewer.play->stage;
    frond_picture_scene scene = frame_stage(stage, 0, 0, 1);
    scene.camera = picture_camera(viewer.camera);
    must(frond_picture_begin(picture, &scene));
    const auto is_on = [&](Overlay overlay) { return viewer.overlays[size_t(overlay)]; };
    uint32_t what = is_on(Overlay::STRAIN) ? 0 : FROND_PICTURE_SURFACE;
    if (is_on(Overlay::CAGE)) what |= FROND_PICTURE_CAGE;
    if (is_on(Overlay::CAPSULES)) what |= FROND_PICTURE_CAPSULES;
    if (is_on(Overlay::CONTACTS)) what |= FROND_PICTURE_CONTACTS;
    draw_stage(picture, stage, what);
    for (size_t i = 0; i < stage.plants.size() && is_on(Overlay::STRAIN); i++)
        if (stage.sees(i)) draw_strained(picture, stage.plants[i], viewer.shades.at(stage.plant_models[i].id));
    if (frond_grab_is_valid(viewer.hand.grab)) must(frond_picture_draw_grab(picture, viewer.hand.grab));
    must(frond_picture_end(picture));
}

}  // namespace frond::tools
