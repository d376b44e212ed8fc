// Cell size. In: a surface. Out: the size that needs about as many copies of cells as a usual cage has. Counting is
// cheap, so the size is found by bisection.
#include <algorithm>
#include <cmath>

#include "cage/cage_parts.hpp"

namespace frond {

// Wanted and largest number of copies; each has twelve tets.
static constexpr size_t WANTED_COPIES = 140, MOST_COPIES = 320;
// Largest and smallest cell, as shares of the plant's diagonal.
static constexpr double LARGEST_CELL = 1.0 / 6, SMALLEST_CELL = 1.0 / 120;

// Counts the pairs of a cell and a component in it, without small components; stops beyond `limit`.
static size_t count_copies(const Topology& topology, double offset, double cell_size, size_t limit) {
    const std::vector<int> host = find_hosts(topology, cell_size);
    const Lattice lattice = make_lattice(topology, cell_size);
    CellTable cells;
    std::vector<std::vector<int>> hosts_in;
    size_t count = 0;
    CellIndex last_cell{0, 0, 0};
    int last_host = -1;
    for (size_t t = 0; t < topology.triangles.size() && count <= limit; ++t) {
        const Triangle& corner = topology.triangles[t];
        const int here = host[size_t(topology.triangle_component[t])];
        const Polygon polygon = polygon_of(topology.points[size_t(corner[0])], topology.points[size_t(corner[1])],
                                           topology.points[size_t(corner[2])]);
        visit_cells(lattice, offset, polygon, [&](const CellIndex& cell, const Polygon&) {
            if (here == last_host && cell == last_cell) return;
            last_cell = cell;
            last_host = here;
            const size_t number = size_t(cells.insert(cell));
            if (number >= hosts_in.size()) hosts_in.resize(number + 1);
            std::vector<int>& hosts = hosts_in[number];
            if (std::find(hosts.begin(), hosts.end(), here) != hosts.end()) return;
            hosts.push_back(here);
            ++count;
        });
    }
    return count;
}

double choose_cell_size(const Topology& topology, double offset) {
    Eigen::AlignedBox3d box;
    for (const Vec3& place : topology.points) box.extend(place);
    const double size = box.diagonal().norm();
    double low = SMALLEST_CELL * size, high = LARGEST_CELL * size;
    // The offset makes the cage at least that thick.
    low = std::max(low, offset);
    high = std::max(high, low);
    size_t at_low = MOST_COPIES + 1, at_high = 0;
    for (int round = 0; round < 5 && high > low; ++round) {
        const double middle = std::sqrt(low * high);
        const size_t count = count_copies(topology, offset, middle, MOST_COPIES);
        (count > WANTED_COPIES ? low : high) = middle;
        (count > WANTED_COPIES ? at_low : at_high) = count;
    }
    // The number jumps where small components lose their own copies; then the nearer side is better.
    const bool low_is_nearer = at_high > 0 && at_low * at_high < WANTED_COPIES * WANTED_COPIES;
    return at_low <= MOST_COPIES && (low_is_nearer || at_high == 0) ? low : high;
}

}  // namespace frond
