// The functions of the rows in mechanics.cpp, one prefix a row; see struct Mechanics for what each does.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

#define FROND_MECHANICS_ROW(prefix)                                                                        \
    double prefix##_energy(const TetElements&, const VecX& x);                                             \
    int prefix##_add_force(const TetElements&, const VecX& x, VecX& f);                                    \
    void prefix##_add_stiffness(const TetElements&, const VecX& x, Tangent, double scale, BlockMatrix& K); \
    int prefix##_add_both(const TetElements&, const VecX& x, Tangent, VecX& f, BlockMatrix& K);

FROND_MECHANICS_ROW(tet_linear)
FROND_MECHANICS_ROW(tet_corotational)
FROND_MECHANICS_ROW(tet_neohookean)
#undef FROND_MECHANICS_ROW

}  // namespace frond
