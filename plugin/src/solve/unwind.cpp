// In: the motion of nodes that rotate. Out: the same motion, no rotation vector longer than half a turn: beyond that it
// changes too fast with the rotation, and at a whole turn its rate is undefined. This is done between steps, never
// within one: its matrix and the responses by that are in the rotation vectors of its start.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "mechanics/rotation.hpp"
#include "solve/solve.hpp"

namespace frond {

// Replaces a rotation vector by its equivalent nearest to zero, or a whole turn less if it is that; `rates` of it keep
// their angular velocities.
static void turn_back(VecX& x, int node, std::initializer_list<VecX*> rates) {
    const Vec3 turn = point(x, node);
    const double whole = 2 * PI, angle = turn.norm();
    const Vec3 back = turn * (1 - whole * std::max(1.0, std::round(angle / whole)) / angle);
    const Mat3 change = inverse_rate_matrix<double>(back) * rate_matrix<double>(turn);
    for (VecX* rate : rates)
        if (rate->size() == x.size()) point(*rate, node) = change * point(*rate, node);
    point(x, node) = back;
}

void unwind(Motion& motion) {
    constexpr double NEAR = PI / 2;  // what a history may look back over [rad]
    History& history = motion.history;
    for (int node = 1; node < motion.x.size() / 3; node += 2) {
        const double square = point(motion.x, node).squaredNorm();
        if (!(square > PI * PI) || !std::isfinite(square)) continue;
        turn_back(motion.x, node, {&motion.v});
        if (!motion.pinned.empty() && motion.pinned[size_t(node)])
            point(motion.pin_target, node) =
                wound_as(Vec3(point(motion.x, node)), Vec3(point(motion.pin_target, node)));
        if (!history.valid) continue;
        // The past goes along, though it was within half a turn: differences from it are velocities. Where that does
        // not bring it near, as if its axis was another one, the history of all nodes is dropped.
        if (point(history.x_prev, node).squaredNorm() >= 1) turn_back(history.x_prev, node, {&history.v_prev});
        if (!((point(history.x_prev, node) - point(motion.x, node)).squaredNorm() < NEAR * NEAR)) {
            history.valid = false;
            continue;
        }
        if (history.x_end.size() == 0) continue;
        turn_back(history.x_end, node, {&history.v_end, &history.x_rate, &history.v_rate});
    }
}

Vec3 wound_as(const Vec3& from, const Vec3& to) {
    const double way = (to - from).squaredNorm();
    if (!(way > PI * PI)) return to;
    const Vec3 other = to * (1 - 2 * PI / to.norm());
    return (other - from).squaredNorm() < way ? other : to;
}

VecX wound_as(const VecX& from, VecX to) {
    for (int node = 1; node < to.size() / 3; node += 2)
        point(to, node) = wound_as(Vec3(point(from, node)), Vec3(point(to, node)));
    return to;
}

}  // namespace frond
