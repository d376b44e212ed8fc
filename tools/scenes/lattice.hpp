// Lattice: an upright square beam of five-tet bricks, for programs that bring their own tets.
#pragma once

#include <cstdint>
#include <vector>

namespace frond::tools {

struct Lattice {
    std::vector<double> nodes;  // three numbers per node [m]
    std::vector<int32_t> tets;  // four nodes per tet
};

// Makes a beam along the y axis, with a layer of nodes at each of the heights, `across` bricks wide.
Lattice make_lattice(double width, int across, const std::vector<double>& heights);
// Returns count + 1 heights from 0 to length [m].
std::vector<double> even_heights(double length, int count);

}  // namespace frond::tools
