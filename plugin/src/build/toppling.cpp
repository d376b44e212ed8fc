#include "build/toppling.hpp"

#include <cmath>

namespace frond {

void take_by_weight(const Elements& elements, frond_mechanics which, const VecX& x, BlockMatrix& taken) {
    taken.set_zero();
    mechanics(which).add_stiffness(elements, x, Tangent::positive, 1, taken);
    mechanics(which).add_stiffness(elements, x, Tangent::exact, -1, taken);
}

static void hold(const std::vector<uint8_t>& held, VecX& x) {
    for (size_t i = 0; i < held.size(); i++)
        if (held[i]) point(x, int(i)).setZero();
}

// Power iteration, the value by Rayleigh's quotient. What pulls straight has negative eigenvalues; if one of these is
// largest, they are shifted away.
Toppling find_toppling(StaticStiffness& resisting, const BlockMatrix& taken, const std::vector<uint8_t>& held) {
    constexpr int ROUNDS = 200;
    constexpr double CLOSE = 1e-4;  // change of the value in a round [-]
    const Eigen::Index size = 3 * Eigen::Index(held.size());
    VecX product(size), solution(size);
    for (double shift = 0;;) {
        // Begin with the way in which forces in all directions bend the body.
        VecX mode(size);
        for (Eigen::Index i = 0; i < size; i++) product[i] = std::sin(double(i + 1));
        hold(held, product);
        solve(*resisting.factor, product, mode);
        double value = 0, before = INFINITY;
        for (int round = 0; round < ROUNDS; round++) {
            mode.normalize();
            taken.multiply(mode, product);
            hold(held, product);
            const double work = mode.dot(product);
            resisting.K.multiply(mode, solution);
            value = work / mode.dot(solution);
            if (!std::isfinite(value)) return {};
            if (std::abs(value - before) < CLOSE * std::abs(value)) break;
            before = value;
            solve(*resisting.factor, product, solution);
            mode = solution + shift * mode;
        }
        if (value >= 0 || shift > 0) return {mode, value};
        shift = -value;
    }
}

}  // namespace frond
