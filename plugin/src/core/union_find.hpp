// Union-find: sets of numbers, each represented by its smallest member, so that results do not depend on the order of
// joining.
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "core/assert.hpp"

namespace frond {

struct UnionFind {
    std::vector<int> parent;

    explicit UnionFind(size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }
    int find(int i) {
        FROND_ASSERT(i >= 0 && size_t(i) < parent.size());
        while (parent[size_t(i)] != i) i = parent[size_t(i)] = parent[size_t(parent[size_t(i)])];
        return i;
    }
    // Joins two sets. Returns false if they were one set before.
    bool join(int a, int b) {
        a = find(a);
        b = find(b);
        if (a == b) return false;
        if (a > b) std::swap(a, b);
        parent[size_t(b)] = a;
        return true;
    }
    // Returns all sets in the order of their first members.
    std::vector<std::vector<int>> sets() {
        std::vector<std::vector<int>> all;
        std::vector<int> number(parent.size(), -1);
        for (size_t i = 0; i < parent.size(); i++) {
            int& set = number[size_t(find(int(i)))];
            if (set < 0) {
                set = int(all.size());
                all.emplace_back();
            }
            all[size_t(set)].push_back(int(i));
        }
        return all;
    }
};

}  // namespace frond
