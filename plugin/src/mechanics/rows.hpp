// Functions that the rows in mechanics.cpp are made of.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// Make the rows of tets, for elements of an order.
Mechanics tet_linear(int order);
Mechanics tet_corotational(int order);
Mechanics tet_neohookean(int order);

// Functions that these rows share.
template <int ORDER>
std::unique_ptr<const Elements> make_tets(const Model& model, frond_mechanics which);
Masses tet_masses(const Elements&, frond_mass mass);
void tet_section_strains(const Elements&, const VecX& x, std::vector<double>& out);
std::unique_ptr<Elements> without_tets(const Elements&, const std::vector<uint8_t>& gone);
// Trust bound of tets in is_calm(): change of the deformation gradient [-]; as a rotation, about 20 degrees.
constexpr double LARGEST_CHANGE = 0.5;
template <class Element>
bool tets_are_calm(const Elements&, const VecX& from, const VecX& to);

// The rows of the chain mechanics; see struct Mechanics for what each function does.
std::unique_ptr<const Elements> make_rods(const Model& model, frond_mechanics which);
Masses rod_masses(const Elements&, frond_mass mass);
double rod_energy(const Elements&, const VecX& x);
int rod_add_force(const Elements&, const VecX& x, VecX& f);
void rod_add_stiffness(const Elements&, const VecX& x, Tangent, double scale, BlockMatrix& K);
int rod_add_both(const Elements&, const VecX& x, Tangent, VecX& f, BlockMatrix& K);
int rod_add_damped(const Elements&, const VecX& x, const std::vector<double>& damping, VecX& f, BlockMatrix& K,
                   BlockMatrix& D);
int rod_add_ahead(const Elements&, const VecX& x, const Ahead&, VecX& f, BlockMatrix& A);
void rod_inertia(const Elements&, const VecX& x, std::vector<Mat3>& out);
bool rods_yield(const Elements&, const VecX& x);
std::unique_ptr<Elements> copy_rods(const Elements&);
void rods_flow(Elements& own, const VecX& x, double h);
std::vector<double> plastic_of_rods(const Elements& own);
void set_plastic_of_rods(Elements& own, const std::vector<double>& values);
void rod_section_strains(const Elements&, const VecX& x, std::vector<double>& out);
std::unique_ptr<Elements> without_rods(const Elements&, const std::vector<uint8_t>& gone);
bool rods_are_calm(const Elements&, const VecX& from, const VecX& to);
void retract_rods(const Elements&, const VecX& from, const VecX& end, const std::vector<uint8_t>& held, VecX& out);
unsigned retract_rods_of_batch(const Elements&, const NumbersInLines& from, const NumbersInLines& end,
                               const std::vector<uint8_t>& held, const NumbersInLines& seen, NumbersInLines& out);
// Trust bounds of rods in is_calm(): rotation of a node [rad], and change of a segment's chord over its length [-].
constexpr double LARGEST_TURN = 0.35, LARGEST_STRETCH = 0.5;
const BatchMechanics& rod_batch();

}  // namespace frond
