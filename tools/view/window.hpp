// Window: shows a viewer on the screen and passes it the user's input.
#pragma once

#include <chrono>

#include "view/viewer.hpp"

struct GLFWwindow;

namespace frond::tools {

// Only one at a time in a process.
class Window {
public:
    // Opens the window in the viewer's size. Throws a SceneError if there is no display.
    Window(Viewer& viewer, const char* title);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();
    // Returns false after the window was closed.
    bool is_open() const;
    // Handles events, advances time, draws and shows a frame.
    void frame();
    // Draws the last frame again and returns it: width*height*3 of the viewer's, rows from the top.
    std::vector<uint8_t> pixels();
    void write(const std::string& png_path);
    // Returns the position of the upper left corner on the screen.
    void get_place(int& x, int& y) const;

private:
    void listen();
    void make_picture();
    void draw_all();
    Viewer& viewer;
    GLFWwindow* window = nullptr;
    frond_picture* picture = nullptr;
    bool is_quick = false;  // drawn without the sky's shade, as this machine is slow at it
    std::chrono::steady_clock::time_point last;
};

}  // namespace frond::tools
