// Window: shows a viewer on the screen and tells it what the user does.
#pragma once

#include <chrono>

#include "view/viewer.hpp"

struct GLFWwindow;

namespace frond::tools {

// One at a time in a process.
class Window {
public:
    // Opens it in the viewer's size. Throws a SceneError where there is no display.
    Window(Viewer& viewer, const char* title);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();
    // False after it was closed.
    bool is_open() const;
    // Takes in what happened, lets time pass, draws, shows.
    void frame();
    // Draws again what the last frame showed: width*height*3 of the viewer's, rows from the top.
    std::vector<uint8_t> pixels();
    void write(const std::string& png_path);
    // Where its upper left corner is on the screen.
    void get_place(int& x, int& y) const;

private:
    void listen();
    void make_picture();
    void draw_all();
    Viewer& viewer;
    GLFWwindow* window = nullptr;
    frond_picture* picture = nullptr;
    bool is_quick = false;  // drawn without the sky's shade, since this machine is slow at it
    std::chrono::steady_clock::time_point last;
};

}  // namespace frond::tools
