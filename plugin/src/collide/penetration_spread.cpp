// Spreads exits: points of which some have one come in, all that are connected with those have one afterwards (the
// propagation of Heidelberger et al. 2004).
#include "collide/penetration.hpp"

namespace frond {

void spread_ways_out(std::vector<WayOut>& ways, const std::vector<std::vector<int>>& neighbours) {
    // Round by round, so that the order of the points does not matter.
    std::vector<WayOut> found;
    std::vector<size_t> which;
    do {
        found.clear();
        which.clear();
        for (size_t i = 0; i < ways.size(); ++i) {
            if (ways[i].known) continue;
            WayOut way = ways[i];
            double sum = 0;
            for (const int j : neighbours[i]) {
                const WayOut& from = ways[size_t(j)];
                if (!from.known) continue;
                const Vec3 between = from.point - way.point;
                const double weight = 1 / std::max(between.squaredNorm(), 1e-300);
                sum += weight;
                way.normal += weight * from.normal;
                way.depth += weight * (between.dot(from.normal) + from.depth);
            }
            if (!(sum > 0) || !(way.normal.norm() > 1e-6 * sum)) continue;
            way.normal.normalize();
            way.depth /= sum;
            way.known = true;
            found.push_back(way);
            which.push_back(i);
        }
        for (size_t k = 0; k < found.size(); ++k) ways[which[k]] = found[k];
    } while (!found.empty());
}

}  // namespace frond
