// Sums over a model.
#include "model/model.hpp"

#include "cage/tet_geometry.hpp"

namespace frond {

double Model::mass() const {
    double sum = 0;
    for (size_t e = 0; e < cage.tets.size(); e++) sum += tet_density[e] * tet_volume(cage.nodes, cage.tets[e]);
    return sum;
}

const std::vector<double>& Model::young_of(int order) const {
    return order == 2 && !rest_shapes->quadratic_young.empty() ? rest_shapes->quadratic_young : tet_young;
}

const std::vector<double>& Model::grain_of(int order) const {
    return order == 2 && !rest_shapes->quadratic_young.empty() ? rest_shapes->quadratic_grain : tet_grain;
}

}  // namespace frond
