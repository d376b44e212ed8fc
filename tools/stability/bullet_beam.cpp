// In: tets. Out: a Bullet soft body and its motion.
#include "stability/bullet_beam.hpp"

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableLinearElasticityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include <cmath>
#include <cstdio>

namespace frond::stability {

namespace {

btVector3 to_bullet(const frond_vec3& a) {
    return btVector3(btScalar(a.x), btScalar(a.y), btScalar(a.z));
}

frond_vec3 from_bullet(const btVector3& a) {
    return {a.x(), a.y(), a.z()};
}

Places places_of(const Lattice& lattice) {
    Places places;
    for (size_t i = 0; i < lattice.nodes.size(); i += 3)
        places.push_back({lattice.nodes[i], lattice.nodes[i + 1], lattice.nodes[i + 2]});
    return places;
}

double volume_of(const frond_vec3& a, const frond_vec3& b, const frond_vec3& c, const frond_vec3& d) {
    return to_bullet(b - a).dot(to_bullet(c - a).cross(to_bullet(d - a))) / 6;
}

double height_of(const Places& places) {
    double height = 0;
    for (const frond_vec3& p : places) height = std::max(height, p.y);
    return height;
}

}  // namespace

const char* name_of(BulletMethod method) {
    return method == BulletMethod::CLASSIC ? "classic" : method == BulletMethod::LINEAR ? "linear" : "neo-Hookean";
}

BulletBeam::BulletBeam(BulletMethod method, double step, const Lattice& lattice, const frond_material& material)
    : dt(step), rest(places_of(lattice)), is_classic(method == BulletMethod::CLASSIC), size(height_of(rest)) {
    btSoftBodyWorldInfo* info = nullptr;
    if (is_classic)
        make_classic_world();
    else
        make_deformable_world(method, material);
    info = is_classic ? &static_cast<btSoftRigidDynamicsWorld*>(world)->getWorldInfo()
                      : &static_cast<btDeformableMultiBodyDynamicsWorld*>(world)->getWorldInfo();
    std::vector<btVector3> places;
    for (const frond_vec3& p : rest) places.push_back(to_bullet(p));
    body = std::make_unique<btSoftBody>(info, int(places.size()), places.data(), nullptr);
    masses.assign(rest.size(), 0);
    for (size_t t = 0; t < lattice.tets.size(); t += 4) {
        const int32_t* n = &lattice.tets[t];
        // Bullet requires right-handed tets.
        body->appendTetra(n[0], n[1], n[2], n[3]);
        const double volume = volume_of(rest[size_t(n[0])], rest[size_t(n[1])], rest[size_t(n[2])], rest[size_t(n[3])]);
        for (int c = 0; c < 4; c++) masses[size_t(n[c])] += btScalar(material.density * volume / 4);
        for (int a = 0; is_classic && a < 4; a++)
            for (int b = 0; b < a; b++) body->appendLink(n[a], n[b], nullptr, true);
    }
    for (size_t i = 0; i < rest.size(); i++) {
        body->setMass(int(i), masses[i]);
        if (rest[i].y <= FOOT) foot.push_back(i);
        if (rest[i].y > rest[top].y) top = i;
    }
    for (size_t node : foot) hold(node);
    btSoftBodyHelpers::generateBoundaryFaces(body.get());
    body->initializeDmInverse();
    const btSoftBody::TetraScratch scratch = {};
    body->m_tetraScratches.resize(body->m_tetras.size(), scratch);
    body->m_tetraScratchesTn.resize(body->m_tetras.size(), scratch);
    body->getCollisionShape()->setMargin(btScalar(0.005));
    body->m_cfg.kKHR = body->m_cfg.kCHR = 1;
    body->m_cfg.piterations = 10;
    body->m_sleepingThreshold = 0;
    if (is_classic) {
        static_cast<btSoftRigidDynamicsWorld*>(world)->addSoftBody(body.get());
    } else {
        body->m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDF;
        auto* deformable = static_cast<btDeformableMultiBodyDynamicsWorld*>(world);
        deformable->addSoftBody(body.get());
        for (const auto& force : forces) deformable->addForce(body.get(), force.get());
    }
    set_gravity({0, -9.81, 0});
}

BulletBeam::~BulletBeam() {
    for (const auto& rigid : bodies) world->removeRigidBody(rigid.get());
    if (is_classic)
        static_cast<btSoftRigidDynamicsWorld*>(world)->removeSoftBody(body.get());
    else
        static_cast<btDeformableMultiBodyDynamicsWorld*>(world)->removeSoftBody(body.get());
    while (!parts.empty()) parts.pop_back();
}

void BulletBeam::make_classic_world() {
    const auto solver = std::make_shared<btSequentialImpulseConstraintSolver>();
    const auto made =
        std::make_shared<btSoftRigidDynamicsWorld>(&dispatcher, &broadphase, solver.get(), &configuration);
    parts = {solver, made};
    world = made.get();
}

// Makes an implicit solver with a line search, as Bullet's examples set it up for stiff bodies.
void BulletBeam::make_deformable_world(BulletMethod method, const frond_material& material) {
    const auto body_solver = std::make_shared<btDeformableBodySolver>();
    const auto solver = std::make_shared<btDeformableMultiBodyConstraintSolver>();
    solver->setDeformableSolver(body_solver.get());
    const auto made = std::make_shared<btDeformableMultiBodyDynamicsWorld>(&dispatcher, &broadphase, solver.get(),
                                                                           &configuration, body_solver.get());
    made->setImplicit(true);
    made->setLineSearch(true);
    parts = {body_solver, solver, made};
    world = made.get();
    const double E = material.young, nu = material.poisson;
    const btScalar mu = btScalar(E / (2 * (1 + nu))), lambda = btScalar(E * nu / ((1 + nu) * (1 - 2 * nu)));
    if (method == BulletMethod::NEOHOOKEAN)
        forces.push_back(std::make_unique<btDeformableNeoHookeanForce>(mu, lambda));
    else
        forces.push_back(std::make_unique<btDeformableLinearElasticityForce>(mu, lambda));
    forces.push_back(std::make_unique<btDeformableGravityForce>(btVector3(0, 0, 0)));
}

double BulletBeam::between(double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
}

void BulletBeam::put(const std::function<frond_vec3(const frond_vec3&)>& to) {
    for (size_t i = 0; i < rest.size(); i++)
        if (rest[i].y > FOOT) move(i, to(rest[i]));
}

void BulletBeam::push(const std::function<frond_vec3()>& velocity) {
    for (size_t i = 0; i < rest.size(); i++)
        if (rest[i].y > FOOT) body->m_nodes[int(i)].m_v = body->m_nodes[int(i)].m_vn = to_bullet(velocity());
}

void BulletBeam::move_foot(const std::function<frond_vec3(const frond_vec3&)>& to) {
    for (size_t node : foot) move(node, to(rest[node]));
}

void BulletBeam::hold(size_t node) {
    body->setMass(int(node), 0);
}

void BulletBeam::let_go(size_t node) {
    body->setMass(int(node), masses[node]);
}

void BulletBeam::move(size_t node, const frond_vec3& to) {
    btSoftBody::Node& n = body->m_nodes[int(node)];
    n.m_x = n.m_q = to_bullet(to);
    n.m_v = n.m_vn = btVector3(0, 0, 0);
}

frond_vec3 BulletBeam::place(size_t node) const {
    return from_bullet(body->m_nodes[int(node)].m_x);
}

void BulletBeam::set_gravity(const frond_vec3& gravity) {
    world->setGravity(to_bullet(gravity));
    if (is_classic)
        body->m_worldInfo->m_gravity = to_bullet(gravity);
    else
        static_cast<btDeformableGravityForce*>(forces.back().get())->m_gravity = to_bullet(gravity);
}

btRigidBody& BulletBeam::add(btCollisionShape* shape, double mass, const frond_vec3& place,
                             const frond_vec3& velocity) {
    shapes.emplace_back(shape);
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(btScalar(mass), inertia);
    bodies.push_back(std::make_unique<btRigidBody>(btScalar(mass), nullptr, shape, inertia));
    btTransform frame = btTransform::getIdentity();
    frame.setOrigin(to_bullet(place));
    bodies.back()->setWorldTransform(frame);
    bodies.back()->setInterpolationWorldTransform(frame);
    bodies.back()->setLinearVelocity(to_bullet(velocity));
    world->addRigidBody(bodies.back().get());
    return *bodies.back();
}

void BulletBeam::remove(btRigidBody& rigid) {
    world->removeRigidBody(&rigid);
    for (auto it = bodies.begin(); it != bodies.end(); ++it)
        if (it->get() == &rigid) {
            bodies.erase(it);
            return;
        }
}

void BulletBeam::run(double seconds, const std::function<void(double)>& before_each) {
    const int steps = std::max(1, int(std::lround(seconds / dt)));
    for (int i = 0; i < steps; i++) {
        before_each(i * dt);
        step(dt);
        check((i + 1) * dt);
    }
}

void BulletBeam::step(double length) {
    world->stepSimulation(btScalar(length), 1, btScalar(length));
}

void BulletBeam::check(double time) const {
    char text[100];
    for (size_t i = 0; i < rest.size(); i++) {
        const frond_vec3 x = from_bullet(body->m_nodes[int(i)].m_x);
        const double way = length(x - rest[i]);
        if (way <= box) continue;
        std::snprintf(text, sizeof text,
                      std::isfinite(way) ? "a node is %.3g m away after %.3g s" : "not finite (%g) after %.3g s", way,
                      time);
        throw Broken(text);
    }
}

void BulletBeam::expect_shape(double share, const frond_vec3& shift) const {
    int inside_out = 0;
    for (int t = 0; t < body->m_tetras.size(); t++) {
        const btSoftBody::Tetra& tet = body->m_tetras[t];
        const auto at = [&](int c) { return from_bullet(tet.m_n[c]->m_x); };
        inside_out += !(volume_of(at(0), at(1), at(2), at(3)) > 0);
    }
    if (inside_out > 0) throw Broken(std::to_string(inside_out) + " tets inside out");
    double sum = 0;
    for (size_t i = 0; i < rest.size(); i++) sum += length(from_bullet(body->m_nodes[int(i)].m_x) - rest[i] - shift);
    const double mean = sum / double(rest.size()) / size;
    char text[100];
    std::snprintf(text, sizeof text, "nodes are %.3g of its size away in the mean, allowed %.3g", mean, share);
    if (!(mean <= share)) throw Broken(text);
}

}  // namespace frond::stability
