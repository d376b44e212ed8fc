#include "calibration/static_stiffness.hpp"

namespace frond {

// Replaces rows of held nodes by multiples of the identity, of the matrix's own size.
static void hold(const std::vector<uint8_t>& held, BlockMatrix& K) {
    const BlockPattern& pattern = *K.pattern;
    for (int j = 0; j < pattern.node_count; j++) {
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; k++) {
            const int i = pattern.row[size_t(k)];
            if (!held[size_t(i)] && !held[size_t(j)]) continue;
            Eigen::Map<Mat3> block(K.values.data() + 9 * size_t(k));
            if (i != j)
                block.setZero();
            else
                block = Mat3(std::max(block.trace(), 1e-12) / 3 * Mat3::Identity());
        }
    }
}

StaticStiffness::StaticStiffness(const BlockPattern& pattern) : plan(make_block_plan(pattern)) {
    K.pattern = &pattern;
    K.values.resize(9 * pattern.row.size());
    factor.plan = &plan;
}

bool StaticStiffness::set(const Elements& elements, const std::vector<uint8_t>& held, frond_mechanics which,
                          Tangent tangent, const VecX& x) {
    return set(elements, held, mechanics(which), tangent, x);
}

bool StaticStiffness::set(const Elements& elements, const std::vector<uint8_t>& held, const Mechanics& row,
                          Tangent tangent, const VecX& x) {
    K.set_zero();
    row.add_stiffness(elements, x, tangent, 1, K);
    hold(held, K);
    return factorize(factor, K);
}

}  // namespace frond
