// Fits a whole plant's moduli until its first modes under weight are those of its rods.
#pragma once

#include "calibration/sway.hpp"

namespace frond {

// The first modes of rods or of a chain of springs.
struct RodSways {
    std::array<double, 2> square = {};  // squares of the angular frequencies, the slower one first [1/s^2]; 0: none
    std::array<Vec3, 2> momentum = {Vec3::Zero(), Vec3::Zero()};  // of the plant at a velocity of one [sqrt kg]
    std::array<VecX, 2> energies;  // twice the elastic energy of each organ at a kinetic energy of a half [1/s^2]
    VecX share;                    // of each organ: the larger of its shares of the modes' elastic energies [-]
};
struct RodElements;
RodSways find_sways(const Model& model, const RodElements& elements, frond_mechanics which);

// The gap between the first modes of a cage and of its rods.
struct SwayGap {
    double error = 0;  // larger logarithm of the ratio of the frequencies' squares, rods over cage [-]
    VecX change;  // least change of the tets' log moduli, larger in organs that carry the rods' modes, that removes it
};
// Finds the gap for a cage at x, its exact stiffness factorized; changes are within bounds, `done` are those made
// before.
SwayGap find_gap(const Model& model, const TetElements& elements, frond_mechanics which, const VecX& x,
                 BlockFactor& stiffness, const std::vector<uint8_t>& still, const RodSways& rods, const VecX& done);

}  // namespace frond
