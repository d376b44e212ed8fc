// The cases that apply to Bullet's own soft bodies, named as Frond's and applied to a beam of the same tets.
#include <cmath>
#include <cstdio>

#include "stability/bullet_beam.hpp"

namespace frond::stability {
namespace {

using Move = frond_vec3 (*)(const frond_vec3&);

void come_back(BulletBeam& beam) {
    beam.run(COME_BACK);
    beam.expect_shape(NEAR_LET_GO);
}

template <class Put>
void come_back_from(BulletMethod method, double dt, const Put& to) {
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    beam.put([&](const frond_vec3& p) { return to(beam, p); });
    come_back(beam);
}

template <Move to>
void put(BulletMethod method, double dt) {
    come_back_from(method, dt, [](BulletBeam&, const frond_vec3& p) { return to(p); });
}

frond_vec3 to_point(const frond_vec3&) {
    return {0, 0.5, 0};
}
frond_vec3 to_plane(const frond_vec3& p) {
    return {0, p.y, p.z};
}
frond_vec3 to_line(const frond_vec3& p) {
    return {0, p.y, 0};
}
frond_vec3 mirrored(const frond_vec3& p) {
    return {-p.x, p.y, p.z};
}
frond_vec3 folded(const frond_vec3& p) {
    return p.y <= 0.5 ? p : frond_vec3{0.15 - p.x, 1 - p.y, p.z};
}
frond_vec3 shrunk(const frond_vec3& p) {
    return 0.01 * p;
}
frond_vec3 blown_up(const frond_vec3& p) {
    return 5 * p;
}
frond_vec3 wrung(const frond_vec3& p) {
    const double c = std::cos(4 * 2 * M_PI * p.y), s = std::sin(4 * 2 * M_PI * p.y);
    return {c * p.x - s * p.z, p.y, s * p.x + c * p.z};
}

void scatter_beam(BulletMethod method, double dt) {
    come_back_from(method, dt, [](BulletBeam& beam, const frond_vec3& p) {
        return p + frond_vec3{beam.between(-0.5, 0.5), beam.between(-0.5, 0.5), beam.between(-0.5, 0.5)};
    });
}

void scramble(BulletMethod method, double dt) {
    constexpr double FRAMES = 120;
    BulletBeam beam(method, dt, make_lattice(0.1, 3, even_heights(1, 26)), plain_material());
    beam.put([&](const frond_vec3&) {
        return frond_vec3{beam.between(-0.5, 0.5), beam.between(0, 1), beam.between(-0.5, 0.5)};
    });
    beam.run(FRAMES / 60);
    beam.expect_shape(0.05);
}

void kick(BulletMethod method, double dt) {
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    beam.push([&] { return frond_vec3{beam.between(-100, 100), beam.between(-100, 100), beam.between(-100, 100)}; });
    come_back(beam);
}

void stretch(BulletMethod method, double dt) {
    constexpr double TIMES = 100;
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    beam.box = 3 * TIMES;
    const frond_vec3 from = beam.rest[beam.top];
    beam.hold(beam.top);
    beam.run(2, [&](double time) { beam.move(beam.top, from + frond_vec3{0, TIMES * std::min(1.0, time), 0}); });
    beam.let_go(beam.top);
    beam.run(10);
    beam.expect_shape(NEAR_LET_GO);
}

// Pushes the free nodes aside: with no reference to compare with, the beam must only stay within its box.
template <double frond_material::*field>
void bend_of(BulletMethod method, double dt, double value) {
    frond_material material = plain_material();
    material.*field = value;
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), material);
    beam.push([] { return frond_vec3{0.5, 0, 0}; });
    beam.box = 3;
    beam.run(2.5);
}
void soft(BulletMethod method, double dt) {
    bend_of<&frond_material::young>(method, dt, 1e3);
}
void stiff(BulletMethod method, double dt) {
    bend_of<&frond_material::young>(method, dt, 1e11);
}
void light(BulletMethod method, double dt) {
    bend_of<&frond_material::density>(method, dt, 1);
}
void heavy(BulletMethod method, double dt) {
    bend_of<&frond_material::density>(method, dt, 2e4);
}
void no_contraction(BulletMethod method, double dt) {
    bend_of<&frond_material::poisson>(method, dt, 0);
}
void incompressible(BulletMethod method, double dt) {
    bend_of<&frond_material::poisson>(method, dt, 0.499);
}

// Moves the foot to `where` over time, then back.
template <class Where>
void drive(BulletMethod method, double dt, double duration, const Where& where) {
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    beam.run(duration,
             [&](double time) { beam.move_foot([&](const frond_vec3& p) { return where(p, time + beam.dt); }); });
    beam.move_foot([](const frond_vec3& p) { return p; });
    beam.run(COME_BACK);
    beam.expect_shape(NEAR_DRIVEN);
}

void teleport(BulletMethod method, double dt) {
    const frond_vec3 way = {10, 0, 0};
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    beam.box = 30;
    beam.move_foot([&](const frond_vec3& p) { return p + way; });
    beam.run(COME_BACK);
    beam.expect_shape(NEAR_DRIVEN, way);
}
void spin(BulletMethod method, double dt) {
    constexpr double SPEED = 100;
    drive(method, dt, 16 * 2 * M_PI / SPEED, [](const frond_vec3& p, double time) {
        const double c = std::cos(SPEED * time), s = std::sin(SPEED * time);
        return frond_vec3{c * p.x + s * p.z, p.y, c * p.z - s * p.x};
    });
}
void shake(BulletMethod method, double dt) {
    drive(method, dt, 1, [](const frond_vec3& p, double time) {
        return p + frond_vec3{0.05 * std::sin(2 * M_PI * 60 * time + 1), 0, 0.05 * std::cos(2 * M_PI * 47 * time)};
    });
}
void somersault(BulletMethod method, double dt) {
    drive(method, dt, 1, [](const frond_vec3& p, double time) {
        const double c = std::cos(2 * M_PI * time), s = std::sin(2 * M_PI * time);
        return frond_vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    });
}

template <class Gravity>
void gravity_for(BulletMethod method, double dt, const Gravity& gravity) {
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    beam.run(2, [&](double) { beam.set_gravity(gravity(beam)); });
    beam.set_gravity({0, -9.81, 0});
    beam.run(COME_BACK);
    beam.expect_shape(NEAR_DRIVEN);
}
void gravity_100(BulletMethod method, double dt) {
    gravity_for(method, dt, [](BulletBeam&) { return frond_vec3{0, -981, 0}; });
}
void gravity_up(BulletMethod method, double dt) {
    gravity_for(method, dt, [](BulletBeam&) { return frond_vec3{0, 9.81, 0}; });
}
void gravity_tumbling(BulletMethod method, double dt) {
    gravity_for(method, dt, [](BulletBeam& beam) {
        return frond_vec3{beam.between(-98, 98), beam.between(-98, 98), beam.between(-98, 98)};
    });
}

// Hits the beam with a ball of `mass_ratio` times its mass, which is removed after a second.
void hit_by(BulletMethod method, double dt, double mass_ratio, double speed) {
    constexpr double MASS = 8;  // mass of the beam [kg]
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    btRigidBody& ball = beam.add(new btSphereShape(btScalar(0.05)), mass_ratio * MASS, {-0.4, 0.6, 0}, {speed, 0, 0});
    beam.run(1);
    beam.remove(ball);
    beam.run(COME_BACK);
    beam.expect_shape(NEAR_DRIVEN);
}
void light_ball(BulletMethod method, double dt) {
    hit_by(method, dt, 1e-4, 5);
}
void equal_ball(BulletMethod method, double dt) {
    hit_by(method, dt, 1, 5);
}
void heavy_ball(BulletMethod method, double dt) {
    hit_by(method, dt, 1e4, 5);
}
void fast_ball(BulletMethod method, double dt) {
    hit_by(method, dt, 0.5, 100);
}

void stand_in(BulletMethod method, double dt, const btVector3& half, const frond_vec3& at) {
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    beam.add(new btBoxShape(half), 0, at, {});
    beam.run(2);
    beam.expect_shape(NEAR_DRIVEN);
}
void in_a_box(BulletMethod method, double dt) {
    stand_in(method, dt, btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)), {0, 0.3, 0});
}
void wall_through(BulletMethod method, double dt) {
    stand_in(method, dt, btVector3(btScalar(0.02), 1, 1), {0.03, 0.6, 0});
}

void odd_steps(BulletMethod method, double dt) {
    BulletBeam beam(method, dt, make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    beam.push([] { return frond_vec3{0.5, 0, 0}; });
    int count = 0;
    for (double time = 0; time < 6; time += dt)
        if (count++ % 3 != 0) beam.step(dt * std::pow(10, beam.between(-3, 0)));
    beam.run(dt);
    beam.expect_shape(NEAR_DRIVEN);
}

}  // namespace

const std::vector<BulletCase>& bullet_cases() {
    static const std::vector<BulletCase> all = {
        {"crushed_to_point", put<to_point>},
        {"crushed_to_plane", put<to_plane>},
        {"crushed_to_line", put<to_line>},
        {"mirrored", put<mirrored>},
        {"scattered", scatter_beam},
        {"scrambled_beam", scramble},
        {"folded_double", put<folded>},
        {"wrung", put<wrung>},
        {"shrunk", put<shrunk>},
        {"blown_up", put<blown_up>},
        {"kicked", kick},
        {"stretched", stretch},
        {"soft", soft},
        {"stiff", stiff},
        {"light", light},
        {"heavy", heavy},
        {"poisson_0", no_contraction},
        {"poisson_0.499", incompressible},
        {"teleported", teleport},
        {"spun", spin},
        {"shaken", shake},
        {"somersault", somersault},
        {"gravity_100_g", gravity_100},
        {"gravity_reversed", gravity_up},
        {"gravity_tumbling", gravity_tumbling},
        {"ball_1e-4", light_ball},
        {"ball_1", equal_ball},
        {"ball_1e4", heavy_ball},
        {"ball_100_m/s", fast_ball},
        {"in_a_box", in_a_box},
        {"wall_through", wall_through},
        {"odd_steps", odd_steps},
    };
    return all;
}

}  // namespace frond::stability
