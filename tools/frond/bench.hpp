// What frond bench is asked for.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace frond::tools {

struct BenchOptions {
    std::string what = "drag";
    int rounds = 20;
    int most = 17;  // plants
    bool csv = false;
    std::vector<std::string> assignments;
};

void bench_field(const BenchOptions& options);

}  // namespace frond::tools
