// Bullet's own soft bodies, put through the hard cases that they can be put through: a beam of tets in a world of
// theirs.
#pragma once

#include <BulletSoftBody/btDeformableLagrangianForce.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

#include <memory>

#include "stability/bench.hpp"

namespace frond::stability {

// The first are springs along the edges of tets, solved by position, which know no Young's modulus.
enum class BulletMethod { CLASSIC, LINEAR, NEOHOOKEAN, COUNT };
const char* name_of(BulletMethod method);

class BulletBeam {
public:
    // Nodes lower than FOOT above the ground are held.
    BulletBeam(BulletMethod method, double dt, const Lattice& lattice, const frond_material& material);
    BulletBeam(const BulletBeam&) = delete;
    BulletBeam& operator=(const BulletBeam&) = delete;
    ~BulletBeam();

    double box = 20;  // how far from where it began a node may be [m]
    const double dt;  // [s]
    const Places rest;
    std::vector<size_t> foot;
    size_t top = 0;  // a node
    std::mt19937 random{1};
    double between(double low, double high);

    void put(const std::function<frond_vec3(const frond_vec3&)>& to);  // all free nodes, from rest, standing still
    void push(const std::function<frond_vec3()>& velocity);            // each free node
    void move_foot(const std::function<frond_vec3(const frond_vec3&)>& to);
    void hold(size_t node);
    void let_go(size_t node);
    void move(size_t node, const frond_vec3& to);
    void set_gravity(const frond_vec3& gravity);
    btRigidBody& add(btCollisionShape* shape, double mass, const frond_vec3& place, const frond_vec3& velocity);
    void remove(btRigidBody& body);

    frond_vec3 place(size_t node) const;

    // Steps; after each all nodes are finite and in the box.
    void run(
        double seconds, const std::function<void(double time)>& before_each = [](double) {});
    void step(double length);
    // No tet inside out, nodes within a share of its size of where they were modelled and `shift`, in the mean.
    void expect_shape(double share, const frond_vec3& shift = {}) const;

private:
    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    // In the order in which they need each other; the world goes first.
    std::vector<std::shared_ptr<void>> parts;
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    std::vector<std::unique_ptr<btDeformableLagrangianForce>> forces;
    std::unique_ptr<btSoftBody> body;
    btDiscreteDynamicsWorld* world = nullptr;
    const bool is_classic;
    const double size;
    std::vector<btScalar> masses;

    void make_classic_world();
    void make_deformable_world(BulletMethod method, const frond_material& material);
    void check(double time) const;
};

// A case of the same name as Frond's, with the same criterion but for energy, which is not asked for.
struct BulletCase {
    const char* name;
    void (*run)(BulletMethod method, double dt);  // throws Broken
};
const std::vector<BulletCase>& bullet_cases();

}  // namespace frond::stability
