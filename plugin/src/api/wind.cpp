// frond_world_*wind*: the air of a world.
#include "api/call.hpp"
#include "api/handles.hpp"

using namespace frond;

static void check_wind_def(const frond_wind_def* def) {
    check_def(def, 'A', "wind");
    constexpr double FASTEST = 200;  // twice that of the strongest storms [m/s]
    for (double v : {def->velocity.x, def->velocity.y, def->velocity.z})
        check_range(v, -FASTEST, FASTEST, "def.velocity [m/s]");
    check_range(def->turbulence, 0, 1, "def.turbulence");
    check_range(def->length_scale, 0.1, 1e4, "def.length_scale [m]");
    check_row(def->profile, FROND_WIND_PROFILE_COUNT, "def.profile");
    check_range(def->reference_height, 0.01, 1e4, "def.reference_height [m]");
    check_range(def->roughness, 1e-6, 0.5 * def->reference_height, "def.roughness [m]");
    check_range(def->exponent, 0, 1, "def.exponent");
    check_range(def->ground_height, -LARGEST_COORDINATE, LARGEST_COORDINATE, "def.ground_height [m]");
    check_range(def->density, 0.01, 10, "def.density [kg/m^3]");
}

extern "C" {

frond_result frond_world_set_wind(frond_world world, const frond_wind_def* def) {
    return call([&] {
        World& w = get(world);
        if (!def) {
            w.wind = nullptr;
            for (const auto& body : w.bodies) wake(*body);  // plants that it bent come back
            return;
        }
        check_wind_def(def);
        std::unique_ptr<Wind> wind = make_wind(*def);
        if (w.wind) take_over(*wind, up_of(gravity_of(w)), *w.wind);
        w.wind = std::move(wind);
    });
}

frond_result frond_world_set_wind_field(frond_world world, frond_wind_field_fn* field, void* user) {
    return call([&] {
        World& w = get(world);
        if (!w.wind) {
            if (!field) return;
            w.wind = make_wind(frond_default_wind_def());
        }
        w.wind->field = field;
        w.wind->user = user;
    });
}

frond_result frond_world_get_wind_at(frond_world world, frond_vec3 point, frond_vec3* out) {
    return give(out, [&] {
        World& w = get(world);
        check_vec(point, "point");
        if (!w.wind) return frond_vec3{};
        std::vector<frond_vec3> velocities;
        if (!wind_velocities(*w.wind, up_of(gravity_of(w)), w.time, {point}, velocities))
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "the wind field gave a velocity that is not finite or beyond 1000 m/s; have it "
                 "write every velocity");
        return velocities[0];
    });
}

}  // extern "C"
