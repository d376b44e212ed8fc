// In: the stiffness of a linear tet, as which a quadratic one is seen at a point of integration. Out: that stiffness
// between the ten nodes, W^T k W with W the nodes' parts in the four corners; likewise anything else that is found
// between corners, or at them.
#include "mechanics/tet_element.hpp"

namespace frond {

namespace {

// A node's parts in corners: in its own, or in the two that it lies between.
struct Part {
    size_t corner;
    double part;
};
using Parts = std::array<Part, 2>;

// For a corner the second part is not used.
constexpr std::array<Parts, 10> parts_at(int q) {
    using Element = QuadraticTetElement;
    std::array<Parts, 10> out = {};
    const auto L = [&](size_t corner) { return int(corner) == q ? Element::NEAR : Element::FAR; };
    for (size_t c = 0; c < 4; ++c) out[c] = {{{c, 4 * L(c) - 1}, {c, 0}}};
    for (size_t k = 0; k < 6; ++k) {
        const size_t a = size_t(TET_EDGES[k][0]), b = size_t(TET_EDGES[k][1]);
        out[4 + k] = {{{a, 4 * L(b)}, {b, 4 * L(a)}}};
    }
    return out;
}
constexpr std::array<std::array<Parts, 10>, QuadraticTetElement::POINTS> PARTS = {parts_at(0), parts_at(1), parts_at(2),
                                                                                  parts_at(3)};

}  // namespace

void QuadraticTetElement::add_to_nodes(int q, const std::array<Mat3, 16>& corners, std::vector<Mat3>& out) {
    const std::array<Parts, 10>& parts = PARTS[size_t(q)];
    for (size_t n = 0; n < 10; ++n)
        for (size_t m = 0; m < 10; ++m)
            for (size_t i = 0; i < (n < 4 ? 1u : 2u); ++i)
                for (size_t j = 0; j < (m < 4 ? 1u : 2u); ++j)
                    out[10 * n + m] +=
                        parts[n][i].part * parts[m][j].part * corners[4 * parts[n][i].corner + parts[m][j].corner];
}

void QuadraticTetElement::add_to_nodes(int q, const std::array<Vec3, 4>& corners, std::vector<Vec3>& out) {
    const std::array<Parts, 10>& parts = PARTS[size_t(q)];
    for (size_t n = 0; n < 10; ++n)
        for (size_t i = 0; i < (n < 4 ? 1u : 2u); ++i) out[n] += parts[n][i].part * corners[parts[n][i].corner];
}

void QuadraticTetElement::add_stiffness(const TetElements& elements, size_t e, int q, const TetStiffness& k,
                                        BlockMatrix& K) {
    const std::array<Parts, 10>& parts = PARTS[size_t(q)];

    // All sixteen blocks of the linear tet.
    Mat3 all[4][4];
    all[1][1] = k.k11, all[2][1] = k.k21, all[3][1] = k.k31, all[2][2] = k.k22, all[3][2] = k.k32, all[3][3] = k.k33;
    all[1][2] = k.k21.transpose(), all[1][3] = k.k31.transpose(), all[2][3] = k.k32.transpose();
    for (size_t c = 1; c < 4; ++c) {
        all[c][0] = -(all[c][1] + all[c][2] + all[c][3]);
        all[0][c] = all[c][0].transpose();
    }
    all[0][0] = -(all[1][0] + all[2][0] + all[3][0]);

    const std::array<int, 55>& slots = elements.quadratic_slots[e];
    size_t pair = 0;
    for (size_t n = 0; n < 10; ++n) {
        // The node's row against the four corners.
        const auto& [first, second] = parts[n];
        Mat3 row[4];
        for (size_t d = 0; d < 4; ++d) {
            row[d] = first.part * all[first.corner][d];
            if (n >= 4) row[d] += second.part * all[second.corner][d];
        }
        for (size_t m = 0; m <= n; ++m, ++pair) {
            auto block = K.block(slots[pair]);
            block += parts[m][0].part * row[parts[m][0].corner];
            if (m >= 4) block += parts[m][1].part * row[parts[m][1].corner];
        }
    }
}

}  // namespace frond
