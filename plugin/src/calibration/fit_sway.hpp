// Fits a whole plant's moduli until its first modes under weight are those of its rods.
#pragma once

#include "calibration/sway.hpp"

namespace frond {

// The first modes of rods or of a chain of springs.
struct RodSways {
    std::array<double, 2> square = {};  // squares of the angular frequencies, the slower one first [1/s^2]; 0: none
    std::array<Vec3, 2> direction = {Vec3::Zero(), Vec3::Zero()};  // as Sway::direction
    std::array<VecX, 2> energies;  // twice the elastic energy of each organ at a kinetic energy of a half [1/s^2]
    std::vector<char> carries;     // one per organ: whether others grow out of it and its bending is much of a mode
};
struct RodElements;
RodSways find_sways(const Model& model, const RodElements& elements, frond_mechanics which);

// The gap between the first modes of a cage and of its rods, in either direction.
struct SwayGap {
    double error = 0;  // larger logarithm of the ratio of the frequencies' squares, rods over cage [-]
    VecX change;       // least change of the tets' log moduli, in organs that carry the plant, that removes it
};
// Finds the gap for a cage at x, its exact stiffness factorized; changes are within bounds, `done` are those made
// before.
SwayGap find_gap(const Model& model, const TetElements& elements, frond_mechanics which, const VecX& x,
                 BlockFactor& stiffness, const std::vector<uint8_t>& still, const RodSways& rods, const VecX& done);

}  // namespace frond
