// Chain: counts and lengths.
#include "skeleton/chain.hpp"

namespace frond {

int Chain::root_count() const {
    int count = 0;
    for (const ChainNode& node : nodes) count += node.parent < 0;
    return count;
}

int Chain::fork_count() const {
    std::vector<int> children(nodes.size(), 0);
    int count = 0;
    for (const ChainNode& node : nodes)
        if (node.parent >= 0) count += ++children[size_t(node.parent)] == 2;
    return count;
}

double Chain::length() const {
    double sum = 0;
    for (const ChainNode& node : nodes)
        if (node.parent >= 0) sum += (node.position - nodes[size_t(node.parent)].position).norm();
    return sum;
}

}  // namespace frond
