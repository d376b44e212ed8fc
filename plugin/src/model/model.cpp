// Sums over a model.
#include "model/model.hpp"

#include "cage/tet_geometry.hpp"

namespace frond {

double Model::mass() const {
    double sum = 0;
    for (size_t e = 0; e < cage.tets.size(); e++) sum += tet_density[e] * tet_volume(cage.nodes, cage.tets[e]);
    return sum;
}

// Tets are of one organ each, so that what a small one weighs is counted with what it grows on: what is drawn of each
// tells its share, unless the densities of tets were made to.
std::vector<double> Model::organ_masses() const {
    std::vector<double> masses(organs.size(), 0.0);
    double drawn = 0;
    if (!exact_sections)
        for (size_t o = 0; o < cage.organ_tissue.size(); o++)
            drawn += masses[o] = organs[o].material.density * (1 - hole_share(organs[o])) * cage.organ_tissue[o];
    if (drawn > 0) {
        const double by = mass() / drawn;
        for (double& own : masses) own *= by;
        return masses;
    }
    for (size_t e = 0; e < cage.tets.size(); e++)
        masses[size_t(cage.tet_organ[e])] += tet_density[e] * tet_volume(cage.nodes, cage.tets[e]);
    return masses;
}

const std::vector<double>& Model::young_of(int order) const {
    return order == 2 && !rest_shapes->quadratic_young.empty() ? rest_shapes->quadratic_young : tet_young;
}

}  // namespace frond
