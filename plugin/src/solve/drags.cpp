// In: drags, and positions and velocities of the nodes. Out: the force F - D v of each on the nodes, its potential
// -F v + v D v / 2, and its damping.
#include "solve/drags.hpp"

#include <cmath>

#include "core/product.hpp"

namespace frond {

bool drags_are_sound(const System& system, const std::vector<Drag>& drags) {
    for (const Drag& drag : drags)
        if (drag.attachment.turns || !is_sound(drag.attachment, system.elements->node_count) ||
            !drag.force.allFinite() || !drag.damping.allFinite())
            return false;
    return true;
}

double drag_potential(const std::vector<Drag>& drags, const VecX& x, const VecX& v) {
    double potential = 0;
    for (const Drag& drag : drags) {
        const Vec3 velocity = attachment_velocity(drag.attachment, x, v);
        potential += velocity.dot(0.5 * drag.damping * velocity - drag.force);
    }
    return potential;
}

void add_drag_force(const std::vector<Drag>& drags, const VecX& x, const VecX& v, VecX& f) {
    for (const Drag& drag : drags)
        add_attachment_force(drag.attachment, x,
                             drag.force - product(drag.damping, attachment_velocity(drag.attachment, x, v)), f);
}

void add_drag_damping(const std::vector<Drag>& drags, const VecX& x, double scale, BlockMatrix& A) {
    for (const Drag& drag : drags) add_attachment_block(drag.attachment, x, scale * drag.damping, A);
}

// By Cauchy and Schwarz (sum of w v)^2 <= (sum of |w|) (sum of |w| v^2).
void lump_drags(const std::vector<Drag>& drags, size_t node_count, double scale, std::vector<Mat3>& out) {
    out.assign(node_count, Mat3::Zero());
    for (const Drag& drag : drags) {
        double sum = 0;
        for (int k = 0; k < drag.attachment.count; ++k) sum += std::abs(drag.attachment.weight[size_t(k)]);
        for (int k = 0; k < drag.attachment.count; ++k)
            out[size_t(drag.attachment.node[size_t(k)])] +=
                scale * sum * std::abs(drag.attachment.weight[size_t(k)]) * drag.damping;
    }
}

}  // namespace frond
