// In: tets by their corners. Out: their nodes for elements of an order.
#include "mechanics/tet_nodes.hpp"
#include "core/lists.hpp"

#include <algorithm>

namespace frond {

TetNodes make_tet_nodes(int corner_count, const std::vector<Tet>& tets, int order) {
    TetNodes nodes;
    nodes.order = order;
    nodes.corner_count = corner_count;
    if (order == 1) return nodes;

    std::vector<Tet> ordered = tets;
    for (Tet& tet : ordered) {
        std::sort(tet.begin(), tet.end());
        for (const auto& [a, b] : TET_EDGES) nodes.edges.push_back({tet[size_t(a)], tet[size_t(b)]});
    }
    sort_unique(nodes.edges);

    for (const Tet& tet : ordered) {
        QuadraticTet ten;
        std::copy(tet.begin(), tet.end(), ten.begin());
        for (size_t k = 0; k < TET_EDGES.size(); ++k) {
            const Edge edge = {tet[size_t(TET_EDGES[k][0])], tet[size_t(TET_EDGES[k][1])]};
            const auto found = std::lower_bound(nodes.edges.begin(), nodes.edges.end(), edge);
            ten[4 + k] = corner_count + int(found - nodes.edges.begin());
        }
        nodes.of_tet.push_back(ten);
    }
    return nodes;
}

std::vector<uint8_t> with_middles(const TetNodes& nodes, std::vector<uint8_t> held) {
    for (const Edge& edge : nodes.edges) held.push_back(held[size_t(edge[0])] && held[size_t(edge[1])]);
    return held;
}

TetPlace place_in_tet(const TetNodes& nodes, const std::vector<Tet>& tets, int tet, const std::array<double, 4>& L) {
    const Tet& corners = tets[size_t(tet)];
    TetPlace place;
    place.count = nodes.order == 1 ? 4 : 10;
    if (nodes.order == 1) {
        std::copy(corners.begin(), corners.end(), place.node.begin());
        std::copy(L.begin(), L.end(), place.weight.begin());
        return place;
    }
    place.node = nodes.of_tet[size_t(tet)];
    std::array<double, 4> ordered;
    for (size_t a = 0; a < 4; ++a)
        ordered[a] = L[size_t(std::find(corners.begin(), corners.end(), place.node[a]) - corners.begin())];
    for (size_t a = 0; a < 4; ++a) place.weight[a] = ordered[a] * (2 * ordered[a] - 1);
    for (size_t k = 0; k < TET_EDGES.size(); ++k)
        place.weight[4 + k] = 4 * ordered[size_t(TET_EDGES[k][0])] * ordered[size_t(TET_EDGES[k][1])];
    return place;
}

}  // namespace frond
