// Canvas: a small picture to draw on in tests, and access to its pixels.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "frond_picture.h"

constexpr int WIDTH = 200, HEIGHT = 150;

struct Pixel {
    int r, g, b;
    int sum() const { return r + g + b; }
};

inline frond_picture_def small_def() {
    frond_picture_def def = frond_default_picture_def();
    def.width = WIDTH, def.height = HEIGHT;
    def.shadow_size = 512;
    def.sky_samples = 6;
    return def;
}

// Returns a scene that looks along -z at a square of two metres around the origin, lit from the upper left front.
inline frond_picture_scene front_scene() {
    frond_picture_scene scene = frond_default_picture_scene();
    scene.camera.eye = {0, 0, 6};
    scene.camera.target = {0, 0, 0};
    scene.camera.up = {0, 1, 0};
    scene.camera.field_of_view = 2 * std::atan(1.0 / 6);
    scene.sun_direction = {-1, 0.6, 0.6};
    scene.ground = false;
    return scene;
}

struct Canvas {
    frond_picture* picture = nullptr;
    bool shared = false;
    // One picture is shared by all tests that allow it, since creating one takes longer than drawing.
    Canvas() : shared(true) {
        static Canvas& canvas = *new Canvas(small_def());
        picture = canvas.picture;
    }
    explicit Canvas(const frond_picture_def& def) {
        EXPECT_TRUE(frond_picture_create(&def, &picture)) << frond_picture_last_error();
    }
    ~Canvas() {
        if (!shared) frond_picture_destroy(picture);
    }
    Canvas(const Canvas&) = delete;
    void begin(const frond_picture_scene& scene) {
        ASSERT_TRUE(frond_picture_begin(picture, &scene)) << frond_picture_last_error();
    }
    std::vector<uint8_t> end() {
        EXPECT_TRUE(frond_picture_end(picture)) << frond_picture_last_error();
        int width = 0, height = 0;
        EXPECT_TRUE(frond_picture_get_size(picture, &width, &height));
        const uint8_t* pixels = frond_picture_get_pixels(picture);
        if (!pixels) return {};
        return std::vector<uint8_t>(pixels, pixels + size_t(width) * height * 3);
    }
};

// Returns a pixel; x, y in the front scene's metres: the picture shows -1..1 upwards.
inline Pixel at(const std::vector<uint8_t>& pixels, double x, double y) {
    const int column = int(WIDTH / 2.0 + x * HEIGHT / 2), row = int(HEIGHT / 2.0 - y * HEIGHT / 2);
    const size_t i = (size_t(row) * WIDTH + size_t(column)) * 3;
    return {pixels.at(i), pixels.at(i + 1), pixels.at(i + 2)};
}

// A flat sheet across the view: corner, size, normals towards the eye.
struct Sheet {
    std::vector<float> positions, normals, uvs = {0, 1, 1, 1, 1, 0, 0, 0};
    std::vector<int32_t> indices = {0, 1, 2, 0, 2, 3};
    frond_picture_part part{0, 2, {0.2f, 0.5f, 0.1f, 1}, -1, 0, 0, false};
    Sheet(float x, float y, float size, float z = 0)
        : positions{x, y, z, x + size, y, z, x + size, y + size, z, x, y + size, z}, normals{0, 0, 1, 0, 0, 1,
                                                                                             0, 0, 1, 0, 0, 1} {}
    frond_picture_mesh mesh() const {
        frond_picture_mesh mesh{};
        mesh.positions = positions.data(), mesh.normals = normals.data(), mesh.uvs = uvs.data();
        mesh.indices = indices.data();
        mesh.vertex_count = int(positions.size() / 3), mesh.triangle_count = int(indices.size() / 3);
        mesh.parts = &part, mesh.part_count = 1;
        return mesh;
    }
};

inline bool same_color(Pixel a, Pixel b, int tolerance = 2) {
    return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance && std::abs(a.b - b.b) <= tolerance;
}

inline std::string out_path(const std::string& name) {
    return std::string(FROND_PICTURE_OUT) + "/" + name;
}
