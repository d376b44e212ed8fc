// Pairs of boxes by a dense grid: boxes come in, pairs that overlap go out. Cells with boxes of one group only are
// found first and get no entries; the entries of the others are sorted by cell, by counting, so that a cell's are
// contiguous.
#include <algorithm>
#include <cmath>
#include <limits>

#include "collide/hash.hpp"

namespace frond {

static constexpr int NOBODY = -1, SEVERAL = -2;  // owner of a cell, besides a group

struct Grid {
    double lower[3], upper[3], cells_per_metre;
    int size[3];
    // Rounding is monotone: a point within a box is in a cell within the box's cells. Distances too long for
    // a number end in the last one.
    int cell_at(double place, int axis) const {
        const double cell = (std::clamp(place, lower[axis], upper[axis]) - lower[axis]) * cells_per_metre;
        return cell < size[axis] - 1 ? int(cell) : size[axis] - 1;
    }
    int number(int x, int y, int z) const { return (z * size[1] + y) * size[0] + x; }
    int count() const { return size[0] * size[1] * size[2]; }
};

static void bounds_of(const BoxSet& set, double lower[3], double upper[3]) {
    for (int k = 0; k < 3; ++k) {
        lower[k] = std::numeric_limits<double>::infinity();
        upper[k] = -lower[k];
    }
    for (const BoxSet::Bounds& box : set.boxes)
        for (int k = 0; k < 3; ++k) {
            lower[k] = std::min(lower[k], box.lower[k]);
            upper[k] = std::max(upper[k], box.upper[k]);
        }
}

// Fits the grid to where items and queries overlap. False if nowhere.
static bool fit_grid(const BoxSet& items, const BoxSet& queries, double cell_size, Grid& grid) {
    constexpr double MOST_CELLS = 1 << 20;  // beyond it cells are made larger
    double lower[3], upper[3];
    bounds_of(items, grid.lower, grid.upper);
    bounds_of(queries, lower, upper);
    for (int k = 0; k < 3; ++k) {
        grid.lower[k] = std::max(grid.lower[k], lower[k]);
        grid.upper[k] = std::min(grid.upper[k], upper[k]);
        if (!(grid.lower[k] <= grid.upper[k])) return false;
    }
    cell_size = bearable_cell_size(items, queries, cell_size);
    const auto is_endless = [&](int k) { return !std::isfinite(grid.upper[k] - grid.lower[k]); };
    if (is_endless(0) || is_endless(1) || is_endless(2)) {
        grid.cells_per_metre = 0;
        grid.size[0] = grid.size[1] = grid.size[2] = 1;
        return true;
    }
    for (double count = MOST_CELLS + 1; count > MOST_CELLS; cell_size *= 1.25) {
        count = 1;
        grid.cells_per_metre = 1 / cell_size;
        for (int k = 0; k < 3; ++k) {
            const double cells = std::floor((grid.upper[k] - grid.lower[k]) * grid.cells_per_metre) + 1;
            grid.size[k] = int(std::min(cells, MOST_CELLS));
            count *= cells;
        }
    }
    return true;
}

// Calls visit(cell number) for each cell that a box touches.
template <class Visit>
static void visit_cells(const Grid& grid, const BoxSet::Bounds& box, Visit&& visit) {
    int low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        if (box.upper[k] < grid.lower[k] || box.lower[k] > grid.upper[k]) return;
        low[k] = grid.cell_at(box.lower[k], k);
        high[k] = grid.cell_at(box.upper[k], k);
    }
    for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int x = low[0]; x <= high[0]; ++x) visit(grid.number(x, y, z));
}

// Two boxes may share several cells. Returns the one in which their pair is reported.
static int cell_of_pair(const Grid& grid, const BoxSet::Bounds& a, const BoxSet::Bounds& b) {
    return grid.number(grid.cell_at(std::max(a.lower[0], b.lower[0]), 0),
                       grid.cell_at(std::max(a.lower[1], b.lower[1]), 1),
                       grid.cell_at(std::max(a.lower[2], b.lower[2]), 2));
}

// Finds whose boxes are in each cell; owner_of(number of a box).
template <class OwnerOf>
static void find_owners(const Grid& grid, const BoxSet& set, std::vector<int>& owner, OwnerOf&& owner_of) {
    owner.assign(size_t(grid.count()), NOBODY);
    for (size_t i = 0; i < set.boxes.size(); ++i)
        visit_cells(grid, set.boxes[i], [&](int cell) {
            int& who = owner[size_t(cell)];
            who = who == NOBODY || who == owner_of(i) ? owner_of(i) : SEVERAL;
        });
}

void cull_by_grid(const BoxSet& boxes, const std::vector<int>& owner, double cell_size, HashMemory& memory,
                  std::vector<uint8_t>& kept) {
    kept.assign(boxes.boxes.size(), 0);
    if (std::all_of(owner.begin(), owner.end(), [&](int who) { return who == owner[0]; })) return;
    Grid grid;
    if (!fit_grid(boxes, boxes, cell_size, grid)) return;
    find_owners(grid, boxes, memory.owner, [&](size_t i) { return owner[i]; });
    for (size_t i = 0; i < kept.size(); ++i)
        visit_cells(grid, boxes.boxes[i], [&](int cell) { kept[i] |= memory.owner[size_t(cell)] == SEVERAL; });
}

void find_pairs_by_grid(const BoxSet& items, const BoxSet& queries, int, double cell_size, HashMemory& memory,
                        std::vector<std::array<int, 2>>& out) {
    Grid grid;
    if (!fit_grid(items, queries, cell_size, grid)) return;

    std::vector<int>& owner = memory.owner;
    find_owners(grid, queries, owner, [&](size_t i) { return queries.boxes[i].group; });

    // Items enter the cells where a query of another group is, sorted by cell.
    memory.entries.clear();
    memory.start.assign(size_t(grid.count()) + 1, 0);
    for (size_t i = 0; i < items.boxes.size(); ++i)
        visit_cells(grid, items.boxes[i], [&](int cell) {
            const int who = owner[size_t(cell)];
            if (who == NOBODY || who == items.boxes[i].group) return;
            memory.entries.push_back({cell, int(i)});
            ++memory.start[size_t(cell)];
        });
    int sum = 0;
    for (int& start : memory.start) start = sum += start;
    memory.items.resize(memory.entries.size());
    for (const auto& [cell, item] : memory.entries) memory.items[size_t(--memory.start[size_t(cell)])] = item;

    // Queries are tested against the items in their cells.
    for (size_t q = 0; q < queries.boxes.size(); ++q)
        visit_cells(grid, queries.boxes[q], [&](int cell) {
            for (int k = memory.start[size_t(cell)]; k < memory.start[size_t(cell) + 1]; ++k) {
                const int item = memory.items[size_t(k)];
                const BoxSet::Bounds& box = items.boxes[size_t(item)];
                if (boxes_meet(box, queries.boxes[q]) && cell_of_pair(grid, box, queries.boxes[q]) == cell)
                    out.push_back({item, int(q)});
            }
        });
}

}  // namespace frond
