// What the build is given where no C API checks it first: metres, y up, cages as they are by default.
#pragma once

#include "build/build.hpp"

namespace frond::test {

inline frond_model_def model_def() {
    frond_model_def def = {};
    def.cage_smoothness = CageOptions().smoothness;
    def.scale = 1;
    def.up = {0, 1, 0};
    return def;
}

}  // namespace frond::test
