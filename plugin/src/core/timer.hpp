// Wall-clock time of stages.
#pragma once

#include <chrono>

namespace frond {

struct Timer {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    double ms() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    // Returns the time since the last lap or the start [ms] and starts the next lap.
    double lap() {
        const double passed = ms();
        start = std::chrono::steady_clock::now();
        return passed;
    }
};

}  // namespace frond
