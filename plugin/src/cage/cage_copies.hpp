// Copies: each cell of the lattice once for each connected part of the surface in it. Neighbouring copies share nodes
// if their parts are connected; otherwise their nodes merely have the same position.
#pragma once

#include "cage/cage_patches.hpp"

namespace frond {

// Corners of a cell by bits: 1 = +x, 2 = +y, 4 = +z; node 8 is its middle.
struct Copies {
    std::vector<int> entry_copy;  // copy of each entry of Voxels
    std::vector<CellIndex> cell;  // cell of each copy
    std::vector<int> patch;       // patch of most triangles of each copy
    std::vector<std::array<int, 9>> nodes;
    std::vector<Vec3> positions;              // positions of the nodes [m]
    std::vector<std::vector<int>> neighbors;  // copies with connected parts, at a face, edge or corner of the cell
};

// Returns for each component the one whose copies it uses: itself or, if it is small compared with a cell, the nearest
// one along the joints that is not.
std::vector<int> find_hosts(const Topology& topology, double cell_size);

// Connected parts of the surface in each cell, as sets of entries that find_pieces() numbers; none spans two cells.
struct Pieces {
    std::vector<int> entry_piece;
    int count = 0;
    std::vector<int> first, entries;        // the entries of part p are entries[first[p]] .. entries[first[p+1]-1]
    std::vector<std::array<int, 2>> links;  // parts in neighbouring cells that share an item, a < b
};
Pieces find_pieces(const Topology& topology, const Patches& patches, const Voxels& voxels);

// A cell inside a component: it cannot be reached from outside without crossing a cell that the component touches.
struct Inside {
    CellIndex cell;
    int component;
};
std::vector<Inside> find_inside(const Topology& topology, const Voxels& voxels);

Copies make_copies(const Topology& topology, const Patches& patches, const Voxels& voxels);

}  // namespace frond
