// Springs between points of a plant and fixed targets, and fibres between two of its points: energy, force, stiffness.
#pragma once

#include <functional>

#include "solve/system.hpp"

namespace frond {

bool springs_are_sound(const System& system, const std::vector<Spring>& springs);
double spring_energy(const std::vector<Spring>& springs, const VecX& x);
void add_spring_force(const std::vector<Spring>& springs, const VecX& x, VecX& f);
void add_spring_stiffness(const std::vector<Spring>& springs, const VecX& x, Tangent tangent, double scale,
                          BlockMatrix& A);

// Returns the distance of a fibre's ends over its length [-].
double drawn(const Fibre& fibre, const VecX& x);
double fibre_energy(const Fibre& fibre, const VecX& x);
void add_fibre_force(const Fibre& fibre, const VecX& x, VecX& f);
// Adds the exact stiffness, which is positive as a fibre only pulls; or calls `add` for its blocks and their slots in a
// matrix of that pattern.
void add_fibre_stiffness(const Fibre& fibre, const VecX& x, double scale, BlockMatrix& A);
void for_each_fibre_block(const Fibre& fibre, const VecX& x, double scale, const BlockPattern& pattern,
                          const std::function<void(int slot, const Mat3& block)>& add);
// Returns by how much the energy of fibres at `to` differs from that of their forces and stiffness at `from` [J].
double miss_of_fibres(const std::vector<Fibre>& fibres, const VecX& from, const VecX& to);
// Calls `use` for each fibre of a solve.
template <class Use>
void for_each_fibre(const Loads& loads, const Use& use) {
    if (!loads.fibres) return;
    for (const Fibre& fibre : loads.fibres->list) use(fibre);
}

}  // namespace frond
