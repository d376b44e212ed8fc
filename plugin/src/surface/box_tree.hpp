// Box tree: a binary tree of bounding boxes over items, split at the median so that its depth is the logarithm of their
// number whatever their shape. Several trees may share one array of nodes.
#pragma once

#include "core/types.hpp"

namespace frond {

using Box = Eigen::AlignedBox3d;

struct BoxTree {
    struct Node {
        Box box;
        int right;         // right child, -1 at a leaf; the left child is the next node
        int first, count;  // range of its items
    };
    std::vector<Node> nodes;  // children come after their parent
    std::vector<int> items;   // numbers of boxes, in the order of the leaves
};

// Adds a tree over the items and returns its root. `boxes` is indexed by item.
int grow_tree(BoxTree& tree, const std::vector<Box>& boxes, const std::vector<int>& items, int leaf_size);
BoxTree make_box_tree(const std::vector<Box>& boxes, int leaf_size);

}  // namespace frond
