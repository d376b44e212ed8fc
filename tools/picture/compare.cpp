// In: two pictures of one size. Out: how much they differ visibly, and where. Differences are CIE 1976 Delta E in
// L*a*b* (D65), after a soft blur, each pixel against the best match among its neighbours; a mean over windows finds
// those that are large enough to be seen. Edges that are rasterised a little differently pass, a missing leaf does not.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "error.hpp"
#include "frond_picture.h"

using namespace picture;

namespace {

constexpr int WINDOW = 9;           // [pixel]
constexpr float NOTICEABLE = 2.3f;  // [Delta E]

using Lab = std::array<float, 3>;

struct LabImage {
    int width, height;
    std::vector<Lab> pixels;
    const Lab& at(int x, int y) const {
        return pixels[size_t(std::clamp(y, 0, height - 1)) * width + std::clamp(x, 0, width - 1)];
    }
};

Lab to_lab(float r, float g, float b) {
    // From the primaries of sRGB, relative to the white of D65.
    const float x = (0.4124f * r + 0.3576f * g + 0.1805f * b) / 0.9505f;
    const float y = 0.2126f * r + 0.7152f * g + 0.0722f * b;
    const float z = (0.0193f * r + 0.1192f * g + 0.9505f * b) / 1.089f;
    const auto f = [](float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116; };
    return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

// Returns the image in linear light, blurred by 1 2 1 in both directions, in L*a*b*.
LabImage soften(const uint8_t* rgb, int width, int height) {
    std::array<float, 256> linear;
    for (int i = 0; i < 256; i++) {
        const float v = float(i) / 255;
        linear[size_t(i)] = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    }
    LabImage image{width, height, std::vector<Lab>(size_t(width) * height)};
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            float sum[3] = {0, 0, 0};
            for (int j = -1; j <= 1; j++)
                for (int i = -1; i <= 1; i++) {
                    const int u = std::clamp(x + i, 0, width - 1), v = std::clamp(y + j, 0, height - 1);
                    const float weight = float((2 - std::abs(i)) * (2 - std::abs(j))) / 16;
                    for (int c = 0; c < 3; c++) sum[c] += weight * linear[rgb[(size_t(v) * width + u) * 3 + c]];
                }
            image.pixels[size_t(y) * width + x] = to_lab(sum[0], sum[1], sum[2]);
        }
    return image;
}

float squared_distance(const Lab& a, const Lab& b) {
    return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
}

// Returns the squared distance from a pixel of `a` to the most similar one in `b` within one pixel of it.
float best_match(const LabImage& a, const LabImage& b, int x, int y) {
    float best = squared_distance(a.at(x, y), b.at(x, y));
    for (int j = -1; j <= 1 && best > 0; j++)
        for (int i = -1; i <= 1; i++) best = std::min(best, squared_distance(a.at(x, y), b.at(x + i, y + j)));
    return best;
}

// Finds the window with the largest mean, by a summed-area table.
void find_worst(const std::vector<float>& difference, int width, int height, frond_picture_difference& out) {
    std::vector<double> sums(size_t(width + 1) * size_t(height + 1), 0.0);
    const auto sum = [&](int x, int y) -> double& { return sums[size_t(y) * size_t(width + 1) + size_t(x)]; };
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            sum(x + 1, y + 1) = double(difference[size_t(y) * width + x]) + sum(x, y + 1) + sum(x + 1, y) - sum(x, y);
    const int across = std::min(WINDOW, width), down = std::min(WINDOW, height);
    for (int y = 0; y + down <= height; y++)
        for (int x = 0; x + across <= width; x++) {
            const double mean =
                (sum(x + across, y + down) - sum(x, y + down) - sum(x + across, y) + sum(x, y)) / (across * down);
            if (mean > out.worst) out.worst = mean, out.worst_x = x + across / 2, out.worst_y = y + down / 2;
        }
    out.worst = std::max(out.worst, 0.0);
}

// Colours a difference: black, red, yellow, white at 0, 13, 27 and 40 Delta E.
void paint(float difference, uint8_t* rgb) {
    const float heat = std::min(difference / 40 * 3, 3.0f);
    for (int c = 0; c < 3; c++) rgb[c] = uint8_t(255 * std::clamp(heat - float(c), 0.0f, 1.0f) + 0.5f);
}

void check_sizes(const uint8_t* pixels, int width, int height, double tolerance) {
    if (!pixels) fail("the pixels are null");
    if (width < 1 || height < 1 || width > FROND_PICTURE_LARGEST || height > FROND_PICTURE_LARGEST)
        fail("pictures of %d x %d pixels cannot be compared; use 1..%d", width, height, FROND_PICTURE_LARGEST);
    if (!(tolerance >= 0)) fail("the tolerance is %g; use FROND_PICTURE_TOLERANCE", tolerance);
}

// Writes reference, picture and difference side by side; uncovered areas are white.
void write_difference(const char* path, const uint8_t* reference, int reference_width, int reference_height,
                      const uint8_t* rgb, int width, int height, const uint8_t* difference) {
    const int gap = 4, total_width = reference_width + 2 * (width + gap),
              total_height = std::max(height, reference_height);
    std::vector<uint8_t> sheet(size_t(total_width) * total_height * 3, 255);
    const auto put = [&](const uint8_t* from, int from_width, int from_height, int x) {
        for (int y = 0; y < from_height; y++)
            std::memcpy(&sheet[(size_t(y) * total_width + size_t(x)) * 3], from + size_t(y) * from_width * 3,
                        size_t(from_width) * 3);
    };
    put(reference, reference_width, reference_height, 0);
    put(rgb, width, height, reference_width + gap);
    if (difference) put(difference, width, height, reference_width + width + 2 * gap);
    if (!frond_picture_write_png(path, sheet.data(), total_width, total_height))
        fail("%s", std::string(frond_picture_last_error()).c_str());
}

}  // namespace

bool frond_picture_compare(const uint8_t* a, const uint8_t* b, int width, int height, double tolerance,
                           frond_picture_difference* out, uint8_t* difference_rgb) {
    if (out) *out = frond_picture_difference{};
    return guarded([&] {
        if (!out) fail("where the result goes (out) is null");
        check_sizes(a, width, height, tolerance);
        check_sizes(b, width, height, tolerance);
        const LabImage first = soften(a, width, height), second = soften(b, width, height);
        std::vector<float> difference(size_t(width) * height);
        frond_picture_difference result{};
        double sum = 0;
        size_t noticed = 0;
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                // In both directions: additions and omissions.
                const float value =
                    std::sqrt(std::max(best_match(first, second, x, y), best_match(second, first, x, y)));
                difference[size_t(y) * width + x] = value;
                sum += double(value);
                noticed += value > NOTICEABLE;
                if (difference_rgb) paint(value, difference_rgb + (size_t(y) * width + x) * 3);
            }
        find_worst(difference, width, height, result);
        result.mean = sum / double(difference.size());
        result.share = double(noticed) / double(difference.size());
        result.same = result.worst <= tolerance;
        *out = result;
    });
}

bool frond_picture_compare_file(const uint8_t* rgb, int width, int height, const char* reference_png, double tolerance,
                                frond_picture_difference* out, const char* difference_png) {
    if (out) *out = frond_picture_difference{};
    uint8_t* reference = nullptr;
    int reference_width = 0, reference_height = 0;
    const bool compared = guarded([&] {
        if (!out) fail("where the result goes (out) is null");
        check_sizes(rgb, width, height, tolerance);
        if (!frond_picture_read_png(reference_png, &reference, &reference_width, &reference_height))
            fail("%s", std::string(frond_picture_last_error()).c_str());
        if (reference_width != width || reference_height != height) {
            if (difference_png)
                write_difference(difference_png, reference, reference_width, reference_height, rgb, width, height,
                                 nullptr);
            fail("the picture has %d x %d pixels, its reference %s %d x %d", width, height, reference_png,
                 reference_width, reference_height);
        }
        std::vector<uint8_t> difference(size_t(width) * height * 3);
        if (!frond_picture_compare(rgb, reference, width, height, tolerance, out, difference.data()))
            fail("%s", std::string(frond_picture_last_error()).c_str());
        if (!out->same && difference_png)
            write_difference(difference_png, reference, width, height, rgb, width, height, difference.data());
    });
    frond_picture_free(reference);
    return compared;
}
