// In: where a plant is and where it is guessed to be soon. Out: whether all tets are strained and turned little on the
// way, so that forces and stiffness there are worth taking.
#include "mechanics/tet_element.hpp"
#include "solve/integrator.hpp"

namespace frond {

bool is_calm(const System& system, const VecX& from, const VecX& to) {
    constexpr double MOST = 0.5;  // change of the deformation gradient [-]; as a turn, about 20 degrees
    for (size_t e = 0; e < system.elements.tets.size(); ++e) {
        const Mat3 change =
            deformation_gradient(system.elements, e, to) - deformation_gradient(system.elements, e, from);
        if (!(change.squaredNorm() < MOST * MOST)) return false;
    }
    return true;
}

}  // namespace frond
