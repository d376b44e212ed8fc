// The plasticity of tets, as far as materials share it.
#pragma once

#include "mechanics/tet_element.hpp"

namespace frond {

// The elastic stretch S at a point, a symmetric matrix, and the strain of a bar that is pulled as much out of shape:
// that of von Mises, of logarithmic strains [-]; 0 for what is turned inside out or flat.
struct Strained {
    Mat3 S;
    double strain;
};
// Nearly the same by Green's strain, for strains that are small; without a rotation, and of any F.
double green_strain(const TetShare& share, const Mat3& F);
Strained strained_at(const TetShare& share, const Mat3& F);
// Tells whether that strain is beyond `most`, never where `most` is zero. Most tets need no rotation for it.
bool exceeds(const TetShare& share, const Mat3& F, double most, Strained& out);
// Up to which square of its deviator, of Green's strain, a tet is far from its yield; infinite where it has none.
double green_square_allowed(const TetElements& elements, size_t e);
// Makes 1 - `elastic` of the distortion of S lasting: F becomes F times this, of determinant one.
Mat3 flow_of(const Mat3& S, double elastic);

// Sets `yields` of elements that are complete otherwise.
void let_tets_yield(const Model& model, TetElements& elements);
template <class Element>
bool tets_yield(const Elements& elements, const VecX& x);
std::unique_ptr<Elements> copy_tets(const Elements& elements);
std::vector<double> plastic_of_tets(const Elements& own);
void set_plastic_of_tets(Elements& own, const std::vector<double>& values);

}  // namespace frond
