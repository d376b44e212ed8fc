// Copies: each cell of the lattice once for each piece of plant in it. Copies of neighbouring cells that carry the same
// piece share their nodes; those that carry different ones only look as if they did.
#pragma once

#include "model/cage_patches.hpp"

namespace frond {

// Corners of a cell by bits: 1 = +x, 2 = +y, 4 = +z; node 8 is its middle.
struct Copies {
    std::vector<int> entry_copy;  // of each entry of the cover
    std::vector<CellIndex> cell;  // of each copy
    std::vector<int> patch;       // that most of it belongs to
    std::vector<std::array<int, 9>> nodes;
    std::vector<Vec3> positions;              // of the nodes [m]
    std::vector<std::vector<int>> neighbors;  // copies that carry the same piece, at a face, edge or corner of the cell
};

// For each component the one with which it shares cells: itself, or, if it is small against a cell, the nearest along
// the joints that is not.
std::vector<int> find_hosts(const Topology& topology, double cell_size);

// Pieces of the entries: find_pieces() numbers them; entries in different cells have different pieces.
struct Pieces {
    std::vector<int> entry_piece;
    int count = 0;
    std::vector<int> first, entries;        // the entries of piece p are entries[first[p]] .. entries[first[p+1]-1]
    std::vector<std::array<int, 2>> links;  // pieces in neighbouring cells that share an item, a < b
};
Pieces find_pieces(const Topology& topology, const Patches& patches, const Cover& cover);

// Cells within bodies, a component each: what cannot be reached from outside without crossing a cell that it touches.
struct Inside {
    CellIndex cell;
    int component;
};
std::vector<Inside> find_inside(const Topology& topology, const Cover& cover);

Copies make_copies(const Topology& topology, const Patches& patches, const Cover& cover);

}  // namespace frond
