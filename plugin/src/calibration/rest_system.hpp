// Derivative of a cage's balance at given positions by its positions at rest: an unsymmetric sparse system, for
// Newton's method of inverse statics.
#pragma once

#include <memory>

#include "mechanics/mechanics.hpp"

namespace frond {

// Returns elastic force and weight at x, zero for held nodes [N].
VecX unbalanced_force(const TetElements& elements, const std::vector<uint8_t>& held, frond_mechanics which,
                      const VecX& x, double gravity);

class RestSystem {
public:
    // Takes the elements' pattern; held nodes stay where they are at rest.
    RestSystem(const TetElements& elements, std::vector<uint8_t> held);
    ~RestSystem();
    // Finds the displacement of the rest positions after which, to first order, nothing is unbalanced; false if there
    // is none.
    bool find_move(const TetElements& elements, frond_mechanics which, const VecX& x, double gravity,
                   const VecX& unbalanced, VecX& move);

private:
    struct Inside;
    std::unique_ptr<Inside> inside;
};

}  // namespace frond
