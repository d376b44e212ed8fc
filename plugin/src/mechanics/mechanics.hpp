// Mechanics: energy, force and exact stiffness of a body of elements; rows of a table indexed by frond_mechanics.
#pragma once

#include <memory>

#include "core/types.hpp"
#include "frond/frond.h"
#include "mechanics/block_matrix.hpp"
#include "model/model.hpp"

namespace frond {

// What tets need at rest; read-only, shared by all plants of a model.
struct TetElements {
    int node_count = 0;
    std::vector<Tet> tets;           // as in the cage
    std::vector<Tet> ordered;        // the same tets, nodes ascending: their blocks then fall in the lower triangle
    std::vector<Mat3> rest_inverse;  // inverse of the edges from ordered[0] to ordered[1..3], as columns [1/m]
    std::vector<double> volume;      // [m^3]
    std::vector<double> lambda, mu;  // Lame's constants [Pa]
    std::vector<double> density;     // [kg/m^3]
    VecX rest_positions;             // node_count*3 [m]
    std::vector<std::array<int, 16>> slots;  // of ordered nodes a, b at [4*a+b], in a BlockMatrix of this pattern
    BlockPattern pattern;
};

// For rest positions other than the model's own (the rest shape found under gravity), pass them.
TetElements make_tet_elements(const Model& model, const VecX* rest_positions = nullptr);

// Which derivative of the force: the exact one, or one that is always positive semi-definite.
enum class Tangent { exact, positive };

// x is in the frame of the rest positions: a plant that is placed turned in a world is not bent by that.
struct Mechanics {
    const char* name;
    // Elastic energy at x [J].
    double (*energy)(const TetElements& elements, const VecX& x);
    // Adds the elastic force at x, minus the gradient of the energy, to f [N]; the number of inverted tets is returned.
    int (*add_force)(const TetElements& elements, const VecX& x, VecX& f);
    // Adds scale times the stiffness at x, the second derivative of the energy, to K [N/m].
    void (*add_stiffness)(const TetElements& elements, const VecX& x, Tangent tangent, double scale, BlockMatrix& K);
    // Both of the above in one pass over the elements, the stiffness with scale one.
    int (*add_force_and_stiffness)(const TetElements& elements, const VecX& x, Tangent tangent, VecX& f,
                                   BlockMatrix& K);
    // One solve alone may blow up where tets are inside out: go on from there with a line search.
    bool needs_search;
};
const Mechanics& mechanics(frond_mechanics which);

}  // namespace frond
