// frond_*_detail, frond_world_set_viewer: how much of each plant is simulated.
#include "api/call.hpp"
#include "api/handles.hpp"

using namespace frond;

static void check_detail_def(const frond_detail_def* def) {
    check_def(def, 'D', "detail");
    check_range(def->rod_from, 0, LARGEST_COORDINATE, "def.rod_from");
    check_range(def->half_from, def->rod_from, LARGEST_COORDINATE, "def.half_from");
    check_range(def->modal_from, def->half_from, LARGEST_COORDINATE, "def.modal_from");
    check_range(def->still_from, def->modal_from, LARGEST_COORDINATE, "def.still_from");
    check_range(def->hysteresis, 0, 0.9, "def.hysteresis");
    check_range(def->budget, 0, 1e6, "def.budget [ms]");
}

extern "C" {

frond_result frond_world_set_detail(frond_world world, const frond_detail_def* def) {
    return call([&] {
        World& w = get(world);
        if (def) check_detail_def(def);
        set_detail(w, def);
    });
}

frond_result frond_world_set_viewer(frond_world world, frond_vec3 position) {
    return call([&] {
        World& w = get(world);
        check_vec(position, "position [m]");
        const frond_detail_def def = frond_default_detail_def();
        if (!w.detail) set_detail(w, &def);
        w.detail->viewer = to_vec(position);
        w.detail->has_viewer = true;
    });
}

}  // extern "C"
