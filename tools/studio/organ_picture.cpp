#include "studio/organ_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "frond/frond_expert.h"

namespace frond::tools {

double scale_bar(double pixels_per_metre, double pixels, std::string& text) {
    const double most = pixels / pixels_per_metre, power = std::pow(10.0, std::floor(std::log10(most)));
    const double length = most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
    char words[32];
    if (length < 0.01)
        std::snprintf(words, sizeof words, "%g mm", 1e3 * length);
    else
        std::snprintf(words, sizeof words, "%g m", length);
    text = words;
    return length;
}

namespace {

constexpr int LIST_WIDTH = 250, LINE = 12, MARGIN = 8;
constexpr int MOST_LABELS = 40;  // organs that are named in the picture itself
constexpr Pixel PAPER = {250, 250, 248}, INK = {30, 30, 30}, DOUBT = {190, 40, 20}, WHITE = {255, 255, 255};

// An organ and where it is in the picture.
struct Shown {
    frond_organ organ;
    frond_color color = {};  // linear
    frond_vec3 middle = {};  // [m]
    double area = 0;         // [m^2]
};

// Returns a colour of its own for each organ: hues in steps of the golden ratio, which differ from their neighbours'.
frond_color color_of(int organ) {
    const double hue = std::fmod(0.33 + 0.6180339887 * organ, 1.0), value = organ % 2 ? 0.85 : 0.6;
    std::array<double, 3> rgb;
    for (int c = 0; c < 3; c++) {
        const double k = std::fmod(6 * hue + (c == 0 ? 5 : c == 1 ? 3 : 1), 6.0);
        rgb[size_t(c)] = value * (1 - 0.85 * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
    }
    return {float(rgb[0]), float(rgb[1]), float(rgb[2]), 1};
}

Pixel displayed(const frond_color& color) {
    const auto byte = [](float linear) { return uint8_t(std::lround(255 * std::pow(double(linear), 1 / 2.2))); };
    return {byte(color.r), byte(color.g), byte(color.b)};
}

std::vector<Shown> list_organs(frond_model model, const frond_model_info& info) {
    std::vector<Shown> shown(size_t(info.organ_count));
    for (int i = 0; i < info.organ_count; i++) {
        must(frond_model_get_organ(model, i, &shown[size_t(i)].organ));
        shown[size_t(i)].color = color_of(i);
    }
    return shown;
}

frond_vec3 vertex(const frond_surface_view& view, int triangle, int corner) {
    const float* p = view.positions + 3 * size_t(view.indices[3 * size_t(triangle) + size_t(corner)]);
    return {p[0], p[1], p[2]};
}

// Adds a part's triangles to its organ's middle.
void add_to_middle(const frond_surface_view& view, const frond_part& part, Shown& shown) {
    for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++) {
        const frond_vec3 a = vertex(view, t, 0), b = vertex(view, t, 1), c = vertex(view, t, 2);
        const double x = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y),
                     y = (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z),
                     z = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        const double area = 0.5 * std::sqrt(x * x + y * y + z * z), share = area / 3;
        shown.area += area;
        shown.middle.x += share * (a.x + b.x + c.x);
        shown.middle.y += share * (a.y + b.y + c.y);
        shown.middle.z += share * (a.z + b.z + c.z);
    }
}

// Draws the surface in its organs' colours, and finds their middles.
void draw_surface(frond_picture* picture, const Stage& stage, const frond_model_info& info, std::vector<Shown>& shown) {
    frond_surface_view view;
    must(frond_plant_get_surface(stage.plants[0], &view));
    std::map<std::string, Shown*> by_name;
    for (Shown& one : shown) by_name[one.organ.name] = &one;
    std::vector<frond_picture_part> parts;
    for (int i = 0; i < info.part_count; i++) {
        frond_part part;
        must(frond_model_get_part(stage.plant_models[0], i, &part));
        Shown& one = *by_name.at(part.organ);
        parts.push_back({part.first_triangle, part.triangle_count, one.color, -1, 0.2f, 0.1f, false});
        add_to_middle(view, part, one);
    }
    for (Shown& one : shown)
        if (one.area > 0) one.middle = {one.middle.x / one.area, one.middle.y / one.area, one.middle.z / one.area};
    frond_picture_mesh mesh{};
    mesh.positions = view.positions, mesh.normals = view.normals, mesh.indices = view.indices;
    mesh.vertex_count = view.vertex_count, mesh.triangle_count = view.triangle_count;
    mesh.parts = parts.data(), mesh.part_count = int(parts.size());
    must(frond_picture_draw_mesh(picture, &mesh));
}

// Draws the chain and its roots, where the plant's capsules are now.
void draw_chain(frond_picture* picture, const Stage& stage) {
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(stage.plants[0])));
    must(frond_plant_get_capsules(stage.plants[0], capsules.data(), int(capsules.size())));
    for (const frond_capsule& capsule : capsules) {
        must(frond_picture_draw_line(picture, capsule.begin, capsule.end, 1.3, {0.02f, 0.02f, 0.02f, 0.9f}));
        must(frond_picture_draw_point(picture, capsule.end, 3, {0.02f, 0.02f, 0.02f, 0.9f}));
    }
    frond_chain_view chain;
    must(frond_model_get_chain(stage.plant_models[0], &chain));
    const frond_vec3& place = stage.places[0];
    for (int i = 0; i < chain.node_count; i++) {
        const double* p = chain.nodes + 3 * size_t(i);
        if (chain.parents[i] < 0)
            must(frond_picture_draw_point(picture, {place.x + p[0], place.y + p[1], place.z + p[2]}, 11,
                                          {0.8f, 0.01f, 0.01f, 1}));
    }
}

// Returns "0.25 kg" or "3.1 g".
std::string weight(double mass) {
    char text[32];
    std::snprintf(text, sizeof text, mass < 0.1 ? "%.3g g" : "%.3g kg", mass < 0.1 ? 1e3 * mass : mass);
    return text;
}

// Lists the organs beside the picture, from x on.
void write_list(Canvas& canvas, const std::vector<Shown>& shown, const frond_model_info& info, int x) {
    char line[160];
    std::snprintf(line, sizeof line, "%.3g m high, %s, %d roots", info.upper.y - info.lower.y,
                  weight(info.mass).c_str(), info.root_count);
    canvas.text(x, MARGIN, line, INK);
    if (info.stiffening_factor > 1.005) {
        std::snprintf(line, sizeof line, "made %.3g times stiffer", info.stiffening_factor);
        canvas.text(x, MARGIN + LINE, line, info.stiffening_factor > 3 ? DOUBT : INK);
    }
    int y = MARGIN + 2 * LINE + LINE / 2;
    for (const Shown& one : shown) {
        if (y > canvas.height - 3 * LINE) {
            std::snprintf(line, sizeof line, "and %d more", int(&shown.back() - &one) + 1);
            canvas.text(x, y, line, INK);
            return;
        }
        canvas.box(x, y - 1, 9, 9, displayed(one.color));
        std::snprintf(line, sizeof line, "%.18s: %s, %s, %.0f %% sure", one.organ.name, one.organ.kind,
                      weight(one.organ.mass).c_str(), 100 * one.organ.certainty);
        canvas.text(x + 13, y, line, one.organ.certainty < 0.5 ? DOUBT : INK);
        y += LINE;
    }
}

void write_labels(Canvas& canvas, const std::vector<Shown>& shown, const Projection& projection) {
    if (int(shown.size()) > MOST_LABELS) return;
    double x, y;
    for (const Shown& one : shown)
        if (one.area > 0 && projection.place(one.middle, x, y))
            canvas.rimmed_text(int(x) - text_width(one.organ.name) / 2, int(y) - 4, one.organ.name,
                               displayed(one.color), {20, 20, 20});
}

}  // namespace

Canvas draw_organs(const Stage& stage, const View& view) {
    if (stage.plants.empty()) throw SceneError("there is no plant to draw; add one to the stage first");
    frond_model_info info;
    must(frond_model_get_info(stage.plant_models[0], &info));
    std::vector<Shown> shown = list_organs(stage.plant_models[0], info);
    Studio studio(view);
    const frond_picture_scene scene = studio.draw(stage, [&](frond_picture* picture) {
        draw_surface(picture, stage, info, shown);
        draw_chain(picture, stage);
    });
    Canvas canvas(view.width + LIST_WIDTH, view.height, PAPER);
    canvas.copy(studio.pixels(), view.width, view.height, 0, 0);
    const Projection projection(scene.camera, view.width, view.height);
    write_labels(canvas, shown, projection);
    write_list(canvas, shown, info, view.width + MARGIN);
    std::string text;
    const double length = scale_bar(projection.per_metre(), 0.2 * view.width, text);
    canvas.box(MARGIN, view.height - MARGIN - 4, int(length * projection.per_metre()), 4, WHITE);
    canvas.rimmed_text(MARGIN, view.height - MARGIN - 16, text, WHITE, INK);
    return canvas;
}

}  // namespace frond::tools
