#include <algorithm>
#include <cmath>

#include "study/study.hpp"

namespace frond::study {

void mark_front(std::vector<Point>& points) {
    std::vector<Point*> order;
    for (Point& point : points) {
        point.on_front = false;
        const Outcome& o = point.outcome;
        if (point.failure.empty() && std::isfinite(o.error) && std::isfinite(o.cpu_per_second)) order.push_back(&point);
    }
    // Take, from the cheapest on, each point that is better than all before it.
    std::stable_sort(order.begin(), order.end(), [](const Point* a, const Point* b) {
        const Outcome &x = a->outcome, &y = b->outcome;
        return x.cpu_per_second != y.cpu_per_second ? x.cpu_per_second < y.cpu_per_second : x.error < y.error;
    });
    double best = INFINITY;
    for (Point* point : order)
        if (point->outcome.error < best) {
            best = point->outcome.error;
            point->on_front = true;
        }
}

}  // namespace frond::study
