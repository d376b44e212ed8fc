// Misuse of every function: it gives a text, does nothing and does not crash.
#include <cmath>
#include <limits>

#include "canvas.hpp"

namespace test_misuse_tests {

const double NaN = std::numeric_limits<double>::quiet_NaN();
const frond_color RED = {1, 0, 0, 1};

// Expects that the call failed with a text that contains `word`.
void expect_refused(bool result, const char* word) {
    EXPECT_FALSE(result);
    EXPECT_NE(std::string(frond_picture_last_error()).find(word), std::string::npos)
        << "said: " << frond_picture_last_error() << ", expected: " << word;
}

// Makes all drawing calls with valid arguments.
std::vector<bool> draw_all(frond_picture* picture) {
    static const double nodes[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const int32_t tets[4] = {0, 1, 2, 3};
    const Sheet sheet(0, 0, 1);
    const frond_picture_mesh mesh = sheet.mesh();
    return {frond_picture_draw_mesh(picture, &mesh),
            frond_picture_draw_sphere(picture, {0, 0, 0}, 1, RED),
            frond_picture_draw_box(picture, {0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1}, RED),
            frond_picture_draw_capsule(picture, {0, 0, 0}, {0, 1, 0}, 1, RED),
            frond_picture_draw_line(picture, {0, 0, 0}, {0, 1, 0}, 1, RED),
            frond_picture_draw_arrow(picture, {0, 0, 0}, {0, 1, 0}, 1, RED),
            frond_picture_draw_point(picture, {0, 0, 0}, 1, RED),
            frond_picture_draw_tets(picture, nodes, 4, tets, 1, 1, RED, RED)};
}

TEST(PictureMisuse, DefsAreChecked) {
    frond_picture* picture = reinterpret_cast<frond_picture*>(1);
    expect_refused(frond_picture_create(nullptr, &picture), "null");
    EXPECT_EQ(picture, nullptr);
    frond_picture_def def = small_def();
    expect_refused(frond_picture_create(&def, nullptr), "null");
    const auto refuse = [&](auto change, const char* word) {
        frond_picture_def wrong = small_def();
        change(wrong);
        expect_refused(frond_picture_create(&wrong, &picture), word);
        EXPECT_EQ(picture, nullptr);
    };
    refuse([](auto& d) { d.cookie = 0; }, "frond_default_picture_def");
    for (int size : {0, -1, 8193, INT32_MIN, INT32_MAX}) {
        refuse([&](auto& d) { d.width = size; }, "width");
        refuse([&](auto& d) { d.height = size; }, "height");
    }
    refuse([](auto& d) { d.samples = 0; }, "samples");
    refuse([](auto& d) { d.samples = 17; }, "samples");
    refuse([](auto& d) { d.shadow_size = 15; }, "shadow");
    refuse([](auto& d) { d.shadow_size = 100000; }, "shadow");
    refuse([](auto& d) { d.sky_samples = -1; }, "sky");
    refuse([](auto& d) { d.sky_samples = 33; }, "sky");
    refuse([](auto& d) { d.platform = frond_picture_platform(99); }, "platform");
    refuse([](auto& d) { d.platform = frond_picture_platform(-1); }, "platform");
}

TEST(PictureMisuse, NullAndDestroyedPicturesAreRecognised) {
    const frond_picture_def def = small_def();
    frond_picture* dead = nullptr;
    ASSERT_TRUE(frond_picture_create(&def, &dead));
    frond_picture_destroy(dead);
    int width = 5, height = 5, texture = 5;
    const uint8_t byte = 0;
    for (frond_picture* picture : {static_cast<frond_picture*>(nullptr), dead}) {
        frond_picture_destroy(picture);
        expect_refused(frond_picture_get_size(picture, &width, &height), "picture");
        EXPECT_EQ(width, 0);
        EXPECT_STREQ(frond_picture_get_renderer(picture), "");
        expect_refused(frond_picture_begin(picture, nullptr), "picture");
        expect_refused(frond_picture_end(picture), "picture");
        EXPECT_EQ(frond_picture_get_pixels(picture), nullptr);
        expect_refused(frond_picture_write(picture, "x.png"), "picture");
        expect_refused(frond_picture_present(picture, 0, 1, 1), "picture");
        expect_refused(frond_picture_add_texture(picture, &byte, 1, &texture), "picture");
        EXPECT_EQ(texture, -1);
        for (bool drawn : draw_all(picture)) EXPECT_FALSE(drawn);
    }
}

TEST(PictureMisuse, DrawingNeedsABegunFrame) {
    Canvas canvas(small_def());
    for (bool drawn : draw_all(canvas.picture)) EXPECT_FALSE(drawn);
    expect_refused(frond_picture_end(canvas.picture), "begin");
    EXPECT_EQ(frond_picture_get_pixels(canvas.picture), nullptr);
    expect_refused(frond_picture_write(canvas.picture, out_path("never.png").c_str()), "end");
    ASSERT_TRUE(frond_picture_begin(canvas.picture, nullptr));
    for (bool drawn : draw_all(canvas.picture)) EXPECT_TRUE(drawn) << frond_picture_last_error();
    EXPECT_EQ(canvas.end().size(), size_t(WIDTH * HEIGHT * 3));
    expect_refused(frond_picture_end(canvas.picture), "begin");
    expect_refused(frond_picture_present(canvas.picture, 0, 10, 10), "FROND_PICTURE_CURRENT");
}

TEST(PictureMisuse, ScenesAreChecked) {
    Canvas canvas;
    const auto refuse = [&](auto change, const char* word) {
        frond_picture_scene scene = front_scene();
        change(scene);
        expect_refused(frond_picture_begin(canvas.picture, &scene), word);
        expect_refused(frond_picture_end(canvas.picture), "begin");
    };
    refuse([](auto& s) { s.cookie = 0; }, "frond_default_picture_scene");
    refuse([](auto& s) { s.camera.eye.x = NaN; }, "eye");
    refuse([](auto& s) { s.camera.target.z = 1e300; }, "target");
    refuse([](auto& s) { s.camera.eye = s.camera.target; }, "same point");
    refuse([](auto& s) { s.camera.up = {0, 0, 0}; }, "up");
    refuse([](auto& s) { s.camera.up.y = NaN; }, "up");
    for (double angle : {0.0, -1.0, 3.2, NaN})
        refuse([&](auto& s) { s.camera.field_of_view = angle; }, "field of view");
    refuse([](auto& s) { s.sun_direction.x = NaN; }, "sun");
    refuse([](auto& s) { s.up = {0, 0, 0}; }, "up");
    refuse([](auto& s) { s.ground_height = NaN; }, "ground");
    refuse([](auto& s) { s.exposure = -1; }, "exposure");
    refuse([](auto& s) { s.sun.r = float(NaN); }, "sun");
    refuse([](auto& s) { s.sky.b = -1; }, "sky");
    refuse([](auto& s) { s.background_top.g = -1; }, "background");
    refuse([](auto& s) { s.background_horizon.g = 1e9f; }, "background");
    refuse([](auto& s) { s.ground_color.g = -1; }, "ground");
}

TEST(PictureMisuse, OddButSoundScenesDraw) {
    Canvas canvas;
    // Looking along up, light along the ground or from below, the sun straight overhead.
    for (frond_vec3 sun : {frond_vec3{0, 1, 0}, frond_vec3{1, 0, 0}, frond_vec3{0, -1, 0}, frond_vec3{0, 0, 0}}) {
        frond_picture_scene scene = front_scene();
        scene.camera.eye = {0, 5, 0};
        scene.camera.up = {0, 1, 0};
        scene.sun_direction = sun;
        scene.ground = true;
        canvas.begin(scene);
        for (bool drawn : draw_all(canvas.picture)) EXPECT_TRUE(drawn);
        EXPECT_EQ(canvas.end().size(), size_t(WIDTH * HEIGHT * 3));
    }
}

TEST(PictureMisuse, NumbersOfDrawCallsAreChecked) {
    Canvas canvas;
    canvas.begin(front_scene());
    frond_picture* p = canvas.picture;
    const frond_color wrong = {float(NaN), 0, 0, 1}, negative = {0, -1, 0, 1};
    for (frond_color color : {wrong, negative}) {
        expect_refused(frond_picture_draw_sphere(p, {0, 0, 0}, 1, color), "colour");
        expect_refused(frond_picture_draw_box(p, {0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1}, color), "colour");
        expect_refused(frond_picture_draw_capsule(p, {0, 0, 0}, {0, 1, 0}, 1, color), "colour");
        expect_refused(frond_picture_draw_line(p, {0, 0, 0}, {0, 1, 0}, 1, color), "colour");
        expect_refused(frond_picture_draw_arrow(p, {0, 0, 0}, {0, 1, 0}, 1, color), "colour");
        expect_refused(frond_picture_draw_point(p, {0, 0, 0}, 1, color), "colour");
    }
    for (double bad : {NaN, 1e9, -1e300}) {
        const frond_vec3 point = {0, bad, 0};
        expect_refused(frond_picture_draw_sphere(p, point, 1, RED), "centre");
        expect_refused(frond_picture_draw_box(p, point, {0, 0, 0, 1}, {1, 1, 1}, RED), "centre");
        expect_refused(frond_picture_draw_box(p, {0, 0, 0}, {0, 0, 0, 1}, point, RED), "size");
        expect_refused(frond_picture_draw_capsule(p, point, {0, 1, 0}, 1, RED), "begin");
        expect_refused(frond_picture_draw_capsule(p, {0, 1, 0}, point, 1, RED), "end");
        expect_refused(frond_picture_draw_line(p, point, {0, 1, 0}, 1, RED), "begin");
        expect_refused(frond_picture_draw_line(p, {0, 1, 0}, point, 1, RED), "end");
        expect_refused(frond_picture_draw_arrow(p, point, {0, 1, 0}, 1, RED), "begin");
        expect_refused(frond_picture_draw_arrow(p, {0, 1, 0}, point, 1, RED), "end");
        expect_refused(frond_picture_draw_point(p, point, 1, RED), "point");
        expect_refused(frond_picture_draw_sphere(p, {0, 0, 0}, bad, RED), "radius");
        expect_refused(frond_picture_draw_capsule(p, {0, 0, 0}, {0, 1, 0}, bad, RED), "radius");
        expect_refused(frond_picture_draw_line(p, {0, 0, 0}, {0, 1, 0}, bad, RED), "width");
        expect_refused(frond_picture_draw_arrow(p, {0, 0, 0}, {0, 1, 0}, bad, RED), "width");
        expect_refused(frond_picture_draw_point(p, {0, 0, 0}, bad, RED), "size");
    }
    expect_refused(frond_picture_draw_box(p, {0, 0, 0}, {0, 0, 0, 0}, {1, 1, 1}, RED), "quaternion");
    expect_refused(frond_picture_draw_box(p, {0, 0, 0}, {0, 0, 0, 1}, {-1, 1, 1}, RED), "negative");
    EXPECT_EQ(canvas.end().size(), size_t(WIDTH * HEIGHT * 3));
}

TEST(PictureMisuse, ArraysAreChecked) {
    Canvas canvas;
    canvas.begin(front_scene());
    frond_picture* p = canvas.picture;
    expect_refused(frond_picture_draw_mesh(p, nullptr), "null");
    const Sheet sheet(0, 0, 1);
    const auto refuse = [&](auto change, const char* word) {
        frond_picture_mesh mesh = sheet.mesh();
        change(mesh);
        expect_refused(frond_picture_draw_mesh(p, &mesh), word);
    };
    refuse([](auto& m) { m.positions = nullptr; }, "positions");
    refuse([](auto& m) { m.indices = nullptr; }, "indices");
    refuse([](auto& m) { m.vertex_count = -1; }, "vertices");
    refuse([](auto& m) { m.triangle_count = -1; }, "triangles");
    refuse([](auto& m) { m.part_count = -1; }, "parts");
    frond_picture_mesh bare = sheet.mesh();
    bare.normals = bare.uvs = nullptr, bare.parts = nullptr, bare.part_count = 7;
    EXPECT_TRUE(frond_picture_draw_mesh(p, &bare));
    const frond_picture_mesh nothing{};
    EXPECT_TRUE(frond_picture_draw_mesh(p, &nothing));

    const double nodes[12] = {0, NaN, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const int32_t tets[8] = {0, 1, 2, 3, 1, 2, 3, 77};
    expect_refused(frond_picture_draw_tets(p, nullptr, 4, tets, 1, 1, RED, RED), "nodes");
    expect_refused(frond_picture_draw_tets(p, nodes, 4, nullptr, 1, 1, RED, RED), "tets");
    expect_refused(frond_picture_draw_tets(p, nodes, -4, tets, 1, 1, RED, RED), "nodes");
    expect_refused(frond_picture_draw_tets(p, nodes, 4, tets, -1, 1, RED, RED), "tets");
    expect_refused(frond_picture_draw_tets(p, nodes, 4, tets, 1, NaN, RED, RED), "width");
    EXPECT_TRUE(frond_picture_draw_tets(p, nodes, 4, tets, 2, 1, RED, RED)) << "tets that cannot be drawn are left out";
    EXPECT_TRUE(frond_picture_draw_tets(p, nullptr, 0, nullptr, 0, 1, RED, RED));
    EXPECT_EQ(canvas.end().size(), size_t(WIDTH * HEIGHT * 3));
}

TEST(PictureMisuse, TexturesOfRubbishAreRefused) {
    Canvas canvas;
    int texture = 0;
    const uint8_t png[] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 0, 8, 0, 0};
    const uint8_t webp[] = {'R', 'I', 'F', 'F', 20, 0, 0, 0, 'W', 'E', 'B', 'P', 'V', 'P', '8', ' ', 1, 2, 3, 4};
    const uint8_t jpeg[] = {0xff, 0xd8, 0xff, 0xe0, 0, 16, 'J', 'F', 'I', 'F', 0, 1, 1};
    const uint8_t huge[] = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0x3f, 0xff, 0x3f, 32, 8};
    expect_refused(frond_picture_add_texture(canvas.picture, nullptr, 5, &texture), "bytes");
    expect_refused(frond_picture_add_texture(canvas.picture, png, 0, &texture), "bytes");
    expect_refused(frond_picture_add_texture(canvas.picture, png, sizeof png, nullptr), "out");
    expect_refused(frond_picture_add_texture(canvas.picture, png, sizeof png, &texture), "image");
    expect_refused(frond_picture_add_texture(canvas.picture, webp, sizeof webp, &texture), "image");
    expect_refused(frond_picture_add_texture(canvas.picture, jpeg, sizeof jpeg, &texture), "image");
    expect_refused(frond_picture_add_texture(canvas.picture, huge, sizeof huge, &texture), "smaller");
    EXPECT_EQ(texture, -1);
}

TEST(PictureMisuse, CamerasForNonsenseAreFinite) {
    for (const frond_picture_camera& camera : {frond_picture_frame({NaN, 0, 0}, {1, 1, 1}, {0, 1, 0}, 0, 0, 1),
                                               frond_picture_frame({1, 1, 1}, {0, 0, 0}, {0, 1, 0}, 0, 0, 1),
                                               frond_picture_frame({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0, 1),
                                               frond_picture_frame({0, 0, 0}, {1, 1, 1}, {NaN, 0, 0}, NaN, 1e9, -1)}) {
        Canvas canvas;
        frond_picture_scene scene = frond_default_picture_scene();
        scene.camera = camera;
        canvas.begin(scene);
        EXPECT_FALSE(canvas.end().empty());
    }
}

TEST(PictureMisuse, FilesAreChecked) {
    const uint8_t rgb[3] = {1, 2, 3};
    uint8_t* pixels = nullptr;
    int width = 0, height = 0;
    expect_refused(frond_picture_write_png(nullptr, rgb, 1, 1), "path");
    expect_refused(frond_picture_write_png("", rgb, 1, 1), "path");
    expect_refused(frond_picture_write_png(out_path("x.png").c_str(), nullptr, 1, 1), "null");
    expect_refused(frond_picture_write_png(out_path("x.png").c_str(), rgb, 0, 1), "pixels");
    expect_refused(frond_picture_write_png(out_path("x.png").c_str(), rgb, 1, 70000), "pixels");
    expect_refused(frond_picture_write_png("/nowhere/at/all/x.png", rgb, 1, 1), "/nowhere/at/all/x.png");
    expect_refused(frond_picture_read_png("/nowhere/at/all/x.png", &pixels, &width, &height), "/nowhere");
    expect_refused(frond_picture_read_png(nullptr, &pixels, &width, &height), "path");
    expect_refused(frond_picture_read_png("x.png", nullptr, &width, &height), "null");
    frond_picture_free(nullptr);
}

TEST(PictureMisuse, FilmsAreChecked) {
    frond_film* film = nullptr;
    expect_refused(frond_film_create(nullptr, &film), "null");
    frond_film_def def = frond_default_film_def();
    expect_refused(frond_film_create(&def, nullptr), "null");
    const auto refuse = [&](auto change, const char* word) {
        frond_film_def wrong = frond_default_film_def();
        change(wrong);
        expect_refused(frond_film_create(&wrong, &film), word);
        EXPECT_EQ(film, nullptr);
    };
    refuse([](auto& d) { d.cookie = 0; }, "frond_default_film_def");
    refuse([](auto& d) { d.width = 0; }, "pixels");
    refuse([](auto& d) { d.height = 10000; }, "pixels");
    refuse([](auto& d) { d.frames_per_second = NaN; }, "frames per second");
    refuse([](auto& d) { d.quality = 101; }, "quality");
    refuse([](auto& d) { d.effort = 7; }, "effort");
    refuse([](auto& d) { d.sheet_width = -1; }, "sheet");

    def.width = def.height = 8;
    ASSERT_TRUE(frond_film_create(&def, &film));
    expect_refused(frond_film_add(film, nullptr), "null");
    expect_refused(frond_film_write_webp(film, out_path("x.webp").c_str()), "no frames");
    expect_refused(frond_film_write_sheet(film, out_path("x.png").c_str(), 2, 2), "no frames");
    const std::vector<uint8_t> frame(8 * 8 * 3, 100);
    ASSERT_TRUE(frond_film_add(film, frame.data()));
    expect_refused(frond_film_write_webp(film, nullptr), "path");
    expect_refused(frond_film_write_webp(film, "/nowhere/at/all/x.webp"), "/nowhere");
    expect_refused(frond_film_write_sheet(film, out_path("x.png").c_str(), 0, 2), "sheet");
    expect_refused(frond_film_write_sheet(film, nullptr, 2, 2), "path");
    expect_refused(frond_film_add(film, frame.data()), "written");
    frond_film_destroy(film);
    for (frond_film* dead : {film, static_cast<frond_film*>(nullptr)}) {
        frond_film_destroy(dead);
        EXPECT_EQ(frond_film_get_frame_count(dead), 0);
        expect_refused(frond_film_add(dead, frame.data()), "film");
        expect_refused(frond_film_write_webp(dead, "x.webp"), "film");
        expect_refused(frond_film_write_sheet(dead, "x.png", 1, 1), "film");
    }
}

TEST(PictureMisuse, ComparisonsAreChecked) {
    const uint8_t rgb[3] = {1, 2, 3};
    frond_picture_difference difference;
    expect_refused(frond_picture_compare(nullptr, rgb, 1, 1, 1, &difference, nullptr), "null");
    expect_refused(frond_picture_compare(rgb, nullptr, 1, 1, 1, &difference, nullptr), "null");
    expect_refused(frond_picture_compare(rgb, rgb, 1, 1, 1, nullptr, nullptr), "null");
    expect_refused(frond_picture_compare(rgb, rgb, 0, 1, 1, &difference, nullptr), "pixels");
    expect_refused(frond_picture_compare(rgb, rgb, 1, 1, NaN, &difference, nullptr), "tolerance");
    expect_refused(frond_picture_compare_file(rgb, 1, 1, "/nowhere/x.png", 1, &difference, nullptr), "/nowhere");
    expect_refused(frond_picture_compare_file(rgb, 1, 1, nullptr, 1, &difference, nullptr), "path");
    expect_refused(frond_picture_compare_file(nullptr, 1, 1, "x.png", 1, &difference, nullptr), "null");
    EXPECT_FALSE(difference.same);
}

}  // namespace test_misuse_tests
