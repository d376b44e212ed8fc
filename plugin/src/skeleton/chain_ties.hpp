// Chain ties: where stems lean on supports, or are tied to them by rings and clips with meshes of their own.
#pragma once

#include "skeleton/organ.hpp"
#include "skeleton/topology.hpp"

namespace frond {

// Finds where stems, branches and supports touch a support with which they share no corner: a pair of triangles in the
// middle of each patch of the first, at most a thousandth of the plant's size apart.
std::vector<Joint> find_ties(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs);

}  // namespace frond
