// The table of mechanics: one row for each name in FROND_MECHANICS.
#include "mechanics/mechanics.hpp"

#include "mechanics/rows.hpp"

namespace frond {

const Mechanics& mechanics(frond_mechanics which) {
    static const Mechanics TABLE[] = {
        {"tet_linear", tet_linear_energy, tet_linear_add_force, tet_linear_add_stiffness, tet_linear_add_both, false},
        {"tet_corotational", tet_corotational_energy, tet_corotational_add_force, tet_corotational_add_stiffness,
         tet_corotational_add_both, false},
        {"tet_neohookean", tet_neohookean_energy, tet_neohookean_add_force, tet_neohookean_add_stiffness,
         tet_neohookean_add_both, true},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_MECHANICS_COUNT, "every mechanics needs its row");
    return TABLE[which];
}

}  // namespace frond
