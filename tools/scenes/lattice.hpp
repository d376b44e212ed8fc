// Lattice: an upright square beam of five-tet bricks, for those who bring their own tets.
#pragma once

#include <cstdint>
#include <vector>

namespace frond::tools {

struct Lattice {
    std::vector<double> nodes;  // three a node [m]
    std::vector<int32_t> tets;  // four a tet
};

// Its axis is the y axis; a layer of nodes at each of the heights, `across` bricks wide.
Lattice make_lattice(double width, int across, const std::vector<double>& heights);
// count + 1 of them, from 0 to length [m].
std::vector<double> even_heights(double length, int count);

}  // namespace frond::tools
