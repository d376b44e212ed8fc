// Toppling: how a body gives way first under its weight. Linear buckling: with P the stiffness that resists and G the
// stiffness that weight takes from it, this is the mode of the largest eigenvalue of P^-1 G; a body is stable while
// that is below one (Greenhill 1881 for a single stem).
#pragma once

#include <functional>

#include "calibration/static_stiffness.hpp"

namespace frond {

struct Toppling {
    VecX mode;            // empty: none was found
    double overload = 0;  // how many times too heavy the body is [-]
};

// Finds the stiffness that weight takes from a body at x: the positive one less the exact one.
void take_by_weight(const Elements& elements, const Mechanics& row, const VecX& x, BlockMatrix& taken);

// Sets the three numbers of each held node to zero.
void hold(const std::vector<uint8_t>& held, VecX& x);
// Finds the mode in which the body topples; `resisting` has its factor.
Toppling find_toppling(StaticStiffness& resisting, const BlockMatrix& taken, const std::vector<uint8_t>& held);

// Returns organs' shares in the elastic energy of the motion: to first order, by how much, relatively, the load that
// the body bears grows with an organ's modulus [-]. `add_work` adds move' K move with each organ's own stiffness K.
std::vector<double> find_shares(const Toppling& toppling, StaticStiffness& resisting, const BlockMatrix& taken,
                                const std::vector<uint8_t>& held, size_t organ_count,
                                const std::function<void(const VecX& move, std::vector<double>& work)>& add_work);
// Returns how many times stiffer each organ should be so that the body bears its load: organs with a large share alike,
// the others not at all. At most 8 at once, since shares change.
std::vector<double> stiffer_by(const std::vector<double>& shares, double overload);

}  // namespace frond
