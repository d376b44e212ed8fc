// GLFW provides the window, its EGL context and the user's input; tools/picture and, over it, Dear ImGui draw into that
// context.
#include "view/window.hpp"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "studio/studio.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>

namespace frond::tools {

namespace {

[[noreturn]] void fail_with_glfw(const char* what) {
    const char* text = nullptr;
    glfwGetError(&text);
    throw SceneError(std::string(what) + ": " + (text ? text : "GLFW does not say why") +
                     "; frond run SCENE --shot FILE makes pictures without a window");
}

Viewer& viewer_of(GLFWwindow* window) {
    return *static_cast<Viewer*>(glfwGetWindowUserPointer(window));
}

// A listener's exceptions must not pass through GLFW; the window closes, as the next frame would fail too.
template <class Action>
void tell(GLFWwindow* window, const Action& action) {
    try {
        action(viewer_of(window));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "frond: %s\n", error.what());
        glfwSetWindowShouldClose(window, GLFW_TRUE);
    }
}

void on_button(GLFWwindow* window, int button, int action, int) {
    const Button known[] = {Button::LEFT, Button::RIGHT, Button::MIDDLE};  // in GLFW's order
    if (button > 2) return;
    tell(window, [&](Viewer& viewer) {
        if (action == GLFW_PRESS && !ImGui::GetIO().WantCaptureMouse) press_button(viewer, known[button]);
        if (action == GLFW_RELEASE) release_button(viewer, known[button]);
    });
}

// The cursor's position is in screen coordinates, which may differ from pixels.
void on_move(GLFWwindow* window, double x, double y) {
    int wide = 1, high = 1;
    glfwGetWindowSize(window, &wide, &high);
    tell(window, [&](Viewer& viewer) { move_mouse(viewer, x * viewer.width / wide, y * viewer.height / high); });
}

void on_character(GLFWwindow* window, unsigned code) {
    if (code < 128 && !ImGui::GetIO().WantTextInput) tell(window, [&](Viewer& viewer) { press(viewer, char(code)); });
}

void on_key(GLFWwindow* window, int key, int, int action, int) {
    if (key == GLFW_KEY_ESCAPE && action == GLFW_PRESS) glfwSetWindowShouldClose(window, GLFW_TRUE);
}

void on_wheel(GLFWwindow* window, double, double clicks) {
    if (ImGui::GetIO().WantCaptureMouse) return;
    tell(window, [&](Viewer& viewer) { turn_wheel(viewer, clicks); });
}

}  // namespace

Window::Window(Viewer& viewer, const char* title) : viewer(viewer) {
    if (!glfwInit()) fail_with_glfw("there is no display to open a window on");
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    window = glfwCreateWindow(viewer.width, viewer.height, title, nullptr, nullptr);
    try {
        if (!window) fail_with_glfw("no window with OpenGL 3.3 can be made");
        glfwMakeContextCurrent(window);
        glfwSwapInterval(1);
        listen();
        make_picture();
        // Dear ImGui comes after the viewer's own listeners, which it calls too.
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        if (!ImGui_ImplGlfw_InitForOpenGL(window, true) || !ImGui_ImplOpenGL3_Init("#version 330 core"))
            throw SceneError("Dear ImGui finds no OpenGL 3.3");
    } catch (...) {
        glfwTerminate();
        throw;
    }
    last = std::chrono::steady_clock::now();
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    frond_picture_destroy(picture);
    glfwTerminate();
}

void Window::listen() {
    glfwSetWindowUserPointer(window, &viewer);
    glfwSetMouseButtonCallback(window, on_button);
    glfwSetCursorPosCallback(window, on_move);
    glfwSetCharCallback(window, on_character);
    glfwSetKeyCallback(window, on_key);
    glfwSetScrollCallback(window, on_wheel);
}

void Window::make_picture() {
    frond_picture_destroy(picture);
    picture = nullptr;
    glfwGetFramebufferSize(window, &viewer.width, &viewer.height);
    frond_picture_def def = frond_default_picture_def();
    def.platform = FROND_PICTURE_CURRENT;
    def.width = viewer.width;
    def.height = viewer.height;
    if (is_quick) {
        def.samples = 1;
        def.sky_samples = 0;
        def.shadow_size = 1024;
    }
    must(frond_picture_create(&def, &picture));
}

bool Window::is_open() const {
    return !glfwWindowShouldClose(window);
}

void Window::frame() {
    constexpr double SLOW = 0.05;  // [s]
    using clock = std::chrono::steady_clock;
    const auto seconds = [](clock::duration time) { return std::chrono::duration<double>(time).count(); };
    glfwPollEvents();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    const bool is_hidden = width == 0 || height == 0;
    if (!is_hidden && (width != viewer.width || height != viewer.height)) make_picture();
    const clock::time_point now = clock::now();
    advance(viewer, seconds(now - last));
    last = now;
    if (is_hidden) return;
    const clock::time_point start = clock::now();
    draw_all();
    glfwSwapBuffers(window);
    if (is_quick || seconds(clock::now() - start) < SLOW) return;
    is_quick = true;
    make_picture();
}

void Window::draw_all() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    // The panel comes before drawing, as a command may replace the stage.
    show_panel(viewer);
    ImGui::Render();
    draw(viewer, picture);
    must(frond_picture_present(picture, 0, viewer.width, viewer.height));
    glDisable(GL_FRAMEBUFFER_SRGB);  // its colours are already sRGB
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

std::vector<uint8_t> Window::pixels() {
    draw_all();
    const size_t row = 3 * size_t(viewer.width), rows = size_t(viewer.height);
    std::vector<uint8_t> upwards(row * rows), pixels;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, viewer.width, viewer.height, GL_RGB, GL_UNSIGNED_BYTE, upwards.data());
    for (size_t i = rows; i-- > 0;)
        pixels.insert(pixels.end(), upwards.begin() + long(i * row), upwards.begin() + long((i + 1) * row));
    return pixels;
}

void Window::write(const std::string& png_path) {
    must(frond_picture_write_png(png_path.c_str(), pixels().data(), viewer.width, viewer.height));
}

void Window::get_place(int& x, int& y) const {
    glfwGetWindowPos(window, &x, &y);
}

}  // namespace frond::tools
