// In: values at, or blocks between, the corners of the linear tet that a quadratic one equals at an integration point.
// Out: the same at, or between, its ten nodes, W^T k W with W the nodes' weights in the four corners.
#include "mechanics/tet_element.hpp"

namespace frond {

namespace {

// A node's weight in a corner: a corner node has one, an edge node one for each corner of its edge.
struct Part {
    size_t corner;
    double part;
};
using Parts = std::array<Part, 2>;

// Returns the weights at point q; a corner node's second one is unused.
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

}  // namespace frond
