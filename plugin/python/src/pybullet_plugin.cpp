// The plugin that PyBullet's server loads, and the way from it to the server's world.
//
// PyBullet hands a plugin the address of its command processor. Its first member after the table of virtual functions
// points to its data, in which one slot has the world, that world whose user pointer is the processor. Memory is read
// through the kernel, so that a wrong guess is refused and does not crash. Tried with PyBullet 3.2.6 and 3.2.7 on
// Linux.
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <malloc.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <typeinfo>

#include "host.hpp"

namespace frond_host {

namespace {

constexpr int SHARED_MEMORY_MAGIC_NUMBER = 202010061;  // of PyBullet 3.2.0 and later

// What PyBullet passes to its plugins, as far as it is read here.
struct Context {
    void* client;
    void* user;
    void* return_data;
    const void* vr_events;
    int vr_count;
    const void* key_events;
    int key_count;
    const void* mouse_events;
    int mouse_count;
    const unsigned char* notifications;
    int notification_count;
    void* processor;
};
struct Arguments {
    char text[1024];
    int int_count;
    int ints[128];
    int float_count;
    double floats[128];
};

std::mutex plugins_mutex;
std::map<int, const void*> processors;  // by number of the plugin
int next_plugin = 1;

bool read_memory(const void* from, void* to, size_t size) {
    const iovec local = {to, size}, remote = {const_cast<void*>(from), size};
    return process_vm_readv(getpid(), &local, 1, &remote, 1, 0) == ssize_t(size);
}

// Where a world has its user pointer.
struct Members : btDynamicsWorld {
    static size_t of_user_info() {
        void* btDynamicsWorld::*member = &Members::m_worldUserInfo;
        size_t offset;
        static_assert(sizeof member == sizeof offset, "a pointer to data of a class is its offset");
        std::memcpy(&offset, &member, sizeof offset);
        return offset;
    }
};

// Returns whether an object is of one of these types, by the name that its table of functions leads to.
bool is_of(const void* object, std::initializer_list<const std::type_info*> types) {
    const char *functions, *type, *name;
    char text[80] = {};
    if (!read_memory(object, &functions, sizeof functions) ||
        !read_memory(functions - sizeof(void*), &type, sizeof type) ||
        !read_memory(type + sizeof(void*), &name, sizeof name) || !read_memory(name, text, sizeof text - 1))
        return false;
    return std::any_of(types.begin(), types.end(),
                       [&](const std::type_info* known) { return std::strcmp(known->name(), text) == 0; });
}

// Returns whether the memory at `at` is a Bullet world whose user pointer is the processor.
bool is_world_of(const void* at, const void* processor) {
    if (reinterpret_cast<uintptr_t>(at) % alignof(void*)) return false;
    const void* user;
    if (!read_memory(static_cast<const char*>(at) + Members::of_user_info(), &user, sizeof user)) return false;
    return user == processor && is_of(at, {&typeid(btDiscreteDynamicsWorld), &typeid(btMultiBodyDynamicsWorld),
                                           &typeid(btSoftRigidDynamicsWorld), &typeid(btSoftMultiBodyDynamicsWorld),
                                           &typeid(btDeformableMultiBodyDynamicsWorld)});
}

}  // namespace

btDynamicsWorld* find_world(const void* processor) {
    const void* data;
    if (!read_memory(static_cast<const char*>(processor) + sizeof(void*), &data, sizeof data) || !data) return nullptr;
    const size_t size = malloc_usable_size(const_cast<void*>(data));
    for (size_t at = 0; at + sizeof(void*) <= size; at += sizeof(void*)) {
        const void* slot;
        if (!read_memory(static_cast<const char*>(data) + at, &slot, sizeof slot)) return nullptr;
        if (slot && is_world_of(slot, processor)) return static_cast<btDynamicsWorld*>(const_cast<void*>(slot));
    }
    return nullptr;
}

const void* processor_of(int plugin) {
    std::lock_guard<std::mutex> lock(plugins_mutex);
    const auto found = processors.find(plugin);
    return found == processors.end() ? nullptr : found->second;
}

static int plugin_of(const Context& context) {
    return int(reinterpret_cast<intptr_t>(context.user));
}

}  // namespace frond_host

using namespace frond_host;

extern "C" {

FROND_API int initPlugin_frond(Context* context) {
    std::lock_guard<std::mutex> lock(plugins_mutex);
    context->user = reinterpret_cast<void*>(intptr_t(next_plugin));
    processors[next_plugin++] = context->processor;
    return SHARED_MEMORY_MAGIC_NUMBER;
}

// Returns the plugin's number, by which frond_host_attach knows it.
FROND_API int executePluginCommand_frond(Context* context, const Arguments*) {
    return plugin_of(*context);
}

FROND_API void exitPlugin_frond(Context* context) {
    const int plugin = plugin_of(*context);
    for (const std::shared_ptr<Host>& host : hosts_of_plugin(plugin)) {
        release_host(host->world);
        frond_world_destroy(host->world);
    }
    sweep_hosts();
    std::lock_guard<std::mutex> lock(plugins_mutex);
    processors.erase(plugin);
}

// The server's thread holds the plants from the first substep of a call until the call has ended.
FROND_API int preTickPluginCallback_frond(Context* context) {
    for (const std::shared_ptr<Host>& host : hosts_of_plugin(plugin_of(*context))) {
        if (host->is_stepping) continue;
        host->stepping.lock();
        host->is_stepping = true;
    }
    return 0;
}

FROND_API int processNotifications_frond(Context* context) {
    for (const std::shared_ptr<Host>& host : hosts_of_plugin(plugin_of(*context))) {
        if (!host->is_stepping) continue;
        if (host->log) host->log->has_ended = true;
        host->is_stepping = false;
        host->stepping.unlock();
    }
    return 0;
}

}  // extern "C"
