#include "world/convert.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Computes FNV-1a over the bits of all nodes, plastic states and fragments.
uint64_t state_hash(World& world) {
    uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](const auto& values) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (size_t i = 0; i < size_t(values.size()) * sizeof(double); i++) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    };
    for (const std::unique_ptr<PlantBody>& body : world.bodies) {
        look_at(*body);
        add(body->plant->state.motion.x);
        add(body->plant->state.motion.v);
        add(plastic_of(*body->plant));
        for (size_t k = 0; k < body->fragment_bodies.size(); k++) {
            const Fragment& fragment = body->plant->state.fragments[k];
            const btRigidBody& rigid = *body->fragment_bodies[k]->body;
            add(fragment.turn);
            add(fragment.shift);
            add(from_bullet(rigid.getLinearVelocity()));
            add(from_bullet(rigid.getAngularVelocity()));
        }
    }
    compress_looked_at(world);
    return hash;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
