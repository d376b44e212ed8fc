// An invisible screen (Xvfb), with a mouse and keys that XTest controls.
#pragma once

#include <cstdint>
#include <vector>

// DISPLAY names it during its lifetime.
class UnseenScreen {
public:
    UnseenScreen();
    UnseenScreen(const UnseenScreen&) = delete;
    UnseenScreen& operator=(const UnseenScreen&) = delete;
    ~UnseenScreen();
    bool is_there() const { return display != nullptr; }
    void move_mouse(int x, int y);
    void press_button(unsigned number, bool down);
    void tap_key(const char* name);  // names as in X: "space", "n"
    // Returns RGB, rows from the top.
    std::vector<uint8_t> pixels(int left, int top, int width, int height) const;

private:
    void* display = nullptr;
    int server = 0;  // id of the server's process
};
