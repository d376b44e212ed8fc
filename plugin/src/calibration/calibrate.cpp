// Calibration: organ materials -> constants of the cage's tets. A cage is fatter than the organ in it, and four-node
// tets are too stiff in bending, by a factor of ten to a thousand; so the moduli of each organ's tets are scaled until
// the organ in the cage, held where it grows out of another one, bends as the rod with its true section would.

#include "calibration/beams.hpp"
#include "calibration/calibrate_together.hpp"
#include "calibration/calibration.hpp"
#include "calibration/fit_moduli.hpp"
#include "calibration/weigh.hpp"
#include "core/elementary.hpp"

namespace frond {

void take_materials(Model& model) {
    const size_t tet_count = model.cage.tets.size();
    model.tet_young.resize(tet_count);
    model.tet_poisson.resize(tet_count);
    model.tet_grain.assign(tet_count, 0);
    model.tet_axis.assign(tet_count, Vec3::UnitX());
    for (size_t e = 0; e < tet_count; e++) {
        const size_t organ = size_t(model.cage.tet_organ[e]);
        const Material& material = model.organs[organ].material;
        const double hole = hole_share(model.organs[organ]);
        model.tet_young[e] = material.young * model.organ_stiffer[organ] * model.cage.tet_fill[e] * (1 - hole * hole) *
                             seen_share(model.organs[organ]);
        model.tet_poisson[e] = material.poisson;
    }
}

// Takes the fitted moduli; loose tets get the organ's mean factor.
static void take_moduli(Model& model, const LoneOrgan& lone) {
    double sum = 0;
    for (size_t e = 0; e < lone.tets.size(); e++)
        sum += frond::log(lone.model.tet_young[e] / model.tet_young[lone.tets[e]]);
    const double mean = frond::exp(sum / double(lone.tets.size()));
    for (size_t e = 0; e < model.tet_young.size(); e++)
        if (model.cage.tet_organ[e] == lone.organ) model.tet_young[e] *= mean;
    for (size_t e = 0; e < lone.tets.size(); e++) {
        model.tet_young[lone.tets[e]] = lone.model.tet_young[e];
        model.tet_grain[lone.tets[e]] = lone.model.tet_grain[e];
    }
}

void calibrate(Model& model, int order) {
    take_materials(model);  // the rule of mixtures, to begin with
    Model beams = join_beams(model);
    const std::vector<int> hangs = hang_tets(beams);
    for (size_t e = 0; e < hangs.size(); e++) beams.tet_axis[e] = beams.sections[size_t(hangs[e])].axis.normalized();
    std::vector<char> alone;
    for (LoneOrgan& lone : take_organs(beams)) {
        alone.push_back(lone.is_sound() && fit_moduli(lone, beams, hangs, order));
        if (alone.back()) take_moduli(beams, lone);
    }
    calibrate_together(beams, alone, order);
    model.tet_young = std::move(beams.tet_young);
    model.tet_grain = std::move(beams.tet_grain);
    model.tet_axis = std::move(beams.tet_axis);
    model.calibrated = true;
}

}  // namespace frond
