// In: contacts that approach or overlap. Out: impulses of springs at them, found in a few rounds.
//
// A spring of stiffness k is implicit in time: p = h k (depth - h v) for the velocity v along the normal that remains
// after the impulses of all springs, W p. That is a contact with a compliance of 1 / (h^2 k), so no k is too stiff:
// with infinite k the bodies just stop and part. Rounds go from contact to contact, each spring with the others'
// current impulses, and end early: the rest is left to the next steps. Plants that overlap part by position correction.
#include <algorithm>

#include "solve/impulses.hpp"

namespace frond {

namespace {

struct ContactSpring {
    Mat3 own = Mat3::Zero();       // compliance of the contact to its own impulse [1/kg]
    double along = 0, across = 0;  // normal part, and a bound of the tangential part
    bool known = false;
};

const ContactSpring& spring_of(std::vector<ContactSpring>& springs, const Touch& touch,
                               const std::vector<Coupling>& row, int i) {
    ContactSpring& spring = springs[size_t(i)];
    if (spring.known) return spring;
    spring.known = true;
    for (const Coupling& c : row)
        if (c.other == i) spring.own += c.block;
    spring.along = touch.normal.dot(spring.own * touch.normal);
    spring.across = spring.own.trace() - spring.along;
    return spring;
}

// Returns the velocity at which an infinitely stiff spring would part them; plants that overlap only stop, since
// position correction parts them.
double wanted_speed(const Touch& touch, double h) {
    return touch.least_correction == Touch::NO_CORRECTION ? touch.bias_velocity : std::min(touch.depth, 0.0) / h;
}

// Returns the impulse of one spring in place of `before`, with all others as they are.
Vec3 pushed(const Touch& touch, const ContactSpring& spring, Vec3 velocity, const Vec3& before,
            const ResponseSettings& settings) {
    if (touch.is_bond) return before + firm_inverse(spring.own) * (touch.wanted - velocity);
    const double give = 1 / (settings.h * settings.h * settings.stiffness);  // [1/kg]
    const double push_before = before.dot(touch.normal);
    const double lacking = wanted_speed(touch, settings.h) - velocity.dot(touch.normal) - give * push_before;
    const double push = std::max(0.0, push_before + lacking / (spring.along + give));
    // Friction stops the remaining sliding, as far as it can.
    velocity += spring.own * ((push - push_before) * touch.normal);
    const Vec3 sliding = velocity - velocity.dot(touch.normal) * touch.normal;
    Vec3 hold = before - push_before * touch.normal;
    if (spring.across > 0) hold -= sliding / spring.across;
    const double most = touch.friction * push, size = hold.norm();
    if (size > most) hold *= most / size;
    return push * touch.normal + hold;
}

}  // namespace

void push_by_penalty(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     std::vector<Vec3>& impulses) {
    constexpr int ROUNDS = 8;  // in which springs feel each other
    std::vector<ContactSpring> springs(touches.size());
    std::vector<Vec3> velocities;
    for (const Touch& touch : touches) velocities.push_back(touch.velocity);
    impulses.assign(touches.size(), Vec3::Zero());
    for (int round = 0; round < ROUNDS; round++)
        for (size_t i = 0; i < touches.size(); i++) {
            const Touch& touch = touches[i];
            Vec3& impulse = impulses[i];
            const bool waits = impulse.isZero(0) && velocities[i].dot(touch.normal) >= wanted_speed(touch, settings.h);
            if (waits && !touch.is_bond) continue;
            const std::vector<Coupling>& row = coupling.row(int(i));
            const ContactSpring& spring = spring_of(springs, touch, row, int(i));
            const Vec3 by = pushed(touch, spring, velocities[i], impulse, settings) - impulse;
            impulse += by;
            for (const Coupling& c : row) velocities[size_t(c.other)] += c.block.transpose() * by;
        }
}

}  // namespace frond
