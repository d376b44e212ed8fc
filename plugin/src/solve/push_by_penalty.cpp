// In: touches that overlap. Out: impulses of springs between them, one by one, at the cost of no system.
//
// A spring of stiffness k that is h further along in time: p = h k (depth - h (v + W p)) for the velocity v along the
// normal, W what the touch answers to p, or more. So no k is too stiff: without end it is p = (depth / h - v) / W, which
// just stops and parts. Touches at one body share it (W times their number), so that all of them together never push
// more than one would: x'Wx is at most n times the sum of x_i W_ii x_i.
#include <algorithm>

#include "solve/impulses.hpp"

namespace frond {

void push_by_penalty(const std::vector<Touch>& touches, const CouplingTable& coupling, const ResponseSettings& settings,
                     Pushes& out) {
    constexpr double FASTEST = 0.3;  // that a spring lets overlapping bodies part [m/s]
    const double h = settings.h, k = settings.stiffness;
    out.impulses.assign(touches.size(), Vec3::Zero());
    out.shifts.clear();
    for (size_t i = 0; i < touches.size(); i++) {
        const Touch& touch = touches[i];
        const Mat3& own = coupling.row(int(i)).front().block;
        if (touch.is_bond) {
            out.impulses[i] = firm_inverse(own) * (touch.wanted - touch.velocity);
            continue;
        }
        const double speed = touch.velocity.dot(touch.normal);
        const double along = touch.normal.dot(own * touch.normal);
        const double push = h * k * (std::min(touch.depth, FASTEST * h) - h * speed) / (1 + h * h * k * along);
        if (!(push > 0)) continue;
        // Friction stops the sliding, as far as it can.
        const Vec3 sliding = touch.velocity - speed * touch.normal;
        const double across = own.trace() - along;  // no less than any direction's
        Vec3 hold = across > 0 ? Vec3(-sliding / across) : Vec3(Vec3::Zero());
        const double most = touch.friction * push, size = hold.norm();
        if (size > most) hold *= most / size;
        out.impulses[i] = push * touch.normal + hold;
    }
}

}  // namespace frond
