// The models of the cases.
#include "stability/bench.hpp"

namespace frond::stability {

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
