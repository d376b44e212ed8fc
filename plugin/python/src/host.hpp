// Host: what stands beside a frond_world in its Bullet world: a sentinel, which learns that the world is deleted, and a
// record of forces.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <vector>

#include "frond/frond_bullet.hpp"
#include "frond_host.h"

namespace frond_host {

// Sums of impulses over the substeps of a call.
struct Sum {
    frond_force last = {};
    double impulse[3] = {}, moment[3] = {}, point[3] = {}, normal[3] = {};
    double weight = 0, gap = 0;
};
struct Wrench {
    frond_vec3 force = {}, moment = {};
    double time = 0;  // of the substeps in the sums [s]
};

// Records the forces of substeps. Its action comes after Frond's own.
struct ForceLog final : btActionInterface {
    frond_world world;
    bool has_ended = true;  // the call; the next substep begins a new one
    double time = 0;        // of the substeps of the call [s]
    std::vector<frond_force> last;
    std::map<std::tuple<uint64_t, uint64_t, const void*, int>, Sum> sums;
    std::map<uint64_t, Wrench> roots, bonds;  // by handle

    explicit ForceLog(frond_world world) : world(world) {}
    void updateAction(btCollisionWorld*, btScalar h) override;
    void debugDraw(btIDebugDraw*) override {}
    std::vector<frond_force> mean() const;
};

// An object without shape in the Bullet world. Its host deletes it with all others.
struct Sentinel final : btCollisionObject {
    bool* is_gone;
    btEmptyShape shape;
    explicit Sentinel(bool* is_gone) : is_gone(is_gone) {
        setCollisionShape(&shape);
        setCollisionFlags(CF_STATIC_OBJECT | CF_NO_CONTACT_RESPONSE);
    }
    ~Sentinel() override { *is_gone = true; }
};

// Belongs to the table of hosts; freed with its frond_world.
struct Host {
    frond_world world = {};
    btDynamicsWorld* bullet = nullptr;
    int plugin = -1;  // -1: a world that no PyBullet steps
    bool is_gone = false;
    std::unique_ptr<ForceLog> log;
    Sentinel* sentinel = nullptr;   // the server's, once it is in the world
    std::recursive_mutex stepping;  // held by the server's thread while it steps
    bool is_stepping = false;       // of the server's thread alone
};

// Takes sentinel and record out of a Bullet world that exists.
void release_host(frond_world world);
// Returns the host of a world, or makes one for a world of Frond's own; null for an invalid handle.
std::shared_ptr<Host> host_of(frond_world world);
// Adds a host for a world of PyBullet's, and its sentinel.
void add_host(frond_world world, btDynamicsWorld* bullet, int plugin);
// Frees hosts, and their worlds, whose Bullet worlds were deleted; and those whose frond_world was destroyed.
void sweep_hosts();
std::vector<std::shared_ptr<Host>> hosts_of_plugin(int plugin);

// Finds the world of a PyBullet server; null if there is none that this library knows how to use.
btDynamicsWorld* find_world(const void* processor);
const void* processor_of(int plugin);

// Sets frond_last_error to a text of this library's; returns the code.
frond_result failed(frond_result code, const char* text);

}  // namespace frond_host
