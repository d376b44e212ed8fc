// In: the pattern of a matrix. Out: the plan of its factor, if it is a tree of pairs of nodes.
#include "solve/tree_factor.hpp"

namespace frond {

std::optional<TreePlan> make_tree_plan(const BlockPattern& pattern) {
    if (pattern.node_count == 0 || pattern.node_count % 2) return std::nullopt;
    TreePlan plan;
    plan.pairs.assign(size_t(pattern.node_count) / 2, {-1, {-1, -1, -1}, {-1, -1, -1, -1}});
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)];
            TreePlan::Pair& pair = plan.pairs[size_t(i) / 2];
            if (i / 2 == j / 2) {
                pair.own[size_t(i % 2 + j % 2)] = k;
                continue;
            }
            if (pair.parent >= 0 && pair.parent != j / 2) return std::nullopt;
            pair.parent = j / 2;
            pair.link[size_t(i % 2 + 2 * (j % 2))] = k;
        }
    return plan;
}

}  // namespace frond
