// Beams: of structured tets, or of a stem with Frond's own cage and chain.
#include <array>
#include <cmath>

#include "scenes/lattice.hpp"
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

// Makes structured tets; bricks are cubes unless specified.
static tools::Lattice make_box(const Beam& beam, int across) {
    int along = int(std::lround(Beam::LENGTH / beam.width * across));
    for (const Beam::Cells& cells : beam.cells)
        if (cells.across == across) along = cells.along;
    return tools::make_lattice(beam.width, across, tools::even_heights(Beam::LENGTH, along));
}

ModelPtr make_beam(const Beam& beam, const Setup& setup) {
    // Solid, isotropic, undamped; no part of it is a sheet, to which the thickness would apply.
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
        const tools::Lattice box = make_box(beam, setup.resolution);
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
