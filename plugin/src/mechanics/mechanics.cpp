// The table of mechanics: one row for each name in FROND_MECHANICS and each order of elements.
#include "mechanics/mechanics.hpp"

#include "mechanics/rows.hpp"

namespace frond {

static Mechanics rods(const char* name, double asked_from) {
    Mechanics row;
    row.name = name;
    row.make = make_rods;
    row.masses = rod_masses;
    row.energy = rod_energy;
    row.add_force = rod_add_force;
    row.add_stiffness = rod_add_stiffness;
    row.add_force_and_stiffness = rod_add_both;
    row.add_force_stiffness_and_damping = rod_add_damped;
    row.add_ahead = rod_add_ahead;
    row.rotary_inertia = rod_inertia;
    row.is_calm = rods_are_calm;
    row.yields = rods_yield;
    row.copy = copy_rods;
    row.flow = rods_flow;
    row.get_plastic = plastic_of_rods;
    row.set_plastic = set_plastic_of_rods;
    row.section_strains = rod_section_strains;
    row.without = without_rods;
    row.moves_chain = true;
    row.asked_from = asked_from;
    row.batch = &rod_batch();
    row.retract = retract_rods;
    return row;
}

const Mechanics& mechanics(frond_mechanics which, int order) {
    using Rows = std::array<Mechanics, FROND_MECHANICS_COUNT>;
    const auto rows = [](int n) {
        return Rows{tet_linear(n), tet_corotational(n), tet_neohookean(n), rods("rod", 0),
                    rods("spring_chain", 1.0 / 3)};
    };
    static const std::array<Rows, HIGHEST_ORDER> TABLE = {rows(1), rows(2)};
    static_assert(FROND_MECHANICS_COUNT == 5, "every mechanics needs its row");
    return TABLE[size_t(order - 1)][size_t(which)];
}

}  // namespace frond
