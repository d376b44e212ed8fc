// Slabs of a plant for finding its organs: short pieces along the way from the ground, each a sheet or a tube.
#pragma once

#include <Eigen/Geometry>

#include "skeleton/chain_tree.hpp"

namespace frond {

struct Slab {
    int parent = -1;  // slab that it grows out of; -1 at a root
    bool is_sheet = false;
    double length = 0;           // along the way from the ground [m]
    Vec3 normal = Vec3::Zero();  // integral of the normal over the area [m^2]
    double flux = 0;             // integral of position times normal [m^3]
    Eigen::AlignedBox3d box;

    // Returns the radius of a tube with this area and length [m].
    double radius(double area) const { return length > 0 ? area / (6.283185307179586 * length) : 0; }
};

struct Slabs {
    Bands bands;
    ChainTree tree;
    std::vector<Slab> slabs;   // as bands.pieces
    std::vector<int> slab_of;  // the slab that holds a triangle's middle, by triangle
};

// Cuts a plant into slabs, the parts of the surface apart from each other. Components get ten bands at least.
Slabs cut_slabs(const Surface& surface, const Topology& topology);

}  // namespace frond
