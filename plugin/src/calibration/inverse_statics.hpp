// Inverse statics: finds the shape X without gravity from which weight bends a cage to the shape x that was modelled,
// elastic forces f(x; X) + weight = 0, by Newton's method with the exact derivative by X, which takes some six rounds.
// The exact tangent at x then shows whether the plant stands there stably or would topple (Greenhill 1881).
#pragma once

#include "calibration/rest_system.hpp"
#include "calibration/static_stiffness.hpp"
#include "mechanics/tet_element.hpp"

namespace frond {

// A rest shape with its elements, and the systems that move it.
struct RestSearch {
    const Model& model;
    frond_mechanics which;
    const Mechanics& row;
    TetElements elements;
    std::vector<uint8_t> held;
    VecX x, rest;
    StaticStiffness stiffness;
    RestSystem system;
    int torn = -1;  // organ at which a balance failed

    RestSearch(const Model& model, frond_mechanics which, int order);
    RestSearch(const RestSearch&) = delete;
    RestSearch& operator=(const RestSearch&) = delete;
    void move_to(const VecX& moved);
    // Scales each tet's moduli by the exponential of `change`.
    void stiffen(const VecX& change);
};

struct RestOutcome {
    VecX rest;                   // empty unless the plant stands
    std::vector<double> shares;  // organs' shares in the energy of the mode in which it topples; empty unless it does
    double overload = 1;         // how many times too heavy it then is [-]
    int torn = -1;               // else the organ at which no balance was found
};

// Balances a share of gravity from the present rest shape; false, with that shape unchanged, if that fails.
bool balance(RestSearch& search, double gravity);
// Finds the rest shape of one mechanics, of a plant that would stand if each organ were softer by its margin. Gravity
// is increased gradually, in steps as large as the search bears.
RestOutcome search_rest_shape(RestSearch& search, const std::vector<double>& margins);

}  // namespace frond
