// Copies of cells: one for each connected part of the surface in the cell, with eight corners of its own. Then corners
// are merged into one node wherever two neighbouring copies carry parts that are connected (virtual nodes: Molino, Bao,
// Fedkiw 2004).
#include "cage/cage_copies.hpp"

#include <algorithm>

#include "core/lists.hpp"
#include "core/union_find.hpp"

namespace frond {

namespace {

// Copies while their corners are being joined.
struct Joining {
    Copies copies;
    std::vector<int> component;                   // component that encloses each copy, -1 if none does
    UnionFind corners{0};                         // 8 per copy
    std::vector<std::array<int, 8>> corner_sets;  // corners of the copies that remain
    std::vector<std::array<int, 2>> links;
};

}  // namespace

// Joins the corners at which two cells meet.
static void join_corners(Joining& joining, int a, int b) {
    const CellIndex &cell_a = joining.copies.cell[size_t(a)], &cell_b = joining.copies.cell[size_t(b)];
    for (int corner = 0; corner < 8; ++corner) {
        int other = 0;
        bool shared = true;
        for (int axis = 0; axis < 3; ++axis) {
            const int bit = (corner >> axis & 1) + cell_a[size_t(axis)] - cell_b[size_t(axis)];
            shared = shared && (bit == 0 || bit == 1);
            other |= (bit & 1) << axis;
        }
        if (shared) joining.corners.join(8 * a + corner, 8 * b + other);
    }
}

static void add_inside(const Topology& topology, const Voxels& voxels, Joining& joining) {
    Copies& copies = joining.copies;
    const std::vector<Inside> inside = find_inside(topology, voxels);
    const int first = int(copies.cell.size());
    for (const Inside& one : inside) {
        copies.cell.push_back(one.cell);
        joining.component.push_back(one.component);
    }
    // Neighbours are other cells inside the same component and the copies that carry its surface.
    const auto find = [&](const CellIndex& cell, int component) {
        const auto order = [](const Inside& a, const Inside& b) {
            if (a.component != b.component) return a.component < b.component;
            for (size_t axis = 3; axis-- > 0;)
                if (a.cell[axis] != b.cell[axis]) return a.cell[axis] < b.cell[axis];
            return false;
        };
        const Inside wanted{cell, component};
        const auto found = std::lower_bound(inside.begin(), inside.end(), wanted, order);
        return found != inside.end() && !order(wanted, *found) ? first + int(found - inside.begin()) : -1;
    };
    const int triangle_count = int(topology.triangles.size());
    for (int i = 0; i < int(inside.size()); ++i)
        for (int side = 0; side < 6; ++side) {
            CellIndex next = inside[size_t(i)].cell;
            next[size_t(side / 2)] += side % 2 ? 1 : -1;
            const int component = inside[size_t(i)].component;
            const int other = find(next, component), cell = voxels.cells.find(next);
            if (other > first + i) joining.links.push_back({first + i, other});
            if (cell < 0) continue;
            for (int e = voxels.first[size_t(cell)]; e < voxels.first[size_t(cell) + 1]; ++e) {
                const int item = voxels.item[size_t(e)];
                if (item >= triangle_count || topology.triangle_component[size_t(item)] != component) continue;
                joining.links.push_back({copies.entry_copy[size_t(e)], first + i});
            }
        }
}

// Merges copies of one cell that now have all corners in common.
static void merge_equal(Joining& joining) {
    Copies& copies = joining.copies;
    std::vector<std::array<int, 8>> corners(copies.cell.size());
    for (int copy = 0; copy < int(corners.size()); ++copy)
        for (int corner = 0; corner < 8; ++corner)
            corners[size_t(copy)][size_t(corner)] = joining.corners.find(8 * copy + corner);
    std::vector<int> order(copies.cell.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        return corners[size_t(a)] != corners[size_t(b)] ? corners[size_t(a)] < corners[size_t(b)] : a < b;
    });
    std::vector<int> same(copies.cell.size()), number(copies.cell.size(), -1);
    for (size_t i = 0; i < order.size(); ++i) {
        const bool equal = i > 0 && corners[size_t(order[i])] == corners[size_t(order[i - 1])];
        same[size_t(order[i])] = equal ? same[size_t(order[i - 1])] : order[i];
    }
    int count = 0;
    for (size_t c = 0; c < same.size(); ++c) {
        if (same[c] != int(c)) continue;
        number[c] = count;
        copies.cell[size_t(count)] = copies.cell[c];
        corners[size_t(count)] = corners[c];
        ++count;
    }
    copies.cell.resize(size_t(count));
    joining.corner_sets.assign(corners.begin(), corners.begin() + count);
    for (int& copy : copies.entry_copy) copy = number[size_t(same[size_t(copy)])];
    for (std::vector<int>& list : copies.neighbors)
        for (int& copy : list) copy = number[size_t(same[size_t(copy)])];
    std::vector<std::vector<int>> neighbors(static_cast<size_t>(count));
    for (size_t c = 0; c < same.size(); ++c) {
        auto& list = neighbors[size_t(number[size_t(same[c])])];
        list.insert(list.end(), copies.neighbors[c].begin(), copies.neighbors[c].end());
    }
    for (std::vector<int>& list : neighbors) sort_unique(list);
    copies.neighbors = std::move(neighbors);
}

// Numbers the nodes in the order of the copies and computes their positions.
static void place_nodes(const Lattice& lattice, Joining& joining) {
    Copies& copies = joining.copies;
    std::vector<int> number(joining.corners.parent.size(), -1);
    copies.nodes.resize(copies.cell.size());
    for (size_t copy = 0; copy < copies.cell.size(); ++copy) {
        for (size_t corner = 0; corner < 8; ++corner) {
            int& node = number[size_t(joining.corner_sets[copy][corner])];
            if (node < 0) {
                node = int(copies.positions.size());
                CellIndex at = copies.cell[copy];
                for (size_t axis = 0; axis < 3; ++axis) at[axis] += int(corner >> axis & 1);
                copies.positions.push_back(lattice.low(at));
            }
            copies.nodes[copy][corner] = node;
        }
        copies.nodes[copy][8] = int(copies.positions.size());
        copies.positions.push_back(lattice.low(copies.cell[copy]) + Vec3::Constant(0.5 * lattice.cell_size));
    }
}

// Finds the patch that each copy mostly carries; copies inside take that of a neighbour.
static void find_patches(const Topology& topology, const Patches& patches, const Voxels& voxels, Copies& copies) {
    const size_t count = copies.cell.size();
    std::vector<std::vector<int>> carried(count);
    for (size_t e = 0; e < voxels.item.size(); ++e)
        if (size_t(voxels.item[e]) < topology.triangles.size())
            carried[size_t(copies.entry_copy[e])].push_back(patches.triangle_patch[size_t(voxels.item[e])]);
    copies.patch.assign(count, -1);
    std::vector<int> waiting;
    for (size_t c = 0; c < count; ++c) {
        std::vector<int>& list = carried[c];
        std::sort(list.begin(), list.end());
        size_t most = 0;
        for (size_t i = 0, end; i < list.size(); i = end) {
            for (end = i; end < list.size() && list[end] == list[i];) ++end;
            if (end - i > most) {
                most = end - i;
                copies.patch[c] = list[i];
            }
        }
        if (copies.patch[c] >= 0) waiting.push_back(int(c));
    }
    for (size_t i = 0; i < waiting.size(); ++i)
        for (int other : copies.neighbors[size_t(waiting[i])]) {
            if (copies.patch[size_t(other)] >= 0) continue;
            copies.patch[size_t(other)] = copies.patch[size_t(waiting[i])];
            waiting.push_back(other);
        }
}

Copies make_copies(const Topology& topology, const Patches& patches, const Voxels& voxels) {
    const Pieces pieces = find_pieces(topology, patches, voxels);
    Joining joining;
    Copies& copies = joining.copies;
    copies.entry_copy = pieces.entry_piece;
    copies.cell.resize(size_t(pieces.count));
    joining.component.assign(size_t(pieces.count), -1);
    for (size_t cell = 0; cell + 1 < voxels.first.size(); ++cell)
        for (int e = voxels.first[cell]; e < voxels.first[cell + 1]; ++e)
            copies.cell[size_t(pieces.entry_piece[size_t(e)])] = voxels.cells.cells()[cell];
    joining.links = pieces.links;
    add_inside(topology, voxels, joining);

    joining.corners = UnionFind(8 * copies.cell.size());
    copies.neighbors.resize(copies.cell.size());
    for (const auto& [a, b] : joining.links) {
        join_corners(joining, a, b);
        copies.neighbors[size_t(a)].push_back(b);
        copies.neighbors[size_t(b)].push_back(a);
    }
    merge_equal(joining);
    place_nodes(voxels.lattice, joining);
    find_patches(topology, patches, voxels, copies);
    return std::move(joining.copies);
}

}  // namespace frond
