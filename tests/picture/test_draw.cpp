// Drawing: light, shadow, cutouts, two sides, overlays; and hostile meshes.
#include <cstring>
#include <limits>
#include <random>

#include "canvas.hpp"

namespace test_draw_tests {

// Returns the bytes of a TGA file: opaque green on the left, transparent on the right.
std::vector<uint8_t> half_cut_png() {
    // Not every reader knows alpha in a BMP file; TGA holds it, and is quickly written.
    std::vector<uint8_t> tga = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 8, 0, 32, 0x28};
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 8; x++) {
            const uint8_t pixel[4] = {20, 200, 20, uint8_t(x < 4 ? 255 : 0)};
            tga.insert(tga.end(), pixel, pixel + 4);
        }
    return tga;
}

int changed(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
    int count = 0;
    for (size_t i = 0; i < a.size(); i += 3) count += a[i] != b[i] || a[i + 1] != b[i + 1] || a[i + 2] != b[i + 2];
    return count;
}

std::vector<uint8_t> draw_sheet(const Sheet& sheet, const frond_picture_scene& scene) {
    Canvas canvas;
    canvas.begin(scene);
    const frond_picture_mesh mesh = sheet.mesh();
    EXPECT_TRUE(frond_picture_draw_mesh(canvas.picture, &mesh)) << frond_picture_last_error();
    return canvas.end();
}

std::vector<uint8_t> draw_nothing(const frond_picture_scene& scene) {
    Canvas canvas;
    canvas.begin(scene);
    return canvas.end();
}

TEST(PictureDraw, BallHasALightSideAndADarkSide) {
    Canvas canvas;
    canvas.begin(front_scene());
    ASSERT_TRUE(frond_picture_draw_sphere(canvas.picture, {0, 0, 0}, 0.8, {0.5f, 0.5f, 0.5f, 1}));
    const std::vector<uint8_t> pixels = canvas.end();
    EXPECT_GT(at(pixels, -0.5, 0.3).sum(), at(pixels, 0.6, -0.3).sum() + 150);
}

TEST(PictureDraw, ShadowFallsAwayFromTheSun) {
    // Seen from straight above: x to the right, z downwards on the picture.
    frond_picture_scene scene = front_scene();
    scene.camera.eye = {0, 6, 0};
    scene.camera.up = {0, 0, -1};
    scene.ground = true;
    scene.sun_direction = {-1, 1, 0};
    Canvas canvas;
    canvas.begin(scene);
    ASSERT_TRUE(frond_picture_draw_box(canvas.picture, {-0.3, 0.5, 0}, {0, 0, 0, 1}, {0.15, 0.05, 0.15},
                                       {0.5f, 0.5f, 0.5f, 1}));
    const std::vector<uint8_t> pixels = canvas.end();
    // The box floats at half a metre; light at 45 degrees moves its shadow by that much to the right.
    const int shadow = at(pixels, 0.2, 0).sum(), left = at(pixels, -0.85, 0).sum(), far = at(pixels, 0.2, 0.8).sum();
    EXPECT_LT(shadow, far - 120);
    EXPECT_LT(shadow, left - 120);
    EXPECT_GT(far, 500);
}

TEST(PictureDraw, ShadowFollowsTheGroundsHeightAndUp) {
    frond_picture_scene scene = front_scene();
    scene.camera.eye = {0, 0, 6};
    scene.up = {0, 0, 1};
    scene.ground = true;
    scene.ground_height = -0.4;
    scene.sun_direction = {-1, 0, 1};
    Canvas canvas;
    canvas.begin(scene);
    ASSERT_TRUE(frond_picture_draw_box(canvas.picture, {-0.3, 0, 0.1}, {0, 0, 0, 1}, {0.15, 0.15, 0.02},
                                       {0.5f, 0.5f, 0.5f, 1}));
    const std::vector<uint8_t> pixels = canvas.end();
    EXPECT_LT(at(pixels, 0.19, 0).sum(), at(pixels, 0.19, 0.8).sum() - 120);
}

TEST(PictureDraw, BodyShadesAnother) {
    frond_picture_scene scene = front_scene();
    scene.sun_direction = {0, 1, 0.3};
    const auto draw = [&](bool roof) {
        Canvas canvas;
        canvas.begin(scene);
        EXPECT_TRUE(frond_picture_draw_sphere(canvas.picture, {0, -0.4, 0}, 0.4, {0.5f, 0.5f, 0.5f, 1}));
        if (roof) {
            EXPECT_TRUE(
                frond_picture_draw_box(canvas.picture, {0, 0.6, 0}, {0, 0, 0, 1}, {0.6, 0.02, 0.6}, {1, 1, 1, 1}));
        }
        return canvas.end();
    };
    EXPECT_LT(at(draw(true), 0, -0.2).sum(), at(draw(false), 0, -0.2).sum() - 120);
}

TEST(PictureDraw, SkyLeavesEnclosedPlacesDarker) {
    frond_picture_scene scene = front_scene();
    scene.sun = {0, 0, 0, 0};
    const auto draw = [&](bool walls) {
        Canvas canvas;
        canvas.begin(scene);
        EXPECT_TRUE(
            frond_picture_draw_box(canvas.picture, {0, -0.6, 0}, {0, 0, 0, 1}, {0.3, 0.3, 0.3}, {0.5f, 0.5f, 0.5f, 1}));
        if (walls) {
            EXPECT_TRUE(frond_picture_draw_box(canvas.picture, {0, 0.3, 0.6}, {0, 0, 0, 1}, {1, 0.1, 1.2},
                                               {0.5f, 0.5f, 0.5f, 1}));
        }
        return canvas.end();
    };
    EXPECT_LT(at(draw(true), 0, -0.6).sum(), at(draw(false), 0, -0.6).sum() - 30);
}

TEST(PictureDraw, AlphaCutsLeavesOut) {
    Canvas canvas;
    canvas.begin(front_scene());
    const std::vector<uint8_t> bytes = half_cut_png();
    Sheet sheet(-0.8f, -0.8f, 1.6f);
    sheet.part.color = {1, 1, 1, 1};
    ASSERT_TRUE(frond_picture_add_texture(canvas.picture, bytes.data(), bytes.size(), &sheet.part.texture))
        << frond_picture_last_error();
    const frond_picture_mesh mesh = sheet.mesh();
    ASSERT_TRUE(frond_picture_draw_mesh(canvas.picture, &mesh));
    const std::vector<uint8_t> pixels = canvas.end(), empty = draw_nothing(front_scene());
    EXPECT_GT(at(pixels, -0.5, 0).g, at(pixels, -0.5, 0).r + 50);
    EXPECT_TRUE(same_color(at(pixels, 0.5, 0), at(empty, 0.5, 0)));
}

TEST(PictureDraw, CutLeafThrowsACutShadow) {
    frond_picture_scene scene = front_scene();
    scene.camera.eye = {0, 6, 0};
    scene.camera.up = {0, 0, -1};
    scene.ground = true;
    scene.ground_height = -0.5;
    scene.sun_direction = {-1, 1, 0};
    Canvas canvas;
    canvas.begin(scene);
    const std::vector<uint8_t> bytes = half_cut_png();
    Sheet sheet(0, 0, 1);
    // Flat at height zero, from -0.6 to 0 in x; the transparent half is the right one.
    sheet.positions = {-0.6f, 0, 0.3f, 0, 0, 0.3f, 0, 0, -0.3f, -0.6f, 0, -0.3f};
    for (size_t i = 0; i < 12; i++) sheet.normals[i] = i % 3 == 1 ? 1.0f : 0.0f;
    ASSERT_TRUE(frond_picture_add_texture(canvas.picture, bytes.data(), bytes.size(), &sheet.part.texture));
    const frond_picture_mesh mesh = sheet.mesh();
    ASSERT_TRUE(frond_picture_draw_mesh(canvas.picture, &mesh));
    const std::vector<uint8_t> pixels = canvas.end();
    EXPECT_LT(at(pixels, 0.06, 0).sum(), at(pixels, 0.06, 0.8).sum() - 100);
    EXPECT_GT(at(pixels, 0.36, 0).sum(), at(pixels, 0.36, 0.8).sum() - 40);
}

TEST(PictureDraw, SheetsLookTheSameWhicheverWayTheyWereWound) {
    Sheet sheet(-0.8f, -0.8f, 1.6f);
    const Pixel front = at(draw_sheet(sheet, front_scene()), 0, 0);
    sheet.indices = {0, 2, 1, 0, 3, 2};
    EXPECT_TRUE(same_color(front, at(draw_sheet(sheet, front_scene()), 0, 0)));
    for (float& n : sheet.normals) n = -n;
    EXPECT_TRUE(same_color(front, at(draw_sheet(sheet, front_scene()), 0, 0)));
    EXPECT_FALSE(same_color(front, at(draw_nothing(front_scene()), 0, 0), 20));
}

TEST(PictureDraw, LeafGlowsWithTheSunBehindIt) {
    frond_picture_scene scene = front_scene();
    scene.sun_direction = {0.2, 0.3, -1};
    Sheet sheet(-0.8f, -0.8f, 1.6f);
    const Pixel wood = at(draw_sheet(sheet, scene), 0, 0);
    sheet.part.translucency = 0.4f;
    const Pixel leaf = at(draw_sheet(sheet, scene), 0, 0);
    EXPECT_GT(leaf.g, wood.g + 30);
    EXPECT_GT(leaf.g - leaf.b, wood.g - wood.b);
}

TEST(PictureDraw, AWideFloorLeavesShadowsSharp) {
    const auto contrast = [](bool is_floor) {
        Sheet floor(-100, -100, 200);
        floor.part.is_floor = is_floor;
        floor.part.color = {0.5f, 0.5f, 0.5f, 1};
        Canvas canvas;
        canvas.begin(front_scene());
        const frond_picture_mesh mesh = floor.mesh();
        EXPECT_TRUE(frond_picture_draw_mesh(canvas.picture, &mesh));
        EXPECT_TRUE(frond_picture_draw_sphere(canvas.picture, {-0.3, 0.3, 0.3}, 0.15, {1, 0, 0, 1}));
        const std::vector<uint8_t> pixels = canvas.end();
        EXPECT_TRUE(same_color(at(pixels, -0.7, -0.7), at(pixels, 0.7, 0.7), 12));
        return at(pixels, 0.7, 0.7).sum() - at(pixels, 0.2, 0).sum();  // lit, and in the sphere's shadow
    };
    EXPECT_GT(contrast(true), 90);
    EXPECT_LT(contrast(false), contrast(true) / 2);  // a texel of the map is as wide as the sphere
}

TEST(PictureDraw, VertexColoursAndPartsShow) {
    Sheet sheet(-0.8f, -0.8f, 1.6f);
    sheet.part.color = {1, 1, 1, 1};
    const std::vector<uint8_t> colors = {200, 0, 0, 255, 200, 0, 0, 255, 200, 0, 0, 255, 200, 0, 0, 255};
    Canvas canvas;
    canvas.begin(front_scene());
    frond_picture_mesh mesh = sheet.mesh();
    mesh.colors = colors.data();
    const frond_picture_part second = {1, 1, {0, 0, 0, 1}, -1, 0, 0, false};
    const frond_picture_part parts[2] = {{0, 1, {1, 1, 1, 1}, -1, 0, 0, false}, second};
    mesh.parts = parts, mesh.part_count = 2;
    ASSERT_TRUE(frond_picture_draw_mesh(canvas.picture, &mesh));
    const std::vector<uint8_t> pixels = canvas.end();
    EXPECT_GT(at(pixels, 0.4, -0.4).r, 150);  // first triangle, lower right
    EXPECT_LT(at(pixels, 0.4, -0.4).g, 60);
    EXPECT_LT(at(pixels, -0.4, 0.4).sum(), 60);
}

TEST(PictureDraw, NearerSurfacesHideOthers) {
    Canvas canvas;
    canvas.begin(front_scene());
    ASSERT_TRUE(frond_picture_draw_sphere(canvas.picture, {0, 0, 0.5}, 0.3, {1, 0, 0, 1}));
    ASSERT_TRUE(frond_picture_draw_sphere(canvas.picture, {0, 0, -0.5}, 0.3, {0, 0, 1, 1}));
    const Pixel middle = at(canvas.end(), 0, 0);
    EXPECT_GT(middle.r, middle.b + 60);
}

TEST(PictureDraw, WireframeShowsInFrontAndFaintlyThroughASurface) {
    const double nodes[12] = {-0.8, -0.8, 0.5, 0.8, -0.8, 0.5, 0, 0.8, 0.5, 0, 0, -0.9};
    const int32_t tet[4] = {0, 1, 2, 3};
    const auto draw = [&](bool wire, double z) {
        Canvas canvas;
        canvas.begin(front_scene());
        Sheet sheet(-1.5f, -1.5f, 3.0f, float(z));
        const frond_picture_mesh mesh = sheet.mesh();
        EXPECT_TRUE(frond_picture_draw_mesh(canvas.picture, &mesh));
        if (wire) {
            EXPECT_TRUE(frond_picture_draw_tets(canvas.picture, nodes, 4, tet, 1, 2, {0, 0, 0.3f, 1}, {0, 0, 0, 0}));
        }
        return canvas.end();
    };
    const int in_front = changed(draw(true, -1), draw(false, -1)), behind = changed(draw(true, 1), draw(false, 1));
    EXPECT_GT(in_front, 400);
    EXPECT_GT(behind, 400);
    // Fainter behind: the change along the lowest edge is smaller.
    const Pixel front_pixel = at(draw(true, -1), 0, -0.87), behind_pixel = at(draw(true, 1), 0, -0.87);
    const Pixel front_plain = at(draw(false, -1), 0, -0.87), behind_plain = at(draw(false, 1), 0, -0.87);
    EXPECT_GT(front_plain.sum() - front_pixel.sum(), 2 * (behind_plain.sum() - behind_pixel.sum()));
    EXPECT_GT(behind_plain.sum() - behind_pixel.sum(), 5);
}

TEST(PictureDraw, CageFacesTintWhatIsBehind) {
    const double nodes[12] = {-0.8, -0.8, 0.5, 0.8, -0.8, 0.5, 0, 0.8, 0.5, 0, 0, -0.9};
    const int32_t tet[4] = {0, 1, 2, 3};
    Canvas canvas;
    canvas.begin(front_scene());
    ASSERT_TRUE(frond_picture_draw_tets(canvas.picture, nodes, 4, tet, 1, 0, {0, 0, 0, 1}, {1, 0, 0, 0.5f}));
    const std::vector<uint8_t> pixels = canvas.end(), empty = draw_nothing(front_scene());
    EXPECT_LT(at(pixels, 0, -0.3).b, at(empty, 0, -0.3).b - 30);
    EXPECT_GT(at(pixels, 0, -0.3).r, at(pixels, 0, -0.3).b + 30);
    EXPECT_TRUE(same_color(at(pixels, -0.9, 0.8), at(empty, -0.9, 0.8)));
}

TEST(PictureDraw, ArrowAndPointShowWhereTheyAre) {
    Canvas canvas;
    canvas.begin(front_scene());
    ASSERT_TRUE(frond_picture_draw_arrow(canvas.picture, {-0.5, 0, 0}, {0.5, 0, 0}, 4, {0.8f, 0, 0, 1}));
    ASSERT_TRUE(frond_picture_draw_point(canvas.picture, {0, 0.5, 0}, 10, {0, 0, 0.8f, 1}));
    const std::vector<uint8_t> pixels = canvas.end(), empty = draw_nothing(front_scene());
    EXPECT_GT(at(pixels, -0.2, 0).r, at(pixels, -0.2, 0).g + 120);
    EXPECT_GT(at(pixels, 0.35, 0.04).r, at(pixels, 0.35, 0.04).g + 120) << "the head is wider than the line";
    EXPECT_TRUE(same_color(at(pixels, 0.6, 0), at(empty, 0.6, 0)));
    EXPECT_GT(at(pixels, 0, 0.5).b, at(pixels, 0, 0.5).g + 120);
}

TEST(PictureDraw, GlassLetsThroughAndThrowsNoShadow) {
    frond_picture_scene scene = front_scene();
    scene.camera.eye = {0, 6, 0};
    scene.camera.up = {0, 0, -1};
    scene.ground = true;
    scene.sun_direction = {-1, 1, 0};
    Canvas canvas;
    canvas.begin(scene);
    ASSERT_TRUE(frond_picture_draw_capsule(canvas.picture, {-0.3, 0.5, -0.1}, {-0.3, 0.5, 0.1}, 0.15, {1, 0, 0, 0.4f}));
    const std::vector<uint8_t> pixels = canvas.end();
    EXPECT_GT(at(pixels, -0.3, 0).r, at(pixels, -0.3, 0).b + 30);
    EXPECT_GT(at(pixels, -0.3, 0).b, 40);
    EXPECT_TRUE(same_color(at(pixels, 0.2, 0), at(pixels, 0.2, 0.8), 6));
}

TEST(PictureDraw, LinesThroughTheEyeAreCut) {
    Canvas canvas;
    canvas.begin(front_scene());
    ASSERT_TRUE(frond_picture_draw_line(canvas.picture, {0, 0, 0}, {0.3, 0, 20}, 3, {1, 0, 0, 1}));
    ASSERT_TRUE(frond_picture_draw_line(canvas.picture, {0, 0, 8}, {0, 0, 9}, 3, {1, 0, 0, 1}));
    const std::vector<uint8_t> pixels = canvas.end(), empty = draw_nothing(front_scene());
    EXPECT_TRUE(same_color(at(pixels, -0.8, 0), at(empty, -0.8, 0))) << "nothing on the far side";
    EXPECT_LT(changed(pixels, empty), WIDTH * HEIGHT / 8);
}

TEST(PictureDraw, FramedBoxIsInsideThePictureFromAllSides) {
    const frond_vec3 lower = {-0.2, 0.1, -0.4}, upper = {0.5, 2.3, 0.3};
    for (frond_vec3 up : {frond_vec3{0, 1, 0}, frond_vec3{0, 0, 1}})
        for (double aspect : {0.5, 16.0 / 9})
            for (double elevation : {-1.5, -0.3, 0.0, 0.4, 1.5})
                for (double azimuth = 0; azimuth < 6.2; azimuth += 0.7) {
                    const frond_picture_camera camera =
                        frond_picture_frame(lower, upper, up, azimuth, elevation, aspect);
                    const double slope = std::tan(0.5 * camera.field_of_view);
                    const auto minus = [](frond_vec3 a, frond_vec3 b) {
                        return frond_vec3{a.x - b.x, a.y - b.y, a.z - b.z};
                    };
                    const auto dot = [](frond_vec3 a, frond_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
                    const auto cross = [](frond_vec3 a, frond_vec3 b) {
                        return frond_vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
                    };
                    const auto unit = [&](frond_vec3 a) {
                        const double s = 1 / std::sqrt(dot(a, a));
                        return frond_vec3{s * a.x, s * a.y, s * a.z};
                    };
                    const frond_vec3 back = unit(minus(camera.eye, camera.target)),
                                     right = unit(cross(camera.up, back));
                    const frond_vec3 over = cross(back, right);
                    double widest = 0;
                    for (int c = 0; c < 8; c++) {
                        const frond_vec3 p =
                            minus({c & 1 ? upper.x : lower.x, c & 2 ? upper.y : lower.y, c & 4 ? upper.z : lower.z},
                                  camera.eye);
                        const double depth = -dot(p, back);
                        ASSERT_GT(depth, 0);
                        const double x = std::fabs(dot(p, right)) / (depth * slope * aspect),
                                     y = std::fabs(dot(p, over)) / (depth * slope);
                        widest = std::max({widest, x, y});
                    }
                    EXPECT_LT(widest, 1) << "azimuth " << azimuth << " elevation " << elevation;
                    EXPECT_GT(widest, 0.8);
                }
}

TEST(PictureDraw, TroubledTrianglesAreLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    Sheet sheet(-0.8f, -0.8f, 1.6f);
    const std::vector<uint8_t> expected = draw_sheet(sheet, front_scene());
    for (float bad : {nan, inf, -inf, 1e30f, -3e38f, 2e6f}) {
        sheet.positions.insert(sheet.positions.end(), {bad, 0, 0, 0, bad, 0, 0.1f, 0.1f, bad});
        sheet.normals.insert(sheet.normals.end(), {bad, bad, bad, 0, 0, 0, bad, 0, 0});
        sheet.uvs.insert(sheet.uvs.end(), {bad, bad, bad, 0, 0, bad});
        const int n = int(sheet.positions.size() / 3);
        sheet.indices.insert(sheet.indices.end(), {0, 1, n - 1, n - 3, n - 2, n - 1, 0, n - 2, 2});
    }
    const int n = int(sheet.positions.size() / 3);
    sheet.indices.insert(sheet.indices.end(), {0, 1, -1, 0, 1, n, INT32_MIN, INT32_MAX, 0, 2, 2, 2, 0, 0, 1});
    sheet.part.triangle_count = int(sheet.indices.size() / 3);
    EXPECT_EQ(changed(expected, draw_sheet(sheet, front_scene())), 0);
}

TEST(PictureDraw, NormalsThatAreNoDirectionBecomeTheFaces) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Sheet sheet(-0.8f, -0.8f, 1.6f);
    const Pixel expected = at(draw_sheet(sheet, front_scene()), 0, 0);
    sheet.normals = {nan, 0, 0, 0, 0, 0, 1e30f, nan, 0, 0, 0, 0};
    EXPECT_TRUE(same_color(expected, at(draw_sheet(sheet, front_scene()), 0, 0)));
}

TEST(PictureDraw, RandomMeshesDoNoHarm) {
    std::mt19937 random(7);
    Canvas canvas;
    for (int round = 0; round < 30; round++) {
        std::vector<float> positions(90), normals(90), uvs(60);
        std::vector<int32_t> indices(120);
        std::vector<uint8_t> colors(120);
        for (auto* array : {&positions, &normals, &uvs})
            for (float& value : *array) {
                // Arbitrary bits, or an ordinary number.
                const uint32_t bits = uint32_t(random());
                if (random() % 4 == 0)
                    std::memcpy(&value, &bits, 4);
                else
                    value = float(int(random() % 2000) - 1000) / 700;
            }
        for (int32_t& index : indices) index = int32_t(random() % 8 ? random() % 30 : random());
        for (uint8_t& color : colors) color = uint8_t(random());
        frond_picture_part parts[3];
        for (frond_picture_part& part : parts) {
            part = {
                int(random() % 50) - 5, int(random() % 60) - 5, {1, 1, 1, 1}, int(random() % 5) - 2, 0.5f, 0.5f, false};
            if (random() % 4 == 0) part.color.r = part.gloss = part.translucency = std::nanf("");
            if (random() % 4 == 0) part.first_triangle = INT32_MAX, part.triangle_count = INT32_MAX;
        }
        const frond_picture_mesh mesh = {
            positions.data(), normals.data(), uvs.data(), colors.data(), indices.data(), 30, 40, parts, 3};
        canvas.begin(front_scene());
        EXPECT_TRUE(frond_picture_draw_mesh(canvas.picture, &mesh));
        EXPECT_EQ(canvas.end().size(), size_t(WIDTH * HEIGHT * 3));
    }
}

TEST(PictureDraw, SizesFromOnePixelToTallAndWideWork) {
    for (const auto& size : {std::pair<int, int>{1, 1}, {3, 500}, {2000, 2}}) {
        frond_picture_def def = small_def();
        def.width = size.first, def.height = size.second;
        def.samples = 1 + size.first % 3;
        Canvas canvas(def);
        canvas.begin(front_scene());
        EXPECT_TRUE(frond_picture_draw_sphere(canvas.picture, {0, 0, 0}, 0.5, {1, 0, 0, 1}));
        EXPECT_EQ(canvas.end().size(), size_t(size.first) * size.second * 3);
    }
}

TEST(PictureDraw, FarFromTheOriginLooksTheSame) {
    const auto draw = [](double x) {
        frond_picture_scene scene = front_scene();
        scene.camera.eye.x += x, scene.camera.target.x += x;
        Canvas canvas;
        canvas.begin(scene);
        EXPECT_TRUE(frond_picture_draw_sphere(canvas.picture, {x, 0, 0}, 0.7, {0.5f, 0.2f, 0.1f, 1}));
        return canvas.end();
    };
    frond_picture_difference difference;
    const std::vector<uint8_t> near = draw(0), far = draw(5e5);
    ASSERT_TRUE(
        frond_picture_compare(near.data(), far.data(), WIDTH, HEIGHT, FROND_PICTURE_TOLERANCE, &difference, nullptr));
    EXPECT_TRUE(difference.same) << difference.worst;
}

}  // namespace test_draw_tests

// A sphere of radius 1 m, 5 m away, before a wall 8 m away.
TEST(PictureDraw, MeasuresWhatIsSeenAndHowFarItIs) {
    Canvas canvas;
    frond_picture_scene scene = front_scene();
    scene.camera.field_of_view = 0.6;
    canvas.begin(scene);
    ASSERT_TRUE(frond_picture_set_id(canvas.picture, 7));
    ASSERT_TRUE(frond_picture_draw_sphere(canvas.picture, {0, 0, 0}, 1, {1, 0, 0, 1}));
    ASSERT_TRUE(frond_picture_set_id(canvas.picture, 1 << 30));
    ASSERT_TRUE(frond_picture_draw_box(canvas.picture, {0, 2, -3}, {0, 0, 0, 1}, {9, 2, 1}, {0, 1, 0, 1}));
    canvas.end();
    const int32_t* ids = frond_picture_get_ids(canvas.picture);
    const float* distances = frond_picture_get_distances(canvas.picture);
    ASSERT_TRUE(ids && distances) << frond_picture_last_error();
    const auto at = [](int x, int y) { return y * WIDTH + x; };
    EXPECT_EQ(ids[at(WIDTH / 2, HEIGHT / 2)], 7);
    EXPECT_NEAR(double(distances[at(WIDTH / 2, HEIGHT / 2)]), 5, 0.02);
    EXPECT_EQ(ids[at(2, 2)], 1 << 30);
    EXPECT_NEAR(double(distances[at(2, 2)]), 8, 0.001);
    EXPECT_EQ(ids[at(2, HEIGHT - 2)], -1);
    EXPECT_EQ(distances[at(2, HEIGHT - 2)], INFINITY);
    canvas.begin(scene);
    canvas.end();
    EXPECT_FALSE(frond_picture_get_ids(canvas.picture));  // it was not measured
    EXPECT_FALSE(frond_picture_get_distances(canvas.picture));
    EXPECT_FALSE(frond_picture_set_id(canvas.picture, 1));  // no frame is begun
}
