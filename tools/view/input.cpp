// In: keys, buttons and the mouse. Out: what they do.
#include <cmath>

#include "view/viewer.hpp"

namespace frond::tools {

static bool is_over_panel(const Viewer& viewer) {
    return viewer.shows_panel && viewer.mouse_x < PANEL_LEFT + PANEL_WIDTH;
}

// True if there is something to click under the mouse.
static bool click_panel(Viewer& viewer) {
    if (!is_over_panel(viewer)) return false;
    const std::vector<Row> rows = panel_of(viewer);
    const double row = std::floor((viewer.mouse_y - PANEL_TOP) / ROW_HEIGHT);
    if (row < 0 || row >= double(rows.size()) || !rows[size_t(row)].action) return false;
    rows[size_t(row)].action(viewer);
    return true;
}

void press(Viewer& viewer, char key) {
    for (const Row& row : panel_of(viewer))
        if (row.key == key && key) return row.action(viewer);
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
    if (button == Button::LEFT && click_panel(viewer)) return;
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
