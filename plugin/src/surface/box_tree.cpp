// Builds a box tree: the boxes are halved at the median centre along the longest axis until few are left.
#include "surface/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace frond {

static int grow(BoxTree& tree, const std::vector<Box>& boxes, int first, int count, int leaf_size) {
    const int self = int(tree.nodes.size());
    Box box, centres;
    for (int k = first; k < first + count; ++k) {
        const Box& item = boxes[size_t(tree.items[size_t(k)])];
        box.extend(item);
        centres.extend(item.center());
    }
    tree.nodes.push_back({box, -1, first, count});
    if (count <= leaf_size) return self;

    // Equal centres are ordered by number, so that the tree is the same on every machine.
    int axis;
    centres.sizes().maxCoeff(&axis);
    const auto begin = tree.items.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](int a, int b) {
        const double place_a = boxes[size_t(a)].min()[axis] + boxes[size_t(a)].max()[axis];
        const double place_b = boxes[size_t(b)].min()[axis] + boxes[size_t(b)].max()[axis];
        return place_a != place_b ? place_a < place_b : a < b;
    });
    grow(tree, boxes, first, count / 2, leaf_size);
    const int right = grow(tree, boxes, first + count / 2, count - count / 2, leaf_size);
    tree.nodes[size_t(self)].right = right;
    return self;
}

int grow_tree(BoxTree& tree, const std::vector<Box>& boxes, const std::vector<int>& items, int leaf_size) {
    const int first = int(tree.items.size());
    tree.items.insert(tree.items.end(), items.begin(), items.end());
    return grow(tree, boxes, first, int(items.size()), leaf_size);
}

BoxTree make_box_tree(const std::vector<Box>& boxes, int leaf_size) {
    std::vector<int> items(boxes.size());
    std::iota(items.begin(), items.end(), 0);
    BoxTree tree;
    tree.nodes.reserve(2 * boxes.size() / size_t(leaf_size) + 1);
    grow_tree(tree, boxes, items, leaf_size);
    return tree;
}

}  // namespace frond
