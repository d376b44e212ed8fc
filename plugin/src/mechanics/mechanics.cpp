// The table of mechanics: one row for each name in FROND_MECHANICS and each order of elements.
#include "mechanics/mechanics.hpp"

#include "mechanics/rows.hpp"

namespace frond {

static Mechanics rods(const char* name) {
    return {name,
            make_rods,
            rod_masses,
            rod_energy,
            rod_add_force,
            rod_add_stiffness,
            rod_add_both,
            rod_add_damped,
            rod_add_ahead,
            rod_inertia,
            rods_are_calm,
            nullptr,
            rods_yield,
            copy_rods,
            rods_flow,
            plastic_of_rods,
            set_plastic_of_rods,
            rod_section_strains,
            without_rods,
            false,
            true,
            true,
            &rod_batch(),
            retract_rods};
}

const Mechanics& mechanics(frond_mechanics which, int order) {
    using Rows = std::array<Mechanics, FROND_MECHANICS_COUNT>;
    const auto rows = [](int n) {
        return Rows{tet_linear(n), tet_corotational(n), tet_neohookean(n), rods("rod"), rods("spring_chain")};
    };
    static const std::array<Rows, HIGHEST_ORDER> TABLE = {rows(1), rows(2)};
    static_assert(FROND_MECHANICS_COUNT == 5, "every mechanics needs its row");
    return TABLE[size_t(order - 1)][size_t(which)];
}

}  // namespace frond
