// In: springs and positions of the nodes. Out: their energy 1/2 k |p - target|^2, its force and stiffness.
#include "solve/springs.hpp"

#include <cmath>

namespace frond {

bool springs_are_sound(const System& system, const std::vector<Spring>& springs) {
    for (const Spring& spring : springs) {
        if (!is_sound(spring.attachment, system.elements->node_count)) return false;
        if (!(spring.stiffness >= 0) || !std::isfinite(spring.stiffness) || !spring.target.allFinite()) return false;
    }
    return true;
}

double spring_energy(const std::vector<Spring>& springs, const VecX& x) {
    double energy = 0;
    for (const Spring& spring : springs)
        energy += 0.5 * spring.stiffness * (spring.target - attachment_place(spring.attachment, x)).squaredNorm();
    return energy;
}

void add_spring_force(const std::vector<Spring>& springs, const VecX& x, VecX& f) {
    for (const Spring& spring : springs)
        add_attachment_force(spring.attachment, x,
                             spring.stiffness * (spring.target - attachment_place(spring.attachment, x)), f);
}

void add_spring_stiffness(const std::vector<Spring>& springs, const VecX& x, Tangent tangent, double scale,
                          BlockMatrix& A) {
    for (const Spring& spring : springs) {
        add_attachment_stiffness(spring.attachment, x, scale * spring.stiffness, A);
        if (tangent == Tangent::positive) continue;
        const Vec3 force = spring.stiffness * (spring.target - attachment_place(spring.attachment, x));
        add_attachment_turning(spring.attachment, x, force, scale, A);
    }
}

}  // namespace frond
