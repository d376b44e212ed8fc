// Models of the cases.
#include "stability/bench.hpp"

namespace frond::stability {

std::vector<double> even_heights(double length, int count) {
    std::vector<double> heights;
    for (int i = 0; i <= count; i++) heights.push_back(length * i / count);
    return heights;
}

// Every other brick is mirrored so that neighbours fit.
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

frond_material plain_material() {
    frond_material material = {};
    material.density = 800;
    material.young = 1e7;
    material.poisson = 0.3;
    material.thickness = 0.001;
    material.damping_ratio = 0.05;
    material.friction = 0.5;
    return material;
}

frond_model model_of(const Lattice& lattice, const frond_material& material) {
    const frond_organ_material organ = {"stem", material};
    frond_model_def def = frond_default_model_def();
    def.scale = 1;
    def.up = {0, 1, 0};
    def.organs = &organ;
    def.organ_count = 1;
    frond_model model = {};
    must(frond_model_from_tets(lattice.nodes.data(), int(lattice.nodes.size() / 3), lattice.tets.data(),
                               int(lattice.tets.size() / 4), &def, &model));
    return model;
}

frond_model beam() {
    static const frond_model model = model_of(make_lattice(0.1, 2, even_heights(1, 10)), plain_material());
    return model;
}

frond_model herb() {
    static const frond_model made = [] {
        const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.3, 0}, 0.012, 0.01},
                                    {0, {0, 0.3, 0}, {0, 0.6, 0.02}, 0.01, 0.007},
                                    {0, {0, 0.3, 0}, {0.2, 0.45, 0}, 0.006, 0.004},
                                    {1, {0, 0.6, 0.02}, {-0.1, 0.65, 0.1}, 0.005, 0.003}};
        frond_model_def def = frond_default_model_def();
        def.cage_size = 0.06;
        frond_model model = {};
        must(frond_model_from_stems(stems, 4, &def, &model));
        return model;
    }();
    return made;
}

}  // namespace frond::stability
