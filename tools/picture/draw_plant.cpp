// In: a plant and its model. Out: draw calls on a picture, made with the public C API only.
#include <vector>

#include "error.hpp"
#include "frond_picture.h"
#include "require.hpp"

using namespace picture;

namespace {

bool is_thin(const char* kind) {
    const std::string text = kind ? kind : "";
    return text == "blade" || text == "crown" || text == "flower" || text == "tendril";
}

void draw_surface(frond_picture* picture, frond_plant plant, frond_model model, const frond_model_info& info) {
    frond_surface_view view;
    require(frond_plant_get_surface(plant, &view), "the plant's surface");
    // A texture that cannot be decoded is omitted; the base colour remains.
    std::vector<int> textures(size_t(info.texture_count), -1);
    for (int i = 0; i < info.texture_count; i++) {
        frond_texture_view texture;
        require(frond_model_get_texture(model, i, &texture), "the model's texture");
        if (texture.bytes && texture.byte_count > 0)
            frond_picture_add_texture(picture, texture.bytes, texture.byte_count, &textures[size_t(i)]);
    }
    std::vector<frond_picture_part> parts;
    for (int i = 0; i < info.part_count; i++) {
        frond_part part;
        require(frond_model_get_part(model, i, &part), "the model's part");
        const bool thin = is_thin(part.kind);
        const int texture =
            part.texture >= 0 && part.texture < info.texture_count ? textures[size_t(part.texture)] : -1;
        parts.push_back({part.first_triangle,
                         part.triangle_count,
                         {part.color[0], part.color[1], part.color[2], part.color[3]},
                         texture,
                         thin ? 0.35f : 0.0f,
                         thin ? 0.3f : 0.2f,
                         false});
    }
    frond_picture_mesh mesh{};
    mesh.positions = view.positions, mesh.normals = view.normals, mesh.uvs = view.uvs, mesh.colors = view.colors;
    mesh.indices = view.indices;
    mesh.vertex_count = view.vertex_count, mesh.triangle_count = view.triangle_count;
    mesh.parts = parts.empty() ? nullptr : parts.data(), mesh.part_count = int(parts.size());
    require(frond_picture_draw_mesh(picture, &mesh));
}

void draw_cage(frond_picture* picture, frond_plant plant, frond_model model, uint32_t what) {
    frond_cage_view cage;
    require(frond_model_get_cage(model, &cage), "the model's cage");
    std::vector<double> nodes(size_t(cage.node_count) * 3);
    require(frond_plant_get_state(plant, nodes.data(), nullptr, cage.node_count), "the plant's state");
    const frond_color line = {0.02f, 0.10f, 0.32f, 0.8f}, fill = {0.10f, 0.35f, 0.80f, 0.10f}, none = {0, 0, 0, 0};
    require(frond_picture_draw_tets(picture, nodes.data(), cage.node_count, cage.tets, cage.tet_count,
                                    what & FROND_PICTURE_CAGE ? 1.2 : 0, line,
                                    what & FROND_PICTURE_CAGE_FACES ? fill : none));
}

void draw_capsules(frond_picture* picture, frond_plant plant) {
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
    if (capsules.empty()) return;
    require(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())), "the plant's capsules");
    for (const frond_capsule& capsule : capsules)
        require(frond_picture_draw_capsule(picture, capsule.begin, capsule.end, capsule.radius,
                                           {0.95f, 0.45f, 0.05f, 0.35f}));
}

void draw_contacts(frond_picture* picture, frond_plant plant) {
    std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plant)));
    require(frond_plant_get_contacts(plant, contacts.data(), int(contacts.size())), "the plant's contacts");
    for (const frond_contact& contact : contacts) {
        const bool pushes = contact.impulse.x != 0 || contact.impulse.y != 0 || contact.impulse.z != 0;
        const frond_color red = {0.85f, 0.02f, 0.02f, 1}, grey = {0.2f, 0.2f, 0.2f, 0.7f};
        require(frond_picture_draw_point(picture, contact.point, 8, pushes ? red : grey));
    }
}

}  // namespace

bool frond_picture_draw_plant(frond_picture* picture, frond_plant plant, frond_model model, uint32_t what) {
    return guarded([&] {
        int width = 0;
        require(frond_picture_get_size(picture, &width, nullptr));
        if (what & ~uint32_t(31))
            fail("0x%x is not made of FROND_PICTURE_SURFACE, _CAGE, _CAGE_FACES, _CAPSULES and _CONTACTS",
                 unsigned(what));
        frond_model_info info;
        require(frond_model_get_info(model, &info), "the model");
        if (!frond_plant_is_valid(plant)) fail("the plant's handle is null or destroyed");
        if (what & FROND_PICTURE_SURFACE) draw_surface(picture, plant, model, info);
        if (what & (FROND_PICTURE_CAGE | FROND_PICTURE_CAGE_FACES)) draw_cage(picture, plant, model, what);
        if (what & FROND_PICTURE_CAPSULES) draw_capsules(picture, plant);
        if (what & FROND_PICTURE_CONTACTS) draw_contacts(picture, plant);
    });
}

bool frond_picture_draw_robot(frond_picture* picture, frond_robot robot, frond_color color) {
    return guarded([&] {
        int width = 0;
        require(frond_picture_get_size(picture, &width, nullptr));
        frond_surface_view view;
        require(frond_robot_get_surface(robot, &view), "the robot's surface");
        const frond_picture_part part = {0, view.triangle_count, color, -1, 0, 0.2f, false};
        frond_picture_mesh mesh{};
        mesh.positions = view.positions, mesh.indices = view.indices;
        mesh.vertex_count = view.vertex_count, mesh.triangle_count = view.triangle_count;
        mesh.parts = &part, mesh.part_count = 1;
        require(frond_picture_draw_mesh(picture, &mesh));
    });
}

bool frond_picture_draw_grab(frond_picture* picture, frond_grab grab) {
    return guarded([&] {
        frond_vec3 point, target;
        require(frond_grab_get(grab, &point, &target, nullptr), "the grab");
        require(frond_picture_draw_arrow(picture, point, target, 4, {0.80f, 0.01f, 0.01f, 1}));
        require(frond_picture_draw_point(picture, point, 9, {0.80f, 0.01f, 0.01f, 1}));
    });
}
