// Beams: of structured tets, or of a stem whose cage and chain Frond makes.
#include <array>
#include <cmath>

#include "study/known.hpp"
#include "study/trial.hpp"

namespace frond::study {

Beam peers_beam() {
    return {0.1, 1e7, 800, 0.3, {{3, 26}, {7, 82}}};
}

double area_of(const Beam& beam, Body body) {
    return (body == Body::MESH ? 1 : M_PI / 4) * beam.width * beam.width;
}
double inertia_of(const Beam& beam, Body body) {
    return (body == Body::MESH ? 1.0 / 12 : M_PI / 64) * std::pow(beam.width, 4);
}
double torsion_constant_of(const Beam& beam, Body body) {
    return (body == Body::MESH ? torsion_of_square() : M_PI / 32) * std::pow(beam.width, 4);
}

frond_model_info Model::info() const {
    frond_model_info info;
    must(frond_model_get_info(handle, &info));
    return info;
}

struct Box {
    std::vector<double> nodes;
    std::vector<int32_t> tets;
};

// Cubes of five tets, in every other one mirrored so that neighbours fit; the axis of the beam is the y axis.
static Box make_box(const Beam& beam, int across) {
    const double width = beam.width, length = Beam::LENGTH;
    int along = int(std::lround(length / width * across));
    for (const Beam::Cells& cells : beam.cells)
        if (cells.across == across) along = cells.along;
    const auto node = [&](int i, int j, int k) { return (j * (across + 1) + k) * (across + 1) + i; };
    Box box;
    for (int j = 0; j <= along; j++)
        for (int k = 0; k <= across; k++)
            for (int i = 0; i <= across; i++)
                for (double value :
                     {width * (double(i) / across - 0.5), length * j / along, width * (double(k) / across - 0.5)})
                    box.nodes.push_back(value);
    static constexpr int EVEN[5][4] = {{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 1, 2, 7}, {5, 1, 4, 7}, {6, 2, 4, 7}};
    static constexpr int ODD[5][4] = {{0, 3, 5, 6}, {1, 0, 3, 5}, {2, 0, 3, 6}, {4, 0, 5, 6}, {7, 3, 5, 6}};
    for (int j = 0; j < along; j++)
        for (int k = 0; k < across; k++)
            for (int i = 0; i < across; i++)
                for (const auto& tet : (i + j + k) % 2 ? ODD : EVEN)
                    for (int c : tet) box.tets.push_back(node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)));
    return box;
}

ModelPtr make_beam(const Beam& beam, const Setup& setup) {
    // Solid, of the same stiffness in all directions, undamped; nothing of it is a sheet that the thickness is for.
    frond_organ_material organ = {"stem", {}};
    organ.material.density = beam.density;
    organ.material.young = beam.young;
    organ.material.poisson = beam.poisson;
    organ.material.thickness = beam.width / 100;
    organ.material.drag = Beam::DRAG;
    frond_model_def def = frond_default_model_def();
    def.scale = 1;
    def.up = {0, 1, 0};
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = &organ;
    def.organ_count = 1;
    frond_model model = {};
    if (setup.body == Body::MESH) {
        const Box box = make_box(beam, setup.resolution);
        must(frond_model_from_tets(box.nodes.data(), int(box.nodes.size() / 3), box.tets.data(),
                                   int(box.tets.size() / 4), &def, &model));
    } else {
        (moves_chain(setup.plant.mechanics) ? def.capsule_height : def.cage_size) = Beam::LENGTH / setup.resolution;
        const double r = beam.width / 2;
        const frond_stem stem = {-1, {0, 0, 0}, {0, Beam::LENGTH, 0}, r, r};
        must(frond_model_from_stems(&stem, 1, &def, &model));
    }
    return std::make_shared<const Model>(model);
}

double cap_mass(const Beam& beam, Body body, const Model& model) {
    const double own = beam.density * area_of(beam, body) * Beam::LENGTH;
    return std::max(0.0, (model.info().mass / own - 1) / 2);
}

}  // namespace frond::study
