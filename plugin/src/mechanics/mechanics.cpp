// The table of mechanics: one row for each name in FROND_MECHANICS.
#include "mechanics/mechanics.hpp"

#include "mechanics/rows.hpp"

namespace frond {

const Mechanics& mechanics(frond_mechanics which) {
#define TETS(prefix, needs_search)                                                                   \
    {                                                                                                \
        #prefix, make_tets, tet_masses, prefix##_energy, prefix##_add_force, prefix##_add_stiffness, \
            prefix##_add_both, nullptr, tets_are_calm, needs_search, false                           \
    }
#define RODS(name)                                                                                                    \
    {                                                                                                                 \
        name, make_rods, rod_masses, rod_energy, rod_add_force, rod_add_stiffness, rod_add_both, rod_inertia,          \
            rods_are_calm, false, true                                                                                \
    }
    static const Mechanics TABLE[] = {
        TETS(tet_linear, false),
        TETS(tet_corotational, false),
        TETS(tet_neohookean, true),
        RODS("rod"),
        RODS("spring_chain"),
    };
#undef TETS
#undef RODS
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_MECHANICS_COUNT, "every mechanics needs its row");
    return TABLE[which];
}

}  // namespace frond
