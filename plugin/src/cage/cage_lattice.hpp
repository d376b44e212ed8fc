// Lattice: space divided into cubic cells, and the cells that a surface passes through.
#pragma once

#include <cmath>

#include "skeleton/topology.hpp"

namespace frond {

using CellIndex = std::array<int, 3>;

struct Lattice {
    Vec3 origin;       // [m]
    double cell_size;  // [m]

    CellIndex cell_of(const Vec3& place) const {
        const Vec3 steps = (place - origin) / cell_size;
        return {int(std::floor(steps.x())), int(std::floor(steps.y())), int(std::floor(steps.z()))};
    }
    Vec3 low(const CellIndex& cell) const { return origin + cell_size * Vec3(cell[0], cell[1], cell[2]); }
};

// Makes a lattice around the surface, centred on it.
Lattice make_lattice(const Topology& topology, double cell_size);

// A flat convex shape: a triangle, or the part of it in a cell.
struct Polygon {
    std::array<Vec3, 12> corners;
    int count = 0;
};
Polygon polygon_of(const Vec3& a, const Vec3& b, const Vec3& c);
// Clips a polygon to the space between two planes across an axis.
Polygon clip(const Polygon& polygon, int axis, double low, double high);
double area_of(const Polygon& polygon, Vec3& centre);

// Calls visit(cell, part) for each cell, enlarged by `margin` on all sides, that a polygon reaches into, with the
// polygon's part in that cell. The work is proportional to the number of cells visited, however large the polygon.
template <class Visit>
void visit_cells(const Lattice& lattice, double margin, const Polygon& polygon, const Visit& visit) {
    CellIndex low, high;
    const auto range = [&](const Polygon& part, int axis) {
        double least = part.corners[0][axis], most = least;
        for (int k = 1; k < part.count; ++k) {
            least = std::min(least, part.corners[size_t(k)][axis]);
            most = std::max(most, part.corners[size_t(k)][axis]);
        }
        low[size_t(axis)] = int(std::floor((least - margin - lattice.origin[axis]) / lattice.cell_size));
        high[size_t(axis)] = int(std::floor((most + margin - lattice.origin[axis]) / lattice.cell_size));
    };
    const auto slab = [&](const Polygon& part, int axis, int cell) {
        if (low[size_t(axis)] == high[size_t(axis)]) return part;
        const double begin = lattice.origin[axis] + lattice.cell_size * cell;
        return clip(part, axis, begin - margin, begin + lattice.cell_size + margin);
    };
    CellIndex cell;
    range(polygon, 0);
    for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) {
        const Polygon in_x = slab(polygon, 0, cell[0]);
        if (in_x.count == 0) continue;
        range(in_x, 1);
        for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
            const Polygon in_y = slab(in_x, 1, cell[1]);
            if (in_y.count == 0) continue;
            range(in_y, 2);
            for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
                const Polygon in_z = slab(in_y, 2, cell[2]);
                if (in_z.count > 0) visit(cell, in_z);
            }
        }
    }
}

// Hash table of cells by their indices, which numbers them in order of first appearance.
class CellTable {
public:
    CellTable() : slots(1024, -1) {}
    int find(const CellIndex& cell) const {
        const int found = slots[slot_of(cell)];
        return found;
    }
    int insert(const CellIndex& cell);
    const std::vector<CellIndex>& cells() const { return numbered; }

private:
    size_t slot_of(const CellIndex& cell) const {
        uint64_t hash = 0;
        for (int index : cell) {
            hash = (hash ^ uint64_t(uint32_t(index))) * 0xD6E8FEB86659FD93ull;
            hash ^= hash >> 32;
        }
        size_t k = hash & (slots.size() - 1);
        while (slots[k] >= 0 && numbered[size_t(slots[k])] != cell) k = (k + 1) & (slots.size() - 1);
        return k;
    }
    std::vector<int> slots;
    std::vector<CellIndex> numbered;
};

// The cells that the surface passes through (surface voxelization). Items are the triangles, then the joints (as lines
// between their ends).
struct Voxels {
    Lattice lattice;
    double margin;  // enlargement of cells on all sides [m]
    CellTable cells;
    std::vector<int> first;    // the entries of cell c are first[c] .. first[c+1]-1, by ascending item
    std::vector<int> item;     // item of each entry
    std::vector<Vec3> centre;  // centre of the item's part in the cell [m]

    bool holds(int cell, const Vec3& place) const {
        const Vec3 offset = place - lattice.low(cells.cells()[size_t(cell)]);
        return offset.minCoeff() >= -margin && offset.maxCoeff() <= lattice.cell_size + margin;
    }
    // Returns the entry of an item in a cell, or -1.
    int find_entry(int cell, int item) const;
};

Voxels make_voxels(const Topology& topology, const Lattice& lattice, double offset);

// Limits of cells, and of entries in all plus so many per triangle. Cells that need more are too small.
constexpr size_t MAX_CELLS = 200000, MAX_ENTRIES = 4000000, MAX_ENTRIES_PER_TRIANGLE = 8;

}  // namespace frond
