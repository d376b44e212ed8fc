// Bands, first half. In: a topology and root points. Out: distances along the surface, and the triangles that share
// edges.
#include <algorithm>
#include <cmath>
#include <queue>

#include "skeleton/bands.hpp"

namespace frond {

struct Ways {
    std::vector<int> first, to;
    std::vector<double> length;
};

// Lists the paths from each point: all edges, and over each joint from every corner of one triangle to every corner of
// the other.
static Ways find_ways(const Topology& topology) {
    const size_t count = topology.points.size();
    Ways ways;
    ways.first.assign(count + 1, 0);
    const auto each_way = [&](auto&& use) {
        for (const Triangle& t : topology.triangles)
            for (size_t k = 0; k < 3; k++) {
                const int u = t[k], v = t[(k + 1) % 3];
                if (u != v) use(u, v, -1.0);
            }
        for (const Joint& joint : topology.joints)
            for (int u : topology.triangles[size_t(joint.triangle_a)])
                for (int v : topology.triangles[size_t(joint.triangle_b)]) {
                    if (u == v) continue;
                    use(u, v,
                        (topology.points[size_t(u)] - joint.point_a).norm() + (joint.point_a - joint.point_b).norm() +
                            (joint.point_b - topology.points[size_t(v)]).norm());
                }
    };
    each_way([&](int u, int v, double) {
        ways.first[size_t(u) + 1]++;
        ways.first[size_t(v) + 1]++;
    });
    for (size_t i = 0; i < count; i++) ways.first[i + 1] += ways.first[i];
    ways.to.resize(size_t(ways.first[count]));
    ways.length.resize(ways.to.size());
    std::vector<int> next(ways.first.begin(), ways.first.end() - 1);
    each_way([&](int u, int v, double length) {
        if (length < 0) length = (topology.points[size_t(u)] - topology.points[size_t(v)]).norm();
        for (int turn = 0; turn < 2; turn++) {
            const size_t at = size_t(next[size_t(u)]++);
            ways.to[at] = v;
            ways.length[at] = length;
            std::swap(u, v);
        }
    });
    return ways;
}

std::vector<double> measure_distances(const Topology& topology, std::vector<int>& roots,
                                      const std::vector<double>& start) {
    const Ways ways = find_ways(topology);
    std::vector<double> distance(topology.points.size(), INFINITY);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> front;
    const auto spread = [&] {
        while (!front.empty()) {
            const auto [reached, u] = front.top();
            front.pop();
            if (reached > distance[size_t(u)]) continue;
            for (int i = ways.first[size_t(u)]; i < ways.first[size_t(u) + 1]; i++) {
                const double there = reached + ways.length[size_t(i)];
                const int v = ways.to[size_t(i)];
                if (there >= distance[size_t(v)]) continue;
                distance[size_t(v)] = there;
                front.push({there, v});
            }
        }
    };
    const auto begin_at = [&](int root, double behind) {
        distance[size_t(root)] = behind;
        front.push({behind, root});
    };
    for (size_t i = 0; i < roots.size(); i++) begin_at(roots[i], start.empty() ? 0 : start[i]);
    spread();

    // A component that no path leads to begins at its own lowest point.
    std::vector<int> lost;
    for (size_t i = 0; i < distance.size(); i++)
        if (!std::isfinite(distance[i])) lost.push_back(int(i));
    std::sort(lost.begin(), lost.end(), [&](int a, int b) {
        const double ya = topology.points[size_t(a)].y(), yb = topology.points[size_t(b)].y();
        return ya != yb ? ya < yb : a < b;
    });
    for (int i : lost) {
        if (std::isfinite(distance[size_t(i)])) continue;
        roots.push_back(i);
        begin_at(i, 0);
        spread();
    }
    return distance;
}

std::vector<SharedEdge> find_shared_edges(const Topology& topology) {
    // Half edges go into buckets by their smaller point; in a bucket, equal larger points mark the same edge.
    struct Half {
        int other, triangle;
    };
    const size_t count = topology.points.size();
    std::vector<int> first(count + 1, 0);
    const auto each_half = [&](auto&& use) {
        for (size_t t = 0; t < topology.triangles.size(); t++)
            for (size_t k = 0; k < 3; k++) {
                const int u = topology.triangles[t][k], v = topology.triangles[t][(k + 1) % 3];
                if (u != v) use(std::min(u, v), std::max(u, v), int(t));
            }
    };
    each_half([&](int u, int, int) { first[size_t(u) + 1]++; });
    for (size_t i = 0; i < count; i++) first[i + 1] += first[i];
    std::vector<Half> halves(static_cast<size_t>(first[count]));
    std::vector<int> next(first.begin(), first.end() - 1);
    each_half([&](int u, int v, int t) { halves[size_t(next[size_t(u)]++)] = {v, t}; });
    std::vector<SharedEdge> edges;
    edges.reserve(halves.size() / 2);
    for (size_t u = 0; u < count; u++) {
        const auto begin = halves.begin() + first[u], end = halves.begin() + first[u + 1];
        std::sort(begin, end, [](const Half& a, const Half& b) {
            return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
        });
        for (auto i = begin; i != end; ++i)
            if (i != begin && (i - 1)->other == i->other && (i - 1)->triangle != i->triangle)
                edges.push_back({(i - 1)->triangle, i->triangle, int(u), i->other});
    }
    return edges;
}

}  // namespace frond
