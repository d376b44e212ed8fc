// Inside: for each component large enough to have an interior, the cells that a flood fill from outside its box does
// not reach. The flood does not enter through holes narrower than a cell.
#include <algorithm>

#include "cage/cage_copies.hpp"

namespace frond {

// Components with more cells in their box are left hollow; no plant has a fruit that large.
static constexpr int64_t MAX_BOX = 4000000;

static void flood(const CellIndex& low, const CellIndex& count, std::vector<char>& state, int component,
                  std::vector<Inside>& inside) {
    // The box has one layer of outside cells around it. States: 1 touched, 2 reached.
    const auto at = [&count](int x, int y, int z) { return (z * count[1] + y) * count[0] + x; };
    std::vector<CellIndex> front = {{0, 0, 0}};
    state[0] = 2;
    while (!front.empty()) {
        const CellIndex here = front.back();
        front.pop_back();
        for (int side = 0; side < 6; ++side) {
            CellIndex next = here;
            next[size_t(side / 2)] += side % 2 ? 1 : -1;
            const int along = next[size_t(side / 2)];
            if (along < 0 || along >= count[size_t(side / 2)]) continue;
            char& there = state[size_t(at(next[0], next[1], next[2]))];
            if (there) continue;
            there = 2;
            front.push_back(next);
        }
    }
    for (int z = 0; z < count[2]; ++z)
        for (int y = 0; y < count[1]; ++y)
            for (int x = 0; x < count[0]; ++x)
                if (!state[size_t(at(x, y, z))]) inside.push_back({{low[0] + x, low[1] + y, low[2] + z}, component});
}

std::vector<Inside> find_inside(const Topology& topology, const Voxels& voxels) {
    // Lists the touched cells of each component.
    const int triangle_count = int(topology.triangles.size());
    std::vector<std::vector<int>> touched(size_t(topology.component_count));
    for (int cell = 0; cell + 1 < int(voxels.first.size()); ++cell)
        for (int e = voxels.first[size_t(cell)]; e < voxels.first[size_t(cell) + 1]; ++e) {
            if (voxels.item[size_t(e)] >= triangle_count) continue;
            auto& cells = touched[size_t(topology.triangle_component[size_t(voxels.item[size_t(e)])])];
            if (cells.empty() || cells.back() != cell) cells.push_back(cell);
        }
    std::vector<Inside> inside;
    std::vector<char> state;
    for (int component = 0; component < topology.component_count; ++component) {
        const auto& cells = touched[size_t(component)];
        if (cells.size() < 6) continue;  // it takes six to enclose a cell
        CellIndex low = voxels.cells.cells()[size_t(cells[0])], high = low;
        for (int cell : cells)
            for (size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], voxels.cells.cells()[size_t(cell)][axis]);
                high[axis] = std::max(high[axis], voxels.cells.cells()[size_t(cell)][axis]);
            }
        CellIndex count;
        int64_t total = 1;
        bool thick = true;
        for (size_t axis = 0; axis < 3; ++axis) {
            thick = thick && high[axis] - low[axis] >= 2;
            low[axis] -= 1;
            count[axis] = high[axis] - low[axis] + 2;
            total *= count[axis];
        }
        if (!thick || total > MAX_BOX) continue;
        state.assign(size_t(total), 0);
        for (int cell : cells) {
            const CellIndex& at = voxels.cells.cells()[size_t(cell)];
            state[size_t((int64_t(at[2] - low[2]) * count[1] + (at[1] - low[1])) * count[0] + (at[0] - low[0]))] = 1;
        }
        flood(low, count, state, component, inside);
    }
    return inside;
}

}  // namespace frond
