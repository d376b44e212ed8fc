// The functions of the rows in mechanics.cpp, one prefix a row; see struct Mechanics for what each does.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

#define FROND_MECHANICS_ROW(prefix)                                                                     \
    double prefix##_energy(const Elements&, const VecX& x);                                             \
    int prefix##_add_force(const Elements&, const VecX& x, VecX& f);                                    \
    void prefix##_add_stiffness(const Elements&, const VecX& x, Tangent, double scale, BlockMatrix& K); \
    int prefix##_add_both(const Elements&, const VecX& x, Tangent, VecX& f, BlockMatrix& K);

FROND_MECHANICS_ROW(tet_linear)
FROND_MECHANICS_ROW(tet_corotational)
FROND_MECHANICS_ROW(tet_neohookean)
FROND_MECHANICS_ROW(rod)
#undef FROND_MECHANICS_ROW

// What the tet mechanics have in common.
std::unique_ptr<const Elements> make_tets(const Model& model, frond_mechanics which);
Masses tet_masses(const Elements&, frond_mass mass);
bool tets_are_calm(const Elements&, const VecX& from, const VecX& to);

// What the chain mechanics have in common.
std::unique_ptr<const Elements> make_rods(const Model& model, frond_mechanics which);
Masses rod_masses(const Elements&, frond_mass mass);
void rod_inertia(const Elements&, const VecX& x, std::vector<Mat3>& out);
bool rods_are_calm(const Elements&, const VecX& from, const VecX& to);

}  // namespace frond
