// Quantiles of measured values.
#pragma once

#include <algorithm>
#include <vector>

namespace frond::tools {

// Returns the value below which that share of the values lies; 0 if there are none.
inline double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}
inline double median(const std::vector<double>& values) {
    return quantile(values, 0.5);
}

}  // namespace frond::tools
