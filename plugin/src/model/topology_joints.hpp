// Joints: what holds the components of a soup together.
#pragma once

#include "model/topology.hpp"

namespace frond {

// Fills the joints of a topology whose triangles and components stand.
void join_components(Topology& topology);

}  // namespace frond
