// PNG and WebP: files are read back as they were written.
#include <webp/demux.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "canvas.hpp"

namespace test_files_tests {

std::vector<uint8_t> read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Draws a white disc that moves to the right on a blue background.
std::vector<uint8_t> moving_disc(int width, int height, int step) {
    std::vector<uint8_t> pixels(size_t(width) * height * 3);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const bool inside = std::hypot(x - 10.0 - 6 * step, y - height / 2.0) < 8;
            const uint8_t color[3] = {uint8_t(inside ? 255 : 20), uint8_t(inside ? 255 : 40),
                                      uint8_t(inside ? 255 : 120)};
            std::copy(color, color + 3, &pixels[(size_t(y) * width + x) * 3]);
        }
    return pixels;
}

TEST(PictureFiles, PngComesBackExactly) {
    std::vector<uint8_t> pixels(37 * 23 * 3);
    for (size_t i = 0; i < pixels.size(); i++) pixels[i] = uint8_t(i * 7919 >> 3);
    const std::string path = out_path("round_trip.png");
    ASSERT_TRUE(frond_picture_write_png(path.c_str(), pixels.data(), 37, 23)) << frond_picture_last_error();
    uint8_t* read = nullptr;
    int width = 0, height = 0;
    ASSERT_TRUE(frond_picture_read_png(path.c_str(), &read, &width, &height)) << frond_picture_last_error();
    EXPECT_EQ(width, 37);
    EXPECT_EQ(height, 23);
    EXPECT_EQ(pixels, std::vector<uint8_t>(read, read + pixels.size()));
    frond_picture_free(read);
}

TEST(PictureFiles, DamagedPngsAreRefused) {
    const std::vector<uint8_t> pixels(64 * 64 * 3, 77);
    const std::string path = out_path("damaged.png");
    ASSERT_TRUE(frond_picture_write_png(path.c_str(), pixels.data(), 64, 64));
    const std::vector<uint8_t> whole = read_file(path);
    for (size_t length = 0; length < whole.size(); length += 5) {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(whole.data()), std::streamsize(length));
        uint8_t* read = nullptr;
        int width = 0, height = 0;
        if (frond_picture_read_png(path.c_str(), &read, &width, &height))
            EXPECT_GT(length, whole.size() - 16);
        else
            EXPECT_EQ(read, nullptr);
        frond_picture_free(read);
    }
}

TEST(PictureFiles, PictureWritesItsPixels) {
    Canvas canvas;
    canvas.begin(front_scene());
    ASSERT_TRUE(frond_picture_draw_sphere(canvas.picture, {0, 0, 0}, 0.5, {0.8f, 0.1f, 0.1f, 1}));
    const std::vector<uint8_t> pixels = canvas.end();
    const std::string path = out_path("ball.png");
    ASSERT_TRUE(frond_picture_write(canvas.picture, path.c_str()));
    uint8_t* read = nullptr;
    int width = 0, height = 0;
    ASSERT_TRUE(frond_picture_read_png(path.c_str(), &read, &width, &height));
    EXPECT_EQ(pixels, std::vector<uint8_t>(read, read + pixels.size()));
    frond_picture_free(read);
    // A PNG is also a texture.
    const std::vector<uint8_t> bytes = read_file(path);
    int first = -1, second = -1;
    EXPECT_TRUE(frond_picture_add_texture(canvas.picture, bytes.data(), bytes.size(), &first))
        << frond_picture_last_error();
    EXPECT_TRUE(frond_picture_add_texture(canvas.picture, bytes.data(), bytes.size(), &second));
    EXPECT_GE(first, 0);
    EXPECT_EQ(second, first) << "the same bytes are the same texture";
}

TEST(PictureFiles, WebpHasTheFramesAndTheirTimes) {
    frond_film_def def = frond_default_film_def();
    def.width = 96, def.height = 48;
    def.frames_per_second = 20;
    def.quality = 90;
    frond_film* film = nullptr;
    ASSERT_TRUE(frond_film_create(&def, &film)) << frond_picture_last_error();
    for (int step = 0; step < 12; step++) ASSERT_TRUE(frond_film_add(film, moving_disc(96, 48, step).data()));
    EXPECT_EQ(frond_film_get_frame_count(film), 12);
    const std::string path = out_path("disc.webp");
    ASSERT_TRUE(frond_film_write_webp(film, path.c_str())) << frond_picture_last_error();
    EXPECT_TRUE(frond_film_write_webp(film, path.c_str())) << "writing again is allowed";
    frond_film_destroy(film);

    const std::vector<uint8_t> bytes = read_file(path);
    const WebPData data = {bytes.data(), bytes.size()};
    WebPAnimDecoderOptions options;
    ASSERT_TRUE(WebPAnimDecoderOptionsInit(&options));
    options.color_mode = MODE_RGBA;
    WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, &options);
    ASSERT_NE(decoder, nullptr);
    WebPAnimInfo info;
    ASSERT_TRUE(WebPAnimDecoderGetInfo(decoder, &info));
    EXPECT_EQ(info.frame_count, 12u);
    EXPECT_EQ(info.canvas_width, 96u);
    EXPECT_EQ(info.loop_count, 0u);
    for (int step = 0; step < 12; step++) {
        uint8_t* rgba = nullptr;
        int time = 0;
        ASSERT_TRUE(WebPAnimDecoderGetNext(decoder, &rgba, &time));
        EXPECT_EQ(time, 50 * (step + 1)) << "each frame ends one twentieth of a second later";
        const size_t disc = (24 * 96 + size_t(10 + 6 * step)) * 4,
                     ground = (24 * 96 + size_t((60 + 6 * step) % 96)) * 4;
        EXPECT_GT(rgba[disc], 200);
        EXPECT_LT(rgba[ground], 80);
    }
    WebPAnimDecoderDelete(decoder);
}

TEST(PictureFiles, SheetShowsFirstToLastFrame) {
    frond_film_def def = frond_default_film_def();
    def.width = 40, def.height = 20;
    def.sheet_width = 20;
    def.moving = false;
    frond_film* film = nullptr;
    ASSERT_TRUE(frond_film_create(&def, &film));
    for (int i = 0; i < 30; i++)
        ASSERT_TRUE(frond_film_add(film, std::vector<uint8_t>(40 * 20 * 3, uint8_t(i * 8)).data()));
    EXPECT_FALSE(frond_film_write_webp(film, out_path("none.webp").c_str()));
    const std::string path = out_path("sheet.png");
    ASSERT_TRUE(frond_film_write_sheet(film, path.c_str(), 3, 2)) << frond_picture_last_error();
    frond_film_destroy(film);
    uint8_t* pixels = nullptr;
    int width = 0, height = 0;
    ASSERT_TRUE(frond_picture_read_png(path.c_str(), &pixels, &width, &height));
    ASSERT_EQ(width, 3 * 24 + 4);
    ASSERT_EQ(height, 2 * 14 + 4);
    for (int k = 0; k < 6; k++)
        EXPECT_EQ(pixels[(size_t(4 + k / 3 * 14 + 5) * width + size_t(4 + k % 3 * 24 + 10)) * 3], k * 29 / 5 * 8);
    frond_picture_free(pixels);
}

}  // namespace test_files_tests
