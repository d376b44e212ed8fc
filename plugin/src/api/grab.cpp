// frond_grab_*: the user's hold on a plant.
#include "api/call.hpp"
#include "api/handles.hpp"

using namespace frond;

extern "C" {

frond_result frond_grab_create(frond_plant plant, frond_vec3 near_point, double stiffness, frond_grab* out) {
    return give(out, [&] {
        PlantBody& body = get(plant);
        check_vec(near_point, "point [m]");
        check_range(stiffness, 1e-9, 1e12, "stiffness [N/m]");
        Plant& p = awaken(body);
        const int vertex = nearest_vertex(p, to_vec(near_point));
        p.input.grabs.push_back({vertex, pulled_place(p, vertex), stiffness, 0});
        Grab& grab = p.input.grabs.back();
        const auto handle = handle_for<frond_grab>(GrabEntry{&body, &grab}, [&] { p.input.grabs.pop_back(); });
        grab.handle = handle.id;
        return handle;
    });
}

frond_result frond_grab_move(frond_grab grab, frond_vec3 target) {
    return call([&] {
        const GrabEntry entry = get(grab);
        check_vec(target, "target [m]");
        if (to_vec(target) == entry.grab->target) return;
        entry.grab->target = to_vec(target);
        wake(*entry.body);
    });
}

frond_result frond_grab_get(frond_grab grab, frond_vec3* held_point, frond_vec3* target, frond_vec3* force) {
    return call([&] {
        for (frond_vec3* out : {held_point, target, force})
            if (out) *out = {};
        const GrabEntry entry = get(grab);
        const Plant& plant = *look_at(*entry.body).plant;
        if (held_point) *held_point = from_vec(pulled_place(plant, entry.grab->vertex));
        if (target) *target = from_vec(entry.grab->target);
        if (force) *force = from_vec(grab_force(plant, *entry.grab));
    });
}

void frond_grab_destroy(frond_grab grab) {
    call([&] {
        const GrabEntry entry = slots<frond_grab>().erase(grab.id);
        if (!entry.body) return;
        wake(*entry.body);
        Plant& plant = *entry.body->plant;
        plant.input.grabs.remove_if([&](const Grab& other) { return &other == entry.grab; });
        plant.state.motion.history.valid = false;  // its force ends at once
    });
}

bool frond_grab_is_valid(frond_grab grab) {
    return bool(find(grab));
}

}  // extern "C"
