// frond_world_save and _restore.
#include <cstring>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "frond/frond_snapshot.h"
#include "world/robot.hpp"
#include "world/snapshot.hpp"

using namespace frond;

static std::vector<uint8_t> saved_bytes(World& world) {
    if (!world.robots.empty())
        fail(FROND_RESULT_UNSUPPORTED, "this world has robots, whose joints no snapshot holds; save without them");
    Snapshot snapshot = take_snapshot(world);
    return bytes_of(snapshot);
}

extern "C" {

size_t frond_world_get_snapshot_size(frond_world world) {
    size_t size = 0;
    call([&] { size = saved_bytes(get(world)).size(); });
    return size;
}

frond_result frond_world_save(frond_world world, void* snapshot, size_t size) {
    return call([&] {
        World& w = get(world);
        check_pointer(snapshot, "snapshot");
        const std::vector<uint8_t> bytes = saved_bytes(w);
        if (size != bytes.size())
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "size is %zu, this world's snapshot has %zu bytes; ask frond_world_get_snapshot_size", size,
                 bytes.size());
        std::memcpy(snapshot, bytes.data(), size);
        find_contacts_anew(w);
    });
}

frond_result frond_world_restore(frond_world world, const void* snapshot, size_t size) {
    return call([&] {
        World& w = get(world);
        check_pointer(snapshot, "snapshot");
        if (!w.robots.empty()) fail(FROND_RESULT_UNSUPPORTED, "this world has robots, whose joints no snapshot holds");
        Snapshot read = snapshot_from(static_cast<const uint8_t*>(snapshot), size);
        check_snapshot(w, read);
        put_snapshot(w, std::move(read));
    });
}

}  // extern "C"
