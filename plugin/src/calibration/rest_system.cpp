// In: elements at rest in X, positions x. Out: the derivative of elastic force and weight at x by X, factorized.
#include "calibration/rest_system.hpp"

#include <Eigen/SparseLU>

#include "mechanics/tet_element.hpp"

namespace frond {

VecX unbalanced_force(const TetElements& elements, const std::vector<uint8_t>& held, frond_mechanics which,
                      const VecX& x, double gravity) {
    VecX f = VecX::Zero(x.size());
    for (size_t e = 0; e < elements.tets.size(); e++) {
        const ElementNodes nodes = element_nodes(elements, e);
        const double weight = gravity * elements.density[e] * elements.volume[e];
        for (size_t n = 0; n < nodes.count; n++)
            f[3 * nodes.node[n] + 1] -= lumped_share(elements.nodes.order, n) * weight;
    }
    mechanics(which, elements.nodes.order).add_force(elements, x, f);
    for (size_t i = 0; i < held.size(); i++)
        if (held[i]) point(f, int(i)).setZero();
    return f;
}

struct RestSystem::Inside {
    std::vector<uint8_t> held;
    Eigen::SparseMatrix<double> J;
    // Position of an element's block (a, b) of n nodes in its column, at [n a + b].
    std::vector<std::vector<int>> places;
    Eigen::SparseLU<Eigen::SparseMatrix<double>> lu;

    // Adds the derivative of a free node's force by a free node's displacement.
    void add(int row_node, int column_node, int place, const Mat3& block) {
        if (held[size_t(row_node)] || held[size_t(column_node)]) return;
        for (int c = 0; c < 3; c++)
            Eigen::Map<Vec3>(J.valuePtr() + J.outerIndexPtr()[3 * column_node + c] + 3 * place) += block.col(c);
    }
};

RestSystem::RestSystem(const TetElements& elements, std::vector<uint8_t> held) : inside(new Inside) {
    inside->held = std::move(held);
    // Neighbours of each node, itself among them, ascending.
    const BlockPattern& lower = elements.pattern;
    std::vector<std::vector<int>> neighbours(size_t(lower.node_count));
    for (int j = 0; j < lower.node_count; j++)
        for (int k = lower.start[size_t(j)]; k < lower.start[size_t(j) + 1]; k++) {
            const int i = lower.row[size_t(k)];
            neighbours[size_t(j)].push_back(i);
            if (i != j) neighbours[size_t(i)].push_back(j);
        }
    for (std::vector<int>& list : neighbours) std::sort(list.begin(), list.end());

    Eigen::SparseMatrix<double>& J = inside->J;
    J.resize(3 * lower.node_count, 3 * lower.node_count);
    Eigen::VectorXi sizes(J.cols());
    for (int i = 0; i < sizes.size(); i++) sizes[i] = 3 * int(neighbours[size_t(i / 3)].size());
    J.reserve(sizes);
    for (int column = 0; column < J.cols(); column++)
        for (int node : neighbours[size_t(column / 3)])
            for (int r = 0; r < 3; r++) J.insert(3 * node + r, column) = 0;
    J.makeCompressed();
    for (size_t e = 0; e < elements.tets.size(); e++) {
        const ElementNodes nodes = element_nodes(elements, e);
        std::vector<int>& places = inside->places.emplace_back();
        for (size_t a = 0; a < nodes.count; a++)
            for (size_t b = 0; b < nodes.count; b++) {
                const std::vector<int>& list = neighbours[size_t(nodes.node[b])];
                places.push_back(int(std::lower_bound(list.begin(), list.end(), nodes.node[a]) - list.begin()));
            }
    }
    inside->lu.analyzePattern(J);
}

RestSystem::~RestSystem() = default;

bool RestSystem::find_move(const TetElements& elements, frond_mechanics which, const VecX& x, double gravity,
                           const VecX& unbalanced, VecX& move) {
    Inside& in = *inside;
    std::fill(in.J.valuePtr(), in.J.valuePtr() + in.J.nonZeros(), 0.0);
    const int order = elements.nodes.order;
    std::vector<Mat3> blocks;
    std::vector<Vec3> slopes;
    for (size_t e = 0; e < elements.tets.size(); e++) {
        mechanics(which, order).rest_derivative(elements, e, x, blocks);
        // Every node bears its share of the weight, which grows with the volume at rest.
        volume_slopes(elements, e, slopes);
        const double weight = gravity * elements.density[e];
        const ElementNodes nodes = element_nodes(elements, e);
        for (size_t a = 0; a < nodes.count; a++)
            for (size_t b = 0; b < nodes.count; b++) {
                const size_t at = nodes.count * a + b;
                blocks[at].row(1) -= lumped_share(order, a) * weight * slopes[b].transpose();
                in.add(nodes.node[a], nodes.node[b], in.places[e][at], blocks[at]);
            }
    }
    for (size_t i = 0; i < in.held.size(); i++)
        if (in.held[i])
            for (int c = 0; c < 3; c++) in.J.coeffRef(3 * int(i) + c, 3 * int(i) + c) = 1;
    in.lu.factorize(in.J);
    if (in.lu.info() != Eigen::Success) return false;
    move = in.lu.solve(-unbalanced);
    return move.allFinite();
}

}  // namespace frond
