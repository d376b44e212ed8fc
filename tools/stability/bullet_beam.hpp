// Bullet's own soft bodies in the hard cases that apply to them: a beam of tets in a Bullet world.
#pragma once

#include <BulletSoftBody/btDeformableLagrangianForce.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

#include <memory>

#include "stability/bench.hpp"

namespace frond::stability {

// CLASSIC: springs along the edges of tets, solved by positions, without a Young's modulus.
enum class BulletMethod { CLASSIC, LINEAR, NEOHOOKEAN, COUNT };
const char* name_of(BulletMethod method);

class BulletBeam {
public:
    // Holds the nodes lower than FOOT above the ground.
    BulletBeam(BulletMethod method, double dt, const Lattice& lattice, const frond_material& material);
    BulletBeam(const BulletBeam&) = delete;
    BulletBeam& operator=(const BulletBeam&) = delete;
    ~BulletBeam();

    double box = 20;  // largest distance of a node from its start [m]
    const double dt;  // [s]
    const Places rest;
    std::vector<size_t> foot;
    size_t top = 0;  // index of the top node
    std::mt19937 random{1};
    double between(double low, double high);

    void put(const std::function<frond_vec3(const frond_vec3&)>& to);  // moves all free nodes from rest and stops them
    void push(const std::function<frond_vec3()>& velocity);            // sets the velocity of each free node
    void move_foot(const std::function<frond_vec3(const frond_vec3&)>& to);
    void hold(size_t node);
    void let_go(size_t node);
    void move(size_t node, const frond_vec3& to);
    void set_gravity(const frond_vec3& gravity);
    btRigidBody& add(btCollisionShape* shape, double mass, const frond_vec3& place, const frond_vec3& velocity);
    void remove(btRigidBody& body);

    frond_vec3 place(size_t node) const;

    // Takes steps; after each, all nodes must be finite and in the box.
    void run(
        double seconds, const std::function<void(double time)>& before_each = [](double) {});
    void step(double length);
    // Checks that no tet is inverted and the mean distance of nodes from rest plus `shift`, as a share of the size.
    void expect_shape(double share, const frond_vec3& shift = {}) const;

private:
    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    // In order of dependence; destroyed from the back, the world first.
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

// A case with the name and the criterion of one of Frond's, except for energy, which is not checked.
struct BulletCase {
    const char* name;
    void (*run)(BulletMethod method, double dt);  // throws Broken
};
const std::vector<BulletCase>& bullet_cases();

}  // namespace frond::stability
