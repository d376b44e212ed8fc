// In: a beam's width and the heights of its layers. Out: its tets.
#include "scenes/lattice.hpp"

namespace frond::tools {

std::vector<double> even_heights(double length, int count) {
    std::vector<double> heights;
    for (int i = 0; i <= count; i++) heights.push_back(length * i / count);
    return heights;
}

// Every other brick is mirrored so that faces of neighbours match.
Lattice make_lattice(double width, int across, const std::vector<double>& heights) {
    const auto node = [&](int i, int j, int k) { return (j * (across + 1) + k) * (across + 1) + i; };
    const int along = int(heights.size()) - 1;
    Lattice lattice;
    for (double height : heights)
        for (int k = 0; k <= across; k++)
            for (int i = 0; i <= across; i++)
                for (double value : {width * (double(i) / across - 0.5), height, width * (double(k) / across - 0.5)})
                    lattice.nodes.push_back(value);
    static constexpr int EVEN[5][4] = {{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 1, 2, 7}, {5, 1, 4, 7}, {6, 2, 4, 7}};
    static constexpr int ODD[5][4] = {{0, 3, 5, 6}, {1, 0, 3, 5}, {2, 0, 3, 6}, {4, 0, 5, 6}, {7, 3, 5, 6}};
    for (int j = 0; j < along; j++)
        for (int k = 0; k < across; k++)
            for (int i = 0; i < across; i++)
                for (const auto& tet : (i + j + k) % 2 ? ODD : EVEN)
                    for (int c : tet) lattice.tets.push_back(node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)));
    return lattice;
}

}  // namespace frond::tools
