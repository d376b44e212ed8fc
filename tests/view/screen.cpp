#include "view/screen.hpp"

#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

extern char** environ;

static Display* open(void* display) {
    return static_cast<Display*>(display);
}

// The server picks its own number and writes it to a pipe.
UnseenScreen::UnseenScreen() {
    int ends[2];
    if (pipe(ends)) return;
    const std::string end = std::to_string(ends[1]);
    const char* arguments[] = {"Xvfb",        "-displayfd", end.c_str(), "-screen", "0",
                               "1024x768x24", "-nolisten",  "tcp",       nullptr};
    if (posix_spawnp(&server, "Xvfb", nullptr, nullptr, const_cast<char**>(arguments), environ)) server = 0;
    close(ends[1]);
    std::string number;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(ends[0]);
    if (number.empty()) return;
    setenv("DISPLAY", (":" + number).c_str(), 1);
    display = XOpenDisplay(nullptr);
}

UnseenScreen::~UnseenScreen() {
    if (display) XCloseDisplay(open(display));
    unsetenv("DISPLAY");
    if (!server) return;
    kill(server, SIGTERM);
    waitpid(server, nullptr, 0);
}

void UnseenScreen::move_mouse(int x, int y) {
    XTestFakeMotionEvent(open(display), -1, x, y, CurrentTime);
    XSync(open(display), False);
}

void UnseenScreen::press_button(unsigned number, bool down) {
    XTestFakeButtonEvent(open(display), number, down, CurrentTime);
    XSync(open(display), False);
}

void UnseenScreen::tap_key(const char* name) {
    const KeyCode code = XKeysymToKeycode(open(display), XStringToKeysym(name));
    for (const int down : {True, False}) XTestFakeKeyEvent(open(display), code, down, CurrentTime);
    XSync(open(display), False);
}

std::vector<uint8_t> UnseenScreen::pixels(int left, int top, int width, int height) const {
    std::vector<uint8_t> rgb;
    XImage* image = XGetImage(open(display), DefaultRootWindow(open(display)), left, top, unsigned(width),
                              unsigned(height), AllPlanes, ZPixmap);
    if (!image) return rgb;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (const int shift : {16, 8, 0}) rgb.push_back(uint8_t(XGetPixel(image, x, y) >> shift & 255));
    XDestroyImage(image);
    return rgb;
}
