// Lays a lattice over a surface and finds the cells that it passes through, by cutting each triangle into slabs,
// columns and cells: exact, with work in proportion to the number of cells.
#include "cage/cage_lattice.hpp"

#include <algorithm>

#include "core/assert.hpp"
#include "core/error.hpp"

namespace frond {

// Cells are enlarged by the larger of these shares of their size and of the plant's (twice the distance by which
// welding may move a vertex), so that nothing is lost on a face between two cells.
static constexpr double CELL_MARGIN = 1e-4, SIZE_MARGIN = 2e-6;

Lattice make_lattice(const Topology& topology, double cell_size) {
    Eigen::AlignedBox3d box;
    for (const Vec3& place : topology.points) box.extend(place);
    if (!(box.diagonal().norm() / cell_size < 1e6))
        fail(FROND_RESULT_BAD_ARGUMENT, "cage_size is %g m for a plant of %g m; make it larger, or 0 to choose",
             cell_size, box.diagonal().norm());
    // Takes just as many cells as are needed, centred on the plant; a face that only touches gets no further cell.
    Lattice lattice{Vec3::Zero(), cell_size};
    for (int axis = 0; axis < 3; ++axis) {
        const double cells = std::floor(box.sizes()[axis] / cell_size + 1e-3) + 1;
        lattice.origin[axis] = box.center()[axis] - 0.5 * cells * cell_size;
    }
    return lattice;
}

Polygon polygon_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    Polygon polygon;
    polygon.corners[0] = a;
    polygon.corners[1] = b;
    polygon.corners[2] = c;
    polygon.count = 3;
    return polygon;
}

// Keeps the side on which sign * (coordinate - limit) <= 0.
static Polygon cut(const Polygon& polygon, int axis, double limit, double sign) {
    Polygon kept;
    for (int k = 0; k < polygon.count; ++k) {
        const Vec3& here = polygon.corners[size_t(k)];
        const Vec3& next = polygon.corners[size_t(k + 1 == polygon.count ? 0 : k + 1)];
        const double out_here = sign * (here[axis] - limit), out_next = sign * (next[axis] - limit);
        if (out_here <= 0) kept.corners[size_t(kept.count++)] = here;
        if ((out_here < 0 && out_next > 0) || (out_here > 0 && out_next < 0)) {
            Vec3 between = here + out_here / (out_here - out_next) * (next - here);
            between[axis] = limit;
            kept.corners[size_t(kept.count++)] = between;
        }
        // A convex shape gains one corner per cut; more could only come from rounding.
        if (kept.count >= 11) break;
    }
    return kept;
}

Polygon clip(const Polygon& polygon, int axis, double low, double high) {
    return cut(cut(polygon, axis, low, -1), axis, high, 1);
}

double area_of(const Polygon& polygon, Vec3& centre) {
    double area = 0;
    Vec3 moment = Vec3::Zero(), mean = Vec3::Zero();
    for (int k = 0; k < polygon.count; ++k) mean += polygon.corners[size_t(k)] / polygon.count;
    for (int k = 2; k < polygon.count; ++k) {
        const Vec3 &a = polygon.corners[0], &b = polygon.corners[size_t(k - 1)], &c = polygon.corners[size_t(k)];
        const double part = 0.5 * (b - a).cross(c - a).norm();
        area += part;
        moment += part * (a + b + c - 3 * mean) / 3;
    }
    centre = area > 0 ? Vec3(mean + moment / area) : mean;
    return area;
}

int CellTable::insert(const CellIndex& cell) {
    size_t k = slot_of(cell);
    if (slots[k] >= 0) return slots[k];
    if (2 * (numbered.size() + 1) > slots.size()) {
        slots.assign(2 * slots.size(), -1);
        for (size_t i = 0; i < numbered.size(); ++i) slots[slot_of(numbered[i])] = int(i);
        k = slot_of(cell);
    }
    slots[k] = int(numbered.size());
    numbered.push_back(cell);
    return slots[k];
}

int Voxels::find_entry(int cell, int wanted) const {
    FROND_ASSERT(cell >= 0 && size_t(cell) + 1 < first.size());
    const auto begin = item.begin() + first[size_t(cell)], end = item.begin() + first[size_t(cell) + 1];
    const auto found = std::lower_bound(begin, end, wanted);
    return found != end && *found == wanted ? int(found - item.begin()) : -1;
}

Voxels make_voxels(const Topology& topology, const Lattice& lattice, double offset) {
    double size = 0;
    for (const Vec3& place : topology.points) size = std::max(size, 2 * (place - topology.points[0]).norm());
    Voxels voxels{lattice, offset + std::max(CELL_MARGIN * lattice.cell_size, SIZE_MARGIN * size), {}, {}, {}, {}};

    // Entries in the order of the items.
    std::vector<int> cell_of_entry, item_of_entry;
    std::vector<Vec3> centres;
    CellIndex last_cell{0, 0, 0};
    int last = -1;
    const size_t most = MAX_ENTRIES + MAX_ENTRIES_PER_TRIANGLE * topology.triangles.size();
    const auto enter = [&](int item, const Polygon& polygon) {
        visit_cells(lattice, voxels.margin, polygon, [&](const CellIndex& cell, const Polygon& part) {
            if (last < 0 || cell != last_cell) {
                last = voxels.cells.insert(cell);
                last_cell = cell;
            }
            if (cell_of_entry.size() >= most || voxels.cells.cells().size() > MAX_CELLS)
                fail(FROND_RESULT_BAD_ARGUMENT,
                     "cells of %g m are too small for this plant, or cage_offset or its %zu triangles are too large; "
                     "make "
                     "cage_size larger, or 0 to choose, or the triangles fewer",
                     lattice.cell_size, topology.triangles.size());
            cell_of_entry.push_back(last);
            item_of_entry.push_back(item);
            Vec3 centre = Vec3::Zero();
            for (int k = 0; k < part.count; ++k) centre += part.corners[size_t(k)];
            centres.push_back(centre / part.count);
        });
    };
    const int triangle_count = int(topology.triangles.size());
    for (int t = 0; t < triangle_count; ++t) {
        const Triangle& corner = topology.triangles[size_t(t)];
        enter(t, polygon_of(topology.points[size_t(corner[0])], topology.points[size_t(corner[1])],
                            topology.points[size_t(corner[2])]));
    }
    for (size_t j = 0; j < topology.joints.size(); ++j) {
        const Joint& joint = topology.joints[j];
        enter(triangle_count + int(j), polygon_of(joint.point_a, joint.point_b, joint.point_b));
    }

    // Sorts the entries by cell and keeps the order of items.
    voxels.first.assign(voxels.cells.cells().size() + 1, 0);
    for (int cell : cell_of_entry) ++voxels.first[size_t(cell) + 1];
    for (size_t c = 1; c < voxels.first.size(); ++c) voxels.first[c] += voxels.first[c - 1];
    std::vector<int> next(voxels.first.begin(), voxels.first.end() - 1);
    voxels.item.resize(cell_of_entry.size());
    voxels.centre.resize(cell_of_entry.size());
    for (size_t e = 0; e < cell_of_entry.size(); ++e) {
        const size_t place = size_t(next[size_t(cell_of_entry[e])]++);
        voxels.item[place] = item_of_entry[e];
        voxels.centre[place] = centres[e];
    }
    FROND_ASSERT(size_t(voxels.first.back()) == voxels.item.size());
    return voxels;
}

}  // namespace frond
