// In: frames of a run. Out: an animated WebP, encoded frame by frame (libwebp's animation encoder), and a contact
// sheet.
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "error.hpp"
#include "frond_picture.h"
#include "registry.hpp"

using namespace picture;

struct frond_film {
    struct EncoderDeleter {
        void operator()(WebPAnimEncoder* encoder) const noexcept { WebPAnimEncoderDelete(encoder); }
    };
    frond_film_def def;
    std::unique_ptr<WebPAnimEncoder, EncoderDeleter> encoder;
    WebPConfig config;
    int frame_count = 0;
    bool written = false;
    std::vector<uint8_t> webp;  // the file, once assembled
    int small_width = 0, small_height = 0;
    std::vector<std::vector<uint8_t>> small;  // frames at the sheet's size
};

namespace {

constexpr uint32_t FILM_COOKIE = 0xf11e01u;

frond_film& living(const frond_film* film) {
    if (!film) fail("the film is null; make one with frond_film_create");
    if (!Registry<frond_film>::instance().holds(film))
        fail("the film has been destroyed, or never was one; make one with frond_film_create");
    return *const_cast<frond_film*>(film);
}

void check_def(const frond_film_def* def) {
    if (!def) fail("the def is null");
    if (def->cookie != FILM_COOKIE) fail("the def was not made by frond_default_film_def; start from that");
    if (def->width < 1 || def->height < 1 || def->width > FROND_PICTURE_LARGEST || def->height > FROND_PICTURE_LARGEST)
        fail("a film of %d x %d pixels cannot be made; use 1..%d", def->width, def->height, FROND_PICTURE_LARGEST);
    if (!(def->frames_per_second >= 1 && def->frames_per_second <= 1000))
        fail("the film has %g frames per second; use 1..1000", def->frames_per_second);
    if (!(def->quality >= 0 && def->quality <= 100)) fail("the film's quality is %g; use 0..100", def->quality);
    if (def->effort < 0 || def->effort > 6) fail("the film's effort is %d; use 0..6", def->effort);
    if (def->sheet_width < 0 || def->sheet_width > FROND_PICTURE_LARGEST)
        fail("the frames on the sheet are %d pixels wide; use 0..%d", def->sheet_width, FROND_PICTURE_LARGEST);
}

// Returns means over the area of each small pixel. sRGB bytes are averaged as they are: the sheet is an overview.
std::vector<uint8_t> shrink(const uint8_t* rgb, int width, int height, int small_width, int small_height) {
    std::vector<uint8_t> small(size_t(small_width) * small_height * 3);
    for (int y = 0; y < small_height; y++)
        for (int x = 0; x < small_width; x++) {
            const int left = int(int64_t(x) * width / small_width), top = int(int64_t(y) * height / small_height);
            const int right = std::max(left + 1, int(int64_t(x + 1) * width / small_width));
            const int bottom = std::max(top + 1, int(int64_t(y + 1) * height / small_height));
            uint64_t sum[3] = {0, 0, 0};
            for (int j = top; j < bottom; j++)
                for (int i = left; i < right; i++)
                    for (int c = 0; c < 3; c++) sum[c] += rgb[(size_t(j) * width + i) * 3 + c];
            const uint64_t count = uint64_t(right - left) * (bottom - top);
            for (int c = 0; c < 3; c++)
                small[(size_t(y) * small_width + x) * 3 + c] = uint8_t((sum[c] + count / 2) / count);
        }
    return small;
}

void encode(frond_film& film, const uint8_t* rgb) {
    WebPPicture frame;
    if (!WebPPictureInit(&frame)) fail("another version of libwebp is installed than this was built with; build anew");
    frame.width = film.def.width, frame.height = film.def.height;
    frame.use_argb = 1;
    const int start = int(film.frame_count * 1000.0 / film.def.frames_per_second + 0.5);
    const bool added = WebPPictureImportRGB(&frame, rgb, film.def.width * 3) &&
                       WebPAnimEncoderAdd(film.encoder.get(), &frame, start, &film.config);
    WebPPictureFree(&frame);
    if (!added) fail("the frame cannot be encoded: %s", WebPAnimEncoderGetError(film.encoder.get()));
}

}  // namespace

frond_film_def frond_default_film_def(void) {
    frond_film_def def{};
    def.width = 1280, def.height = 720;
    def.frames_per_second = 30;
    def.quality = 80;
    def.effort = 2;
    def.sheet_width = 320;
    def.moving = true;
    def.cookie = FILM_COOKIE;
    return def;
}

bool frond_film_create(const frond_film_def* def, frond_film** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        if (!out) fail("where the film goes (out) is null");
        check_def(def);
        auto film = std::make_unique<frond_film>();
        film->def = *def;
        if (def->moving) {
            WebPAnimEncoderOptions options;
            if (!WebPAnimEncoderOptionsInit(&options) || !WebPConfigInit(&film->config))
                fail("another version of libwebp is installed than this was built with; build anew");
            film->config.quality = float(def->quality);
            film->config.method = def->effort;
            film->encoder.reset(WebPAnimEncoderNew(def->width, def->height, &options));
            if (!film->encoder) fail("libwebp cannot make a film of %d x %d pixels", def->width, def->height);
        }
        if (def->sheet_width > 0) {
            film->small_width = std::min(def->sheet_width, def->width);
            film->small_height = std::max(1, int(int64_t(film->small_width) * def->height / def->width));
        }
        Registry<frond_film>::instance().add(film.get());
        *out = film.release();
    });
}

void frond_film_destroy(frond_film* film) {
    guarded([&] {
        if (film && Registry<frond_film>::instance().remove(film)) delete film;
    });
}

bool frond_film_add(frond_film* film, const uint8_t* rgb) {
    return guarded([&] {
        frond_film& target = living(film);
        if (!rgb) fail("the pixels are null");
        if (target.written) fail("the film has been written; make another one");
        if (target.frame_count >= 1000000) fail("the film is too long; make another one");
        if (target.encoder) encode(target, rgb);
        if (target.small_width > 0)
            target.small.push_back(
                shrink(rgb, target.def.width, target.def.height, target.small_width, target.small_height));
        target.frame_count++;
    });
}

int frond_film_get_frame_count(const frond_film* film) {
    int count = 0;
    guarded([&] { count = living(film).frame_count; });
    return count;
}

bool frond_film_write_webp(frond_film* film, const char* path) {
    return guarded([&] {
        frond_film& source = living(film);
        if (!path || !*path) fail("the path of the WebP is empty; name a file");
        if (!source.encoder) fail("the film keeps no moving picture; set moving in its def");
        if (source.frame_count == 0) fail("the film has no frames; add some first");
        if (!source.written) {
            const int end = int(source.frame_count * 1000.0 / source.def.frames_per_second + 0.5);
            WebPData data;
            WebPDataInit(&data);
            source.written = true;
            if (!WebPAnimEncoderAdd(source.encoder.get(), nullptr, end, nullptr) ||
                !WebPAnimEncoderAssemble(source.encoder.get(), &data))
                fail("the film cannot be put together: %s", WebPAnimEncoderGetError(source.encoder.get()));
            const std::unique_ptr<const uint8_t, void (*)(const void*)> owner(
                data.bytes, [](const void* bytes) { WebPFree(const_cast<void*>(bytes)); });
            source.webp.assign(data.bytes, data.bytes + data.size);
        }
        if (source.webp.empty()) fail("the film could not be put together before; make another one");
        std::FILE* file = std::fopen(path, "wb");
        if (!file) fail("cannot write %s; check the folder", path);
        const bool whole = std::fwrite(source.webp.data(), 1, source.webp.size(), file) == source.webp.size();
        if (std::fclose(file) != 0 || !whole) fail("cannot write all of %s; check the space left", path);
    });
}

bool frond_film_write_sheet(frond_film* film, const char* png_path, int columns, int rows) {
    bool written = false;
    const bool drawn = guarded([&] {
        const frond_film& source = living(film);
        if (source.small_width == 0) fail("the film keeps no sheet; set sheet_width in its def");
        if (source.small.empty()) fail("the film has no frames; add some first");
        if (columns < 1 || rows < 1 || columns > 1000 || rows > 1000)
            fail("a sheet of %d x %d frames cannot be made; use 1..1000", columns, rows);

        // Show as many frames as fit, evenly spaced, including first and last.
        const int64_t total = int64_t(source.small.size()), count = std::min<int64_t>(total, int64_t(columns) * rows);
        const int gap = 4, across = int(std::min<int64_t>(columns, count)), down = int((count + across - 1) / across);
        const int64_t width = int64_t(across) * (source.small_width + gap) + gap;
        const int64_t height = int64_t(down) * (source.small_height + gap) + gap;
        if (width > 65535 || height > 65535)
            fail("the sheet would have %lld x %lld pixels; use fewer columns and rows, or a smaller sheet_width",
                 static_cast<long long>(width), static_cast<long long>(height));
        std::vector<uint8_t> sheet(size_t(width) * size_t(height) * 3, 255);
        for (int64_t k = 0; k < count; k++) {
            const std::vector<uint8_t>& frame = source.small[size_t(count > 1 ? k * (total - 1) / (count - 1) : 0)];
            const int64_t x = gap + k % across * (source.small_width + gap),
                          y = gap + k / across * (source.small_height + gap);
            for (int row = 0; row < source.small_height; row++)
                std::copy_n(frame.data() + size_t(row) * source.small_width * 3, size_t(source.small_width) * 3,
                            sheet.data() + (size_t(y + row) * size_t(width) + size_t(x)) * 3);
        }
        written = frond_picture_write_png(png_path, sheet.data(), int(width), int(height));
    });
    return drawn && written;
}
