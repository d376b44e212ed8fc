// In: a pattern of blocks. Out: its nodes in an order of elimination, by Eigen's AMD.
#include "solve/elimination_order.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include "core/assert.hpp"

namespace frond {

std::vector<int> elimination_order(const BlockPattern& pattern) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k)
            entries.emplace_back(pattern.row[size_t(k)], j, 1.0);
    Eigen::SparseMatrix<double> graph(pattern.node_count, pattern.node_count);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), permutation);
    const auto& indices = permutation.indices();
    FROND_ASSERT(indices.size() == pattern.node_count);
    return std::vector<int>(indices.data(), indices.data() + indices.size());
}

}  // namespace frond
