// frond_rigid_*: bodies that plants touch.
#include "api/call.hpp"
#include "api/handles.hpp"
#include "world/fragments.hpp"

using namespace frond;

static void check_state(const frond_rigid_state& state) {
    check_vec(state.position, "state.position [m]");
    checked_rotation(state.rotation, "state.rotation");
    constexpr double FASTEST = 1e6;  // [m/s] and [rad/s]
    for (double v : {state.velocity.x, state.velocity.y, state.velocity.z})
        check_range(v, -FASTEST, FASTEST, "state.velocity [m/s]");
    for (double v : {state.angular_velocity.x, state.angular_velocity.y, state.angular_velocity.z})
        check_range(v, -FASTEST, FASTEST, "state.angular_velocity [rad/s]");
}

static void check_rigid_def(const frond_rigid_def* def) {
    check_def(def, 'R', "rigid");
    check_row(def->shape, FROND_SHAPE_COUNT, "def.shape");
    const double size[] = {def->size.x, def->size.y, def->size.z};
    for (int i = 0; i < size_count(def->shape); i++) check_range(size[i], 1e-4, 1e4, "def.size [m]");
    if (def->mass != 0) check_range(def->mass, 1e-6, 1e9, "def.mass [kg]");
    check_range(def->friction, 0, 100, "def.friction");
    check_range(def->restitution, 0, 1, "def.restitution");
    check_state(def->state);
}

extern "C" {

frond_result frond_rigid_create(frond_world world, const frond_rigid_def* def, frond_rigid* out) {
    return give(out, [&] {
        World& w = get(world);
        check_rigid_def(def);
        Rigid* rigid = add_rigid(w, *def);
        return rigid->handle = handle_for<frond_rigid>(rigid, [&] { remove_rigid(w, rigid); });
    });
}

void frond_rigid_destroy(frond_rigid rigid) {
    call([&] {
        Rigid* found = find(rigid);
        if (!found || found->grown_on) return;
        slots<frond_rigid>().erase(rigid.id);
        remove_rigid(*found->world, found);
    });
}

bool frond_rigid_is_valid(frond_rigid rigid) {
    return find(rigid) != nullptr;
}

frond_result frond_rigid_get_state(frond_rigid rigid, frond_rigid_state* out) {
    return give(out, [&] { return state_of(get(rigid)); });
}

frond_result frond_rigid_set_state(frond_rigid rigid, const frond_rigid_state* state) {
    return call([&] {
        check_pointer(state, "state");
        Rigid& found = get(rigid);
        check_state(*state);
        if (found.is_plane)
            fail(FROND_RESULT_BAD_ARGUMENT, "the rigid body is a plane, which does not move; use a box");
        set_state(found, *state);
        if (!found.grown_on) return;
        carry_fragments(*found.grown_on);
        moved(*found.grown_on->plant);
        move_capsules(*found.grown_on);
        found.world->bullet->updateSingleAabb(found.grown_on);
    });
}

const void* frond_rigid_get_body(frond_rigid rigid) {
    const Rigid* found = find(rigid);
    return found ? static_cast<const btCollisionObject*>(found->body.get()) : nullptr;
}

}  // extern "C"
