// Handles: the objects that the C API's handles stand for.
#pragma once

#include "core/error.hpp"
#include "core/slots.hpp"
#include "frond/frond_robot.h"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct GrabEntry {
    PlantBody* body = nullptr;
    Grab* grab = nullptr;
    explicit operator bool() const { return grab != nullptr; }
};

// What the handles of each kind stand for, and the number that tells kinds apart. Only declared.
Slots<std::shared_ptr<World>, 1> objects_of(frond_world);
Slots<std::shared_ptr<const Model>, 2> objects_of(frond_model);
Slots<PlantBody*, 3> objects_of(frond_plant);
Slots<GrabEntry, 4> objects_of(frond_grab);
Slots<Rigid*, 5> objects_of(frond_rigid);
Slots<Bond*, 6> objects_of(frond_bond);
Slots<Robot*, 7> objects_of(frond_robot);
template <class T, uint8_t KIND>
const char* noun_of(const Slots<T, KIND>&) {
    static const char* const NOUNS[] = {"", "world", "model", "plant", "grab", "rigid", "bond", "robot"};
    return NOUNS[KIND];
}

// Never destroyed, so that handles may still be released while the program ends.
template <class Handle>
auto& slots() {
    static auto* instance = new decltype(objects_of(Handle()));
    return *instance;
}
// Returns what a handle stands for; null if it is unknown.
template <class Handle>
auto find(Handle handle) {
    return slots<Handle>().find(handle.id);
}
// The same; throws BAD_HANDLE if it is unknown.
template <class Handle>
auto find_or_fail(Handle handle) {
    auto found = find(handle);
    const char* noun = noun_of(slots<Handle>());
    if (handle.id == 0)
        fail(FROND_RESULT_BAD_HANDLE, "the %s handle is null; use the one that its create or load call gave", noun);
    if (!found)
        fail(FROND_RESULT_BAD_HANDLE,
             "the %s handle is stale or of another kind; the %s was destroyed, or its world was, or the "
             "host deleted it; make it anew",
             noun, noun);
    return found;
}
template <class Handle>
auto& get(Handle handle) {
    return *find_or_fail(handle);
}
inline std::shared_ptr<const Model> get(frond_model model) {
    return find_or_fail(model);
}
inline GrabEntry get(frond_grab grab) {
    return find_or_fail(grab);
}
// Returns a handle for an object that was just made. If there is none left, `unmake` takes the object away again.
template <class Handle, class Object>
Handle handle_for(Object object, const std::function<void()>& unmake = {}) {
    const Handle handle = {slots<Handle>().insert(std::move(object))};
    if (handle.id) return handle;
    if (unmake) unmake();
    fail(FROND_RESULT_OUT_OF_MEMORY, "too many %ss; destroy some", noun_of(slots<Handle>()));
}

// Wakes a plant that is about to be changed, after all arguments were checked: it is stepped in full again.
Plant& awaken(PlantBody& body);
// Updates capsules and box after the nodes were moved.
void show(PlantBody& body);

// Releases the handles of a plant, its grabs, bonds and fragments; the plant itself belongs to the world.
void forget(PlantBody& body);

// Holds the plant's vertex nearest to the point to a body of its world, and returns the bond's handle.
frond_bond make_bond(PlantBody& plant, const frond_vec3& point, btCollisionObject& body);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
