// Fits a whole plant's moduli until it sways as its rods do, under its weight.
#pragma once

#include "build/sway.hpp"

namespace frond {

// How rods or a chain of springs sway.
struct RodSways {
    std::array<double, 2> square = {};  // of the angular frequencies, the slower one first [1/s^2]; 0: none
    std::array<VecX, 2> energies;       // twice the elastic energy of each organ at a kinetic energy of a half [1/s^2]
    std::vector<char> carries;          // one an organ: whether others grow out of it and its bending is much of a sway
};
struct RodElements;
RodSways find_sways(const Model& model, const RodElements& elements, frond_mechanics which);

// The gap between the sways of a cage and of its rods.
struct SwayGap {
    double error = 0;  // the larger one of the logarithms of the frequencies' squares, rods over cage [-]
    VecX change;  // the least one of the logarithms of the tets' moduli, in organs that carry the plant, that mends it
};
// The cage is at x, its exact stiffness factorized; changes are within bounds, `done` are those made before.
SwayGap find_gap(const Model& model, const TetElements& elements, frond_mechanics which, const VecX& x,
                 BlockFactor& stiffness, const std::vector<uint8_t>& still, const RodSways& rods, const VecX& done);

}  // namespace frond
