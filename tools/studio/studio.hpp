// Studio: pictures of a stage, and progress on a terminal.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "picture/frond_picture.h"
#include "scenes/scene.hpp"

namespace frond::tools {

// The user's settings of a picture.
struct View {
    int width = 1280, height = 720;
    double azimuth = 0.5, elevation = 0.15;  // [rad]
    std::vector<std::string> overlays;       // cage, faces, capsules, force
};

class Studio {
public:
    explicit Studio(const View& view);
    Studio(const Studio&) = delete;
    Studio& operator=(const Studio&) = delete;
    ~Studio();
    // Draws the stage; the pixels are valid until the next call.
    const uint8_t* shoot(const Stage& stage);
    // Draws what `draw` puts into a frame for which the stage is framed; returns the scene. Pixels as above.
    frond_picture_scene draw(const Stage& stage, const std::function<void(frond_picture*)>& draw);
    const uint8_t* pixels() const { return frond_picture_get_pixels(picture); }
    void write(const std::string& png_path);

private:
    View view;
    frond_picture* picture = nullptr;
};
// Frames as PNG files in a folder, a contact sheet and a moving picture.
class Film {
public:
    Film(const std::string& folder, const View& view, double frames_per_second);
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;
    ~Film();
    void add(Studio& studio, const Stage& stage);
    void finish();

private:
    std::string folder;
    frond_film* film = nullptr;
};
// Returns light, ground and a camera that sees the stage. azimuth, elevation [rad]; aspect: width over height.
frond_picture_scene frame_stage(const Stage& stage, double azimuth, double elevation, double aspect);
// Draws everything on the stage into a frame that was begun; what: bits FROND_PICTURE_* for plants.
void draw_stage(frond_picture* picture, const Stage& stage, uint32_t what);
// Throws a SceneError with frond_picture_last_error() if a call failed.
void must(bool ok);

// Prints "step 120 of 300" on a terminal, once something has taken a second; nothing into files and pipes.
class Progress {
public:
    Progress(const char* what, int total);
    ~Progress();
    void at(int done);

private:
    const char* what;
    int total;
    bool on_terminal, shown = false;
    std::chrono::steady_clock::time_point start, last;
};

}  // namespace frond::tools
