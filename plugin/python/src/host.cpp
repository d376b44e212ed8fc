// The table of hosts, and the functions of frond_host.h.
#include "host.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "frond/frond_robot.hpp"

namespace frond_host {

namespace {

std::mutex table_mutex;
std::map<uint64_t, std::shared_ptr<Host>>& table() {
    static auto* hosts = new std::map<uint64_t, std::shared_ptr<Host>>;  // never destroyed: used while programs end
    return *hosts;
}
thread_local std::string own_error;

// Returns the record of a world, and begins it.
std::shared_ptr<Host> recording(frond_world world) {
    std::shared_ptr<Host> host = host_of(world);
    if (!host || host->log) return host;
    host->log = std::make_unique<ForceLog>(world);
    host->bullet->addAction(host->log.get());
    return host;
}

frond_result stale() {
    return failed(FROND_RESULT_BAD_HANDLE,
                  "the world handle is stale; the world was destroyed, or PyBullet has reset it: attach again");
}

}  // namespace

frond_result failed(frond_result code, const char* text) {
    own_error = text ? text : frond_last_error();
    return code;
}

std::shared_ptr<Host> host_of(frond_world world) {
    sweep_hosts();
    std::lock_guard<std::mutex> lock(table_mutex);
    const auto found = table().find(world.id);
    if (found != table().end()) return found->second;
    btDynamicsWorld* bullet = frond::bullet_world(world);
    if (!bullet) return nullptr;
    auto host = std::make_shared<Host>();
    host->world = world;
    host->bullet = bullet;
    table()[world.id] = host;
    return host;
}

void add_host(frond_world world, btDynamicsWorld* bullet, int plugin) {
    auto host = std::make_shared<Host>();
    host->world = world;
    host->bullet = bullet;
    host->plugin = plugin;
    host->sentinel = new Sentinel(&host->is_gone);
    bullet->addCollisionObject(host->sentinel, 0, 0);
    std::lock_guard<std::mutex> lock(table_mutex);
    table()[world.id] = host;
}

void release_host(frond_world world) {
    sweep_hosts();
    std::lock_guard<std::mutex> lock(table_mutex);
    const auto found = table().find(world.id);
    if (found == table().end()) return;
    Host& host = *found->second;
    if (host.log) host.bullet->removeAction(host.log.get());
    if (host.sentinel) {
        host.bullet->removeCollisionObject(host.sentinel);
        delete host.sentinel;
    }
    table().erase(found);
}

void sweep_hosts() {
    std::lock_guard<std::mutex> lock(table_mutex);
    for (auto it = table().begin(); it != table().end();) {
        const bool is_gone = it->second->is_gone;
        if (is_gone) frond::forget(it->second->world);
        it = is_gone ? table().erase(it) : std::next(it);
    }
}

std::vector<std::shared_ptr<Host>> hosts_of_plugin(int plugin) {
    std::lock_guard<std::mutex> lock(table_mutex);
    std::vector<std::shared_ptr<Host>> hosts;
    for (const auto& entry : table())
        if (entry.second->plugin == plugin && !entry.second->is_gone) hosts.push_back(entry.second);
    return hosts;
}

}  // namespace frond_host

using namespace frond_host;

extern "C" {

const char* frond_host_last_error(void) {
    return own_error.c_str();
}

void frond_host_release(frond_world world) {
    release_host(world);
}

frond_result frond_host_attach(int plugin, const frond_world_def* def, frond_world* out) {
    *out = {};
    sweep_hosts();
    const void* processor = processor_of(plugin);
    if (!processor) return failed(FROND_RESULT_BAD_ARGUMENT, "the plugin is not loaded; call frond.pybullet.attach");
    btDynamicsWorld* bullet = find_world(processor);
    if (!bullet)
        return failed(FROND_RESULT_UNSUPPORTED,
                      "the Bullet world of this PyBullet was not found; use PyBullet 3.2.6 and 3.2.7 from the package "
                      "index, in double precision");
    const frond_result result = frond::attach(bullet, def, out);
    if (result != FROND_OK) return failed(result, nullptr);
    add_host(*out, bullet, plugin);
    return FROND_OK;
}

bool frond_host_is_alive(frond_world world) {
    sweep_hosts();
    return frond_world_is_valid(world);
}

void frond_host_hold(frond_world world) {
    if (const std::shared_ptr<Host> host = host_of(world)) host->stepping.lock();
}

void frond_host_let_go(frond_world world) {
    if (const std::shared_ptr<Host> host = host_of(world)) host->stepping.unlock();
}

const void* frond_host_find_body(frond_world world, int body, int link) {
    const std::shared_ptr<Host> host = host_of(world);
    if (!host) return nullptr;
    const btCollisionObjectArray& objects = host->bullet->getCollisionObjectArray();
    for (int i = 0; i < objects.size(); i++) {
        if (frond::plant_of(objects[i]).id) continue;
        if (const auto* part = btMultiBodyLinkCollider::upcast(objects[i])) {
            if (part->m_multiBody->getUserIndex2() == body && part->m_link == link) return objects[i];
        } else if (objects[i] != host->sentinel && objects[i]->getUserIndex2() == body && link == -1) {
            return objects[i];
        }
    }
    return nullptr;
}

frond_result frond_host_bond(frond_plant plant, frond_vec3 point, const void* body, frond_bond* out) {
    *out = {};
    auto* object = static_cast<btCollisionObject*>(const_cast<void*>(body));
    const frond_result result =
        frond::bond(plant, btVector3(btScalar(point.x), btScalar(point.y), btScalar(point.z)), object, out);
    return result == FROND_OK ? result : failed(result, nullptr);
}

const void* frond_host_get_object(frond_plant plant) {
    return frond::bullet_object(plant);
}
// The window draws objects without a graphics instance, whose number is the user index; none has this one.
void frond_host_hide(frond_plant plant) {
    if (btCollisionObject* object = frond::bullet_object(plant)) object->setUserIndex(std::numeric_limits<int>::max());
}
frond_plant frond_host_get_plant(frond_world world, const void* object) {
    const std::shared_ptr<Host> host = host_of(world);
    if (!host) return {};
    const btCollisionObjectArray& objects = host->bullet->getCollisionObjectArray();
    for (int i = 0; i < objects.size(); i++)
        if (objects[i] == object) return frond::plant_of(objects[i]);
    return {};
}
const void* frond_host_get_world(frond_world world) {
    return frond::bullet_world(world);
}
const void* frond_host_get_multi_body(frond_robot robot) {
    return frond::multi_body(robot);
}
const void* frond_host_get_motor(frond_robot robot, int link) {
    return frond::joint_motor(robot, link);
}

frond_result frond_host_record(frond_world world) {
    return recording(world) ? FROND_OK : stale();
}

frond_result frond_host_begin_call(frond_world world) {
    const std::shared_ptr<Host> host = host_of(world);
    if (!host) return stale();
    if (host->log) host->log->has_ended = true;
    return FROND_OK;
}

int frond_host_get_force_count(frond_world world, bool mean) {
    const std::shared_ptr<Host> host = host_of(world);
    if (!host || !host->log) return 0;
    return int(mean ? host->log->sums.size() : host->log->last.size());
}

frond_result frond_host_get_forces(frond_world world, bool mean, frond_force* out, int count) {
    const std::shared_ptr<Host> host = recording(world);
    if (!host) return stale();
    const std::vector<frond_force> forces = mean ? host->log->mean() : host->log->last;
    if (count != int(forces.size())) return failed(FROND_RESULT_BAD_ARGUMENT, "count is not the table's");
    std::copy(forces.begin(), forces.end(), out);
    return FROND_OK;
}

frond_result frond_host_get_root_force(frond_plant plant, frond_vec3* force, frond_vec3* moment) {
    *force = *moment = {};
    const frond_result result = frond_plant_get_root_force(plant, {0, 0, 0}, force, moment);
    if (result != FROND_OK) return failed(result, nullptr);
    std::lock_guard<std::mutex> lock(table_mutex);
    for (const auto& entry : table()) {
        ForceLog* log = entry.second->log.get();
        std::vector<frond_plant> plants(size_t(frond_world_get_plant_count(entry.second->world)));
        frond_world_get_plants(entry.second->world, plants.data(), int(plants.size()));
        const auto is_it = [&](const frond_plant& other) { return other.id == plant.id; };
        if (!log || std::none_of(plants.begin(), plants.end(), is_it)) continue;
        const Wrench& root = log->roots[plant.id];
        if (!(root.time > 0)) continue;
        *force = {root.force.x / root.time, root.force.y / root.time, root.force.z / root.time};
        *moment = {root.moment.x / root.time, root.moment.y / root.time, root.moment.z / root.time};
    }
    return FROND_OK;
}

frond_result frond_host_get_bond_force(frond_world world, frond_bond bond, frond_vec3* force) {
    *force = {};
    const frond_result result = frond_bond_get(bond, nullptr, force);
    if (result != FROND_OK) return failed(result, nullptr);
    const std::shared_ptr<Host> host = recording(world);
    if (!host) return stale();
    const Wrench& held = host->log->bonds[bond.id];
    if (held.time > 0) *force = {held.force.x / held.time, held.force.y / held.time, held.force.z / held.time};
    return FROND_OK;
}

}  // extern "C"
