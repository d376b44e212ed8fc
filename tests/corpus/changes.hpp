// The same plants drawn otherwise.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "surface/surface.hpp"

namespace frond::test {

struct Variant {
    const char* name;
    std::function<void(Surface&, std::mt19937&)> change;
    double kinds, leaves;  // least shares that are right of kinds and of counts of leaves, over the corpus [-]
    double alike;          // least share of files with the mass and the tip of the file as it is [-]
};
const std::vector<Variant>& variants();

}  // namespace frond::test
