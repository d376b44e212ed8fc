// In: keys, buttons and the mouse. Out: commands, drags and camera movements.
#include "view/viewer.hpp"

namespace frond::tools {

void press(Viewer& viewer, char key) {
    for (const Command& command : commands())
        if (command.key == key) return command.run(viewer);
}

void move_mouse(Viewer& viewer, double x, double y) {
    const double dx = x - viewer.mouse_x, dy = y - viewer.mouse_y;
    viewer.mouse_x = x;
    viewer.mouse_y = y;
    if (viewer.drag == Viewer::Drag::HAND) move_hand(viewer);
    if (viewer.drag == Viewer::Drag::ORBIT) orbit(viewer.camera, dx, dy);
    if (viewer.drag == Viewer::Drag::PAN) pan(viewer.camera, dx, dy, viewer.height);
}

void press_button(Viewer& viewer, Button button) {
    if (viewer.drag != Viewer::Drag::NONE) return;
    viewer.drag_button = button;
    viewer.drag = button == Button::MIDDLE                      ? Viewer::Drag::PAN
                  : button == Button::LEFT && take_hold(viewer) ? Viewer::Drag::HAND
                                                                : Viewer::Drag::ORBIT;
}

void release_button(Viewer& viewer, Button button) {
    if (viewer.drag == Viewer::Drag::NONE || button != viewer.drag_button) return;
    if (viewer.drag == Viewer::Drag::HAND) let_go(viewer);
    viewer.drag = Viewer::Drag::NONE;
}

void turn_wheel(Viewer& viewer, double clicks) {
    zoom(viewer.camera, clicks);
}

}  // namespace frond::tools
