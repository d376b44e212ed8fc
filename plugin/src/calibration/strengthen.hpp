// Makes organs stiffer until rods stand under their weight.
#pragma once

#include <functional>

#include "mechanics/rod_elements.hpp"

namespace frond {

// Raises `stiffer` until the rods, or the chain of springs, bear their weight with organs that are weaker by their
// safety factors, one per organ; `make` makes them with organs as stiff as `stiffer` says.
void strengthen_rods(const Model& model, frond_mechanics which, const std::function<RodElements()>& make,
                     const std::vector<double>& safety, std::vector<double>& stiffer);

}  // namespace frond
