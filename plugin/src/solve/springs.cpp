// In: springs and where the nodes are. Out: their energy 1/2 k |p - target|^2 with p = sum of w x, its force and
// stiffness.
#include "solve/springs.hpp"

#include <cmath>

namespace frond {

namespace {

const Tet& tet_of(const System& system, const Spring& spring) {
    return system.elements.tets[size_t(spring.tet)];
}

// From the point of the plant to the target.
Vec3 pull(const System& system, const Spring& spring, const VecX& x) {
    Vec3 to_target = spring.target;
    for (size_t a = 0; a < 4; ++a) to_target -= spring.weights[a] * point(x, tet_of(system, spring)[a]);
    return to_target;
}

}  // namespace

bool springs_are_sound(const System& system, const std::vector<Spring>& springs) {
    for (const Spring& spring : springs) {
        if (spring.tet < 0 || size_t(spring.tet) >= system.elements.tets.size()) return false;
        if (!(spring.stiffness >= 0) || !std::isfinite(spring.stiffness) || !spring.target.allFinite()) return false;
        for (double weight : spring.weights)
            if (!std::isfinite(weight)) return false;
    }
    return true;
}

double spring_energy(const System& system, const std::vector<Spring>& springs, const VecX& x) {
    double energy = 0;
    for (const Spring& spring : springs) energy += 0.5 * spring.stiffness * pull(system, spring, x).squaredNorm();
    return energy;
}

void add_spring_force(const System& system, const std::vector<Spring>& springs, const VecX& x, VecX& f) {
    for (const Spring& spring : springs) {
        const Vec3 force = spring.stiffness * pull(system, spring, x);
        for (size_t a = 0; a < 4; ++a) point(f, tet_of(system, spring)[a]) += spring.weights[a] * force;
    }
}

void add_spring_stiffness(const System& system, const std::vector<Spring>& springs, double scale, BlockMatrix& A) {
    for (const Spring& spring : springs)
        for (size_t a = 0; a < 4; ++a)
            for (size_t b = 0; b < 4; ++b) {
                const int i = tet_of(system, spring)[a], j = tet_of(system, spring)[b];
                if (i < j) continue;  // the lower triangle is all there is
                A.block(A.pattern->slot(i, j)).diagonal().array() +=
                    scale * spring.stiffness * spring.weights[a] * spring.weights[b];
            }
}

}  // namespace frond
