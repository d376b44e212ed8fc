// Plasticity of tets: what all materials share.
#pragma once

#include "mechanics/tet_element.hpp"

namespace frond {

// Elastic stretch S at a point, a symmetric matrix, and its equivalent strain after von Mises, that of an equally
// distorted pulled bar, from logarithmic strains [-]; 0 if inverted or flat.
struct Strained {
    Mat3 S;
    double strain;
};
// Returns nearly the same strain by Green's strain, if strains are small; needs no rotation and takes any F.
double green_strain(const TetShare& share, const Mat3& F);
Strained strained_at(const TetShare& share, const Mat3& F);
// Returns whether that strain is above `most`; never if `most` is zero. Most tets need no rotation for it.
bool exceeds(const TetShare& share, const Mat3& F, double most, Strained& out);
// Returns the squared norm of Green's strain deviator up to which a tet is far from yielding; infinite: never yields.
double green_square_allowed(const TetElements& elements, size_t e);
// Returns the change, of determinant one, that F is multiplied by to make 1 - `elastic` of S's distortion plastic.
Mat3 flow_of(const Mat3& S, double elastic);

// Sets `yields` of elements that are otherwise complete.
void let_tets_yield(const Model& model, TetElements& elements);
template <class Element>
bool tets_yield(const Elements& elements, const VecX& x);
std::unique_ptr<Elements> copy_tets(const Elements& elements);
std::vector<double> plastic_of_tets(const Elements& own);
void set_plastic_of_tets(Elements& own, const std::vector<double>& values);

}  // namespace frond
